// The visit of a brick by a block, in its shared memory: pull words from all neighbours until nothing in the brick
// changes, write back what did, and wake the bricks around that would now improve. Words of a brick are written by its
// own visit only, and a brick is visited once in a round; the border is read while its owners may be at work, and a
// value that comes too late wakes this brick again.
#pragma once

#include "graph/device/block.hpp"
#include "graph/device/bricks.hpp"
#include "graph/device/neighbours.hpp"
#include "graph/device/rules.hpp"

namespace locus::device {

// A brick's cells are numbered x fastest in 10 x 10 x 10, its own voxels in the middle.
LOCUS_HD constexpr unsigned cell_of(unsigned voxel) {
    return voxel % kSide + 1 + kHalo * (voxel / kSide % kSide + 1 + kHalo * (voxel / (kSide * kSide) + 1));
}
// Where a cell lies: on each axis -1 before the brick, 0 in it, 1 behind it; and its voxel in the brick it belongs to.
struct CellPlace {
    unsigned at[3];
    int side[3];
    unsigned voxel;

    LOCUS_HD explicit CellPlace(unsigned cell) : at{cell % kHalo, cell / kHalo % kHalo, cell / (kHalo * kHalo)} {
        voxel = 0;
        for (unsigned a = 3; a-- > 0;) {
            side[a] = at[a] == 0 ? -1 : at[a] == kHalo - 1 ? 1 : 0;
            voxel = kSide * voxel + (at[a] + kSide - 1) % kSide;
        }
    }
    LOCUS_HD unsigned side_number() const {
        return static_cast<unsigned>(side[0] + 1 + 3 * (side[1] + 1) + 9 * (side[2] + 1));
    }
};

// The rows that look at row (y, z), itself included, as bits y + 8 * z.
LOCUS_HD constexpr uint64_t rows_around(unsigned row) {
    const unsigned y = row % kSide, z = row / kSide;
    const uint64_t beside = (y == 0 ? 0x3u : y == kSide - 1 ? 0xC0u : 0x7u << (y - 1)) & 0xFFu;
    return beside << kSide * z | (z > 0 ? beside << kSide * (z - 1) : 0) |
           (z + 1 < kSide ? beside << kSide * (z + 1) : 0);
}

// Weights edge by edge: any rule.
template <typename Word, typename Rule>
struct EdgeCells {
    struct Shared {
        Word word[kCells];
        float operand[kCells];
    };

    LOCUS_HD static void load(Shared &s, const Rule &, uint32_t, unsigned cell, Word word, float operand) {
        s.word[cell] = word;
        s.operand[cell] = operand;
    }
    LOCUS_HD static void store(Shared &s, unsigned cell, Word word) { s.word[cell] = word; }
    // What `from` offers to `to`, but for the part that end() adds.
    LOCUS_HD static Word offer(const Shared &s, const Rule &rule, uint32_t label_bits, unsigned from, unsigned to,
                               unsigned axes) {
        return s.word[from] + (rule(s.operand[from], s.operand[to], axes) << label_bits);
    }
    LOCUS_HD static Word end(const Shared &, Word offered, unsigned, unsigned) { return offered; }
};

// Mean compliance with equal spacings: each cell keeps its word plus its half of the weight, by the number of axes.
template <typename Word>
struct HalfSumCells {
    struct Shared {
        Word word[kCells];
        Word lead[3][kCells];
    };

    LOCUS_HD static void load(Shared &s, const HalfSumRule<Word> &rule, uint32_t label_bits, unsigned cell, Word word,
                              float operand) {
        s.word[cell] = word;
        s.lead[0][cell] = word + (rule.half(operand, 1) << label_bits);
        s.lead[1][cell] = word + (rule.half(operand, 3) << label_bits);
        s.lead[2][cell] = word + (rule.half(operand, 7) << label_bits);
    }
    LOCUS_HD static void store(Shared &s, unsigned cell, Word word) {
        const Word fallen = word - s.word[cell]; // modulo the word: right when it rises too
        s.word[cell] = word;
        LOCUS_UNROLL
        for (unsigned i = 0; i < 3; ++i)
            s.lead[i][cell] += fallen;
    }
    LOCUS_HD static Word offer(const Shared &s, const HalfSumRule<Word> &, uint32_t, unsigned from, unsigned,
                               unsigned axes) {
        return s.lead[moves(axes) - 1][from];
    }
    LOCUS_HD static Word end(const Shared &s, Word offered, unsigned to, unsigned moved) {
        return offered + (s.lead[moved - 1][to] - s.word[to]);
    }
};

template <typename Word, typename Rule, typename Cells, bool raising>
struct Visit {
    static constexpr unsigned threads = 256;
    static constexpr unsigned per_thread = kVoxels / threads;

    struct Shared {
        typename Cells::Shared cells;
        uint64_t active[3];  // rows to look at, by pass modulo 3
        uint64_t changed[8]; // voxels, a word per z
        Word wake[27];       // by the neighbour's side: the smallest word that it would take
        uint32_t brick;
        uint32_t any;
        int place[3];
    };
    struct Local {
        Word best[per_thread];
        uint32_t open[per_thread];
        uint32_t changed; // its voxels, as bits
    };

    Bricks<Word> bricks;
    Rounds<Word> rounds;
    Rule rule;
    Seeds<Word> seeds; // raising: these voxels need no support
    uint32_t label_bits;
    uint32_t round;

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        for (;;) {
            block.each([&](unsigned thread, Local &) { begin(s, thread); });
            if (s.brick == kNoBrick)
                break;
            block.each([&](unsigned thread, Local &local) { load(s, thread, local); });
            uint32_t pass = 0;
            while (s.active[pass % 3] != 0) {
                block.each([&](unsigned thread, Local &local) { pull(s, thread, local, pass); });
                block.each([&](unsigned thread, Local &local) { take(s, thread, local, pass); });
                ++pass;
            }
            block.each([&](unsigned thread, Local &local) { store(s, thread, local); });
            if (s.any != 0)
                block.each([&](unsigned thread, Local &) { look_across(s, thread); });
            block.each([&](unsigned thread, Local &) { end(s, thread, pass); });
        }
    }

private:
    // Take the next brick of the round.
    LOCUS_HD void begin(Shared &s, unsigned thread) const {
        if (thread < 27)
            s.wake[thread] = kNoKey<Word>;
        if (thread < 8)
            s.changed[thread] = 0;
        if (thread != 0)
            return;
        Round<Word> &now = rounds.control->round[round];
        const uint32_t ticket = atomic_add(&now.taken, 1u);
        s.brick = ticket < now.near ? rounds.near[ticket] : kNoBrick;
        s.active[0] = ~uint64_t{0};
        s.active[1] = s.active[2] = 0;
        s.any = 0;
        if (s.brick != kNoBrick)
            bricks.layout.place(s.brick, s.place);
    }

    LOCUS_HD void load(Shared &s, unsigned thread, Local &local) const {
        local.changed = 0;
        for (unsigned cell = thread; cell < kCells; cell += threads) {
            const CellPlace at(cell);
            const uint32_t brick =
                bricks.layout.index(s.place[0] + at.side[0], s.place[1] + at.side[1], s.place[2] + at.side[2]);
            Word word = bricks.beyond;
            float operand = Rule::impassable;
            if (brick != kNoBrick) {
                const uint64_t address = uint64_t{brick} * kVoxels + at.voxel;
                word = load_shared(&bricks.words[address]);
                operand = bricks.operands[address];
            }
            Cells::load(s.cells, rule, label_bits, cell, word, operand);
        }
        LOCUS_UNROLL
        for (unsigned i = 0; i < per_thread; ++i) {
            const unsigned voxel = thread + threads * i;
            local.open[i] = bricks.open != nullptr ? bricks.open[uint64_t{s.brick} * kVoxels + voxel] : ~0u;
        }
    }

    LOCUS_HD void pull(Shared &s, unsigned thread, Local &local, uint32_t pass) const {
        if (thread == 0)
            s.active[(pass + 2) % 3] = 0;
        const uint64_t active = s.active[pass % 3];
        LOCUS_UNROLL
        for (unsigned i = 0; i < per_thread; ++i) {
            const unsigned voxel = thread + threads * i;
            if ((active >> voxel / kSide & 1) == 0)
                continue;
            const unsigned cell = cell_of(voxel);
            local.best[i] = bricks.open == nullptr ? smallest_offer<false>(s, cell, ~0u)
                                                   : smallest_offer<true>(s, cell, local.open[i]);
        }
    }
    template <bool cut>
    LOCUS_HD Word smallest_offer(const Shared &s, unsigned cell, uint32_t open) const {
        Word best[3] = {kNoKey<Word> >> 1, kNoKey<Word> >> 1, kNoKey<Word> >> 1};
        LOCUS_UNROLL
        for (int dz = -1; dz <= 1; ++dz)
            LOCUS_UNROLL
        for (int dy = -1; dy <= 1; ++dy)
            LOCUS_UNROLL
        for (int dx = -1; dx <= 1; ++dx) {
            const unsigned axes = axes_of(dx, dy, dz), moved = moves(axes);
            if (moved == 0 || moved > bricks.classes)
                continue;
            if (cut && (open >> number_of(dx, dy, dz) & 1) == 0)
                continue;
            const Word offered = Cells::offer(s.cells, rule, label_bits, beside(cell, dx, dy, dz), cell, axes);
            if (offered < best[moved - 1])
                best[moved - 1] = offered;
        }
        return nearest(s, best, cell);
    }
    LOCUS_HD Word nearest(const Shared &s, const Word (&best)[3], unsigned cell) const {
        Word least = kNoKey<Word>;
        LOCUS_UNROLL
        for (unsigned i = 0; i < 3; ++i) {
            if (i >= bricks.classes)
                continue;
            const Word offered = Cells::end(s.cells, best[i], cell, i + 1);
            if (offered < least)
                least = offered;
        }
        return least;
    }

    LOCUS_HD void take(Shared &s, unsigned thread, Local &local, uint32_t pass) const {
        const uint64_t active = s.active[pass % 3];
        LOCUS_UNROLL
        for (unsigned i = 0; i < per_thread; ++i) {
            const unsigned voxel = thread + threads * i;
            if ((active >> voxel / kSide & 1) == 0)
                continue;
            const unsigned cell = cell_of(voxel);
            const Word old = s.cells.word[cell];
            if constexpr (raising) {
                if (old >= bricks.beyond || old >= local.best[i] ||
                    seeds.hold(uint64_t{s.brick} * kVoxels + voxel, old))
                    continue;
                Cells::store(s.cells, cell, bricks.beyond);
            } else {
                if (local.best[i] >= old)
                    continue;
                Cells::store(s.cells, cell, local.best[i]);
            }
            local.changed |= 1u << i;
            atomic_or(&s.active[(pass + 1) % 3], rows_around(voxel / kSide));
        }
    }

    LOCUS_HD void store(Shared &s, unsigned thread, Local &local) const {
        LOCUS_UNROLL
        for (unsigned i = 0; i < per_thread; ++i) {
            if ((local.changed >> i & 1) == 0)
                continue;
            const unsigned voxel = thread + threads * i;
            store_shared(&bricks.words[uint64_t{s.brick} * kVoxels + voxel], s.cells.word[cell_of(voxel)]);
            atomic_or(&s.changed[voxel / (kSide * kSide)], uint64_t{1} << voxel % (kSide * kSide));
            atomic_or(&s.any, 1u);
        }
    }

    // Would a cell of the border improve by what changed here? Cut edges are not looked at: that wakes a brick in vain,
    // once. While raising, whatever touches a changed voxel may have lost its support.
    LOCUS_HD void look_across(Shared &s, unsigned thread) const {
        for (unsigned cell = thread; cell < kCells; cell += threads) {
            const CellPlace at(cell);
            const unsigned side = at.side_number();
            const Word old = s.cells.word[cell];
            if (side == 13 || (raising && old >= bricks.beyond))
                continue;
            Word best[3] = {kNoKey<Word> >> 1, kNoKey<Word> >> 1, kNoKey<Word> >> 1};
            bool any = false;
            LOCUS_UNROLL
            for (int dz = -1; dz <= 1; ++dz)
                LOCUS_UNROLL
            for (int dy = -1; dy <= 1; ++dy)
                LOCUS_UNROLL
            for (int dx = -1; dx <= 1; ++dx) {
                const unsigned axes = axes_of(dx, dy, dz), moved = moves(axes);
                if (moved == 0 || moved > bricks.classes || !changed_at(s, at, dx, dy, dz))
                    continue;
                any = true;
                const Word offered = Cells::offer(s.cells, rule, label_bits, beside(cell, dx, dy, dz), cell, axes);
                if (offered < best[moved - 1])
                    best[moved - 1] = offered;
            }
            if (!any)
                continue;
            const Word key = raising ? Word{0} : nearest(s, best, cell);
            if (raising || key < old)
                atomic_min(&s.wake[side], key);
        }
    }
    // Whether the voxel at that offset from a cell is one of the brick's own that changed.
    LOCUS_HD static bool changed_at(const Shared &s, const CellPlace &cell, int dx, int dy, int dz) {
        const unsigned vx = cell.at[0] + static_cast<unsigned>(dx) - 1, vy = cell.at[1] + static_cast<unsigned>(dy) - 1,
                       vz = cell.at[2] + static_cast<unsigned>(dz) - 1; // huge before the brick
        return vx < kSide && vy < kSide && vz < kSide && (s.changed[vz] >> (vx + kSide * vy) & 1) != 0;
    }

    LOCUS_HD void end(Shared &s, unsigned thread, uint32_t passes) const {
        if (thread < 27 && s.wake[thread] != kNoKey<Word>) {
            const uint32_t brick = bricks.layout.index(s.place[0] + static_cast<int>(thread % 3) - 1,
                                                       s.place[1] + static_cast<int>(thread / 3 % 3) - 1,
                                                       s.place[2] + static_cast<int>(thread / 9) - 1);
            if (brick != kNoBrick)
                rounds.wake(brick, s.wake[thread], (round + 1) % 3);
        }
        if (thread != 27)
            return;
        if (s.any != 0)
            rounds.touch(s.brick);
        else
            atomic_add(&rounds.control->vain, uint64_t{1});
        atomic_add(&rounds.control->visits, uint64_t{1});
        atomic_add(&rounds.control->passes, uint64_t{passes});
    }

    LOCUS_HD static constexpr unsigned beside(unsigned cell, int dx, int dy, int dz) {
        return static_cast<unsigned>(static_cast<int>(cell) + dx +
                                     static_cast<int>(kHalo) * (dy + static_cast<int>(kHalo) * dz));
    }
};

} // namespace locus::device
