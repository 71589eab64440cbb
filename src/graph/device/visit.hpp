// The visit of a brick by a block, in its shared memory: pull words from all neighbours until nothing in the brick
// changes, write back what did, and wake the bricks around that would now improve. Words of a brick are written by its
// own visit only, and a brick is visited once in a round; the border is read while its owners may be at work, and a
// value that comes too late wakes this brick again.
#pragma once

#include "graph/device/cells.hpp"

#include <type_traits>

namespace locus::device {

template <typename Word, typename Rule, typename Cells, bool raising>
struct Visit {
    static constexpr unsigned threads = Cells::threads;
    using Own = OwnVoxels<threads>;

    struct Shared {
        typename Cells::Shared cells;
        uint32_t active[3];  // threads' rows to look at, by pass modulo 3, as bits z + 8 * row
        uint32_t wake[27];   // by the neighbour's side: the lowest bucket of what it would take
        uint32_t around[27]; // bricks
        uint32_t next;       // the ticket of the next visit
        uint32_t visits, vain;
        uint64_t passes;
    };
    struct Local {
        Word word[Own::count];
        Word best[Own::count];
        Word border[BorderCell::kinds];
        uint32_t changed; // its voxels, as bits
        bool cut;         // some edge of its voxels leads nowhere
    };

    Bricks<Word> bricks;
    Rounds rounds;
    Rule rule;
    const BorderCell *border;
    Seeds<Word> seeds; // raising: these voxels need no support
    uint32_t label_bits;
    uint32_t round;
    uint32_t blocks; // that were launched

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        block.each([&](unsigned thread, Local &) {
            if (thread == 0) {
                if (block.index() == 0)
                    rounds.adapt(round);
                s.next = static_cast<uint32_t>(block.index());
                s.visits = s.vain = 0;
                s.passes = 0;
            }
        });
        for (;;) {
            block.each([&](unsigned thread, Local &) { begin(s, thread); });
            if (s.around[13] == kNoBrick)
                break;
            block.each([&](unsigned thread, Local &local) { load(s, thread, local); });
            uint32_t pass = 0;
            while (s.active[pass % 3] != 0) {
                block.each([&](unsigned thread, Local &local) { pull(s, thread, local, pass); });
                block.each([&](unsigned thread, Local &local) { take(s, thread, local, pass); });
                ++pass;
            }
            const bool changed = pass > 1;
            block.each([&](unsigned thread, Local &local) {
                if (!changed)
                    return;
                store(s, thread, local);
                if constexpr (!raising)
                    look_across(s, thread, local);
            });
            block.each([&](unsigned thread, Local &) { end(s, thread, pass, changed); });
        }
        block.each([&](unsigned thread, Local &) {
            if (thread == 0 && s.visits != 0)
                rounds.count(s.visits, s.vain, s.passes);
        });
    }

private:
    // The brick of the block's ticket, and those around.
    LOCUS_HD void begin(Shared &s, unsigned thread) const {
        if (thread >= 27)
            return;
        if (thread < 3)
            s.active[thread] = thread == 0 ? ~0u >> (32 - kSide * Own::rows) : 0;
        s.wake[thread] = kNoBucket;
        const uint32_t near = rounds.control->round[round].near, count = bricks.layout.count();
        const uint32_t brick = rounds.near[s.next < count ? s.next : count - 1]; // not waiting for how many there are
        s.around[thread] = s.next < near ? bricks.layout.beside(brick, thread) : kNoBrick;
    }

    LOCUS_HD void load(Shared &s, unsigned thread, Local &local) const {
        if (thread == 0) {
            Round &now = rounds.control->round[round];
            s.next = now.near > blocks ? blocks + atomic_add(&now.taken, 1u) : kNoBrick;
        }
        const Own own(thread);
        const uint64_t first = uint64_t{s.around[13]} * kVoxels;
        float operand[Own::count], border_operand[BorderCell::kinds];
        LOCUS_UNROLL
        for (unsigned i = 0; i < Own::count; ++i) {
            local.word[i] = load_shared(&bricks.words[first + own.voxel(i)]);
            operand[i] = bricks.operands[first + own.voxel(i)];
        }
        local.changed = 0;
        local.cut = false;
        if (bricks.open != nullptr) {
            LOCUS_UNROLL
            for (unsigned i = 0; i < Own::count; ++i)
                local.cut = local.cut || bricks.open[first + own.voxel(i)] != bricks.uncut;
        }
        for_border(thread, [&](unsigned kind, const BorderCell &at, auto) {
            local.border[kind] = bricks.beyond;
            border_operand[kind] = Rule::impassable;
            const uint32_t brick = s.around[at.side];
            if (brick == kNoBrick)
                return;
            local.border[kind] = load_shared(&bricks.words[uint64_t{brick} * kVoxels + at.voxel]);
            border_operand[kind] = bricks.operands[uint64_t{brick} * kVoxels + at.voxel];
        });
        LOCUS_UNROLL
        for (unsigned i = 0; i < Own::count; ++i)
            Cells::put(s.cells, rule, label_bits, own.cell(i), local.word[i], operand[i]);
        for_border(thread, [&](unsigned kind, const BorderCell &at, auto) {
            Cells::put(s.cells, rule, label_bits, at.cell, local.border[kind], border_operand[kind]);
        });
    }
    // visit(kind, cell, the axes on which it lies outside) for the border cells of a thread.
    template <typename Do>
    LOCUS_HD void for_border(unsigned thread, Do &&visit) const {
        if (thread >= BorderCell::holders)
            return;
        visit(0u, border[thread], Axes<1>{});
        visit(1u, border[BorderCell::holders + thread], Axes<2>{});
        visit(2u, border[2 * BorderCell::holders + thread], Axes<4>{});
        const BorderCell last = border[3 * BorderCell::holders + thread];
        if (thread < 32)
            visit(3u, last, Axes<6>{});
        else if (thread < 64)
            visit(3u, last, Axes<5>{});
        else if (thread < 96)
            visit(3u, last, Axes<3>{});
        else if (last.side != 13)
            visit(3u, last, Axes<7>{});
    }
    template <unsigned axes>
    using Axes = std::integral_constant<unsigned, axes>;

    LOCUS_HD bool is_active(const Shared &s, const Own &own, uint32_t pass) const {
        return (s.active[pass % 3] >> (own.z + kSide * (own.y / Own::count)) & 1) != 0;
    }

    LOCUS_HD void pull(Shared &s, unsigned thread, Local &local, uint32_t pass) const {
        if (thread == 0)
            s.active[(pass + 2) % 3] = 0;
        const Own own(thread);
        if (!is_active(s, own, pass))
            return;
        if constexpr (Cells::columns)
            if (!local.cut) {
                if (bricks.classes == 3)
                    Cells::template smallest_offers<Own::count, 3, !raising>(s.cells, own.cell(0), local.word,
                                                                             local.best);
                else if (bricks.classes == 2)
                    Cells::template smallest_offers<Own::count, 2, !raising>(s.cells, own.cell(0), local.word,
                                                                             local.best);
                else
                    Cells::template smallest_offers<Own::count, 1, !raising>(s.cells, own.cell(0), local.word,
                                                                             local.best);
                return;
            }
        LOCUS_UNROLL
        for (unsigned i = 0; i < Own::count; ++i) {
            const unsigned cell = own.cell(i);
            const uint32_t open =
                local.cut ? bricks.open[uint64_t{s.around[13]} * kVoxels + own.voxel(i)] : bricks.uncut;
            local.best[i] = smallest_offer<0>(s, cell, cell, local.word[i], open);
        }
    }
    // Of those of `from` and of the cells beside it on all axes but `out`, to a cell that lies from there on the axes
    // `out`; `open`: the neighbours that count where that is none.
    template <unsigned out>
    LOCUS_HD Word smallest_offer(const Shared &s, unsigned from, unsigned to, Word word, uint32_t open) const {
        Word least = std::numeric_limits<Word>::max();
        LOCUS_UNROLL
        for (unsigned moved = 1; moved <= 3; ++moved) {
            if (moved > bricks.classes)
                continue;
            Word best = kNoOffer<Word>;
            LOCUS_UNROLL
            for (int dz = -1; dz <= 1; ++dz)
                LOCUS_UNROLL
            for (int dy = -1; dy <= 1; ++dy)
                LOCUS_UNROLL
            for (int dx = -1; dx <= 1; ++dx) {
                const unsigned axes = axes_of(dx, dy, dz);
                if ((axes & out) != 0 || moves(axes | out) != moved)
                    continue;
                const Word offered = Cells::offer(s.cells, rule, label_bits, beside(from, dx, dy, dz), to, axes | out);
                if (out != 0 || (open >> number_of(dx, dy, dz) & 1) != 0)
                    best = smaller(best, offered);
            }
            least = smaller(least, Cells::end(s.cells, best, to, word, moved));
        }
        return least;
    }

    LOCUS_HD void take(Shared &s, unsigned thread, Local &local, uint32_t pass) const {
        const Own own(thread);
        if (!is_active(s, own, pass))
            return;
        uint32_t looking = 0; // at what changed
        const unsigned row = own.y / Own::count;
        const uint32_t planes = (7u << own.z >> 1) & 0xFFu;
        LOCUS_UNROLL
        for (unsigned i = 0; i < Own::count; ++i) {
            const Word old = local.word[i];
            Word to = local.best[i];
            if constexpr (raising) {
                if (old >= bricks.beyond || old >= to ||
                    seeds.hold(uint64_t{s.around[13]} * kVoxels + own.voxel(i), old))
                    continue;
                to = bricks.beyond;
            } else if (to >= old) {
                continue;
            }
            Cells::change(s.cells, own.cell(i), old, to);
            local.word[i] = to;
            local.changed |= 1u << i;
            looking |= planes << kSide * row;
            if (i == 0 && row > 0)
                looking |= planes << kSide * (row - 1);
            if (i + 1 == Own::count && row + 1 < Own::rows)
                looking |= planes << kSide * (row + 1);
        }
        if (looking != 0)
            atomic_or(&s.active[(pass + 1) % 3], looking);
    }

    // While raising, whatever touches a changed voxel may have lost its support.
    LOCUS_HD void store(Shared &s, unsigned thread, const Local &local) const {
        const Own own(thread);
        LOCUS_UNROLL
        for (unsigned i = 0; i < Own::count; ++i) {
            if ((local.changed >> i & 1) == 0)
                continue;
            store_shared(&bricks.words[uint64_t{s.around[13]} * kVoxels + own.voxel(i)], local.word[i]);
            if constexpr (raising)
                wake_touched(s, own.x, own.y + i, own.z);
        }
    }
    LOCUS_HD void wake_touched(Shared &s, unsigned x, unsigned y, unsigned z) const {
        const unsigned at[3] = {x, y, z};
        int from[3], to[3];
        LOCUS_UNROLL
        for (unsigned a = 0; a < 3; ++a) {
            from[a] = at[a] == 0 ? -1 : 0;
            to[a] = at[a] == kSide - 1 ? 1 : 0;
        }
        for (int dz = from[2]; dz <= to[2]; ++dz)
            for (int dy = from[1]; dy <= to[1]; ++dy)
                for (int dx = from[0]; dx <= to[0]; ++dx)
                    if (const unsigned moved = moves(axes_of(dx, dy, dz)); moved != 0 && moved <= bricks.classes)
                        store_shared(&s.wake[13 + dx + 3 * dy + 9 * dz], 0u);
    }

    // Would a cell of the border improve? Cut edges are not looked at: that wakes a brick in vain, once. Nor is it held
    // against an offer that another cell of the border makes it: its owner has made that one too.
    LOCUS_HD void look_across(Shared &s, unsigned thread, const Local &local) const {
        for_border(thread, [&]<unsigned out>(unsigned kind, const BorderCell &at, Axes<out>) {
            if (moves(out) > bricks.classes)
                return;
            const Word word = local.border[kind], offered = smallest_offer<out>(s, at.nearest, at.cell, word, ~0u);
            if (offered < word)
                atomic_min(&s.wake[at.side], rounds.bucket(offered));
        });
    }

    LOCUS_HD void end(Shared &s, unsigned thread, uint32_t passes, bool changed) const {
        if (thread < 27 && s.wake[thread] != kNoBucket && s.around[thread] != kNoBrick)
            rounds.wake(s.around[thread], s.wake[thread], (round + 1) % 3);
        if (thread != 27)
            return;
        if (changed)
            rounds.touch(s.around[13]);
        else
            ++s.vain;
        ++s.visits;
        s.passes += passes;
    }
};

} // namespace locus::device
