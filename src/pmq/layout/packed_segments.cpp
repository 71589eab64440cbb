// Searches over the segments. The implicit index is no more than these (thesis section 3.4.2).
#include "pmq/layout/packed_segments.hpp"

#include <algorithm>

namespace locus::pmq {

Segments::Segments(const RecordFormat &format, const Densities &densities, Keys keys, unsigned height)
    : windows(densities, height), slots(format, windows.slots(), keys), heads(keys == Keys::apart ? count() : 0) {
    slots.set_key(0, 0); // fill() sets the heads; the one segment of an empty array is never filled
}

size_t Segments::bytes(const RecordFormat &format, const Densities &densities, Keys keys, unsigned height) noexcept {
    return (size_t{densities.segment_slots} << height) * Slots::bytes(format, keys) + Windows::bytes(height) +
           (keys == Keys::apart ? Heads::bytes(size_t{1} << height) : 0);
}

void Segments::index_heads(size_t first, size_t segments) noexcept {
    if (!heads.present())
        return;
    for (size_t s = first; s < first + segments; ++s)
        heads.set(s, slots.key(slot(s)));
    heads.renew(first, segments);
}

size_t Segments::locate(uint64_t key, size_t first, size_t last) const noexcept {
    constexpr size_t few = 64; // segments, among which halving is as quick as coming down from the top
    if (heads.present() && last - first > few)
        return std::clamp(heads.find_below(key), first, last);
    size_t length = last - first; // the answer is first or one of the `length` segments behind it
    while (length > 0) {
        const size_t half = (length + 1) / 2;
        first = head(first + half) < key ? first + half : first;
        length -= half;
    }
    return first;
}

size_t Segments::below(size_t segment, uint64_t key) const noexcept {
    const size_t start = slot(segment);
    size_t low = 0, length = size(segment);
    while (length > 8) {
        const size_t half = length / 2;
        low = slots.key(start + low + half) < key ? low + half : low;
        length -= half;
    }
    size_t smaller = low;
    for (size_t i = 0; i < length; ++i)
        smaller += slots.key(start + low + i) < key;
    return smaller;
}

uint64_t Segments::count(const KeyRange &keys, size_t first, size_t last) const noexcept {
    const size_t a = locate(keys.lo, first, last);
    const size_t b = locate(keys.hi, a, last);
    return windows.between(a, b) + below(b, keys.hi) - below(a, keys.lo);
}

} // namespace locus::pmq
