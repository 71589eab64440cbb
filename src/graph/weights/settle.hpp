// Sixteen bounded shortest-path searches at once, one per SIMD lane, over the same window of the grid: what the kernels
// are given, and the table of kernels per instruction set.
//
// A lane's word at voxel v is min(D(v), d(q, v)): it starts at D(v), the distance to the nearest seed, and falls where
// the query q is nearer. Because D is itself a fixpoint of the same edges, words that have not fallen never lower a
// neighbour, and because the stolen set is star-shaped around q (u on a shortest path to a stolen v is stolen: d(q,u) =
// d(q,v) - d(u,v) < D(v) - d(u,v) <= D(u)), the search is exact although it goes no farther than what is stolen.
// Instead of D, a bound per lane may be where the words start: a plain search up to that distance.
// Forward and backward raster sweeps over 13 neighbours each (Danielsson-style) are repeated over the parts of rows
// that changed until nothing falls.
#pragma once

#include "core/simd.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace locus::graph {

constexpr unsigned batch_lanes = 16;
constexpr unsigned backward_edges = 13;
constexpr std::array<unsigned, 3> backward_face = {12, 10, 4}; // the numbers of the neighbours at -x, -y and -z

// What an impassable voxel or an edge that is not there costs: three of them do not wrap, nor reach a sign bit.
template <typename Word>
constexpr Word far_away = sizeof(Word) == 4 ? Word{1} << 29 : Word{1} << 60;

// Places first..last of a row; empty when first > last.
struct Span {
    uint32_t first = UINT32_MAX;
    uint32_t last = 0;
    bool empty() const { return first > last; }
    void add(uint32_t x) {
        first = std::min(first, x);
        last = std::max(last, x);
    }
    void add(const Span &other) {
        first = std::min(first, other.first);
        last = std::max(last, other.last);
    }
};

// The rows that hold anything, by y and z.
struct Hull {
    Span y, z;
    bool empty() const { return y.empty(); }
    void add(size_t y_place, size_t z_place) {
        y.add(static_cast<uint32_t>(y_place));
        z.add(static_cast<uint32_t>(z_place));
    }
    void add(const Hull &other) {
        y.add(other.y);
        z.add(other.z);
    }
};

template <typename Word>
struct Settle {
    std::array<size_t, 3> sizes{};                // of the window, border included
    std::array<ptrdiff_t, backward_edges> step{}; // to the neighbours 0..12
    const Word *nearest = nullptr;                // D per voxel, far_away where nothing may pass
    const Word *back = nullptr;    // 13 weights per voxel: to its neighbours 0..12, far_away where no edge
    Word *reach = nullptr;         // 16 words per voxel
    const Word *bound = nullptr;   // 16 words for restore_bound
    uint16_t *stolen = nullptr;    // out: the lanes whose word lies below D; 0 outside the touched spans
    Span *fresh = nullptr;         // per row: what the previous sweep changed; at first the starts
    Span *changed = nullptr;       // per row: what this sweep changed; at first the starts
    Span *touched_spans = nullptr; // per row: what any sweep changed
    Hull fresh_rows, touched;
    uint64_t most_pulls = UINT64_MAX; // sweep no more once so many voxels, or rows without any, were visited
};

template <typename Word>
struct SettleKernels {
    void (*settle)(Settle<Word> &) = nullptr; // sweep from the fresh spans to the fixpoint, or most_pulls
    void (*mark)(Settle<Word> &) = nullptr;   // note in the touched spans which lanes lie below D
    // In the touched spans, which become empty: stolen = 0 and reach back to D, or to the bounds.
    void (*restore_nearest)(Settle<Word> &) = nullptr;
    void (*restore_bound)(Settle<Word> &) = nullptr;
};

struct SettleTable {
    SettleKernels<uint32_t> narrow;
    SettleKernels<uint64_t> wide;
    template <typename Word>
    const SettleKernels<Word> &of() const {
        if constexpr (sizeof(Word) == 4)
            return narrow;
        else
            return wide;
    }
};

const SettleTable &settle_kernels(Simd target) noexcept;
const SettleTable &scalar_settle_kernels() noexcept;

} // namespace locus::graph
