// The memory of one leaf: a ring of slots in order of arrival, all keys first, then all records. The slab it lies in
// holds besides, close together, the times of every leaf's first entries (ring_times.hpp).
#pragma once

#include "pmq/record.hpp"

namespace locus::pmq {

using LeafMemory = std::byte *;

// The slots of a record layout's leaves.
struct LeafShape {
    size_t slots, record_size;

    explicit LeafShape(const RecordFormat &format) noexcept
        : slots(format.size <= 64 ? 512 : 256), record_size(format.size) {}
    static constexpr size_t most_slots = 512;

    size_t bytes() const noexcept { return slots * (sizeof(uint64_t) + record_size); }
    uint64_t *keys(LeafMemory leaf) const noexcept { return reinterpret_cast<uint64_t *>(leaf); }
    std::byte *record(LeafMemory leaf, size_t slot) const noexcept {
        return leaf + slots * sizeof(uint64_t) + slot * record_size;
    }
    // Times of a leaf's first entries: they are at the slab's beginning, as many places from it on as the leaf is
    // leaves.
    static constexpr size_t most_times = 64; // divides the number of slots
    static constexpr size_t times_bytes = most_times * sizeof(uint16_t);
    static constexpr size_t slab_span = size_t{8} << 20; // the alignment of slabs, and the largest
    uint16_t *times(LeafMemory leaf) const noexcept {
        const size_t offset = reinterpret_cast<uintptr_t>(leaf) % slab_span;
        const uint32_t place = static_cast<uint32_t>(offset) / static_cast<uint32_t>(bytes());
        return reinterpret_cast<uint16_t *>(leaf - offset + place * times_bytes);
    }
    // The slot of the ring's entry number `entry`, counted from `head`.
    size_t slot(size_t head, size_t entry) const noexcept {
        const size_t slot = head + entry;
        return slot < slots ? slot : slot - slots;
    }
};

} // namespace locus::pmq
