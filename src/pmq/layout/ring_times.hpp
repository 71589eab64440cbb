// How many of a leaf's first entries have expired is what every query asks of it. To find out without fetching records,
// a leaf keeps the times of its first entries once more: rounded to units of 2^unit microseconds, modulo 2^16, in a
// ring of their own, that of slot s at s % most_times. The writer's rounds write them down before the entries expire;
// as with the slots, what a reader may look at is never written again.
#pragma once

#include "pmq/layout/ring_directory.hpp"

#include <algorithm>
#include <bit>

namespace locus::pmq {

class HeadTimes {
public:
    HeadTimes(const LeafShape &shape, const LeafEntry &leaf) noexcept : times_(shape.times(leaf.memory)), leaf_(leaf) {}

    static constexpr uint8_t no_unit = 64;
    // The unit in which the times of a window differ by less than half of the most that comparisons bear.
    static uint8_t unit_for(const Moment &moment) noexcept {
        if (moment.cutoff == INT64_MIN)
            return no_unit; // nothing expires
        const uint64_t window = static_cast<uint64_t>(moment.now) - static_cast<uint64_t>(moment.cutoff);
        return static_cast<uint8_t>(std::max(static_cast<int>(std::bit_width(window)) - most_bits + 1, 0));
    }
    static void write(uint16_t *times, size_t slot, int64_t time, unsigned unit) noexcept {
        times[slot % LeafShape::most_times] = rounded(time, unit);
    }
    void prefetch() const noexcept {
        __builtin_prefetch(times_);
        __builtin_prefetch(times_ + LeafShape::most_times / 2);
    }
    bool says(size_t entry, int64_t time) const noexcept { return at(entry) == rounded(time, leaf_.unit); }

    // Can a time be compared with those of the leaf, which lie between leaf.oldest and `now`?
    bool tell(int64_t time, int64_t now) const noexcept {
        return leaf_.known > 0 && leaf_.oldest <= time && time <= now &&
               (static_cast<uint64_t>(now >> leaf_.unit) - static_cast<uint64_t>(leaf_.oldest >> leaf_.unit)) >>
                       most_bits ==
                   0;
    }
    // Of the known entries, which ascend: the first one that is not surely older than a time it can tell of, and, from
    // there, the first one that is surely not.
    void narrow(int64_t time, size_t &first, size_t &end) const noexcept {
        const uint16_t wanted = rounded(time, leaf_.unit);
        const auto older = [&](size_t entry) { return static_cast<int16_t>(at(entry) - wanted) < 0; };
        first = 0;
        for (size_t count = leaf_.known; count > 0;) { // without a branch to mispredict
            const size_t half = (count + 1) / 2;
            first += half & -size_t{older(first + half - 1)};
            count -= half;
        }
        for (end = first; end < leaf_.known && at(end) == wanted;)
            ++end;
    }

private:
    static constexpr int most_bits = 15;
    static uint16_t rounded(int64_t time, unsigned unit) noexcept { return static_cast<uint16_t>(time >> unit); }
    uint16_t at(size_t entry) const noexcept { return times_[(leaf_.head + entry) % LeafShape::most_times]; }

    uint16_t *times_;
    const LeafEntry &leaf_;
};

} // namespace locus::pmq
