// Bricks: the grid cut into blocks of 14 x 8 x 8 voxels. A row along x is 16 words: lanes 1 to 14 are the brick's own
// voxels, lanes 0 and 15 copies of the x-neighbours' edge voxels, so that one row is one vector and lane shifts never
// leave it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

namespace locus::bricks {

inline constexpr unsigned kLanes = 16; // words in a row
inline constexpr unsigned kWidth = 14; // own voxels in a row
inline constexpr unsigned kSide = 8;   // rows in y and in z
inline constexpr unsigned kRows = kSide * kSide;
inline constexpr uint32_t kOwnLanes = 0x7FFE;

// Rows of a brick as bits: row (y, z) is bit y + 8 * z.
using RowMask = uint64_t;

// A row's words and its voxels' operands (see graph/quantize.hpp) side by side: whoever reads the one needs the other.
// An impassable voxel's word never falls.
template <typename Word>
struct alignas(64) BrickRow {
    Word word[kLanes];
    float operand[kLanes];
};

template <typename Word>
struct Brick {
    BrickRow<Word> row[kRows];
};

// The grid in bricks.
struct Layout {
    std::array<uint64_t, 3> dims{}; // voxels
    std::array<uint32_t, 3> bricks{};

    explicit Layout(const std::array<uint64_t, 3> &voxels) : dims(voxels) {
        constexpr std::array<uint64_t, 3> size = {kWidth, kSide, kSide};
        uint64_t count = 1;
        for (size_t a = 0; a < 3; ++a) {
            const uint64_t needed = (dims[a] + size[a] - 1) / size[a];
            count *= needed; // cannot wrap: a grid has less than 2^40 voxels
            if (count > std::numeric_limits<int32_t>::max())
                throw std::bad_alloc(); // 16 TB
            bricks[a] = static_cast<uint32_t>(needed);
        }
    }
    size_t count() const { return size_t{bricks[0]} * bricks[1] * bricks[2]; }
    size_t index(uint32_t bx, uint32_t by, uint32_t bz) const {
        return bx + size_t{bricks[0]} * (by + size_t{bricks[1]} * bz);
    }
};

// A brick's place in the grid of bricks.
struct Place {
    int32_t x = 0, y = 0, z = 0;
};

inline Place place_of(const std::array<uint64_t, 3> &voxel) {
    return {static_cast<int32_t>(voxel[0] / kWidth), static_cast<int32_t>(voxel[1] / kSide),
            static_cast<int32_t>(voxel[2] / kSide)};
}

inline bool adjacent(const Place &a, const Place &b) {
    const auto near = [](int32_t p, int32_t q) { return p - q <= 1 && q - p <= 1; };
    return near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z);
}

inline constexpr RowMask kFirstY = 0x0101010101010101u; // rows with y = 0
inline constexpr RowMask kLastY = kFirstY << 7;         // y = 7
inline constexpr RowMask kFirstZ = 0xFFu;
inline constexpr RowMask kLastZ = kFirstZ << 56;

// The rows of `rows` and all that touch them in y and z.
constexpr RowMask dilate(RowMask rows) {
    rows |= ((rows << 1) & ~kFirstY) | ((rows >> 1) & ~kLastY);
    return rows | (rows << 8) | (rows >> 8);
}

// The rows of the neighbour at (dy, dz) that touch the rows `rows` of this brick.
constexpr RowMask touched(RowMask rows, int dy, int dz) {
    // Only border rows reach across; they land on the opposite border and spread along it.
    if (dy < 0)
        rows = (rows & kFirstY) << 7;
    if (dy > 0)
        rows = (rows & kLastY) >> 7;
    if (dz < 0)
        rows = (rows & kFirstZ) << 56;
    if (dz > 0)
        rows = (rows & kLastZ) >> 56;
    const RowMask border = (dy < 0   ? kLastY
                            : dy > 0 ? kFirstY
                                     : ~RowMask{0}) &
                           (dz < 0   ? kLastZ
                            : dz > 0 ? kFirstZ
                                     : ~RowMask{0});
    return dilate(rows) & border;
}

} // namespace locus::bricks
