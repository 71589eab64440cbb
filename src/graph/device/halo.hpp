// A brick and its border cell by cell, 10 x 10 x 10, x fastest, the brick's own voxels in the middle; and which threads
// of a block look after which of them.
#pragma once

#include "graph/device/block.hpp"
#include "graph/device/bricks.hpp"

#include <vector>

namespace locus::device {

inline constexpr unsigned kHalo = kSide + 2;
// A plane of cells takes a little more room than it needs: 8 voxels along x on 4 planes lie in different banks of
// shared memory.
inline constexpr unsigned kPlane = kHalo * kHalo + 4;
inline constexpr unsigned kCells = kPlane * kHalo;

LOCUS_HD constexpr unsigned cell_at(unsigned x, unsigned y, unsigned z) { return x + kHalo * y + kPlane * z; }
LOCUS_HD constexpr unsigned beside(unsigned cell, int dx, int dy, int dz) {
    return static_cast<unsigned>(static_cast<int>(cell) + dx + static_cast<int>(kHalo) * dy +
                                 static_cast<int>(kPlane) * dz);
}

// The voxels of a brick that a thread works on: `count` in a row along y. A warp has 8 x count x 4 of them.
template <unsigned threads>
struct OwnVoxels {
    static constexpr unsigned count = kVoxels / threads;
    static constexpr unsigned rows = kSide / count; // of threads along y
    unsigned x, y, z;                               // of the first

    LOCUS_HD explicit OwnVoxels(unsigned thread)
        : x(thread % kSide), y(thread / (kSide * kSide) * count), z(thread / kSide % kSide) {}
    LOCUS_HD unsigned cell(unsigned i) const { return cell_at(x + 1, y + i + 1, z + 1); }
    LOCUS_HD unsigned voxel(unsigned i) const { return x + kSide * (y + i + kSide * z); }
};

// A cell of a brick's border: where it lies, and in which voxel of which brick around. 128 threads hold them, four
// each, by kind: those on the faces across x, y and z, and one on an edge along x, y or z (32 threads each) or in a
// corner, if any.
struct alignas(8) BorderCell {
    static constexpr unsigned holders = 128, kinds = 4;
    uint16_t cell;
    uint16_t nearest; // own cell
    uint16_t voxel;
    uint16_t side; // 0..26, x fastest; 13, the brick itself: there is no such cell
};

// All of them, one kind's 128 after the other's.
std::vector<BorderCell> border_cells();

} // namespace locus::device
