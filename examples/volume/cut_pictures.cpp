// The cut as pictures: cells of the first slice, lighter and darker in bands of equal distance, and the blade.
#include "common/animation.hpp"
#include "common/colour_map.hpp"
#include "common/progress.hpp"
#include "volume/blade.hpp"
#include "volume/cutting.hpp"
#include "volume/text.hpp"
#include "volume/viewport.hpp"

#include <algorithm>
#include <cmath>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr int margin = 28, gap = 24, head = 76, caption = 52, foot = 44, columns = 3, frame_width = 640;
constexpr int bands = 14; // of distance, about
constexpr Colour steel{255, 236, 80};
constexpr uint16_t milliseconds = 350; // a step of the animation

// What the pictures of one cut have in common.
struct Scene {
    const Options &options;
    const Input &input;
    const Result &result;
    const Slicer &slicer;
    const Slice &slice;
    const Cutting &cutting;
    Viewport viewport;
    std::vector<Colour> greys;
    double unit; // a distance as a length of the softest material
    double band; // of such lengths

    Scene(const Options &o, const Input &i, const Material &material, const Result &r, const Slicer &s,
          const Cutting &c, int width)
        : options(o), input(i), result(r), slicer(s), slice(s.slices()[0]), cutting(c), viewport(s, slice, i, r, width),
          greys(greys_of(viewport.plane(), o, i)), unit(material.softest) {
        std::vector<float> distances;
        for (const float distance : cutting.steps.back().distances)
            if (std::isfinite(distance))
                distances.push_back(distance);
        band = round_step(std::max(percentile(distances, 0.995) * unit, 1e-30), bands);
    }
    std::string band_text() const {
        return "bands of " + short_number(band) + (options.anatomy ? " mm" : "") +
               " of distance, as lengths of the softest material";
    }
};

bool same_at(const CutStep &a, const CutStep &b, size_t row) {
    return a.labels[row] == b.labels[row] && (a.distances[row] == b.distances[row] || a.labels[row] == LOCUS_NO_SEED);
}

void draw_blade(Canvas &canvas, const Scene &scene, double reach) {
    const auto line = reach > 0 ? line_in(*scene.options.cut, reach, scene.slicer, scene.slice) : std::nullopt;
    if (!line)
        return;
    const auto a = scene.viewport.pixel((*line)[0]), b = scene.viewport.pixel((*line)[1]);
    for (const double off : {-0.5, 0.5}) // two pixels wide whichever way it runs
        canvas.line(a[0] + off, a[1] + off, b[0] + off, b[1] + off, steel);
}

// Cells after a step. With `before`, voxels that are as they were there lose their colours.
Canvas draw_cells(const Scene &scene, const CutStep &step, const CutStep *before) {
    std::vector<Colour> colours = scene.greys;
    for (size_t row = 0; row < colours.size(); ++row) {
        if (step.labels[row] == LOCUS_NO_SEED)
            continue;
        const double distance = double{step.distances[row]} * scene.unit;
        const bool odd = std::fmod(std::floor(distance / scene.band), 2) > 0;
        const double cover = before != nullptr && same_at(step, *before, row) ? 0.08 : odd ? 0.42 : 0.62;
        colours[row] = demo::mix(colours[row], demo::label_colour(step.labels[row]), cover);
    }
    Canvas canvas = scene.viewport.draw(colours, [&](size_t a, size_t b) { return step.labels[a] != step.labels[b]; });
    draw_blade(canvas, scene, step.reach);
    draw_seeds(canvas, scene.viewport, scene.slicer, scene.slice, scene.input, scene.result);
    return canvas;
}

std::string times_text(const Cutting &cutting) {
    return std::to_string(cutting.steps.size() - 1) + " updates, " + demo::duration_text(cutting.median()) +
           " each (median); solved anew: " + demo::duration_text(cutting.seconds_full);
}

} // namespace

void draw_cut(const std::string &path, const Options &options, const Input &input, const Material &material,
              const Result &result, const Slicer &slicer, const Cutting &cutting) {
    const Scene scene(options, input, material, result, slicer, cutting,
                      (options.width - (columns - 1) * gap) / columns);
    const CutStep &before = cutting.steps.front(), &after = cutting.steps.back();
    const int width = scene.viewport.width(), height = scene.viewport.height();
    Canvas sheet(2 * margin + columns * (width + gap) - gap, head + height + caption + foot, paper);
    sheet.text(margin, 14, options.title + ": the diagram follows a cut", ink, Font::large);
    sheet.text(margin, 42, "slice " + scene.slice.title + "; yellow: the blade; " + scene.band_text(), faint);
    const auto panel = [&](int column, const Canvas &picture, const std::string &title, const std::string &note) {
        const int x = margin + column * (width + gap);
        sheet.paste(picture, x, head);
        write_centred(sheet, x + width / 2, head + height + 6, title, ink);
        write_centred(sheet, x + width / 2, head + height + 24, note, faint);
    };
    panel(0, draw_cells(scene, before, nullptr), "before", "");
    panel(1, draw_cells(scene, after, nullptr), "after the cut",
          demo::with_commas(cutting.edges) + " edges of the graph disabled, no voxel removed");
    panel(2, draw_cells(scene, after, &before), "voxels that changed", times_text(cutting));
    draw_scale_bar(sheet, margin, sheet.height() - foot + 20, scene.viewport.scale(), scene.viewport.view().width,
                   options.anatomy ? " mm" : "");
    demo::write_png(path, sheet);
}

void draw_cutting(const std::string &path, const Options &options, const Input &input, const Material &material,
                  const Result &result, const Slicer &slicer, const Cutting &cutting) {
    const Scene scene(options, input, material, result, slicer, cutting, frame_width);
    demo::Animation animation;
    for (size_t i = 0; i < cutting.steps.size(); ++i) {
        const CutStep &step = cutting.steps[i];
        Canvas frame(2 * margin + frame_width, head + scene.viewport.height() + margin, paper);
        frame.text(margin, 14, options.title + ": a moving cut", ink, Font::large);
        frame.text(margin, 42,
                   i == 0 ? "slice " + scene.slice.title + "; " + scene.band_text()
                          : "step " + std::to_string(i) + ": " + demo::with_commas(step.edges) + " edges cut, " +
                                demo::with_commas(step.changed) + " of " + demo::with_commas(cutting.passable) +
                                " voxels changed, update " + demo::duration_text(step.seconds),
                   faint);
        frame.paste(draw_cells(scene, step, nullptr), margin, head);
        animation.add(demo::encode_png(frame));
    }
    animation.write(path, milliseconds);
}

} // namespace volume
