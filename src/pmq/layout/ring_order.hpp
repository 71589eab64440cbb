// Sorting the entries of one leaf by key or by time.
#pragma once

#include "pmq/layout/ring_leaf.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace locus::pmq {

// Entries to be put in order, stably: values and the numbers of their slots. A leaf's keys are near each other, and so
// are its times: buckets by their leading differing bits leave little to sort.
class LeafOrder {
public:
    void add(uint64_t value, size_t slot) noexcept {
        values_[count_] = value;
        slots_[count_++] = static_cast<uint16_t>(slot);
        lowest_ = std::min(lowest_, value);
        highest_ = std::max(highest_, value);
    }
    size_t count() const noexcept { return count_; }

    // Only then can they be sorted: keys always, times within a thousand years.
    bool sortable() const noexcept { return (highest_ - lowest_) >> (64 - slot_bits) == 0; }

    // The slots in order of their values.
    void sort(uint32_t *slots) noexcept {
        const int bits = static_cast<int>(std::bit_width(highest_ - lowest_));
        const int shift = std::max(bits - bucket_bits, 0);
        uint16_t ends[(1 << bucket_bits) + 1] = {};
        for (size_t i = 0; i < count_; ++i)
            ++ends[(values_[i] - lowest_) >> shift];
        uint16_t start = 0, most = 0;
        for (uint16_t &end : ends) {
            most = std::max(most, end);
            start = static_cast<uint16_t>(start + std::exchange(end, start));
        }
        for (size_t i = 0; i < count_; ++i)
            sorted_[ends[(values_[i] - lowest_) >> shift]++] = (values_[i] - lowest_) * LeafShape::most_slots + i;
        if (shift > 0 && most > crowded)
            std::sort(sorted_, sorted_ + count_);
        else if (shift > 0)
            insertion_sort();
        for (size_t i = 0; i < count_; ++i)
            slots[i] = slots_[sorted_[i] % LeafShape::most_slots];
    }

private:
    void insertion_sort() noexcept {
        for (size_t i = 1; i < count_; ++i) {
            const uint64_t value = sorted_[i];
            size_t at = i;
            for (; at > 0 && sorted_[at - 1] > value; --at)
                sorted_[at] = sorted_[at - 1];
            sorted_[at] = value;
        }
    }

    static constexpr int slot_bits = std::bit_width(LeafShape::most_slots - 1);
    static constexpr int bucket_bits = 9;
    static constexpr uint16_t crowded = 48;
    uint64_t values_[LeafShape::most_slots];
    uint64_t sorted_[LeafShape::most_slots];
    uint16_t slots_[LeafShape::most_slots];
    uint64_t lowest_ = UINT64_MAX, highest_ = 0;
    size_t count_ = 0;
};

} // namespace locus::pmq
