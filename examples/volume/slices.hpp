// Three orthogonal slices through a volume: which grid axes they show, and sampling at a pixel of the picture.
#pragma once

#include "volume/model.hpp"

#include <array>
#include <optional>

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

    size_t nearest(const std::array<double, 3> &grid) const;                  // the voxel's index
    float value(const Slice &slice, const std::array<double, 3> &grid) const; // between the four voxels around
    // Between those of the four that a seed reaches; nothing where the nearest voxel is not reached.
    std::optional<float> distance(const Slice &slice, const std::array<double, 3> &grid) const;

private:
    std::array<uint64_t, 3> centre_of_material() const;
    Slice make(const char *title, size_t across_world, size_t down_world, bool down_reversed,
               const std::array<size_t, 3> &grid_axis, const std::array<uint64_t, 3> &centre, bool anatomy) const;
    template <typename Use>
    void around(const Slice &slice, const std::array<double, 3> &grid, Use use) const;

    const Input &input_;
    const Result &result_;
    std::array<Slice, 3> slices_;
};

} // namespace volume
