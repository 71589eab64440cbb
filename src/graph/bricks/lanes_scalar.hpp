// The operations on a row of sixteen words as plain loops: the reference for the SIMD ones, and all there is without
// Highway.
#pragma once

#include "graph/bricks/visit.hpp"

#include <cmath>

#define LOCUS_LANES_NAMESPACE scalar
#define LOCUS_INLINE inline
#define LOCUS_NOINLINE

namespace locus::bricks::scalar {

template <typename Word>
struct Lanes {
    struct Row {
        Word lane[kLanes];
    };

    template <typename F>
    static Row each(F &&f) {
        Row r;
        for (unsigned i = 0; i < kLanes; ++i)
            r.lane[i] = f(i);
        return r;
    }
    static Row all(Word w) {
        return each([&](unsigned) { return w; });
    }
    static Row load(const Word *from) {
        return each([&](unsigned i) { return from[i]; });
    }
    static void store(const Row &a, Word *to) {
        for (unsigned i = 0; i < kLanes; ++i)
            to[i] = a.lane[i];
    }
    static Row add(const Row &a, const Row &b) {
        return each([&](unsigned i) { return static_cast<Word>(a.lane[i] + b.lane[i]); });
    }
    static Row min(const Row &a, const Row &b) {
        return each([&](unsigned i) { return a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i]; });
    }
    static Row operand(const float *from) {
        return each([&](unsigned i) { return bits(static_cast<Real<Word>>(from[i])); });
    }
    static Row larger(const Row &a, const Row &b) {
        return each([&](unsigned i) { return bits(std::max(real(a.lane[i]), real(b.lane[i]))); });
    }
    static Row sum(const Row &a, const Row &b) {
        return each([&](unsigned i) { return bits(real(a.lane[i]) + real(b.lane[i])); });
    }
    static Row share(const Row &operand, Real<Word> factor, Real<Word> low, Real<Word> cap, uint32_t label_bits) {
        return each([&](unsigned i) { return steps(real(operand.lane[i]) * factor, low, cap, label_bits); });
    }
    static Row quotient(const Row &operand, Real<Word> factor, Real<Word> low, Real<Word> cap, uint32_t label_bits) {
        return each([&](unsigned i) { return steps(factor / real(operand.lane[i]), low, cap, label_bits); });
    }
    static Row where_positive(const Row &operand, const Row &a, const Row &otherwise) {
        return each([&](unsigned i) { return real(operand.lane[i]) > 0 ? a.lane[i] : otherwise.lane[i]; });
    }
    static Row blocked(const Row &a, uint32_t bits, const Row &otherwise) {
        return each([&](unsigned i) { return (bits >> i & 1u) != 0 ? otherwise.lane[i] : a.lane[i]; });
    }
    static Row left(const Row &a, const Row &fill) {
        return each([&](unsigned i) { return i == 0 ? fill.lane[0] : a.lane[i - 1]; });
    }
    static Row right(const Row &a, const Row &fill) {
        return each([&](unsigned i) { return i + 1 == kLanes ? fill.lane[0] : a.lane[i + 1]; });
    }
    static uint32_t differ(const Row &a, const Row &b) {
        uint32_t bits = 0;
        for (unsigned i = 0; i < kLanes; ++i)
            bits |= uint32_t{a.lane[i] != b.lane[i]} << i;
        return bits;
    }
    static Row where_differ(const Row &a, const Row &b, const Row &otherwise) {
        return each([&](unsigned i) { return a.lane[i] != b.lane[i] ? a.lane[i] : otherwise.lane[i]; });
    }
    static Row inner(const Row &a, const Row &border) {
        return each([&](unsigned i) { return i == 0 || i + 1 == kLanes ? border.lane[i] : a.lane[i]; });
    }

private:
    static Real<Word> real(Word bits) { return std::bit_cast<Real<Word>>(bits); }
    static Word bits(Real<Word> real) { return std::bit_cast<Word>(real); }
    // Adding 2^52 leaves the nearest integer in a double's mantissa.
    static Word steps(Real<Word> x, Real<Word> low, Real<Word> cap, uint32_t label_bits) {
        const Real<Word> clamped = std::min(std::max(x, low), cap);
        const auto rounded = std::bit_cast<uint64_t>(static_cast<double>(clamped) + 0x1p52) & 0xFFFFFFFFFFFFFu;
        return static_cast<Word>(rounded << label_bits);
    }
};

} // namespace locus::bricks::scalar
