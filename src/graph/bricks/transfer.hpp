// Between dense arrays (x fastest) and bricks: compliances in, words out.
#pragma once

#include "graph/bricks/store.hpp"

#include <cmath>

namespace locus::bricks {

// Fill the z-layer of bricks `bz`: compliances from `compliance(x, y, z)`-ordered dense memory, every word to
// `unreached`.
template <typename Word>
void import_layer(Store<Word> &store, uint32_t bz, const float *compliance, Word unreached) {
    const auto &dims = store.layout().dims;
    const auto &bricks = store.layout().bricks;
    for (uint32_t by = 0; by < bricks[1]; ++by)
        for (uint32_t bx = 0; bx < bricks[0]; ++bx) {
            Brick<Word> &brick = store[store.layout().index(bx, by, bz)];
            for (unsigned r = 0; r < kRows; ++r) {
                const uint64_t y = uint64_t{by} * kSide + r % kSide;
                const uint64_t z = uint64_t{bz} * kSide + r / kSide;
                for (unsigned i = 0; i < kLanes; ++i) {
                    const uint64_t x = uint64_t{bx} * kWidth + i - 1; // wraps to a huge number left of the grid
                    const bool in = x < dims[0] && y < dims[1] && z < dims[2];
                    const float c = in ? compliance[x + dims[0] * (y + dims[1] * z)] : -1.0f;
                    brick.row[r].word[i] = unreached;
                    brick.row[r].operand[i] = c >= 0 ? c : std::numeric_limits<float>::infinity(); // false for NaN too
                }
            }
        }
}

template <typename Word>
void clear_outside(Store<Word> &store, Word unreached) {
    for (auto &row : store[store.outside()].row)
        for (unsigned i = 0; i < kLanes; ++i) {
            row.word[i] = unreached;
            row.operand[i] = std::numeric_limits<float>::infinity();
        }
}

// Copy the words of the z-layer of bricks `bz` to dense memory.
template <typename Word>
void export_layer(const Store<Word> &store, uint32_t bz, Word *words) {
    const auto &dims = store.layout().dims;
    const auto &bricks = store.layout().bricks;
    const uint64_t z_end = std::min<uint64_t>(dims[2], (uint64_t{bz} + 1) * kSide);
    for (uint64_t z = uint64_t{bz} * kSide; z < z_end; ++z)
        for (uint64_t y = 0; y < dims[1]; ++y)
            for (uint32_t bx = 0; bx < bricks[0]; ++bx) {
                const uint64_t x = uint64_t{bx} * kWidth;
                const auto &brick = store[store.layout().index(bx, static_cast<uint32_t>(y / kSide), bz)];
                const Word *from = brick.row[y % kSide + kSide * (z % kSide)].word + 1;
                std::copy_n(from, std::min<uint64_t>(kWidth, dims[0] - x), words + x + dims[0] * (y + dims[1] * z));
            }
}

} // namespace locus::bricks
