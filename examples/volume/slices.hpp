// Three orthogonal slices through a volume: which grid axes they show, and sampling at a pixel of the picture.
#pragma once

#include "volume/model.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace volume {

// A slice as seen in a picture. Bodies are shown as radiologists do: the body's left at the right, front and top up.
struct Slice {
    std::string title;
    std::string left, right, top, bottom; // the sides' names
    size_t across, down, through;         // grid axes
    bool across_flipped, down_flipped;    // the grid runs against the picture
    uint64_t at;                          // voxel index along `through`
    double width, height;                 // in units of length
};

class Slicer {
public:
    Slicer(const Options &options, const Input &input, const Result &result);

    const std::array<Slice, 3> &slices() const { return slices_; }

    // A place in a slice, (right, down) in units of length from its top left corner, as grid coordinates: voxel centres
    // are whole.
    std::array<double, 3> grid_at(const Slice &slice, double right, double down) const;
    // The reverse, for a voxel.
    std::array<double, 2> place_of(const Slice &slice, const std::array<uint64_t, 3> &voxel) const;
    std::array<double, 2> place_of_grid(const Slice &slice, const std::array<double, 3> &grid) const;

    size_t nearest(const std::array<double, 3> &grid) const;                  // the voxel's index
    float value(const Slice &slice, const std::array<double, 3> &grid) const; // between the four voxels around
    // The field's numbers between those of the four voxels that a seed reaches; nothing where the nearest one is not
    // reached. The field takes a voxel's index.
    template <typename Field>
    std::optional<float> between(const Slice &slice, const std::array<double, 3> &grid, Field field) const {
        if (result_.labels[nearest(grid)] == LOCUS_NO_SEED)
            return std::nullopt;
        double sum = 0, weights = 0;
        around(slice, grid, [&](size_t voxel, double weight) {
            if (result_.labels[voxel] == LOCUS_NO_SEED)
                return;
            sum += weight * double{field(voxel)};
            weights += weight;
        });
        return weights > 0 ? static_cast<float>(sum / weights) : field(nearest(grid));
    }

private:
    std::array<uint64_t, 3> centre_of_material() const;
    Slice make(const char *title, size_t across_world, size_t down_world, bool down_reversed,
               const std::array<size_t, 3> &grid_axis, const std::array<uint64_t, 3> &centre, bool anatomy) const;
    // use(voxel's index, weight) for the four voxels of the slice around a place.
    template <typename Use>
    void around(const Slice &slice, const std::array<double, 3> &grid, Use use) const {
        for (int corner = 0; corner < 4; ++corner) {
            std::array<double, 3> voxel = grid;
            double weight = 1;
            for (const auto &[axis, upper] :
                 {std::pair{slice.across, corner & 1}, std::pair{slice.down, corner >> 1}}) {
                const double lower = std::floor(grid[axis]);
                voxel[axis] = lower + upper;
                weight *= upper != 0 ? grid[axis] - lower : 1 - (grid[axis] - lower);
            }
            use(nearest(voxel), weight);
        }
    }

    const Input &input_;
    const Result &result_;
    std::array<Slice, 3> slices_;
};

} // namespace volume
