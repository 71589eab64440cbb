// The deformed slice as pictures: at rest and moved, stiff and soft material in two colours under a grid that moves
// along.
#include "volume/blade.hpp"
#include "volume/deform.hpp"
#include "volume/panels.hpp"
#include "volume/text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr int margin = 28, gap = 24, head = 76, caption = 52, foot = 44, columns = 3;
constexpr Colour soft{196, 74, 66}, stiff{252, 240, 206}, line{40, 18, 18}, moved{90, 230, 90}, before{110, 200, 255};
constexpr uint64_t mesh = 4;       // voxels between the grid's lines
constexpr double line_width = 0.2; // of a voxel

using Place = std::array<double, 2>;

// What the panels have in common.
struct Stage {
    const Options &options;
    const Input &input;
    const Result &result;
    const Slicer &slicer;
    const Slice &slice;
    Plane plane;
    GreyWindow grey;
    std::vector<float> stiffness; // rows; NaN outside the object at rest
    double stiff_from;
    View view;
    double scale; // pixels per unit of length

    Place pixel(const Place &place, double zoom) const {
        return {(place[0] - view.left) * zoom, (place[1] - view.top) * zoom};
    }
    int pixels(double length, double zoom) const { return std::max(1, static_cast<int>(std::lround(length * zoom))); }
    // 0 outside the object, 1 soft, 2 stiff, for the object at rest.
    int kind(size_t row) const { return std::isnan(stiffness[row]) ? 0 : double{stiffness[row]} >= stiff_from ? 2 : 1; }
};

// Displacements at the corners of the voxels: means over the voxels there that edges join, so that those hang together
// and a cut gapes.
class Corners {
public:
    Corners(const Stage &stage, const Shape &shape) : corners_(shape.there.size()) {
        for (size_t row = 0; row < corners_.size(); ++row)
            for (size_t corner = 0; shape.there[row] && corner < 4; ++corner)
                corners_[row][corner] = mean(stage.plane, shape, row, (corner & 1) != 0 ? 1 : -1, corner < 2 ? -1 : 1);
    }
    // Inside the row's voxel, 0..1 along the grid's axes.
    Place at(size_t row, double across, double down) const {
        Place sum{0, 0};
        for (size_t corner = 0; corner < 4; ++corner) {
            const double weight = ((corner & 1) != 0 ? across : 1 - across) * (corner < 2 ? 1 - down : down);
            sum[0] += weight * corners_[row][corner][0];
            sum[1] += weight * corners_[row][corner][1];
        }
        return sum;
    }

private:
    static Place mean(const Plane &plane, const Shape &shape, size_t row, int across, int down) {
        Place sum = shape.moved[row];
        int count = 1;
        for (const auto &[i, j] : {std::pair{across, 0}, std::pair{0, down}, std::pair{across, down}}) {
            if (!shape.is_joined(row, i, j))
                continue;
            const Place &other = shape.moved[*plane.beside(row, i, j)];
            sum = {sum[0] + other[0], sum[1] + other[1]};
            ++count;
        }
        return {sum[0] / count, sum[1] / count};
    }
    std::vector<std::array<Place, 4>> corners_; // by row
};

// The material's colour at a place inside a voxel at rest: its kind, its grey, and the grid's lines.
Colour material_colour(const Stage &stage, size_t row, const std::array<double, 3> &grid) {
    const double light = std::clamp(stage.grey.light(stage.slicer.value(stage.slice, grid)), 0.0, 1.0);
    const Colour flesh = demo::mix(soft, {250, 196, 180}, light);
    const auto on_line = [&](size_t axis) {
        const double along = std::fmod(grid[axis] + 0.5 + line_width / 2, static_cast<double>(mesh));
        return along >= 0 && along < line_width;
    };
    const bool lined = on_line(stage.slice.across) || on_line(stage.slice.down);
    return demo::mix(stage.kind(row) == 2 ? stiff : flesh, line, lined ? 0.7 : 0);
}

// Every voxel laid where it was moved to, in points close enough to leave no hole.
void lay(Canvas &canvas, const Stage &stage, const Shape &shape, double zoom) {
    const Corners corners(stage, shape);
    const auto &spacing = stage.input.info.spacing;
    for (size_t row = 0; row < shape.there.size(); ++row) {
        if (!shape.there[row])
            continue;
        const auto voxel = stage.plane.at(row);
        const auto place = [&](double across, double down) {
            std::array<double, 3> grid{};
            grid[stage.slice.through] = static_cast<double>(stage.slice.at);
            grid[stage.slice.across] = static_cast<double>(voxel[stage.slice.across]) + across - 0.5;
            grid[stage.slice.down] = static_cast<double>(voxel[stage.slice.down]) + down - 0.5;
            const Place rest = stage.slicer.place_of_grid(stage.slice, grid), by = corners.at(row, across, down);
            return std::pair{stage.pixel({rest[0] + by[0], rest[1] + by[1]}, zoom), grid};
        };
        const auto [a, ignored_a] = place(0, 0);
        double longest = std::max(spacing[stage.slice.across], spacing[stage.slice.down]) * zoom;
        for (const auto &[across, down] : {std::pair{1.0, 0.0}, std::pair{0.0, 1.0}, std::pair{1.0, 1.0}}) {
            const auto [b, ignored_b] = place(across, down);
            longest = std::max(longest, std::hypot(b[0] - a[0], b[1] - a[1]));
        }
        const int steps = static_cast<int>(std::ceil(longest * 1.5)) + 1;
        for (int j = 0; j < steps; ++j)
            for (int i = 0; i < steps; ++i) {
                const auto [at, grid] = place((i + 0.5) / steps, (j + 0.5) / steps);
                canvas.set(static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1])),
                           material_colour(stage, row, grid));
            }
    }
}

// The outlines of the object and its stiff part at rest.
void outline(Canvas &canvas, const Stage &stage, double zoom) {
    const auto kind = [&](int x, int y) {
        const auto grid =
            stage.slicer.grid_at(stage.slice, stage.view.left + (x + 0.5) / zoom, stage.view.top + (y + 0.5) / zoom);
        for (const size_t axis : {stage.slice.across, stage.slice.down})
            if (grid[axis] < -0.5 || grid[axis] > static_cast<double>(stage.input.info.dims[axis]) - 0.5)
                return 0;
        return stage.kind(stage.plane.row(stage.slicer.nearest(grid)));
    };
    for (int y = 0; y < canvas.height(); ++y)
        for (int x = 0; x < canvas.width(); ++x) {
            const int here = kind(x, y);
            if (here != kind(x + 1, y) || here != kind(x, y + 1))
                canvas.fill(x, y, 2, 2, before, 0.8);
        }
}

// Seeds near the slice; those that move as crosses that turn along, with a line from where they were.
void draw_frames(Canvas &canvas, const Stage &stage, bool at_rest) {
    std::vector<locus_seed> seeds = seeds_near(stage.slicer, stage.slice, stage.input, stage.result);
    for (const Motion &motion : stage.options.motions)
        if (std::ranges::find(seeds, motion.id, &locus_seed::id) == seeds.end())
            seeds.push_back(*std::ranges::find(stage.result.seeds, motion.id, &locus_seed::id));
    for (const locus_seed &seed : seeds) {
        const Place rest = stage.slicer.place_of(stage.slice, {seed.x, seed.y, seed.z});
        const auto motion = std::ranges::find(stage.options.motions, seed.id, &Motion::id);
        const Place from = stage.pixel(rest, stage.scale);
        if (motion == stage.options.motions.end() || at_rest) {
            draw_dot(canvas, from[0], from[1], motion == stage.options.motions.end() ? white : moved);
            continue;
        }
        const Place to = stage.pixel({rest[0] + motion->right, rest[1] + motion->down}, stage.scale);
        canvas.line(from[0], from[1], to[0], to[1], black);
        canvas.disc(from[0], from[1], 2.5, black);
        const double angle = motion->degrees * std::numbers::pi / 180, c = 14 * std::cos(angle),
                     s = 14 * std::sin(angle);
        canvas.line(to[0] - c, to[1] - s, to[0] + c, to[1] + s, black);
        canvas.line(to[0] + s, to[1] - c, to[0] - s, to[1] + c, black);
        draw_dot(canvas, to[0], to[1], moved);
    }
}

void draw_blade(Canvas &canvas, const Stage &stage, double zoom) {
    const auto line = line_in(*stage.options.cut, 1, stage.slicer, stage.slice);
    if (!line)
        return;
    const Place a = stage.pixel((*line)[0], zoom), b = stage.pixel((*line)[1], zoom);
    for (const double off : {-1.0, 0.0, 1.0})
        canvas.line(a[0] + off, a[1] + off, b[0] + off, b[1] + off, black);
}

Canvas draw_shape(const Stage &stage, const Shape &shape, bool at_rest, bool cut) {
    const double zoom = 2 * stage.scale;
    Canvas large(stage.pixels(stage.view.width, zoom), stage.pixels(stage.view.height, zoom), {32, 34, 39});
    lay(large, stage, shape, zoom);
    if (!at_rest)
        outline(large, stage, zoom);
    else if (cut)
        draw_blade(large, stage, zoom);
    Canvas panel = halved(large);
    draw_frames(panel, stage, at_rest);
    return panel;
}

// The part of the slice that the shapes take.
View view_of_shapes(const Stage &stage, const Deformation &deformation) {
    const double room = 2 * stage.input.info.spacing[stage.slice.across];
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const Shape *shape : {&deformation.rest, &deformation.uniform, &deformation.compliance, &deformation.cut_stale,
                               &deformation.cut_fresh})
        for (size_t row = 0; row < shape->there.size(); ++row) {
            const Place place = stage.slicer.place_of(stage.slice, stage.plane.at(row));
            for (size_t i = 0; shape->there[row] && i < 2; ++i) {
                low[i] = std::min(low[i], place[i] + shape->moved[row][i] - room);
                high[i] = std::max(high[i], place[i] + shape->moved[row][i] + room);
            }
        }
    if (low[0] > high[0])
        return {0, 0, stage.slice.width, stage.slice.height};
    return {low[0], low[1], high[0] - low[0], high[1] - low[1]};
}

Stage make_stage(const Options &options, const Input &input, const Material &material, const Result &result,
                 const Slicer &slicer, const Deformation &deformation) {
    const Slice &slice = slicer.slices()[0];
    Stage stage{options,
                input,
                result,
                slicer,
                slice,
                Plane(slice, input),
                GreyWindow(options, input),
                {},
                stiff_from(material),
                {},
                0};
    for (size_t row = 0; row < stage.plane.rows(); ++row)
        stage.stiffness.push_back(deformation.rest.there[row]
                                      ? options.table->stiffness(input.values()[index_of(input, stage.plane.at(row))])
                                      : NAN);
    stage.view = view_of_shapes(stage, deformation);
    stage.scale = (options.width - (columns - 1) * gap) / columns / stage.view.width;
    return stage;
}

struct Panel {
    const Shape &shape;
    bool at_rest, cut;
    std::string title, note;
};

std::vector<Panel> panels_of(const Deformation &d) {
    const auto strain = [](const Shape &shape) {
        return "stiff material strained by " + short_number(std::round(1000 * shape.stretch) / 10) + " % at most";
    };
    std::vector<Panel> panels{{d.rest, true, false, "at rest", ""},
                              {d.uniform, false, false, "weights of uniform distances", strain(d.uniform)},
                              {d.compliance, false, false, "weights of compliance distances", strain(d.compliance)}};
    if (d.cut) {
        panels.push_back({d.cut_rest, true, true, "cut, at rest", ""});
        panels.push_back({d.cut_stale, false, true, "cut, weights of before", "both sides still move together"});
        panels.push_back({d.cut_fresh, false, true, "cut, weights updated", strain(d.cut_fresh)});
    }
    return panels;
}

} // namespace

void draw_deformation(const std::string &path, const Options &options, const Input &input, const Material &material,
                      const Result &result, const Slicer &slicer, const Deformation &deformation) {
    const Stage stage = make_stage(options, input, material, result, slicer, deformation);
    const std::vector<Panel> panels = panels_of(deformation);
    const int width = stage.pixels(stage.view.width, stage.scale), rows = static_cast<int>(panels.size()) / columns;
    const int height = stage.pixels(stage.view.height, stage.scale);
    Canvas sheet(2 * margin + columns * (width + gap) - gap, head + rows * (height + caption) + foot, paper);
    sheet.text(margin, 14, options.title + ": moved by the seeds' frames", ink, Font::large);
    sheet.text(margin, 42,
               "slice " + stage.slice.title +
                   ", Sibson's weights; green: seeds that move; light: stiff material; blue: "
                   "outlines at rest",
               faint);
    for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
        const Panel &panel = panels[static_cast<size_t>(i)];
        const int x = margin + i % columns * (width + gap), y = head + i / columns * (height + caption);
        sheet.paste(draw_shape(stage, panel.shape, panel.at_rest, panel.cut), x, y);
        write_centred(sheet, x + width / 2, y + height + 6, panel.title, ink);
        write_centred(sheet, x + width / 2, y + height + 24, panel.note, faint);
    }
    draw_scale_bar(sheet, margin, sheet.height() - foot + 20, stage.scale, stage.view.width,
                   options.anatomy ? " mm" : "");
    demo::write_png(path, sheet);
}

} // namespace volume
