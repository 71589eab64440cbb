// The sorted array with gaps: segments packed to the left, and the searches over them.
//
// The first slot of a segment holds its head, a separator of keys even where the segment is empty: every key in the
// segments before is <= head, every key from it on is >= head. In a segment with records the head is the first one's
// key.
#pragma once

#include "core/zcurve.hpp"
#include "pmq/layout/packed_heads.hpp"
#include "pmq/layout/packed_slots.hpp"
#include "pmq/layout/packed_windows.hpp"

namespace locus::pmq {

class Segments {
public:
    Segments() = default;
    // With keys apart there is a search index over the heads.
    Segments(const RecordFormat &format, const Densities &densities, Keys keys, unsigned height);
    static size_t bytes(const RecordFormat &format, const Densities &densities, Keys keys, unsigned height) noexcept;

    Windows windows;
    Slots slots;
    Heads heads;

    size_t count() const noexcept { return windows.segments(); }
    size_t size(size_t segment) const noexcept { return windows.count(0, segment); }
    size_t slot(size_t segment) const noexcept { return segment << windows.segment_shift(); }
    uint64_t head(size_t segment) const noexcept { return heads.present() ? heads[segment] : slots.key(slot(segment)); }
    // Renew the index over the heads of segments that were rewritten.
    void index_heads(size_t first, size_t segments) noexcept;

    // Of the segments first..last the last one whose head is below `key`, or `first`: the first record with a key not
    // below `key` is there or right behind it.
    size_t locate(uint64_t key, size_t first, size_t last) const noexcept;
    // How many records of the segment have a smaller key.
    size_t below(size_t segment, uint64_t key) const noexcept;
    // The records with keys in the range among the segments first..last.
    uint64_t count(const KeyRange &keys, size_t first, size_t last) const noexcept;

    // Spread `total` records evenly over the segments from `first` on; `source` has key(), record() and next() and ends
    // after exactly that many. Counts above the segments are the caller's to renew.
    template <typename Source>
    void fill(size_t first, size_t segments, uint64_t total, Source &&source) noexcept;
};

template <typename Source>
void Segments::fill(size_t first, size_t segments, uint64_t total, Source &&source) noexcept {
    const EvenSpread spread{total, segments};
    uint64_t placed = 0, last_key = 0;
    for (size_t s = 0; s < segments; ++s) {
        const uint64_t end = spread.share(s + 1);
        const size_t start = slot(first + s);
        windows.set_segment(first + s, end - placed);
        // An empty segment takes the next record's key for its head; behind the last one, that one's.
        if (placed == end && total != 0)
            slots.set_key(start, placed < total ? source.key() : last_key);
        for (size_t i = start; placed < end; ++i, ++placed, source.next()) {
            last_key = source.key();
            slots.put(i, last_key, source.record());
        }
    }
}

} // namespace locus::pmq
