// What a block keeps of the cells of a brick and its border in shared memory, and what one cell offers to another: in
// the form that is cheapest for the rule.
#pragma once

#include "graph/device/halo.hpp"
#include "graph/device/neighbours.hpp"
#include "graph/device/rules.hpp"

namespace locus::device {

// An offer that is none; adding a weight does not wrap it.
template <typename Word>
inline constexpr Word kNoOffer = std::numeric_limits<Word>::max() >> 1;

template <typename Word>
LOCUS_HD inline Word smaller(Word a, Word b) {
    return a < b ? a : b;
}
// A GPU of compute capability 9.0 has one instruction for each of these (CUDA's DPX functions).
template <typename Word>
LOCUS_HD inline Word smallest(Word a, Word b, Word c) {
#ifdef __CUDA_ARCH__
    if constexpr (sizeof(Word) == 4)
        return __vimin3_u32(a, b, c);
#endif
    return smaller(smaller(a, b), c);
}
template <typename Word>
LOCUS_HD inline void take_smaller_sum(Word &least, Word a, Word b) {
#ifdef __CUDA_ARCH__
    if constexpr (sizeof(Word) == 4) {
        least = __viaddmin_u32(a, b, least);
        return;
    }
#endif
    least = smaller(least, a + b);
}

// Weights edge by edge: any rule.
template <typename Word, typename Rule>
struct EdgeCells {
    static constexpr unsigned threads = 256;
    static constexpr bool columns = false;
    struct Shared {
        Word word[kCells];
        float operand[kCells];
    };

    LOCUS_HD static void put(Shared &s, const Rule &, uint32_t, unsigned cell, Word word, float operand) {
        s.word[cell] = word;
        s.operand[cell] = operand;
    }
    LOCUS_HD static void change(Shared &s, unsigned cell, Word, Word to) { s.word[cell] = to; }
    // What `from` offers to `to`, but for the part that end() adds.
    LOCUS_HD static Word offer(const Shared &s, const Rule &rule, uint32_t label_bits, unsigned from, unsigned to,
                               unsigned axes) {
        return s.word[from] + (rule(s.operand[from], s.operand[to], axes) << label_bits);
    }
    LOCUS_HD static Word end(const Shared &, Word offered, unsigned, Word, unsigned) { return offered; }
};

// Mean compliance with equal spacings: each cell keeps its word plus its half of the weight, by the number of axes.
template <typename Word>
struct HalfSumCells {
    static constexpr unsigned threads = 128;
    static constexpr bool columns = true;
    struct Shared {
        Word lead[3][kCells];
    };

    LOCUS_HD static void put(Shared &s, const HalfSumRule<Word> &rule, uint32_t label_bits, unsigned cell, Word word,
                             float operand) {
        s.lead[0][cell] = word + (rule.half(operand, 1) << label_bits);
        s.lead[1][cell] = word + (rule.half(operand, 3) << label_bits);
        s.lead[2][cell] = word + (rule.half(operand, 7) << label_bits);
    }
    LOCUS_HD static void change(Shared &s, unsigned cell, Word from, Word to) {
        const Word fallen = to - from; // modulo the word: right when it rises too
        LOCUS_UNROLL
        for (unsigned i = 0; i < 3; ++i)
            s.lead[i][cell] += fallen;
    }
    LOCUS_HD static Word offer(const Shared &s, const HalfSumRule<Word> &, uint32_t, unsigned from, unsigned,
                               unsigned axes) {
        return s.lead[moves(axes) - 1][from];
    }
    // `word`: that of `to`.
    LOCUS_HD static Word end(const Shared &s, Word offered, unsigned to, Word word, unsigned moved) {
        return offered + (s.lead[moved - 1][to] - word);
    }

    // The smallest offers to `count` cells in a row along y, from all neighbours of at most `classes` axes. What a
    // plane of y offers to the next one it also offers to the one before: it is looked at once for both. `settle`: or
    // the words themselves where they are smaller, and what the cells of the row then offer each other.
    template <unsigned count, unsigned classes, bool settle>
    LOCUS_HD static void smallest_offers(const Shared &s, unsigned first, const Word (&word)[count],
                                         Word (&least)[count]) {
        Word across[count + 2][3]; // to the planes beside it
        LOCUS_UNROLL
        for (unsigned plane = 0; plane < count + 2; ++plane) {
            const unsigned cell = first + kHalo * plane - kHalo;
            across[plane][0] = s.lead[0][cell];
            across[plane][1] = classes > 1 ? cross(s.lead[1], cell) : kNoOffer<Word>;
            across[plane][2] = classes > 2 ? diagonal(s.lead[2], cell) : kNoOffer<Word>;
        }
        Word half[count];
        LOCUS_UNROLL
        for (unsigned i = 0; i < count; ++i) {
            const unsigned cell = first + kHalo * i;
            half[i] = across[i + 1][0] - word[i];
            least[i] = smallest(cross(s.lead[0], cell), across[i][0], across[i + 2][0]) + half[i];
            if (classes > 1)
                take_smaller_sum(least[i], smallest(diagonal(s.lead[1], cell), across[i][1], across[i + 2][1]),
                                 s.lead[1][cell] - word[i]);
            if (classes > 2)
                take_smaller_sum(least[i], smaller(across[i][2], across[i + 2][2]), s.lead[2][cell] - word[i]);
            if (settle)
                least[i] = smaller(least[i], word[i]);
        }
        if (!settle)
            return;
        LOCUS_UNROLL
        for (unsigned i = 1; i < count; ++i)
            take_smaller_sum(least[i], least[i - 1], half[i - 1] + half[i]);
        LOCUS_UNROLL
        for (unsigned i = count - 1; i > 0; --i)
            take_smaller_sum(least[i - 1], least[i], half[i - 1] + half[i]);
    }

private:
    // Within a plane of y.
    LOCUS_HD static Word cross(const Word (&lead)[kCells], unsigned cell) {
        return smaller(
            smallest(lead[beside(cell, -1, 0, 0)], lead[beside(cell, 1, 0, 0)], lead[beside(cell, 0, 0, -1)]),
            lead[beside(cell, 0, 0, 1)]);
    }
    LOCUS_HD static Word diagonal(const Word (&lead)[kCells], unsigned cell) {
        return smaller(
            smallest(lead[beside(cell, -1, 0, -1)], lead[beside(cell, 1, 0, -1)], lead[beside(cell, -1, 0, 1)]),
            lead[beside(cell, 1, 0, 1)]);
    }
};

} // namespace locus::device
