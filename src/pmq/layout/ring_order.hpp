// Sorting the entries of one leaf by key or by time.
#pragma once

#include "pmq/layout/ring_leaf.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace locus::pmq {

// Entries to be put in order: their values and, where these are equal, their numbers. The values of a leaf are near
// each other: the leading 16 of the bits in which they differ leave little to sort.
class LeafOrder {
public:
    static constexpr uint64_t values = uint64_t{1} << 55; // all are smaller

    void add(uint64_t value, size_t number) noexcept {
        entries_[count_++] = value * LeafShape::most_slots + number;
        lowest_ = std::min(lowest_, value);
        highest_ = std::max(highest_, value);
    }
    size_t count() const noexcept { return count_; }
    size_t number(size_t i) const noexcept { return entries_[i] % LeafShape::most_slots; } // of the i-th, once sorted

    // Two passes of a radix sort, and insertion.
    void sort() noexcept {
        const uint64_t base = lowest_ * LeafShape::most_slots;
        const int bits = static_cast<int>(std::bit_width((highest_ - lowest_) * LeafShape::most_slots));
        const int low = std::max(bits - 2 * digit_bits, 0), high = low + digit_bits;
        uint16_t lows[digits] = {}, highs[digits] = {};
        for (size_t i = 0; i < count_; ++i) {
            const uint64_t entry = entries_[i] -= base;
            ++lows[(entry >> low) % digits];
            ++highs[entry >> high];
        }
        uint16_t low_start = 0, high_start = 0;
        for (size_t i = 0; i < digits; ++i) {
            low_start = static_cast<uint16_t>(low_start + std::exchange(lows[i], low_start));
            high_start = static_cast<uint16_t>(high_start + std::exchange(highs[i], high_start));
        }
        for (size_t i = 0; i < count_; ++i)
            halfway_[lows[(entries_[i] >> low) % digits]++] = entries_[i];
        for (size_t i = 0; i < count_; ++i)
            entries_[highs[halfway_[i] >> high]++] = halfway_[i];
        insert_strays();
    }

private:
    void insert_strays() noexcept {
        size_t moves = 0;
        for (size_t i = 1; i < count_; ++i) {
            const uint64_t entry = entries_[i];
            size_t at = i;
            for (; at > 0 && entries_[at - 1] > entry; --at)
                entries_[at] = entries_[at - 1];
            entries_[at] = entry;
            moves += i - at;
            if (moves > most_moves) {
                std::sort(entries_, entries_ + count_);
                return;
            }
        }
    }

    static constexpr int digit_bits = 8;
    static constexpr size_t digits = size_t{1} << digit_bits;
    static constexpr size_t most_moves = 8 * LeafShape::most_slots;
    uint64_t entries_[LeafShape::most_slots];
    uint64_t halfway_[LeafShape::most_slots];
    uint64_t lowest_ = UINT64_MAX, highest_ = 0;
    size_t count_ = 0;
};

} // namespace locus::pmq
