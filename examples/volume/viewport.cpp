// Voxels of a slice as squares.
#include "volume/viewport.hpp"

#include "common/colour_map.hpp"

#include <algorithm>
#include <cmath>

namespace volume {

using demo::Canvas;
using demo::Colour;

namespace {

constexpr double room = 1.5; // around the object, in voxels

} // namespace

Viewport::Viewport(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result, int width)
    : slicer_(slicer), slice_(slice), plane_(slice, input),
      view_(view_of(slicer, slice, input, result, room * input.info.spacing[slice.across])), width_(width),
      scale_(width / view_.width), height_(std::max(1, static_cast<int>(std::lround(view_.height * scale_)))) {}

size_t Viewport::row_at(int x, int y) const {
    const double zoom = 2 * scale_;
    return plane_.row(
        slicer_.nearest(slicer_.grid_at(slice_, view_.left + (x + 0.5) / zoom, view_.top + (y + 0.5) / zoom)));
}

Canvas Viewport::draw(const std::vector<Colour> &colours, const std::function<bool(size_t, size_t)> &apart) const {
    Canvas large(2 * width_, 2 * height_);
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x) {
            const size_t here = row_at(x, y), right = row_at(x + 1, y), below = row_at(x, y + 1);
            const bool border = (right != here && apart(here, right)) || (below != here && apart(here, below));
            large.set(x, y, border ? demo::mix(colours[here], black, 0.85) : colours[here]);
        }
    return halved(large);
}

std::vector<Colour> greys_of(const Plane &plane, const Options &options, const Input &input) {
    const GreyWindow grey(options, input);
    std::vector<Colour> greys;
    for (size_t row = 0; row < plane.rows(); ++row)
        greys.push_back(
            demo::colour_of(demo::ColourMap::grey, grey.light(input.values()[index_of(input, plane.at(row))])));
    return greys;
}

void draw_seeds(Canvas &canvas, const Viewport &viewport, const Slicer &slicer, const Slice &slice, const Input &input,
                const Result &result) {
    for (const locus_seed &seed : seeds_near(slicer, slice, input, result)) {
        const auto at = viewport.pixel(slicer.place_of(slice, {seed.x, seed.y, seed.z}));
        draw_dot(canvas, at[0], at[1], white);
    }
}

} // namespace volume
