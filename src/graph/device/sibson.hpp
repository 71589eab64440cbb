// Sibson's weights on a device (thesis section 2.5.3): a block per query spreads from it, level by level, over the
// voxels that are nearer to it than to their seed, in a window of its own, and counts them by label. Many queries are
// answered in one launch; nothing is copied for them.
#pragma once

#include "graph/device/dense.hpp"

namespace locus::device {

// What becomes of a query.
struct Answer {
    static constexpr uint32_t small_window = 0xFFFFFFFF; // what it steals may leave its window
    static constexpr uint32_t no_room = 0xFFFFFFFE;      // its counts did not fit
    uint64_t first;                                      // in the counts
    uint32_t length;                                     // how many labels it steals from, or one of the above
    uint32_t unused = 0;                                 // no byte that comes back is rubbish
};

struct Stolen {
    uint32_t label;
    uint32_t voxels;
};

// Memory of one block, `window` entries each but for the fronts' and the labels'. Between queries `reach` holds kFar,
// `level` and `stolen` 0.
template <typename Word>
struct SibsonScratch {
    Word *reach;
    uint32_t *level;  // the latest level at which a cell was put into a list
    uint32_t *fronts; // cells whose distance fell, in two halves by level modulo 2
    uint32_t *touched;
    uint32_t *stolen; // by label
    uint32_t *labels; // those met
    uint64_t window, label_count;
};

template <typename Word, typename Rule>
struct Sibson {
    static constexpr unsigned threads = 128;
    static constexpr Word kFar = std::numeric_limits<Word>::max() >> 2;

    struct Shared {
        uint32_t query, touched, labels;
        uint32_t size[3]; // of the front, by level modulo 3
        uint32_t left;    // the window was left
        uint64_t base;
        uint64_t origin[3], extent[3];
    };
    struct Local {};

    Dense graph;
    Rule rule;
    const Word *words;
    Word unreached;
    uint32_t label_bits;
    const uint64_t *queries; // voxels, each reached and at a distance above 0
    uint32_t query_count;
    uint32_t *taken;             // 0 before
    uint64_t margin;             // voxels around a query that its window holds
    SibsonScratch<Word> scratch; // of block 0; the others' follow
    Answer *answers;
    Stolen *counts;
    uint64_t *counted; // 0 before
    uint64_t room;

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        const SibsonScratch<Word> own = scratch_of(block.index());
        for (;;) {
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    begin(s, own);
            });
            if (s.query >= query_count)
                break;
            for (uint32_t level = 0; s.size[level % 3] != 0; ++level)
                block.each([&](unsigned thread, Local &) { spread(s, own, thread, level); });
            if (s.left == 0)
                block.each([&](unsigned thread, Local &) { count(s, own, thread); });
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    reserve(s);
            });
            block.each([&](unsigned thread, Local &) { end(s, own, thread); });
        }
    }

private:
    LOCUS_HD SibsonScratch<Word> scratch_of(uint64_t block) const {
        SibsonScratch<Word> own = scratch;
        own.reach += block * scratch.window;
        own.level += block * scratch.window;
        own.fronts += 2 * block * scratch.window;
        own.touched += block * scratch.window;
        own.stolen += block * scratch.label_count;
        own.labels += block * scratch.label_count;
        return own;
    }

    LOCUS_HD void begin(Shared &s, const SibsonScratch<Word> &own) const {
        s.query = atomic_add(taken, 1u);
        s.left = s.labels = 0;
        if (s.query >= query_count)
            return;
        uint64_t at[3];
        graph.place(queries[s.query], at);
        LOCUS_UNROLL
        for (unsigned a = 0; a < 3; ++a) {
            s.origin[a] = at[a] > margin ? at[a] - margin : 0;
            const uint64_t end = at[a] + margin + 1;
            s.extent[a] = (end < graph.dims[a] ? end : graph.dims[a]) - s.origin[a];
        }
        const uint32_t cell = cell_of(s, at);
        own.reach[cell] = 0;
        own.fronts[0] = own.touched[0] = cell;
        s.touched = s.size[0] = 1;
        s.size[1] = s.size[2] = 0;
    }

    LOCUS_HD static uint32_t cell_of(const Shared &s, const uint64_t (&at)[3]) {
        return static_cast<uint32_t>(at[0] - s.origin[0] +
                                     s.extent[0] * (at[1] - s.origin[1] + s.extent[1] * (at[2] - s.origin[2])));
    }
    LOCUS_HD uint64_t voxel_of(const Shared &s, uint32_t cell, uint64_t (&at)[3]) const {
        const uint64_t row = cell / s.extent[0];
        at[0] = s.origin[0] + cell % s.extent[0];
        at[1] = s.origin[1] + row % s.extent[1];
        at[2] = s.origin[2] + row / s.extent[1];
        return at[0] + graph.dims[0] * (at[1] + graph.dims[1] * at[2]);
    }

    // A voxel that nothing reaches is never stolen.
    LOCUS_HD Word nearest(uint64_t voxel) const {
        const Word word = words[voxel];
        return word < unreached ? word >> label_bits : 0;
    }

    LOCUS_HD void spread(Shared &s, const SibsonScratch<Word> &own, unsigned thread, uint32_t level) const {
        if (thread == 0)
            s.size[(level + 2) % 3] = 0;
        const uint32_t size = s.size[level % 3];
        for (uint32_t i = thread; i < size; i += threads) {
            uint64_t at[3];
            const uint32_t cell = own.fronts[level % 2 * own.window + i];
            const uint64_t voxel = voxel_of(s, cell, at);
            const Word reach = load_shared(&own.reach[cell]);
            const float operand = graph.operands[voxel];
            graph.neighbours(voxel, at, [&](uint64_t next, int dx, int dy, int dz) {
                const Word longer = reach + rule(operand, graph.operands[next], axes_of(dx, dy, dz));
                if (longer >= nearest(next))
                    return;
                const uint64_t there[3] = {at[0] + static_cast<uint64_t>(dx), at[1] + static_cast<uint64_t>(dy),
                                           at[2] + static_cast<uint64_t>(dz)};
                bool inside = true;
                LOCUS_UNROLL
                for (unsigned a = 0; a < 3; ++a)
                    inside = inside && there[a] - s.origin[a] < s.extent[a];
                if (inside)
                    lower(s, own, cell_of(s, there), longer, level);
                else
                    atomic_or(&s.left, 1u);
            });
        }
    }
    LOCUS_HD void lower(Shared &s, const SibsonScratch<Word> &own, uint32_t cell, Word to, uint32_t level) const {
        if (to >= load_shared(&own.reach[cell]))
            return;
        const Word old = atomic_min(&own.reach[cell], to);
        if (to >= old)
            return;
        if (old == kFar)
            own.touched[atomic_add(&s.touched, 1u)] = cell;
        if (atomic_exchange(&own.level[cell], level + 1) != level + 1)
            own.fronts[(level + 1) % 2 * own.window + atomic_add(&s.size[(level + 1) % 3], 1u)] = cell;
    }

    // What was touched is what is stolen: the bound was there from the beginning.
    LOCUS_HD void count(Shared &s, const SibsonScratch<Word> &own, unsigned thread) const {
        for (uint32_t i = thread; i < s.touched; i += threads) {
            uint64_t at[3];
            const Word word = words[voxel_of(s, own.touched[i], at)];
            const auto label = static_cast<uint32_t>(word & ((Word{1} << label_bits) - 1));
            if (atomic_add(&own.stolen[label], 1u) == 0)
                own.labels[atomic_add(&s.labels, 1u)] = label;
        }
    }

    LOCUS_HD void reserve(Shared &s) const {
        Answer &answer = answers[s.query];
        s.base = room;
        answer = {0, Answer::small_window};
        if (s.left != 0)
            return;
        s.base = atomic_add(counted, uint64_t{s.labels});
        answer = s.base + s.labels <= room ? Answer{s.base, s.labels} : Answer{0, Answer::no_room};
    }

    // Hand the counts over, and leave the scratch memory as it was.
    LOCUS_HD void end(Shared &s, const SibsonScratch<Word> &own, unsigned thread) const {
        for (uint32_t i = thread; i < s.labels; i += threads) {
            const uint32_t label = own.labels[i];
            if (s.base + s.labels <= room)
                counts[s.base + i] = {label, own.stolen[label]};
            own.stolen[label] = 0;
        }
        for (uint32_t i = thread; i < s.touched; i += threads) {
            const uint32_t cell = own.touched[i];
            own.reach[cell] = kFar;
            own.level[cell] = 0;
        }
    }
};

} // namespace locus::device
