// Counting and reading.
#include "pmq/query/queries.hpp"

#include "pmq/query/scan.hpp"

#include <algorithm>

namespace locus::pmq {

uint64_t count(const View &view, const Selection &selection) {
    const Selection live = selection.at(view.moment());
    uint64_t total = 0;
    for_each_range(view, live.region, [&](const RangeAt &range) {
        total += count_in(view, live, range);
        return true;
    });
    return total;
}

namespace {

// The first `most` records of a block.
void copy_all(const Block &block, size_t size, std::byte *to, size_t most) noexcept {
    const size_t count = std::min(block.count, most);
    if (!block.order && block.record_stride == size) // as they stand
        std::copy_n(block.records, count * size, to);
    else
        for (size_t i = 0; i < count; ++i)
            copy_record(to + i * size, block.record(block.entry(i)), size);
}

} // namespace

size_t read(const View &view, const Selection &selection, Order order, std::byte *records, size_t capacity) {
    const size_t size = view.format().size;
    const Selection live = selection.at(view.moment());
    size_t found = 0;
    for_each_range(view, live.region, [&](const RangeAt &range) {
        const Acceptance accepted(view, live, range);
        return view.scan(range.place, range.keys, live.times.from, order, [&](const Block &block) {
            if (accepted.all_of(block)) {
                if (found < capacity)
                    copy_all(block, size, records + found * size, capacity - found);
                found += block.count;
                return true;
            }
            return accepted.for_each(block, [&](size_t entry) {
                if (found < capacity)
                    copy_record(records + found * size, block.record(entry), size);
                ++found;
                return true;
            });
        });
    });
    return found;
}

bool visit(const View &view, const Selection &selection, Order order, locus_visit_fn visit, void *user) {
    return for_each_record(view, selection, order, [&](uint64_t, Bytes record) { return visit(record, user) == 0; });
}

} // namespace locus::pmq
