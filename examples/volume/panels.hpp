// What the sheets of slices share: their colours, the grey window, seeds, captions and the scale bar.
#pragma once

#include "common/canvas.hpp"
#include "volume/model.hpp"
#include "volume/slices.hpp"

#include <string>
#include <vector>

namespace volume {

constexpr demo::Colour paper{16, 17, 20}, ink{232, 232, 232}, faint{150, 152, 158}, black{0, 0, 0},
    white{255, 255, 255};

// The number below which `part` of the numbers lie; reorders them.
double percentile(std::vector<float> &numbers, double part);

// Which values of the volume are shown black and which white.
class GreyWindow {
public:
    GreyWindow() = default;
    GreyWindow(const Options &options, const Input &input);
    double light(float value) const; // 0 black, 1 white, beyond where the value lies outside the window

private:
    double dark_ = 0, bright_ = 1;
};

// The part of a slice that the reached voxels take and `room` around it, in units of length from its top left corner.
struct View {
    double left, top, width, height;
};
View view_of(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result, double room);

// Half the size, four pixels averaged into one: smooth lines.
demo::Canvas halved(const demo::Canvas &large);

// Seeds near the slice, where their cells meet it: no farther off than a twentieth of the volume, or two voxels.
std::vector<locus_seed> seeds_near(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result);
void draw_dot(demo::Canvas &canvas, double x, double y, demo::Colour colour);
void draw_seeds(demo::Canvas &canvas, const Slicer &slicer, const Slice &slice, const Input &input,
                const Result &result, double scale);

void write_centred(demo::Canvas &canvas, int x, int y, const std::string &text, demo::Colour colour,
                   demo::Font font = demo::Font::small);

// A white bar of round length with its length beside it.
void draw_scale_bar(demo::Canvas &sheet, int x, int y, double scale, double extent, const std::string &unit);

} // namespace volume
