// The part of a slice around the object, drawn voxel by voxel: for pictures that show what happens to single voxels.
#pragma once

#include "volume/panels.hpp"
#include "volume/weights.hpp"

#include <array>
#include <functional>
#include <vector>

namespace volume {

class Viewport {
public:
    Viewport(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result, int width);

    int width() const { return width_; }
    int height() const { return height_; }
    double scale() const { return scale_; } // pixels per unit of length
    const View &view() const { return view_; }
    const Plane &plane() const { return plane_; }

    // A colour for each row of the plane; dark lines where rows beside each other are `apart`.
    demo::Canvas draw(const std::vector<demo::Colour> &colours, const std::function<bool(size_t, size_t)> &apart) const;

    // A place of the slice, (right, down) in units of length, as a pixel.
    std::array<double, 2> pixel(const std::array<double, 2> &place) const {
        return {(place[0] - view_.left) * scale_, (place[1] - view_.top) * scale_};
    }

private:
    size_t row_at(int x, int y) const; // of the picture at twice its size

    const Slicer &slicer_;
    const Slice &slice_;
    Plane plane_;
    View view_;
    int width_;
    double scale_;
    int height_;
};

// The volume's grey at every row of the plane.
std::vector<demo::Colour> greys_of(const Plane &plane, const Options &options, const Input &input);

// White dots for the seeds near the slice.
void draw_seeds(demo::Canvas &canvas, const Viewport &viewport, const Slicer &slicer, const Slice &slice,
                const Input &input, const Result &result);

} // namespace volume
