// Sheets of three slices.
#include "volume/pictures.hpp"

#include "common/canvas.hpp"
#include "common/colour_map.hpp"
#include "volume/panels.hpp"
#include "volume/text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr int margin = 28, gap = 36, head = 68, foot = 62;
constexpr double most_height = 0.6; // of a slice, in widths of the three
constexpr int contours = 10;        // about as many lines over the range of distances

// What a sheet shows, settled once for all its pixels.
struct Look {
    GreyWindow grey;
    double unit;        // shown distance = distance * unit
    double range, step; // shown distances: end of the colour map, between contour lines
};

Look look_at(const Options &options, const Input &input, const Material &material, const Result &result) {
    const size_t stride = std::max<size_t>(1, result.labels.size() / 1'000'000); // a sample is enough for percentiles
    std::vector<float> distances;
    for (size_t i = 0; i < result.labels.size(); i += stride)
        if (result.labels[i] != LOCUS_NO_SEED)
            distances.push_back(result.distances[i]);
    Look look{};
    look.grey = GreyWindow(options, input);
    look.unit = material.softest;
    look.range = std::max(percentile(distances, 0.995) * look.unit, 1e-30);
    look.step = round_step(look.range, contours);
    return look;
}

struct Pixel {
    Colour grey;
    uint32_t label = LOCUS_NO_SEED;
    double distance = 0; // as shown
    bool reached = false;
};

// How a sheet colours its pixels and how strong its contour lines are.
struct Paint {
    std::function<Colour(const Pixel &)> colour;
    double contour;
};

// One slice at `scale` pixels per unit of length: every pixel painted, cell borders and contour lines over it.
Canvas draw_panel(const Slicer &slicer, const Slice &slice, const Look &look, const Result &result, double scale,
                  const Paint &paint) {
    const int width = std::max(1, static_cast<int>(std::lround(slice.width * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(slice.height * scale)));
    std::vector<Pixel> pixels(static_cast<size_t>(width) * static_cast<size_t>(height));
    const auto at = [&](int x, int y) -> Pixel & {
        return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto grid = slicer.grid_at(slice, (x + 0.5) / scale, (y + 0.5) / scale);
            Pixel &pixel = at(x, y);
            pixel.grey = demo::colour_of(demo::ColourMap::grey, look.grey.light(slicer.value(slice, grid)));
            pixel.label = result.labels[slicer.nearest(grid)];
            const auto distance = slicer.between(slice, grid, [&](size_t voxel) { return result.distances[voxel]; });
            pixel.reached = distance.has_value();
            pixel.distance = double{distance.value_or(0)} * look.unit;
        }
    Canvas canvas(width, height, paper);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Pixel &here = at(x, y);
            Colour colour = paint.colour(here);
            for (const auto &[dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
                if (x + dx >= width || y + dy >= height)
                    continue;
                const Pixel &next = at(x + dx, y + dy);
                if (!here.reached || !next.reached)
                    continue;
                if (here.label != next.label)
                    colour = demo::mix(colour, black, 0.8);
                else if (std::floor(here.distance / look.step) != std::floor(next.distance / look.step))
                    colour = demo::mix(colour, white, paint.contour);
            }
            canvas.set(x, y, colour);
        }
    return canvas;
}

// The name of a panel's side, legible on any ground.
void write_side(Canvas &canvas, int x, int y, const std::string &text) {
    if (text.empty())
        return;
    const int width = Canvas::text_width(text);
    canvas.fill(x - width / 2 - 4, y - 1, width + 8, Canvas::text_height() + 2, black, 0.55);
    write_centred(canvas, x, y, text, ink);
}

// The panel's caption, the names of its sides, and lines where the other two slices cut it.
void annotate(Canvas &sheet, const Slicer &slicer, const Slice &slice, int x, int y, int width, int height,
              double scale) {
    std::array<uint64_t, 3> centre{};
    for (const Slice &other : slicer.slices())
        centre[other.through] = other.at;
    const auto cut = slicer.place_of(slice, centre);
    sheet.line(x + cut[0] * scale, y, x + cut[0] * scale, y + height - 1, white, 0.2);
    sheet.line(x, y + cut[1] * scale, x + width - 1, y + cut[1] * scale, white, 0.2);
    sheet.frame(x - 1, y - 1, width + 2, height + 2, {70, 72, 78});
    const int line = Canvas::text_height(), middle = y + height / 2 - line / 2;
    write_side(sheet, x + 14, middle, slice.left);
    write_side(sheet, x + width - 14, middle, slice.right);
    write_side(sheet, x + width / 2, y + 6, slice.top);
    write_side(sheet, x + width / 2, y + height - line - 6, slice.bottom);
    write_centred(sheet, x + width / 2, y + height + 8, slice.title, ink);
}

struct Sheet {
    Canvas canvas;
    int legend_y;
};

Sheet draw_sheet(const std::string &title, const std::string &subtitle, const Options &options, const Input &input,
                 const Result &result, const Slicer &slicer, const Look &look, const Paint &paint) {
    double widths = 0, tallest = 0;
    for (const Slice &slice : slicer.slices()) {
        widths += slice.width;
        tallest = std::max(tallest, slice.height);
    }
    const double scale = options.width * std::min(1 / widths, most_height / tallest);
    std::vector<Canvas> panels;
    int width = 2 * margin - gap, height = 0;
    for (const Slice &slice : slicer.slices()) {
        panels.push_back(halved(draw_panel(slicer, slice, look, result, 2 * scale, paint)));
        draw_seeds(panels.back(), slicer, slice, input, result, scale);
        width += panels.back().width() + gap;
        height = std::max(height, panels.back().height());
    }
    const int wanted = 2 * margin + std::max(Canvas::text_width(title, Font::large), Canvas::text_width(subtitle));
    Sheet sheet{Canvas(std::max(width, wanted), head + height + foot + 56, paper), head + height + foot};
    sheet.canvas.text(margin, 14, title, ink, Font::large);
    sheet.canvas.text(margin, 42, subtitle, faint);
    int x = margin;
    for (size_t i = 0; i < panels.size(); ++i) {
        const int y = head + (height - panels[i].height()) / 2;
        sheet.canvas.paste(panels[i], x, y);
        annotate(sheet.canvas, slicer, slicer.slices()[i], x, y, panels[i].width(), panels[i].height(), scale);
        x += panels[i].width() + gap;
    }
    draw_scale_bar(sheet.canvas, margin, sheet.legend_y + 8, scale, slicer.slices()[0].width,
                   options.anatomy ? " mm" : "");
    return sheet;
}

std::string contour_text(const Look &look, const Options &options) {
    return "lines of equal distance every " + short_number(look.step) + (options.anatomy ? " mm" : "") +
           ", as lengths of the softest material";
}

} // namespace

void draw_cells(const std::string &path, const Options &options, const Input &input, const Material &material,
                const Result &result, const Slicer &slicer) {
    const Look look = look_at(options, input, material, result);
    const auto colour = [](const Pixel &pixel) {
        return pixel.reached ? demo::mix(pixel.grey, demo::label_colour(pixel.label), 0.55) : pixel.grey;
    };
    const Paint paint{colour, 0.5};
    const Sheet sheet = draw_sheet(
        options.title + ": Voronoi cells of " + std::to_string(result.seeds.size()) + " seeds",
        contour_text(look, options) + "; dots: seeds near the slice", options, input, result, slicer, look, paint);
    demo::write_png(path, sheet.canvas);
}

void draw_distances(const std::string &path, const Options &options, const Input &input, const Material &material,
                    const Result &result, const Slicer &slicer) {
    const Look look = look_at(options, input, material, result);
    const auto colour = [&](const Pixel &pixel) {
        return pixel.reached ? demo::colour_of(demo::ColourMap::viridis, pixel.distance / look.range)
                             : demo::mix(pixel.grey, paper, 0.55);
    };
    const Paint paint{colour, 0.75};
    Sheet sheet = draw_sheet(options.title + ": distance to the nearest seed",
                             contour_text(look, options) + "; dark lines: borders of cells", options, input, result,
                             slicer, look, paint);
    std::vector<demo::Mark> marks;
    const double every = round_step(look.range, 6);
    for (double mark = 0; mark <= look.range * 1.0001; mark += every)
        marks.push_back({mark / look.range, short_number(mark)});
    const int width = std::min(520, sheet.canvas.width() / 2);
    demo::draw_legend(sheet.canvas, sheet.canvas.width() - margin - width - 16, sheet.legend_y, width, 14,
                      demo::ColourMap::viridis, marks, ink);
    demo::write_png(path, sheet.canvas);
}

} // namespace volume
