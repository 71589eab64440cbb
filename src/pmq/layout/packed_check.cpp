// Every invariant of the packed array.
#include "core/error.hpp"
#include "pmq/layout/packed_array.hpp"

namespace locus::pmq {
namespace {

template <typename... Parts>
void hold(bool good, const Parts &...parts) {
    if (!good)
        fail(LOCUS_E_INTERNAL, "packed array: ", parts...);
}

void check_counts(const Windows &windows) {
    for (unsigned level = 0; level <= windows.height(); ++level)
        for (size_t w = 0; w < windows.segments() >> level; ++w) {
            const uint64_t count = windows.count(level, w);
            if (level > 0)
                hold(count == windows.count(level - 1, 2 * w) + windows.count(level - 1, 2 * w + 1), "window ", w,
                     " of level ", level, " counts ", count, " records, not those of its halves");
            hold(count <= windows.most_rounded(level) && count >= windows.least_rounded(level), "window ", w,
                 " of level ", level, " has ", count, " records, not ", windows.least_rounded(level), "..",
                 windows.most_rounded(level));
        }
}

} // namespace

void PackedArray::check() const {
    check_counts(array_.windows);
    uint64_t previous = 0;
    for (size_t segment = 0; segment < array_.count(); ++segment) {
        hold(array_.head(segment) >= previous, "the head of segment ", segment, " is below what lies before it");
        previous = array_.head(segment);
        const size_t start = array_.slot(segment);
        hold(array_.head(segment) == array_.slots.key(start), "the index has another head for segment ", segment);
        for (size_t slot = start, end = start + array_.size(segment); slot < end; ++slot) {
            const uint64_t key = array_.slots.key(slot);
            hold(key >= previous && key < key_end, "the key of slot ", slot, " is out of order");
            previous = key;
            const Bytes record = array_.slots.record(slot);
            hold(key == key_of(format_.latitude(record), format_.longitude(record)), "the key of slot ", slot,
                 " is not that of its record");
            const int64_t time = format_.time(record);
            hold(time >= oldest_, "the record in slot ", slot, " is of time ", time, ", before the oldest's ", oldest_);
            hold(time <= moment_.now, "the record in slot ", slot, " is of time ", time, ", after the clock's ",
                 moment_.now);
        }
    }
    const uint64_t used = bytes(array_.windows.height());
    hold(used <= limits_.bytes, "the array has ", used, " bytes, more than the limit's ", limits_.bytes);
    hold(array_.heads.consistent(), "a sample of the heads is not the head");
    index_.check(array_);
}

} // namespace locus::pmq
