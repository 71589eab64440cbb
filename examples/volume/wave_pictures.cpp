// Waves as an animation and side by side: cells as far as they have come, the front of active voxels black.
#include "common/animation.hpp"
#include "common/colour_map.hpp"
#include "common/progress.hpp"
#include "volume/viewport.hpp"
#include "volume/waves.hpp"

#include <algorithm>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr int margin = 28, gap = 20, head = 76, caption = 30, frame_width = 640, columns = 4, rows = 2;
constexpr Colour ground{112, 116, 126}; // outside the object
constexpr size_t most_frames = 60;
constexpr uint16_t milliseconds = 120; // a frame of the animation

struct Scene {
    const Options &options;
    const Input &input;
    const Result &result;
    const Slicer &slicer;
    const Waves &waves;
    Viewport viewport;
    std::vector<Colour> greys;

    Scene(const Options &o, const Input &i, const Result &r, const Slicer &s, const Waves &w, int width)
        : options(o), input(i), result(r), slicer(s), waves(w), viewport(s, s.slices()[0], i, r, width),
          greys(greys_of(viewport.plane(), o, i)) {
        for (size_t row = 0; row < greys.size(); ++row)
            if (waves.waves.back().labels[row] == LOCUS_NO_SEED)
                greys[row] = ground;
    }

    Canvas draw(const Wave &wave) const {
        std::vector<Colour> colours = greys;
        for (size_t row = 0; row < colours.size(); ++row)
            if (wave.front[row])
                colours[row] = black;
            else if (wave.labels[row] != LOCUS_NO_SEED)
                colours[row] =
                    demo::mix(demo::mix(colours[row], white, 0.35), demo::label_colour(wave.labels[row]), 0.6);
        Canvas canvas = viewport.draw(colours, [&](size_t a, size_t b) {
            return wave.labels[a] != wave.labels[b] && !wave.front[a] && !wave.front[b];
        });
        draw_seeds(canvas, viewport, slicer, slicer.slices()[0], input, result);
        return canvas;
    }
    std::string text(size_t i) const {
        return "iteration " + std::to_string(i + 1) + " of " + std::to_string(waves.waves.size()) + ": " +
               demo::with_commas(waves.waves[i].active) + " active voxels";
    }
};

void draw_animation(const std::string &path, const Scene &scene) {
    demo::Animation animation;
    const size_t count = scene.waves.waves.size(), every = (count + most_frames - 1) / most_frames;
    for (size_t i = 0; i < count; i = i + every < count || i + 1 == count ? i + every : count - 1) {
        Canvas frame(2 * margin + frame_width, head + scene.viewport.height() + margin, paper);
        frame.text(margin, 14, scene.options.title + ": waves from the seeds", ink, Font::large);
        frame.text(margin, 42, "slice " + scene.slicer.slices()[0].title + ", " + scene.text(i) + " (black)", faint);
        frame.paste(scene.draw(scene.waves.waves[i]), margin, head);
        animation.add(demo::encode_png(frame));
    }
    animation.write(path, milliseconds);
}

void draw_series(const std::string &path, const Scene &scene) {
    const int width = scene.viewport.width(), height = scene.viewport.height();
    Canvas sheet(2 * margin + columns * (width + gap) - gap, head + rows * (height + caption) + margin, paper);
    sheet.text(margin, 14, scene.options.title + ": waves from the seeds", ink, Font::large);
    sheet.text(margin, 42,
               "slice " + scene.slicer.slices()[0].title + "; black: voxels that are active in the iteration", faint);
    const size_t count = scene.waves.waves.size();
    for (int i = 0; i < columns * rows; ++i) {
        const size_t at = (count - 1) * static_cast<size_t>(i) / (columns * rows - 1);
        const int x = margin + i % columns * (width + gap), y = head + i / columns * (height + caption);
        sheet.paste(scene.draw(scene.waves.waves[at]), x, y);
        write_centred(sheet, x + width / 2, y + height + 6, scene.text(at), ink);
    }
    demo::write_png(path, sheet);
}

} // namespace

void draw_waves(const std::string &folder, const Options &options, const Input &input, const Result &result,
                const Slicer &slicer, const Waves &waves) {
    draw_animation(folder + "/waves.png", Scene(options, input, result, slicer, waves, frame_width));
    const int width = (options.width - (columns - 1) * gap) / columns;
    draw_series(folder + "/waves-series.png", Scene(options, input, result, slicer, waves, width));
}

} // namespace volume
