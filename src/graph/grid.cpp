// The geometry of a voxel grid.
#include "graph/grid.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::graph {
namespace {

constexpr uint64_t most_voxels = uint64_t{1} << 40; // the product of the dims stays below

void check_dims(const uint64_t (&dims)[3]) {
    uint64_t product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        require(dims[axis] >= 1, "options->dims[", axis, "] is 0: a grid has at least one voxel in each direction");
        require(dims[axis] <= (most_voxels - 1) / product, "options->dims is ", dims[0], " x ", dims[1], " x ", dims[2],
                ": more than 2^40 - 1 voxels");
        product *= dims[axis];
    }
}

void check_spacing(const double (&spacing)[3]) {
    for (int axis = 0; axis < 3; ++axis)
        require(std::isfinite(spacing[axis]) && spacing[axis] > 0, "options->spacing[", axis, "] is ", spacing[axis],
                ", not a finite length above 0");
}

// The length class of an offset, of which `mask` has bit 0 set for dx != 0, bit 1 for dy, bit 2 for dz.
unsigned kind_of(unsigned mask, bool isotropic) {
    constexpr std::array<unsigned, 8> count{0, 0, 0, 1, 0, 1, 1, 2};
    constexpr std::array<unsigned, 8> axes{0, 0, 1, 3, 2, 4, 5, 6};
    return isotropic ? count[mask] : axes[mask];
}

} // namespace

Grid::Grid(const uint64_t (&dims)[3], const double (&spacing)[3], uint32_t connectivity)
    : dims_{dims[0], dims[1], dims[2]}, spacing_{spacing[0], spacing[1], spacing[2]}, connectivity_(connectivity) {
    check_dims(dims);
    check_spacing(spacing);
    require(connectivity == 6 || connectivity == 18 || connectivity == 26, "options->connectivity is ", connectivity,
            ", not 6, 18 or 26");
    shortest_ = std::numeric_limits<double>::infinity();
    const auto row = static_cast<int64_t>(dims[0]);
    const auto plane = static_cast<int64_t>(dims[0] * dims[1]);
    const int most_axes = connectivity == 6 ? 1 : connectivity == 18 ? 2 : 3;
    unsigned number = 0;
    size_t used = 0;
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const unsigned mask = (dx != 0 ? 1u : 0u) | (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
                if (mask == 0)
                    continue;
                const unsigned kind = kind_of(mask, isotropic());
                const double sx = dx * spacing[0], sy = dy * spacing[1], sz = dz * spacing[2];
                const double length = std::sqrt(sx * sx + sy * sy + sz * sz);
                require(std::isfinite(length) && length > 0, "options->spacing is ", spacing[0], ", ", spacing[1], ", ",
                        spacing[2], ": too extreme for the length of a diagonal");
                lengths_[kind] = length;
                const int d[3] = {dx, dy, dz};
                for (size_t axis = 0; axis < 3; ++axis) {
                    if (d[axis] < 0)
                        down_[axis] |= 1u << number;
                    if (d[axis] > 0)
                        up_[axis] |= 1u << number;
                }
                all_[number] = {dx, dy, dz, number, kind, dx + dy * row + dz * plane};
                if (std::abs(dx) + std::abs(dy) + std::abs(dz) <= most_axes) {
                    neighbours_[used++] = all_[number];
                    neighbour_mask_ |= 1u << number;
                    shortest_ = std::min(shortest_, length);
                    longest_ = std::max(longest_, length);
                }
                ++number;
            }
}

void Grid::check(const Box &box) const {
    for (size_t axis = 0; axis < 3; ++axis) {
        require(box.extent[axis] >= 1, "box->extent[", axis, "] is 0");
        require(box.origin[axis] < dims_[axis] && box.extent[axis] <= dims_[axis] - box.origin[axis], "box->origin[",
                axis, "] is ", box.origin[axis], " and box->extent[", axis, "] is ", box.extent[axis],
                ": outside the grid, which has ", dims_[axis], " voxels in that direction");
    }
}

unsigned Grid::number_between(uint64_t u, uint64_t v) const {
    const auto a = place(u);
    const auto b = place(v);
    unsigned number = 0;
    for (size_t axis = 3; axis-- > 0;) {
        const auto d = static_cast<int64_t>(b[axis]) - static_cast<int64_t>(a[axis]);
        if (d < -1 || d > 1)
            return 26;
        number = number * 3 + static_cast<unsigned>(d + 1);
    }
    if (number == 13)
        return 26; // the voxel itself
    if (number > 13)
        --number;
    return (neighbour_mask_ >> number & 1) != 0 ? number : 26;
}

} // namespace locus::graph
