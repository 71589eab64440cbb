// Integer edge weights: the only place where a material becomes steps of distance. Every engine, SIMD and CUDA
// included, computes exactly these numbers:
// - Arithmetic is float for 32-bit words and double for 64-bit words, in the order written here, each operation
// correctly
//   rounded and none fused with another (compile with -ffp-contract=off, nvcc with -fmad=false).
// - A voxel enters as its operand, a float: its compliance (mean and max rule), 1 (uniform rule) or its stiffness (mean
// stiffness).
// - steps() rounds half to even and never gives 0: two voxels joined by a free edge would support each other after a
// cut.
#pragma once

#include "core/word.hpp"
#include "graph/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace locus::graph {

// The floating-point type that belongs to a word type.
template <typename Word>
using Real = std::conditional_t<sizeof(Word) == 4, float, double>;

// max(1, x rounded half to even) for 0 <= x <= WordLayout::weight_limit(). Adding 1.5 * 2^23 (2^52) leaves no bits for
// a fraction, so the addition rounds, and the last bits of the sum are the number.
template <typename Word>
LOCUS_HD inline Word steps(Real<Word> x) {
    constexpr Real<Word> magic = sizeof(Word) == 4 ? Real<Word>(12582912.0) : Real<Word>(6755399441055744.0);
    constexpr Word magic_bits = sizeof(Word) == 4 ? Word{0x4B400000} : static_cast<Word>(0x4338000000000000);
    const Real<Word> sum = x + magic;
    Word bits;
    memcpy(&bits, &sum, sizeof bits);
    const Word rounded = bits - magic_bits;
    return rounded > 1 ? rounded : Word{1};
}

// The operand of a voxel, NaN where it is impassable.
struct Operand {
    uint32_t rule;     // LOCUS_WEIGHT_
    uint32_t material; // LOCUS_MATERIAL_

    // A stiffness below the smallest normal number counts as zero: its inverse may be infinite.
    LOCUS_HD bool passable(float value) const {
        if (material == LOCUS_MATERIAL_STIFFNESS)
            return value >= std::numeric_limits<float>::min();
        return value >= 0 && value <= std::numeric_limits<float>::max();
    }
    template <typename R>
    LOCUS_HD R of(float value) const {
        if (!passable(value))
            return std::numeric_limits<R>::quiet_NaN();
        if (rule == LOCUS_WEIGHT_UNIFORM || rule == LOCUS_WEIGHT_CALLER)
            return R(1);
        const bool wants_stiffness = rule == LOCUS_WEIGHT_MEAN_STIFFNESS;
        const bool has_stiffness = material == LOCUS_MATERIAL_STIFFNESS;
        return static_cast<R>(wants_stiffness == has_stiffness ? value : 1.0f / value);
    }
};

// Mean compliance, and uniform with all operands 1: w(u, v) = q(u) + q(v), q(v) = steps(c(v) * scale * len / 2).
template <typename Word>
struct HalfSum {
    std::array<Real<Word>, 7> factor; // scale * len / 2 by length class

    LOCUS_HD Word half(Real<Word> c, unsigned kind) const { return steps<Word>(c * factor[kind]); }
    LOCUS_HD Word operator()(Real<Word> a, Real<Word> b, unsigned kind) const { return half(a, kind) + half(b, kind); }
};

// Max compliance: w(u, v) = max(Q(u), Q(v)), Q(v) = steps(c(v) * scale * len); steps() is monotone, so the maximum may
// be taken of the compliances or of the integers.
template <typename Word>
struct Larger {
    std::array<Real<Word>, 7> factor; // scale * len

    LOCUS_HD Word operator()(Real<Word> a, Real<Word> b, unsigned kind) const {
        return steps<Word>((a < b ? b : a) * factor[kind]);
    }
};

// Mean stiffness with exponent 1: w(u, v) = steps(2 * scale * len / (k(u) + k(v))).
template <typename Word>
struct MeanStiffness {
    std::array<Real<Word>, 7> factor; // 2 * scale * len

    LOCUS_HD Word operator()(Real<Word> a, Real<Word> b, unsigned kind) const {
        return steps<Word>(factor[kind] / (a + b));
    }
};

// x^-p for p > 0 by table, so that it is the same on every machine: x = 2^e * m with m in [1, 2), the power of 2^e from
// one table, that of m by linear interpolation in another (relative error below p (p + 1) / 8 * 2^-24 plus two
// roundings).
template <typename R>
struct PowerTables {
    static constexpr int bits = 12;
    static constexpr int max_exponent = sizeof(R) == 4 ? 160 : 1100; // beyond every finite x

    const R *mantissa; // 2^bits + 1 of them
    const R *exponent; // 2 * max_exponent

    LOCUS_HD R operator()(R x) const {
        using Bits = std::conditional_t<sizeof(R) == 4, uint32_t, uint64_t>;
        constexpr unsigned digits = std::numeric_limits<R>::digits - 1;
        constexpr Bits ones = (Bits{1} << (sizeof(R) == 4 ? 8 : 11)) - 1;
        if (!(x < std::numeric_limits<R>::infinity()))
            return R(0);
        if (!(x > R(0)))
            return std::numeric_limits<R>::infinity();
        int e = -static_cast<int>(ones / 2);
        if (x < std::numeric_limits<R>::min()) { // a denormal number
            x *= static_cast<R>(Bits{1} << digits);
            e -= static_cast<int>(digits);
        }
        Bits raw;
        memcpy(&raw, &x, sizeof raw);
        e += static_cast<int>(raw >> digits & ones);
        raw = (raw & ((Bits{1} << digits) - 1)) | (ones / 2) << digits;
        R m; // in [1, 2), x = m * 2^e
        memcpy(&m, &raw, sizeof m);
        const R place = (m - R(1)) * R(1 << bits);
        const auto i = static_cast<uint32_t>(place);
        const R slope = mantissa[i + 1] - mantissa[i];
        const R rise = slope * (place - static_cast<R>(i));
        return (mantissa[i] + rise) * exponent[e + max_exponent];
    }
};

template <typename R>
class InversePower {
public:
    explicit InversePower(double p)
        : p_(p), mantissa_((size_t{1} << Tables::bits) + 1), exponent_(2 * Tables::max_exponent) {
        for (size_t i = 0; i < mantissa_.size(); ++i)
            mantissa_[i] = static_cast<R>(std::pow(1.0 + std::ldexp(static_cast<double>(i), -Tables::bits), -p));
        for (size_t e = 0; e < exponent_.size(); ++e)
            exponent_[e] = static_cast<R>(std::exp2(-p * (static_cast<double>(e) - Tables::max_exponent)));
    }

    double exponent() const { return p_; }
    PowerTables<R> tables() const { return {mantissa_.data(), exponent_.data()}; }
    size_t mantissas() const { return mantissa_.size(); }
    size_t exponents() const { return exponent_.size(); }

    R operator()(R x) const { return tables()(x); }

private:
    using Tables = PowerTables<R>;
    double p_;
    std::vector<R> mantissa_;
    std::vector<R> exponent_;
};

// Mean stiffness with any exponent: w(u, v) = steps(scale * len * 2^p * (k(u) + k(v))^-p).
template <typename Word>
struct PowerStiffness {
    std::array<Real<Word>, 7> factor; // scale * len * 2^p
    const InversePower<Real<Word>> *power;

    Word operator()(Real<Word> a, Real<Word> b, unsigned kind) const {
        return steps<Word>((*power)(a + b) * factor[kind]);
    }
};

} // namespace locus::graph
