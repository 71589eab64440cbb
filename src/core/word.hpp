// Packed words: a distance in steps in the high bits, a label in the low ones, so that the minimum of two words is the
// nearer seed and, at equal distance, the smaller label (thesis section 2.4, figure 2.5).
#pragma once

#include <algorithm>
#include <cstdint>

#ifdef __CUDACC__
#define LOCUS_HD __host__ __device__
#else
#define LOCUS_HD
#endif

namespace locus {

// How a word is split. Three infinite words can be added without wrapping, so solvers may add weights to infinity
// without a branch; in 64 bits they do not reach the sign either, because signed minima are the fast ones, and the
// infinite distance converts exactly to and from double.
struct WordLayout {
    uint32_t bits = 64;       // 32 or 64
    uint32_t label_bits = 16; // 0..24

    // The distance of an unreached voxel; its word is pack(infinity(), 0), the largest word that a solve leaves behind.
    LOCUS_HD constexpr uint64_t infinity() const {
        return uint64_t{1} << (bits == 32 ? 30 - label_bits : std::min(61 - label_bits, 51u));
    }
    LOCUS_HD constexpr uint64_t max_exact() const { return infinity() - 1; }
    // The largest rounded number (the weight of an edge, or one voxel's share of it). Up to here float, for 32-bit
    // words, and double, for 64-bit ones, round to integers by the addition of one constant; see steps() in
    // graph/quantize.hpp.
    LOCUS_HD constexpr uint64_t weight_limit() const {
        return std::min(max_exact(), uint64_t{1} << (bits == 32 ? 22 : 51));
    }
    LOCUS_HD constexpr uint64_t labels() const { return uint64_t{1} << label_bits; }
    LOCUS_HD constexpr uint64_t unreached() const { return infinity() << label_bits; }
    LOCUS_HD constexpr uint64_t pack(uint64_t distance, uint64_t label) const { return distance << label_bits | label; }
    LOCUS_HD constexpr uint64_t distance(uint64_t word) const { return word >> label_bits; }
    LOCUS_HD constexpr uint32_t label(uint64_t word) const { return static_cast<uint32_t>(word & (labels() - 1)); }
    LOCUS_HD constexpr bool reached(uint64_t word) const { return word < unreached(); }
};

} // namespace locus
