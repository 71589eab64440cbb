// Slice geometry and sampling.
#include "volume/slices.hpp"

#include <algorithm>
#include <cmath>

namespace volume {
namespace {

constexpr size_t left = 0, posterior = 1, superior = 2; // the world's axes

// The grid axis that runs most along each of the world's axes.
std::array<size_t, 3> grid_axes(const locus_volume_info &info) {
    std::array<size_t, 3> order{0, 1, 2}, best = order;
    double most = -1;
    do {
        double sum = 0;
        for (size_t world = 0; world < 3; ++world)
            sum += std::abs(info.direction[3 * order[world] + world]);
        if (sum > most + 1e-9) {
            most = sum;
            best = order;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

} // namespace

Slicer::Slicer(const Options &options, const Input &input, const Result &result) : input_(input), result_(result) {
    const std::array<uint64_t, 3> centre = options.slice ? *options.slice : centre_of_material();
    const std::array<size_t, 3> axes = grid_axes(input.info);
    const bool anatomy = options.anatomy;
    slices_ = {make("axial", left, posterior, false, axes, centre, anatomy),
               make("coronal", left, superior, true, axes, centre, anatomy),
               make("sagittal", posterior, superior, true, axes, centre, anatomy)};
}

std::array<uint64_t, 3> Slicer::centre_of_material() const {
    const uint64_t *dims = input_.info.dims;
    std::array<double, 3> sum{};
    uint64_t count = 0;
    size_t index = 0;
    for (uint64_t z = 0; z < dims[2]; ++z)
        for (uint64_t y = 0; y < dims[1]; ++y)
            for (uint64_t x = 0; x < dims[0]; ++x, ++index) {
                if (result_.labels[index] == LOCUS_NO_SEED)
                    continue;
                sum[0] += static_cast<double>(x);
                sum[1] += static_cast<double>(y);
                sum[2] += static_cast<double>(z);
                ++count;
            }
    std::array<uint64_t, 3> centre{};
    for (size_t axis = 0; axis < 3; ++axis)
        centre[axis] = static_cast<uint64_t>(sum[axis] / static_cast<double>(std::max<uint64_t>(count, 1)));
    return centre;
}

Slice Slicer::make(const char *title, size_t across_world, size_t down_world, bool down_reversed,
                   const std::array<size_t, 3> &grid_axis, const std::array<uint64_t, 3> &centre, bool anatomy) const {
    static constexpr const char *towards[3] = {"L", "P", "S"};
    static constexpr const char *away[3] = {"R", "A", "I"};
    const locus_volume_info &info = input_.info;
    Slice slice;
    slice.across = grid_axis[across_world];
    slice.down = grid_axis[down_world];
    slice.through = 3 - slice.across - slice.down;
    slice.at = centre[slice.through];
    slice.across_flipped = info.direction[3 * slice.across + across_world] < 0;
    slice.down_flipped = (info.direction[3 * slice.down + down_world] < 0) != down_reversed;
    slice.width = static_cast<double>(info.dims[slice.across]) * info.spacing[slice.across];
    slice.height = static_cast<double>(info.dims[slice.down]) * info.spacing[slice.down];
    const std::string place = std::string(1, "xyz"[slice.through]) + " = " + std::to_string(slice.at);
    slice.title = anatomy ? std::string(title) + ", " + place : place;
    if (anatomy) {
        slice.left = away[across_world];
        slice.right = towards[across_world];
        slice.top = down_reversed ? towards[down_world] : away[down_world];
        slice.bottom = down_reversed ? away[down_world] : towards[down_world];
    } else {
        (slice.across_flipped ? slice.left : slice.right) = "xyz"[slice.across];
        (slice.down_flipped ? slice.top : slice.bottom) = "xyz"[slice.down];
    }
    return slice;
}

std::array<double, 3> Slicer::grid_at(const Slice &slice, double right, double down) const {
    const locus_volume_info &info = input_.info;
    const auto along = [&](size_t axis, double length, bool flipped) {
        const double index = length / info.spacing[axis] - 0.5;
        return flipped ? static_cast<double>(info.dims[axis]) - 1 - index : index;
    };
    std::array<double, 3> grid{};
    grid[slice.across] = along(slice.across, right, slice.across_flipped);
    grid[slice.down] = along(slice.down, down, slice.down_flipped);
    grid[slice.through] = static_cast<double>(slice.at);
    return grid;
}

std::array<double, 2> Slicer::place_of(const Slice &slice, const std::array<uint64_t, 3> &voxel) const {
    return place_of_grid(slice,
                         {static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2])});
}

std::array<double, 2> Slicer::place_of_grid(const Slice &slice, const std::array<double, 3> &grid) const {
    const locus_volume_info &info = input_.info;
    const auto along = [&](size_t axis, bool flipped) {
        const double index = flipped ? static_cast<double>(info.dims[axis]) - 1 - grid[axis] : grid[axis];
        return (index + 0.5) * info.spacing[axis];
    };
    return {along(slice.across, slice.across_flipped), along(slice.down, slice.down_flipped)};
}

size_t Slicer::nearest(const std::array<double, 3> &grid) const {
    const uint64_t *dims = input_.info.dims;
    uint64_t voxel[3];
    for (size_t axis = 0; axis < 3; ++axis)
        voxel[axis] =
            static_cast<uint64_t>(std::clamp(std::round(grid[axis]), 0.0, static_cast<double>(dims[axis] - 1)));
    return static_cast<size_t>(voxel[0] + dims[0] * (voxel[1] + dims[1] * voxel[2]));
}

float Slicer::value(const Slice &slice, const std::array<double, 3> &grid) const {
    double sum = 0;
    around(slice, grid, [&](size_t voxel, double weight) { sum += weight * double{input_.values()[voxel]}; });
    return static_cast<float>(sum);
}

} // namespace volume
