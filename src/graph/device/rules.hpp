// Edge weights inside kernels: the integers of graph/quantize.hpp from two voxels' operands, clamped to `cap`, what an
// impassable voxel costs. The host makes the operands; an impassable one is +infinity, or NaN for the rules by
// stiffness, and both clamp to the cap. Offsets fall into classes by the axes they move along: bit 0 x, bit 1 y, bit 2
// z.
#pragma once

#include "graph/quantize.hpp"

namespace locus::device {

using graph::Real;

enum class RuleKind : uint32_t { half_sum, larger, stiffness, power };

template <typename Word>
struct RuleBase {
    Real<Word> factor[8]; // by class
    Real<Word> most;      // what a passable edge costs at most
    Word cap;             // three of them, shifted by the label bits, do not wrap a word

    // Comparisons with NaN are false.
    LOCUS_HD Word rounded(Real<Word> x) const { return x <= most ? graph::steps<Word>(x) : cap; }
};

// w(u, v) = q(u) + q(v)
template <typename Word>
struct HalfSumRule : RuleBase<Word> {
    static constexpr RuleKind kind = RuleKind::half_sum;
    static constexpr float impassable = std::numeric_limits<float>::infinity();
    LOCUS_HD Word half(float operand, unsigned axes) const {
        return this->rounded(static_cast<Real<Word>>(operand) * this->factor[axes]);
    }
    LOCUS_HD Word operator()(float a, float b, unsigned axes) const { return half(a, axes) + half(b, axes); }
};

template <typename Word>
struct LargerRule : RuleBase<Word> {
    static constexpr RuleKind kind = RuleKind::larger;
    static constexpr float impassable = std::numeric_limits<float>::infinity();
    LOCUS_HD Word operator()(float a, float b, unsigned axes) const {
        return this->rounded(static_cast<Real<Word>>(a < b ? b : a) * this->factor[axes]);
    }
};

template <typename Word>
struct StiffnessRule : RuleBase<Word> {
    static constexpr RuleKind kind = RuleKind::stiffness;
    static constexpr float impassable = std::numeric_limits<float>::quiet_NaN();
    LOCUS_HD Word operator()(float a, float b, unsigned axes) const {
        return this->rounded(this->factor[axes] / (static_cast<Real<Word>>(a) + static_cast<Real<Word>>(b)));
    }
};

template <typename Word>
struct PowerRule : RuleBase<Word> {
    static constexpr RuleKind kind = RuleKind::power;
    static constexpr float impassable = std::numeric_limits<float>::quiet_NaN();
    graph::PowerTables<Real<Word>> power;
    LOCUS_HD Word operator()(float a, float b, unsigned axes) const {
        const Real<Word> sum = static_cast<Real<Word>>(a) + static_cast<Real<Word>>(b);
        if (!(sum == sum))
            return this->cap;
        return this->rounded(power(sum) * this->factor[axes]);
    }
};

} // namespace locus::device
