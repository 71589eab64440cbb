// The memory of one leaf: a ring of slots in order of arrival, all keys first, then all records.
#pragma once

#include "pmq/record.hpp"

namespace locus::pmq {

using LeafMemory = std::byte *;

// The slots of a record layout's leaves. Both sizes come out as whole pages.
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
    // The slot of the ring's entry number `entry`, counted from `head`.
    size_t slot(size_t head, size_t entry) const noexcept {
        const size_t slot = head + entry;
        return slot < slots ? slot : slot - slots;
    }
};

} // namespace locus::pmq
