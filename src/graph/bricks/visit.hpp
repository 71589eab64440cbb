// One visit of a brick: what the kernels are given, what they hand back, and the table of kernels per instruction set.
#pragma once

#include "core/simd.hpp"
#include "graph/bricks/layout.hpp"

namespace locus::bricks {

template <typename Word>
using Real = std::conditional_t<sizeof(Word) == 4, float, double>;

// How compliances become integer weights. Offsets fall into seven classes by the axes they move along: bit 0 x, bit 1
// y, bit 2 z. A voxel's share of an edge of class k is q_k = clamp(c * factor[k], low[k], cap) rounded to the nearest
// integer, ties to even, all in single precision: so every instruction set gives the same bits.
template <typename Word>
struct Metric {
    Real<Word> factor[8] = {};
    Real<Word> low[8] = {}; // 1, or `cap` for a class that the connectivity leaves out
    Real<Word> cap = 0;     // what an impassable voxel costs; shifted by label_bits it is `infinity`
    uint32_t label_bits = 0;
    bool isotropic = true; // equal factors for classes 1 2 4, for 3 5 6
    Word infinity = 0;     // three of them do not wrap
};

// The largest power of two whose triple fits a word (63 bits of the wide one: signed comparisons are the fast ones),
// and whose distance part single and double precision convert exactly.
template <typename Word>
constexpr Word infinity_of(uint32_t label_bits) {
    constexpr uint32_t top = sizeof(Word) == 4 ? 30 : 61;
    const uint32_t exact = 51 + label_bits;
    return Word{1} << (top < exact ? top : exact);
}

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

template <typename Word>
struct Visit {
    const Metric<Word> *metric = nullptr;
    const Blocked *blocked = nullptr;      // null: no edge of the brick is cut
    std::array<Brick<Word> *, 9> around{}; // at dx = 0: [dy + 1 + 3 * (dz + 1)], the brick itself in the middle
    RowMask active = 0;                    // rows to look at
    RowMask changed = 0;                   // in: rows changed since the last visit; out: and those this visit changed
    RowMask changed_first = 0;             // rows of `changed` in which lane 1 changed
    RowMask changed_last = 0;              // and lane 14
    std::array<Wake<Word>, 27> wake{};     // rows of the neighbours that would improve
    uint64_t updates = 0;                  // rows looked at
};

template <typename Word>
struct Kernels {
    void (*mean_isotropic)(Visit<Word> &) = nullptr;
    void (*mean_anisotropic)(Visit<Word> &) = nullptr;
    void (*mean_by_edge)(Visit<Word> &) = nullptr; // where edges are cut
    void (*max)(Visit<Word> &) = nullptr;
    void (*stiffness)(Visit<Word> &) = nullptr;
};

struct KernelTable {
    Kernels<uint32_t> narrow;
    Kernels<uint64_t> wide;
};

// The kernels of an instruction set that simd_available() admits.
const KernelTable &kernels(Simd target) noexcept;

const KernelTable &scalar_kernels() noexcept;

} // namespace locus::bricks
