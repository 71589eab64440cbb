// Counts per value of a field.
#include "pmq/query/queries.hpp"
#include "pmq/query/ranges.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace locus::pmq {

std::vector<locus_pmq_group> groups(const View &view, const Selection &selection,
                                    FunctionRef<uint64_t(Bytes record)> group) {
    std::unordered_map<uint64_t, locus_pmq_group> found;
    const RecordFormat &format = view.format();
    for_each_record(view, selection, Order::any, [&](uint64_t, Bytes record) {
        const uint64_t value = group(record);
        const int64_t time = format.time(record);
        locus_pmq_group &mine = found.try_emplace(value, locus_pmq_group{value, 0, time}).first->second;
        ++mine.count;
        mine.newest = std::max(mine.newest, time);
        return true;
    });
    std::vector<locus_pmq_group> sorted;
    sorted.reserve(found.size());
    for (const auto &[value, counted] : found)
        sorted.push_back(counted);
    std::sort(sorted.begin(), sorted.end(), [](const locus_pmq_group &a, const locus_pmq_group &b) {
        return std::tuple(b.count, a.value) < std::tuple(a.count, b.value);
    });
    return sorted;
}

} // namespace locus::pmq
