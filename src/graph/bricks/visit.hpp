// One visit of a brick: what the kernels are given, what they hand back, and the table of kernels per instruction set.
#pragma once

#include "core/simd.hpp"
#include "graph/bricks/layout.hpp"

#include <span>

namespace locus::graph {
class Graph;
}

namespace locus::bricks {

template <typename Word>
using Real = std::conditional_t<sizeof(Word) == 4, float, double>;

// How compliances become integer weights. Offsets fall into seven classes by the axes they move along: bit 0 x, bit 1
// y, bit 2 z. What graph/quantize.hpp computes from operands and factors of class k is clamped to low[k] .. cap before
// it is rounded to the nearest integer, ties to even; every instruction set gives the same bits.
template <typename Word>
struct Metric {
    const graph::Graph *graph = nullptr; // for the kernel that asks it
    Real<Word> factor[8] = {};
    Real<Word> low[8] = {}; // 1, or `cap` for a class that the connectivity leaves out
    Real<Word> cap = 0;     // what an impassable voxel costs; shifted by label_bits it is `infinity`
    uint32_t label_bits = 0;
    bool isotropic = true; // equal factors for classes 1 2 4, for 3 5 6
    Word infinity = 0;     // three of them do not wrap
};

template <typename Word>
struct Wake {
    RowMask rows = 0;
    Word key = std::numeric_limits<Word>::max(); // the smallest word that reaches them
};

inline constexpr unsigned neighbour_number(int dx, int dy, int dz) {
    return static_cast<unsigned>(dx + 1 + 3 * (dy + 1) + 9 * (dz + 1));
}

// The cut edges of a brick's voxels: per row and neighbour number (neighbour_number), one bit per lane.
struct Blocked {
    uint16_t lanes[kRows][27] = {};
};

// A seed's voxel and word.
template <typename Word>
struct Anchor {
    size_t brick;
    unsigned row, lane;
    Word word;
};

template <typename Word>
struct Visit {
    const Metric<Word> *metric = nullptr;
    const Blocked *blocked = nullptr;      // null: no edge of the brick is cut
    bool raise = false;                    // raise words that nothing supports any more, instead of lowering
    Word unreached = 0;                    // raise: to this word
    std::span<const Anchor<Word>> anchors; // raise: the seeds in the brick, which need no support
    Place place;
    std::array<Brick<Word> *, 9> around{}; // at dx = 0: [dy + 1 + 3 * (dz + 1)], the brick itself in the middle
    RowMask active = 0;                    // rows to look at
    RowMask changed = 0;                   // in: rows changed since the last visit; out: and those this visit changed
    RowMask changed_first = 0;             // rows of `changed` in which lane 1 changed
    RowMask changed_last = 0;              // and lane 14
    std::array<Wake<Word>, 27> wake{};     // rows of the neighbours that would improve
    uint64_t updates = 0;                  // rows looked at
};

template <typename Word>
using VisitFunction = void (*)(Visit<Word> &);

// The kernels of one instruction set: separable weights (mean-inl.hpp), and weights edge by edge (edge-inl.hpp).
template <typename Word>
struct MeanKernels {
    VisitFunction<Word> isotropic, anisotropic;
};
template <typename Word>
struct EdgeKernels {
    VisitFunction<Word> mean, max, stiffness;
};

// For an instruction set that simd_available() admits.
template <typename Word>
const MeanKernels<Word> &mean_kernels(Simd target) noexcept;
template <typename Word>
const EdgeKernels<Word> &edge_kernels(Simd target) noexcept;

// The plain loops.
template <typename Word>
const MeanKernels<Word> &scalar_mean_kernels() noexcept;
template <typename Word>
const EdgeKernels<Word> &scalar_edge_kernels() noexcept;

} // namespace locus::bricks
