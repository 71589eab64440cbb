// Small kernels between the forms that a graph's data take on a device.
#pragma once

#include "graph/device/block.hpp"
#include "graph/device/bricks.hpp"
#include "graph/device/halo.hpp"
#include "graph/quantize.hpp"
#include "graph/reading.hpp"

#include <locus/diagram.h>

namespace locus::device {

template <typename T>
struct Fill {
    T *to;
    T value;
    uint64_t filled;

    LOCUS_HD uint64_t count() const { return filled; }
    LOCUS_HD void operator()(uint64_t i) const { to[i] = value; }
};

// Operands of bricks that follow each other, from materials of whole planes, x fastest.
struct Import {
    Layout layout;
    graph::Operand operand;
    float impassable; // the operand of such voxels and of those outside the grid
    const float *materials;
    uint64_t z; // of their first plane
    float *operands;
    uint64_t first, bricks;

    LOCUS_HD uint64_t count() const { return bricks * kVoxels; }
    LOCUS_HD void operator()(uint64_t i) const {
        const auto voxel = static_cast<unsigned>(i % kVoxels);
        const unsigned in[3] = {voxel % kSide, voxel / kSide % kSide, voxel / (kSide * kSide)};
        uint64_t at[3];
        int place[3];
        layout.place(static_cast<uint32_t>(first + i / kVoxels), place);
        bool inside = true;
        for (unsigned a = 0; a < 3; ++a) {
            at[a] = static_cast<uint64_t>(place[a]) * kSide + in[a];
            inside = inside && at[a] < layout.dims[a];
        }
        if (!inside) {
            operands[first * kVoxels + i] = impassable;
            return;
        }
        const float own = operand.of<float>(materials[at[0] + layout.dims[0] * (at[1] + layout.dims[1] * (at[2] - z))]);
        operands[first * kVoxels + i] = own == own ? own : impassable;
    }
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

// What a solved diagram tells of the voxels of a box, into the caller's memory.
template <typename Word>
struct Read {
    Bricks<Word> bricks;
    WordLayout layout;
    graph::Told told;
    uint64_t origin[3], extent[3];
    const uint32_t *ids; // of seeds, by label
    double scale;
    void *to;

    LOCUS_HD uint64_t count() const { return extent[0] * extent[1] * extent[2]; }
    LOCUS_HD void operator()(uint64_t i) const {
        const uint64_t row = i / extent[0];
        const Word word = bricks.words[bricks.layout.address(origin[0] + i % extent[0], origin[1] + row % extent[1],
                                                             origin[2] + row / extent[1])];
        const bool reached = word < bricks.beyond;
        switch (told) {
        case graph::Told::ids:
            static_cast<uint32_t *>(to)[i] = reached ? ids[layout.label(word)] : LOCUS_NO_SEED;
            break;
        case graph::Told::distances:
            static_cast<float *>(to)[i] = reached
                                              ? static_cast<float>(static_cast<double>(layout.distance(word)) / scale)
                                              : std::numeric_limits<float>::infinity();
            break;
        case graph::Told::exact_distances:
            static_cast<uint64_t *>(to)[i] = reached ? layout.distance(word) : UINT64_MAX;
            break;
        }
    }
};

// What the words of all voxels are, and which are not what they were before.
struct Tallied {
    uint64_t reached;           // voxels,
    uint64_t largest;           // and the largest of their words
    uint64_t changed;           // voxels,
    uint64_t first[3], last[3]; // and the box around them

    LOCUS_HD static constexpr Tallied nothing() { return {0, 0, 0, {UINT64_MAX, UINT64_MAX, UINT64_MAX}, {0, 0, 0}}; }
};

template <typename Word>
struct Tally {
    static constexpr unsigned threads = 256;
    struct Shared {
        Tallied sum;
    };
    struct Local {};

    Bricks<Word> bricks;
    Word *before;     // the words before, which become those of now; null: nobody asks what changed
    uint64_t blocks;  // launched
    Tallied *tallied; // nothing yet

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        block.each([&](unsigned thread, Local &) {
            if (thread == 0)
                s.sum = Tallied::nothing();
        });
        block.each([&](unsigned thread, Local &) {
            Tallied own = Tallied::nothing();
            for (uint64_t brick = block.index(); brick < bricks.layout.count(); brick += blocks)
                for (unsigned voxel = thread; voxel < kVoxels; voxel += threads)
                    look(static_cast<uint32_t>(brick), voxel, own);
            add(own, &s.sum);
        });
        block.each([&](unsigned thread, Local &) {
            if (thread == 0)
                add(s.sum, tallied);
        });
    }

private:
    LOCUS_HD void look(uint32_t brick, unsigned voxel, Tallied &own) const {
        const uint64_t at = uint64_t{brick} * kVoxels + voxel;
        const Word word = bricks.words[at] < bricks.beyond ? bricks.words[at] : bricks.beyond;
        if (word < bricks.beyond) {
            ++own.reached;
            own.largest = word > own.largest ? word : own.largest;
        }
        if (before == nullptr || before[at] == word)
            return;
        before[at] = word;
        ++own.changed;
        const unsigned in[3] = {voxel % kSide, voxel / kSide % kSide, voxel / (kSide * kSide)};
        int place[3];
        bricks.layout.place(brick, place);
        for (unsigned a = 0; a < 3; ++a) {
            const uint64_t x = static_cast<uint64_t>(place[a]) * kSide + in[a];
            own.first[a] = x < own.first[a] ? x : own.first[a];
            own.last[a] = x > own.last[a] ? x : own.last[a];
        }
    }
    LOCUS_HD static void add(const Tallied &part, Tallied *to) {
        if (part.reached > 0) {
            atomic_add(&to->reached, part.reached);
            atomic_max(&to->largest, part.largest);
        }
        if (part.changed == 0)
            return;
        atomic_add(&to->changed, part.changed);
        for (unsigned a = 0; a < 3; ++a) {
            atomic_min(&to->first[a], part.first[a]);
            atomic_max(&to->last[a], part.last[a]);
        }
    }
};

// Wake the bricks of the list of those that changed, for the bucket of the smallest word in them and on their borders;
// a brick that sees none waits for a neighbour.
template <typename Word>
struct Resume {
    static constexpr unsigned threads = BorderCell::holders;
    struct Shared {
        uint32_t least; // bucket
        uint32_t ticket;
        uint32_t around[27];
    };
    struct Local {};

    Bricks<Word> bricks;
    Rounds rounds;
    const BorderCell *border;
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
                if (thread == 0 && s.least != kNoBucket)
                    rounds.wake(rounds.touched[s.ticket], s.least, round);
            });
        }
    }

private:
    LOCUS_HD void begin(Shared &s) const {
        s.ticket = atomic_add(taken, 1u);
        s.least = kNoBucket;
        if (s.ticket < rounds.control->touched)
            for (unsigned side = 0; side < 27; ++side)
                s.around[side] = bricks.layout.beside(rounds.touched[s.ticket], side);
    }
    LOCUS_HD void look(Shared &s, unsigned thread) const {
        Word least = bricks.beyond;
        for (unsigned voxel = thread; voxel < kVoxels; voxel += threads)
            see(s.around[13], voxel, least);
        for (unsigned kind = 0; kind < BorderCell::kinds; ++kind) {
            const BorderCell at = border[kind * BorderCell::holders + thread];
            see(s.around[at.side], at.voxel, least);
        }
        if (least < bricks.beyond)
            atomic_min(&s.least, rounds.bucket(least));
    }
    LOCUS_HD void see(uint32_t brick, unsigned voxel, Word &least) const {
        if (brick == kNoBrick)
            return;
        const Word word = bricks.words[uint64_t{brick} * kVoxels + voxel];
        least = word < least ? word : least;
    }
};

} // namespace locus::device
