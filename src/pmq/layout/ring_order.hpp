// Sorting the entries of one leaf by key or by time.
#pragma once

#include "pmq/layout/ring_leaf.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace locus::pmq {

// Entries to be put in order: their values and, where these are equal, their numbers. The values of a leaf are near
// each other: the leading 16 of the bits in which they may differ leave little to sort.
class LeafOrder {
public:
    static constexpr uint64_t values = uint64_t{1} << 55; // all are smaller

    LeafOrder(uint64_t lowest, uint64_t highest) noexcept // of the values that are added, or not wanted
        : base_(lowest),
          low_(std::max(static_cast<int>(std::bit_width(highest - lowest)) + number_bits - 2 * digit_bits, 0)) {}

    // Without a branch to mispredict.
    void add(uint64_t value, size_t number, bool wanted = true) noexcept {
        const uint64_t entry = (value - base_) * LeafShape::most_slots + number;
        entries_[count_] = entry;
        count_ += wanted;
        lows_[(entry >> low_) % digits] += wanted;
        highs_[entry >> (low_ + digit_bits)] += wanted;
    }
    size_t count() const noexcept { return count_; }
    size_t number(size_t i) const noexcept { return entries_[i] % LeafShape::most_slots; } // of the i-th, once sorted

    // Two passes of a radix sort, and insertion.
    void sort() noexcept {
        if (count_ > few)
            sort_digits();
        insert_strays();
    }

private:
    void sort_digits() noexcept {
        uint16_t low_start = 0, high_start = 0;
        for (size_t i = 0; i < digits; ++i) {
            low_start = static_cast<uint16_t>(low_start + std::exchange(lows_[i], low_start));
            high_start = static_cast<uint16_t>(high_start + std::exchange(highs_[i], high_start));
        }
        const int low = low_, high = low_ + digit_bits;
        for (size_t i = 0; i < count_; ++i)
            halfway_[lows_[(entries_[i] >> low) % digits]++] = entries_[i];
        for (size_t i = 0; i < count_; ++i)
            entries_[highs_[halfway_[i] >> high]++] = halfway_[i];
    }
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

    static constexpr int digit_bits = 8, number_bits = std::bit_width(LeafShape::most_slots - 1);
    static constexpr size_t digits = size_t{1} << digit_bits;
    static constexpr size_t few = 16; // to insert them is quicker
    static constexpr size_t most_moves = 8 * LeafShape::most_slots;
    const uint64_t base_;
    const int low_; // the bits below the digits
    size_t count_ = 0;
    uint16_t lows_[digits] = {}, highs_[digits] = {}; // how many entries have a digit, then where the next one goes
    uint64_t entries_[LeafShape::most_slots];
    uint64_t halfway_[LeafShape::most_slots];
};

} // namespace locus::pmq
