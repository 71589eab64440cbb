// Heat maps of weights (thesis figure 2.17).
#include "common/colour_map.hpp"
#include "volume/panels.hpp"
#include "volume/weights.hpp"

#include <algorithm>
#include <cmath>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr int margin = 28, gap = 20, head = 96, side = 150, foot = 64;
constexpr Colour chosen{90, 230, 90}, ground{44, 46, 52};
constexpr auto heat = demo::ColourMap::inferno;
constexpr double room = 1.5; // around the object, in voxels

// A slice's panels: all show the same part of it at the same scale.
struct Frame {
    const Slicer &slicer;
    const Slice &slice;
    const Input &input;
    const Result &result;
    View view;
    double scale; // pixels per unit of length

    std::array<double, 3> grid(int x, int y, double zoom) const {
        return slicer.grid_at(slice, view.left + (x + 0.5) / zoom, view.top + (y + 0.5) / zoom);
    }
    int pixels(double length, double zoom) const { return std::max(1, static_cast<int>(std::lround(length * zoom))); }
};

// Weights as colours, thin lines between cells. `weight` takes a voxel's index.
Canvas heat_map(const Frame &frame, const auto &weight) {
    const double zoom = 2 * frame.scale;
    const int width = frame.pixels(frame.view.width, zoom), height = frame.pixels(frame.view.height, zoom);
    const auto label = [&](int x, int y) { return frame.result.labels[frame.slicer.nearest(frame.grid(x, y, zoom))]; };
    Canvas canvas(width, height, ground);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto value = frame.slicer.between(frame.slice, frame.grid(x, y, zoom), weight);
            if (!value)
                continue;
            const uint32_t here = label(x, y), right = label(x + 1, y), below = label(x, y + 1);
            const bool border = (right != here && right != LOCUS_NO_SEED) || (below != here && below != LOCUS_NO_SEED);
            canvas.set(x, y, demo::mix(demo::colour_of(heat, double{*value}), white, border ? 0.8 : 0));
        }
    return halved(canvas);
}

void draw_column_seeds(Canvas &canvas, const Frame &frame, uint32_t id) {
    const auto dot = [&](const locus_seed &seed, Colour colour) {
        const auto place = frame.slicer.place_of(frame.slice, {seed.x, seed.y, seed.z});
        draw_dot(canvas, (place[0] - frame.view.left) * frame.scale, (place[1] - frame.view.top) * frame.scale, colour);
    };
    for (const locus_seed &seed : seeds_near(frame.slicer, frame.slice, frame.input, frame.result))
        dot(seed, white);
    for (const locus_seed &seed : frame.result.seeds)
        if (seed.id == id)
            dot(seed, chosen);
}

void draw_heat_legend(Canvas &sheet, int right, int y) {
    const int width = std::min(420, sheet.width() / 3);
    sheet.text(right - width - 24 - Canvas::text_width("weight"), y - 1, "weight", ink);
    demo::draw_legend(sheet, right - width, y, width, 14, heat,
                      {{0, "0"}, {0.25, "0.25"}, {0.5, "0.5"}, {0.75, "0.75"}, {1, "1"}}, ink);
}

} // namespace

void draw_weights(const std::string &path, const Options &options, const Input &input, const Result &result,
                  const Slicer &slicer, locus_diagram *diagram) {
    const std::vector<uint32_t> ids = weight_seeds(options, result);
    const Slice &slice = slicer.slices()[0];
    const Plane plane(slice, input);
    Frame frame{slicer, slice, input, result, {}, 0};
    frame.view = view_of(slicer, slice, input, result, room * input.info.spacing[slice.across]);
    const int columns = static_cast<int>(ids.size()), rows = static_cast<int>(methods.size());
    const int width = std::max(60, (options.width - side - (columns - 1) * gap) / columns);
    frame.scale = width / frame.view.width;
    const int height = frame.pixels(frame.view.height, frame.scale);
    Canvas sheet(2 * margin + side + columns * (width + gap) - gap, head + rows * (height + gap) + foot, paper);
    sheet.text(margin, 14, options.title + ": interpolation weights of " + (columns == 1 ? "a seed" : "seeds"), ink,
               Font::large);
    sheet.text(margin, 42,
               "slice " + slice.title +
                   "; green: the column's seed; white: the other seeds near the slice, borders of "
                   "cells",
               faint);
    for (int row = 0; row < rows; ++row) {
        const Method &method = methods[static_cast<size_t>(row)];
        const int y = head + row * (height + gap);
        sheet.text(margin, y + height / 2 - Canvas::text_height() / 2, method.name, ink);
        Call call(std::string("weights: ") + method.name);
        const Weights weights = make_weights(diagram, method.number, &plane.box, &call);
        const std::vector<float> numbers = dense(weights.get(), ids);
        for (int column = 0; column < columns; ++column) {
            const auto c = static_cast<size_t>(column);
            Canvas panel = heat_map(frame, [&](size_t voxel) { return numbers[plane.row(voxel) * ids.size() + c]; });
            draw_column_seeds(panel, frame, ids[c]);
            const int x = margin + side + column * (width + gap);
            sheet.paste(panel, x, y);
            if (row == 0)
                write_centred(sheet, x + width / 2, head - 24, "seed " + std::to_string(ids[c]), ink);
        }
    }
    draw_heat_legend(sheet, sheet.width() - margin - 10, sheet.height() - foot + 14);
    draw_scale_bar(sheet, margin, sheet.height() - foot + 21, frame.scale, frame.view.width,
                   options.anatomy ? " mm" : "");
    demo::write_png(path, sheet);
}

} // namespace volume
