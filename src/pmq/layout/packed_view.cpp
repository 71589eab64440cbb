// Reading the packed array.
#include "pmq/layout/packed_array.hpp"

namespace locus::pmq {

Place PackedArray::everywhere() const noexcept {
    return index_.present() ? index_.everywhere() : Place{0, array_.count() - 1};
}

Place PackedArray::narrow(const Place &outer, const Quadrant &quadrant) const noexcept {
    if (index_.present())
        return index_.narrow(outer, quadrant);
    const KeyRange keys = quadrant.keys();
    const size_t first = array_.locate(keys.lo, outer.first, outer.last);
    return {first, array_.locate(keys.hi, first, outer.last)};
}

uint64_t PackedArray::count(const Place &place, const KeyRange &keys, int64_t from) const {
    if (place.empty())
        return 0;
    if (from <= oldest_)
        return array_.count(keys, place.first, place.last);
    uint64_t total = 0;
    scan(place, keys, from, Order::any, [&](const Block &block) {
        for (size_t i = 0; i < block.count; ++i)
            total += format_.time(block.record(i)) >= from;
        return true;
    });
    return total;
}

bool PackedArray::scan(const Place &place, const KeyRange &keys, int64_t, Order,
                       FunctionRef<bool(const Block &)> visit) const {
    if (place.empty())
        return true;
    const size_t first = array_.locate(keys.lo, place.first, place.last);
    const size_t last = array_.locate(keys.hi, first, place.last);
    Block block;
    block.key_stride = array_.slots.key_stride();
    block.record_stride = array_.slots.record_stride();
    block.oldest = oldest_;
    block.within = true;
    for (size_t segment = first; segment <= last; ++segment) {
        const size_t begin = segment == first ? array_.below(segment, keys.lo) : 0;
        const size_t end = segment == last ? array_.below(segment, keys.hi) : array_.size(segment);
        if (begin >= end)
            continue;
        const size_t slot = array_.slot(segment) + begin;
        block.keys = array_.slots.key_address(slot);
        block.records = array_.slots.record(slot);
        block.count = end - begin;
        if (!visit(block))
            return false;
    }
    return true;
}

LayoutStats PackedArray::stats() const {
    LayoutStats stats = counters_;
    stats.stored = array_.windows.total();
    stats.slots = array_.windows.slots();
    stats.bytes = bytes(array_.windows.height()) + index_.bytes() + scratch_size_ * Slots::bytes(format_, keys_) +
                  tasks_.capacity() * sizeof(Task) + sizeof *this;
    return stats;
}

} // namespace locus::pmq
