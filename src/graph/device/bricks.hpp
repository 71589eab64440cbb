// The grid in bricks of 8 x 8 x 8 voxels on a device, and the rounds in which bricks are visited. In each round the
// waiting bricks of the lowest buckets (of the smallest word that would reach them) are visited, a block each, or all
// that wait where there are blocks for them; what they wake waits for the next round. Nothing of this passes through
// the host: it only launches rounds. (Near-far lists: Davidson et al., "Work-efficient parallel GPU methods for
// single-source shortest paths", 2014.)
#pragma once

#include "graph/device/atomics.hpp"

#include <limits>

namespace locus::device {

inline constexpr unsigned kSide = 8;
inline constexpr unsigned kVoxels = kSide * kSide * kSide; // of a brick

inline constexpr uint32_t kNoBrick = std::numeric_limits<uint32_t>::max();

inline constexpr uint32_t kNoBucket = std::numeric_limits<uint32_t>::max();

struct Layout {
    uint64_t dims[3];   // voxels
    uint32_t bricks[3]; // x fastest; fewer than 2^31

    LOCUS_HD uint32_t count() const { return bricks[0] * bricks[1] * bricks[2]; }
    LOCUS_HD void place(uint32_t brick, int (&at)[3]) const {
        const uint32_t row = brick / bricks[0];
        at[0] = static_cast<int>(brick % bricks[0]);
        at[1] = static_cast<int>(row % bricks[1]);
        at[2] = static_cast<int>(row / bricks[1]);
    }
    // kNoBrick outside the grid.
    LOCUS_HD uint32_t index(int x, int y, int z) const {
        const auto ux = static_cast<uint32_t>(x), uy = static_cast<uint32_t>(y), uz = static_cast<uint32_t>(z);
        if (ux >= bricks[0] || uy >= bricks[1] || uz >= bricks[2])
            return kNoBrick;
        return ux + bricks[0] * (uy + bricks[1] * uz);
    }
    // The brick on a side, 0..26 with x fastest; 13 is the brick itself.
    LOCUS_HD uint32_t beside(uint32_t brick, unsigned side) const {
        int at[3];
        place(brick, at);
        return index(at[0] + static_cast<int>(side % 3) - 1, at[1] + static_cast<int>(side / 3 % 3) - 1,
                     at[2] + static_cast<int>(side / 9) - 1);
    }
    // Where a voxel's word and operand stand.
    LOCUS_HD uint64_t address(uint64_t x, uint64_t y, uint64_t z) const {
        const uint32_t brick =
            index(static_cast<int>(x / kSide), static_cast<int>(y / kSide), static_cast<int>(z / kSide));
        return uint64_t{brick} * kVoxels + x % kSide + kSide * (y % kSide + kSide * (z % kSide));
    }
};

// What a device holds of a graph, by address.
template <typename Word>
struct Bricks {
    Layout layout;
    Word *words;
    const float *operands;
    const uint32_t *open; // the neighbours an edge leads to, by number; null where no edge is cut
    uint32_t uncut;       // what stands there for a voxel inside the grid with all its edges
    uint32_t classes;     // 1 faces, 2 and edges, 3 and corners
    Word beyond;          // the word of a voxel that nothing has reached: just above the limit
};

// One round. Three of them take turns: while one is worked on, the next one fills, and the one after it is emptied.
struct Round {
    uint32_t least;   // the lowest bucket in its list
    uint32_t waiting; // bricks in its list
    uint32_t near;    // of them those that are visited
    uint32_t taken;   // of those the ones that a block has begun after its first one
    uint32_t reach;   // buckets behind the lowest one that are visited with it
};

struct Control {
    Round round[3];
    uint64_t rounds; // that had work
    uint64_t visits;
    uint64_t passes;  // over all rows of a brick, in all visits
    uint64_t vain;    // visits that changed nothing
    uint32_t touched; // bricks in the list of those that changed
};

struct Rounds {
    Control *control;
    uint32_t *key;        // by brick: the bucket it waits for; kNoBucket: it waits in no list
    uint32_t *waiting[3]; // the lists of the rounds; a brick stands in one list at most, and there once
    uint32_t *near;       // what the current round visits; beyond that numbers of any bricks
    uint32_t *touched;    // bricks whose words changed, null where nobody asks,
    uint32_t *is_touched; // and by brick whether it stands there
    uint32_t width_bits;  // a bucket holds 2^width_bits words
    uint32_t at_once;     // so many bricks are visited at the same time: no fewer wait for a later bucket

    template <typename Word>
    LOCUS_HD uint32_t bucket(Word word) const {
        const Word number = word >> width_bits;
        return number < kNoBucket ? static_cast<uint32_t>(number) : kNoBucket - 1;
    }
    LOCUS_HD void wake(uint32_t brick, uint32_t bucket, uint32_t round) const {
        if (atomic_min(&key[brick], bucket) == kNoBucket)
            enter(brick, round);
        lower_together(&control->round[round].least, bucket);
    }
    LOCUS_HD void enter(uint32_t brick, uint32_t round) const {
        waiting[round][take_number(&control->round[round].waiting)] = brick;
    }
    LOCUS_HD void touch(uint32_t brick) const {
        if (touched != nullptr && atomic_exchange(&is_touched[brick], 1u) == 0)
            touched[take_number(&control->touched)] = brick;
    }
    // Once near is known: the next round reaches farther where this one leaves blocks idle, and less far where many
    // visits of a block follow each other.
    LOCUS_HD void adapt(uint32_t round) const {
        const Round &now = control->round[round];
        uint32_t reach = now.reach;
        if (now.near < at_once / 2)
            reach = reach < 128 ? 2 * reach + 1 : 255;
        else if (now.near > 2 * at_once)
            reach /= 2;
        control->round[(round + 1) % 3].reach = reach;
    }
    LOCUS_HD void count(uint64_t visits, uint64_t vain, uint64_t passes) const {
        atomic_add(&control->visits, visits);
        atomic_add(&control->vain, vain);
        atomic_add(&control->passes, passes);
    }
};

// The first kernel of a round: sort its list into the bricks to visit now and those that wait on. One item more than
// the list has empties the round after the next.
struct Select {
    Rounds rounds;
    uint32_t round; // 0..2

    LOCUS_HD uint64_t count() const { return uint64_t{rounds.control->round[round].waiting} + 1; }
    LOCUS_HD void operator()(uint64_t i) const {
        Round &now = rounds.control->round[round];
        const uint32_t next = (round + 1) % 3;
        if (i >= now.waiting) {
            rounds.control->rounds += now.waiting > 0 ? 1 : 0;
            rounds.control->round[(round + 2) % 3] = {kNoBucket, 0, 0, 0, 0};
            return;
        }
        const uint32_t brick = rounds.waiting[round][i];
        const uint32_t bucket = rounds.key[brick];
        if (now.waiting <= rounds.at_once || bucket - now.least <= now.reach) {
            rounds.key[brick] = kNoBucket;
            rounds.near[take_number(&now.near)] = brick;
        } else {
            rounds.enter(brick, next);
            lower_together(&rounds.control->round[next].least, bucket);
        }
    }
};

// Wake bricks by a list, all for the lowest bucket.
struct WakeList {
    Rounds rounds;
    const uint32_t *list;
    uint64_t listed;
    uint32_t round;

    LOCUS_HD uint64_t count() const { return listed; }
    LOCUS_HD void operator()(uint64_t i) const {
        rounds.touch(list[i]);
        rounds.wake(list[i], 0, round);
    }
};

// Seeds by their address, sorted by it.
template <typename Word>
struct Seeds {
    const uint64_t *address;
    const Word *word;
    uint64_t count;

    // Whether a seed with this word or a smaller one lies there.
    LOCUS_HD bool hold(uint64_t at, Word its_word) const {
        uint64_t first = 0, last = count;
        while (first < last) {
            const uint64_t middle = first + (last - first) / 2;
            if (address[middle] < at)
                first = middle + 1;
            else
                last = middle;
        }
        for (; first < count && address[first] == at; ++first)
            if (word[first] <= its_word)
                return true;
        return false;
    }
};

// Lower the words of the seeds' voxels and wake the bricks that look at them.
template <typename Word>
struct Plant {
    Bricks<Word> bricks;
    Rounds rounds;
    Seeds<Word> seeds;
    uint32_t round;

    LOCUS_HD uint64_t count() const { return seeds.count; }
    LOCUS_HD void operator()(uint64_t i) const {
        const uint64_t at = seeds.address[i];
        const Word word = seeds.word[i];
        if (word >= bricks.beyond || atomic_min(&bricks.words[at], word) <= word)
            return;
        const auto brick = static_cast<uint32_t>(at / kVoxels);
        rounds.touch(brick);
        const unsigned voxel = static_cast<unsigned>(at % kVoxels);
        const unsigned in[3] = {voxel % kSide, voxel / kSide % kSide, voxel / (kSide * kSide)};
        int from[3], to[3], place[3];
        for (unsigned a = 0; a < 3; ++a) {
            from[a] = in[a] == 0 ? -1 : 0;
            to[a] = in[a] == kSide - 1 ? 1 : 0;
        }
        bricks.layout.place(brick, place);
        for (int dz = from[2]; dz <= to[2]; ++dz)
            for (int dy = from[1]; dy <= to[1]; ++dy)
                for (int dx = from[0]; dx <= to[0]; ++dx) {
                    const uint32_t there = bricks.layout.index(place[0] + dx, place[1] + dy, place[2] + dz);
                    if (there != kNoBrick)
                        rounds.wake(there, rounds.bucket(word), round);
                }
    }
};

} // namespace locus::device
