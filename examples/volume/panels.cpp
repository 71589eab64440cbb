// Parts of the sheets.
#include "volume/panels.hpp"

#include "volume/text.hpp"

#include <algorithm>
#include <cmath>

namespace volume {

using demo::Canvas;
using demo::Colour;
using demo::Font;

double percentile(std::vector<float> &numbers, double part) {
    if (numbers.empty())
        return 0;
    const auto place = numbers.begin() + static_cast<ptrdiff_t>(part * static_cast<double>(numbers.size() - 1));
    std::ranges::nth_element(numbers, place);
    return double{*place};
}

GreyWindow::GreyWindow(const Options &options, const Input &input) {
    const size_t voxels = static_cast<size_t>(input.voxels());
    const size_t stride = std::max<size_t>(1, voxels / 1'000'000); // a sample is enough for percentiles
    std::vector<float> greys;
    for (size_t i = 0; i < voxels; i += stride)
        if (std::isfinite(input.values()[i]))
            greys.push_back(input.values()[i]);
    dark_ = options.window ? (*options.window)[0] : percentile(greys, 0.01);
    bright_ = options.window ? (*options.window)[1] : percentile(greys, 0.99);
    if (!(bright_ > dark_))
        bright_ = dark_ + 1;
}

double GreyWindow::light(float value) const {
    return std::isfinite(value) ? (double{value} - dark_) / (bright_ - dark_) : 0;
}

View view_of(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result, double room) {
    double low[2] = {slice.width, slice.height}, high[2] = {0, 0};
    std::array<uint64_t, 3> voxel{};
    voxel[slice.through] = slice.at;
    for (voxel[slice.down] = 0; voxel[slice.down] < input.info.dims[slice.down]; ++voxel[slice.down])
        for (voxel[slice.across] = 0; voxel[slice.across] < input.info.dims[slice.across]; ++voxel[slice.across]) {
            if (result.labels[index_of(input, voxel)] == LOCUS_NO_SEED)
                continue;
            const auto place = slicer.place_of(slice, voxel);
            for (size_t i = 0; i < 2; ++i) {
                low[i] = std::min(low[i], place[i]);
                high[i] = std::max(high[i], place[i]);
            }
        }
    if (low[0] > high[0])
        return {0, 0, slice.width, slice.height};
    return {low[0] - room, low[1] - room, high[0] - low[0] + 2 * room, high[1] - low[1] + 2 * room};
}

Canvas halved(const Canvas &large) {
    Canvas small(std::max(1, large.width() / 2), std::max(1, large.height() / 2), paper);
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) {
            const int right = std::min(2 * x + 1, large.width() - 1), below = std::min(2 * y + 1, large.height() - 1);
            const Colour top = demo::mix(large.at(2 * x, 2 * y), large.at(right, 2 * y), 0.5);
            const Colour bottom = demo::mix(large.at(2 * x, below), large.at(right, below), 0.5);
            small.set(x, y, demo::mix(top, bottom, 0.5));
        }
    return small;
}

std::vector<locus_seed> seeds_near(const Slicer &slicer, const Slice &slice, const Input &input, const Result &result) {
    const double reach = std::max(2.0, 0.05 * static_cast<double>(input.info.dims[slice.through]));
    std::vector<locus_seed> near;
    for (const locus_seed &seed : result.seeds) {
        const std::array<uint64_t, 3> voxel{seed.x, seed.y, seed.z};
        const double off = std::abs(static_cast<double>(voxel[slice.through]) - static_cast<double>(slice.at));
        const auto place = slicer.place_of(slice, voxel);
        if (off <= reach && result.labels[slicer.nearest(slicer.grid_at(slice, place[0], place[1]))] == seed.id)
            near.push_back(seed);
    }
    return near;
}

void draw_dot(Canvas &canvas, double x, double y, Colour colour) {
    canvas.disc(x, y, 4.5, black);
    canvas.disc(x, y, 3.2, colour);
}

void draw_seeds(Canvas &canvas, const Slicer &slicer, const Slice &slice, const Input &input, const Result &result,
                double scale) {
    for (const locus_seed &seed : seeds_near(slicer, slice, input, result)) {
        const auto place = slicer.place_of(slice, {seed.x, seed.y, seed.z});
        draw_dot(canvas, place[0] * scale, place[1] * scale, white);
    }
}

void write_centred(Canvas &canvas, int x, int y, const std::string &text, Colour colour, Font font) {
    canvas.text(x - Canvas::text_width(text, font) / 2, y, text, colour, font);
}

void draw_scale_bar(Canvas &sheet, int x, int y, double scale, double extent, const std::string &unit) {
    const double length = round_step(extent, 4);
    const int pixels = static_cast<int>(std::lround(length * scale));
    sheet.fill(x, y, pixels, 3, ink);
    sheet.text(x + pixels + 8, y - Canvas::text_height() / 2 + 1, short_number(length) + unit, ink);
}

} // namespace volume
