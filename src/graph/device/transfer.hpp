// Small kernels between the forms that a graph's data take on a device.
#pragma once

#include "graph/device/block.hpp"
#include "graph/device/bricks.hpp"
#include "graph/device/visit.hpp"

namespace locus::device {

template <typename T>
struct Fill {
    T *to;
    T value;
    uint64_t filled;

    LOCUS_HD uint64_t count() const { return filled; }
    LOCUS_HD void operator()(uint64_t i) const { to[i] = value; }
};

// Between bricks of the whole grid and the bricks of a list, packed one after the other.
template <typename T>
struct Scatter {
    T *to;
    const T *packed;
    const uint32_t *list;
    uint64_t listed;

    LOCUS_HD uint64_t count() const { return listed * kVoxels; }
    LOCUS_HD void operator()(uint64_t i) const { to[uint64_t{list[i / kVoxels]} * kVoxels + i % kVoxels] = packed[i]; }
};
template <typename T>
struct Gather {
    T *packed;
    const T *from;
    const uint32_t *list;
    uint64_t listed;

    LOCUS_HD uint64_t count() const { return listed * kVoxels; }
    LOCUS_HD void operator()(uint64_t i) const {
        packed[i] = from[uint64_t{list[i / kVoxels]} * kVoxels + i % kVoxels];
    }
};

// Words of `planes` planes from z on, x fastest; `beyond` and above become `unreached`.
template <typename Word>
struct Export {
    Bricks<Word> bricks;
    Word *dense;
    Word unreached;
    uint64_t z, planes;

    LOCUS_HD uint64_t count() const { return bricks.layout.dims[0] * bricks.layout.dims[1] * planes; }
    LOCUS_HD void operator()(uint64_t i) const {
        const uint64_t row = i / bricks.layout.dims[0];
        const Word word = bricks.words[bricks.layout.address(i % bricks.layout.dims[0], row % bricks.layout.dims[1],
                                                             z + row / bricks.layout.dims[1])];
        dense[i] = word < bricks.beyond ? word : unreached;
    }
};

// What is found in the words of bricks.
struct Tallied {
    uint64_t reached; // voxels,
    uint64_t largest; // and the largest of their words
};

// Count over all bricks.
template <typename Word>
struct Tally {
    static constexpr unsigned threads = 256;
    struct Shared {
        Tallied sum;
    };
    struct Local {};

    Bricks<Word> bricks;
    uint64_t blocks;  // launched
    Tallied *tallied; // zeros before

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        block.each([&](unsigned thread, Local &) {
            if (thread == 0)
                s.sum = {0, 0};
        });
        block.each([&](unsigned thread, Local &) {
            Tallied own{0, 0};
            for (uint64_t brick = block.index(); brick < bricks.layout.count(); brick += blocks)
                for (unsigned voxel = thread; voxel < kVoxels; voxel += threads)
                    look(bricks.words[brick * kVoxels + voxel], own);
            add(own, &s.sum);
        });
        block.each([&](unsigned thread, Local &) {
            if (thread == 0)
                add(s.sum, tallied);
        });
    }

private:
    LOCUS_HD void look(Word word, Tallied &own) const {
        if (word >= bricks.beyond)
            return;
        ++own.reached;
        own.largest = word > own.largest ? word : own.largest;
    }
    LOCUS_HD static void add(const Tallied &part, Tallied *to) {
        if (part.reached == 0)
            return;
        atomic_add(&to->reached, part.reached);
        atomic_max(&to->largest, part.largest);
    }
};

// Wake the bricks of the list of those that changed, with the smallest word in them and on their borders; a brick that
// sees none waits for a neighbour.
template <typename Word>
struct Resume {
    static constexpr unsigned threads = 256;
    struct Shared {
        Word least;
        uint32_t ticket;
        int place[3];
    };
    struct Local {};

    Bricks<Word> bricks;
    Rounds<Word> rounds;
    uint32_t *taken; // 0 before
    uint32_t round;

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        for (;;) {
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    begin(s);
            });
            if (s.ticket >= rounds.control->touched)
                break;
            block.each([&](unsigned thread, Local &) { look(s, thread); });
            block.each([&](unsigned thread, Local &) {
                if (thread == 0 && s.least < bricks.beyond)
                    rounds.wake(rounds.touched[s.ticket], s.least, round);
            });
        }
    }

private:
    LOCUS_HD void begin(Shared &s) const {
        s.ticket = atomic_add(taken, 1u);
        s.least = kNoKey<Word>;
        if (s.ticket < rounds.control->touched)
            bricks.layout.place(rounds.touched[s.ticket], s.place);
    }
    LOCUS_HD void look(Shared &s, unsigned thread) const {
        Word least = kNoKey<Word>;
        for (unsigned cell = thread; cell < kCells; cell += threads) {
            const CellPlace at(cell);
            const uint32_t brick =
                bricks.layout.index(s.place[0] + at.side[0], s.place[1] + at.side[1], s.place[2] + at.side[2]);
            if (brick == kNoBrick)
                continue;
            const Word word = bricks.words[uint64_t{brick} * kVoxels + at.voxel];
            least = word < least ? word : least;
        }
        if (least != kNoKey<Word>)
            atomic_min(&s.least, least);
    }
};

} // namespace locus::device
