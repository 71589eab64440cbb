// The geometry of a voxel grid: sizes, the offsets to a voxel's neighbours, and their lengths.
#pragma once

#include <locus/graph.h>

#include <array>
#include <cstdint>
#include <span>

namespace locus::graph {

using Box = locus_voxel_box;

// One of a voxel's neighbours. Neighbours are numbered 0..25 in raster order of (dz, dy, dx), whatever the
// connectivity: number n and 25 - n are opposite, and 13..25 lead to the voxels with the higher indices ("forward").
struct Neighbour {
    int dx, dy, dz;
    unsigned number;
    unsigned kind; // its length class
    int64_t step;  // added to the voxel's index
};

constexpr unsigned first_forward = 13;

class Grid {
public:
    // Checks everything; throws LOCUS_E_ARGUMENT naming the option and the value.
    Grid(const uint64_t (&dims)[3], const double (&spacing)[3], uint32_t connectivity);

    uint64_t nx() const { return dims_[0]; }
    uint64_t ny() const { return dims_[1]; }
    uint64_t nz() const { return dims_[2]; }
    const std::array<uint64_t, 3> &dims() const { return dims_; }
    const std::array<double, 3> &spacing() const { return spacing_; }
    uint32_t connectivity() const { return connectivity_; }
    uint64_t voxels() const { return dims_[0] * dims_[1] * dims_[2]; }

    uint64_t index(uint64_t x, uint64_t y, uint64_t z) const { return x + dims_[0] * (y + dims_[1] * z); }
    std::array<uint64_t, 3> place(uint64_t index) const {
        const uint64_t row = index / dims_[0];
        return {index % dims_[0], row % dims_[1], row / dims_[1]};
    }
    bool holds(uint64_t x, uint64_t y, uint64_t z) const { return x < dims_[0] && y < dims_[1] && z < dims_[2]; }

    // Throws LOCUS_E_ARGUMENT unless the box lies inside the grid and is not empty.
    void check(const Box &box) const;
    Box whole() const { return {{0, 0, 0}, {dims_[0], dims_[1], dims_[2]}}; }

    // The neighbours of this connectivity, by number.
    std::span<const Neighbour> neighbours() const { return {neighbours_.data(), connectivity_}; }
    // The same as a set: bit n for number n.
    uint32_t neighbour_mask() const { return neighbour_mask_; }
    const Neighbour &neighbour(unsigned number) const { return all_[number]; }
    // The numbers of this connectivity that stay inside the grid from (x, y, z).
    uint32_t inside(const std::array<uint64_t, 3> &place) const {
        uint32_t mask = neighbour_mask_;
        for (size_t axis = 0; axis < 3; ++axis) {
            if (place[axis] == 0)
                mask &= ~down_[axis];
            if (place[axis] + 1 == dims_[axis])
                mask &= ~up_[axis];
        }
        return mask;
    }
    // The number of the neighbour that leads from u to v, or 26 where they are no neighbours of this connectivity.
    unsigned number_between(uint64_t u, uint64_t v) const;

    // Length classes: with equal spacings 0 face, 1 edge, 2 corner; else 0 x, 1 y, 2 z, 3 xy, 4 xz, 5 yz, 6 xyz.
    bool isotropic() const { return spacing_[0] == spacing_[1] && spacing_[1] == spacing_[2]; }
    unsigned kinds() const { return isotropic() ? 3 : 7; }
    double length(unsigned kind) const { return lengths_[kind]; }
    // Over the neighbours of this connectivity.
    double shortest() const { return shortest_; }
    double longest() const { return longest_; }

private:
    std::array<uint64_t, 3> dims_;
    std::array<double, 3> spacing_;
    uint32_t connectivity_;
    std::array<Neighbour, 26> all_{};
    std::array<Neighbour, 26> neighbours_{};
    uint32_t neighbour_mask_ = 0;
    std::array<uint32_t, 3> down_{}; // the neighbours that lead towards 0 along x, y and z,
    std::array<uint32_t, 3> up_{};   // and away from it
    std::array<double, 7> lengths_{};
    double shortest_ = 0;
    double longest_ = 0;
};

// Call visit(voxel, position in the box) for every voxel of a box that lies inside the grid, x fastest.
template <typename Visit>
void for_each_voxel(const Grid &grid, const Box &box, Visit &&visit) {
    uint64_t position = 0;
    for (uint64_t z = 0; z < box.extent[2]; ++z)
        for (uint64_t y = 0; y < box.extent[1]; ++y) {
            const uint64_t row = grid.index(box.origin[0], box.origin[1] + y, box.origin[2] + z);
            for (uint64_t x = 0; x < box.extent[0]; ++x)
                visit(row + x, position++);
        }
}

} // namespace locus::graph
