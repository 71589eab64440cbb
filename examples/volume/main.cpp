// volume: any volume file and a transfer table in; Voronoi diagram, distances, pictures and volumes out.
#include "volume/cutting.hpp"
#include "volume/deform.hpp"
#include "volume/model.hpp"
#include "volume/options.hpp"
#include "volume/pictures.hpp"
#include "volume/slices.hpp"
#include "volume/text.hpp"
#include "volume/waves.hpp"
#include "volume/weights.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace volume {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void row(const char *name, const std::string &text) { std::printf("  %-12s %s\n", name, text.c_str()); }

std::string triple(const auto &numbers) {
    return short_number(static_cast<double>(numbers[0])) + " x " + short_number(static_cast<double>(numbers[1])) +
           " x " + short_number(static_cast<double>(numbers[2]));
}

std::string engine_name(uint32_t engine) {
    switch (engine) {
    case LOCUS_ENGINE_HEAP:
        return "heap";
    case LOCUS_ENGINE_BUCKET:
        return "bucket";
    case LOCUS_ENGINE_BRICKS:
        return "bricks";
    case LOCUS_ENGINE_RELAX:
        return "relax";
    default:
        return "engine " + std::to_string(engine);
    }
}

void summarize_graph(const Input &input, const Material &material) {
    using demo::with_commas;
    locus_graph_info info{};
    info.struct_size = sizeof info;
    check(locus_graph_get_info(material.graph.get(), &info));
    const double share = 100 * static_cast<double>(info.passable) / static_cast<double>(input.voxels());
    row("voxels", with_commas(input.voxels()) + " (" + triple(info.dims) + "), spacing " + triple(info.spacing));
    row("passable",
        with_commas(info.passable) + " (" + short_number(share) + " %)" +
            (material.dropped > 0 ? ", after dropping " + with_commas(material.dropped) + " in other parts" : ""));
    row("stiffness", short_number(material.softest) + " to " + short_number(material.stiffest));
    row("word",
        std::to_string(info.word_bits) + " bits, " + std::to_string(info.label_bits) + " of them for the label");
    row("scale",
        short_number(info.scale) + " steps per unit of distance, largest distance " + short_number(info.max_distance));
    row("error", "an edge's weight is rounded by " + short_number(100 * info.weight_error) + " % at most");
}

void summarize_result(const Material &material, const Result &result) {
    using demo::duration_text;
    using demo::with_commas;
    const locus_diagram_stats &stats = result.stats;
    const auto [smallest, largest] = std::ranges::minmax(result.cell_sizes);
    row("seeds", std::to_string(result.seeds.size()) +
                     (result.seconds_place > 0.0005 ? ", placed in " + duration_text(result.seconds_place) : ""));
    row("solved", "in " + duration_text(stats.seconds_solve) + " by " + engine_name(stats.engine) + " with " +
                      std::to_string(stats.threads) + " thread(s), import " + duration_text(stats.seconds_import) +
                      ", export " + duration_text(stats.seconds_export) + ", " + with_commas(stats.relaxations) +
                      " edges looked at");
    row("reached", with_commas(stats.reached) + " of " + with_commas(material.passable) +
                       " passable voxels, largest distance " + short_number(stats.max_distance));
    row("cells", with_commas(smallest) + " to " + with_commas(largest) + " voxels, " +
                     with_commas(result.pairs.size()) + " pairs touch");
}

void show_weights(const Options &options, const Input &input, const Material &material, const Result &result,
                  const Slicer &slicer) {
    const Diagram diagram = solve_again(options, material.graph.get(), result.seeds);
    draw_weights(options.out + "/weights.png", options, input, result, slicer, diagram.get());
    row("weights", write_weights(options.out, input, result, diagram.get()));
}

bool show_waves(const Options &options, const Input &input, const Material &material, const Result &result,
                const Slicer &slicer) {
    const Waves waves = propagate(input, material, result, slicer);
    draw_waves(options.out, options, input, result, slicer, waves);
    const double times = static_cast<double>(waves.activations) / static_cast<double>(result.stats.reached);
    row("waves", std::to_string(waves.waves.size()) + " iterations, a voxel active " + short_number(times) +
                     " times on average, labels " + (waves.same ? "the same" : "DIFFER"));
    return waves.same;
}

bool show_cut(const Options &options, const Input &input, const Material &material, const Result &result,
              const Slicer &slicer) {
    const Cutting cutting = cut_in_steps(options, input, material, result, slicer);
    draw_cut(options.out + "/cut.png", options, input, material, result, slicer, cutting);
    draw_cutting(options.out + "/cutting.png", options, input, material, result, slicer, cutting);
    row("cut", demo::with_commas(cutting.edges) + " edges in " + std::to_string(options.cut_steps) + " steps, " +
                   demo::with_commas(cutting.changed()) + " changes of voxels; an update took " +
                   demo::duration_text(cutting.median()) + " (median), " + demo::duration_text(cutting.slowest()) +
                   " at most, solving anew " + demo::duration_text(cutting.seconds_full) +
                   (cutting.same ? ", the same" : ", THEY DIFFER"));
    return cutting.same;
}

bool show_deformation(const Options &options, const Input &input, const Material &material, const Result &result,
                      const Slicer &slicer) {
    const Deformation shapes = deform(options, input, material, result, slicer);
    draw_deformation(options.out + "/deform.png", options, input, material, result, slicer, shapes);
    const auto percent = [](double part) { return short_number(100 * part) + " %"; };
    row("deformed", "stiff material strained by at most " + percent(shapes.uniform.stretch) +
                        " with weights of uniform distances, " + percent(shapes.compliance.stretch) +
                        " with those of compliance");
    if (shapes.cut)
        row("weights cut", demo::with_commas(shapes.changed) + " rows of weights changed, updated in " +
                               demo::duration_text(shapes.seconds_update) +
                               " (made anew: " + demo::duration_text(shapes.seconds_fresh) +
                               (shapes.same ? ", the same)" : ", THEY DIFFER)"));
    return shapes.same;
}

int run(const Options &options) {
    const auto begin = std::chrono::steady_clock::now();
    std::filesystem::create_directories(options.out);
    const Input input = read_input(options);
    const Material material = make_material(options, input);
    std::printf("%s\n", options.input.c_str());
    summarize_graph(input, material);
    const Result result = solve(options, input, material.graph.get());
    summarize_result(material, result);

    const Slicer slicer(options, input, result);
    draw_cells(options.out + "/cells.png", options, input, material, result, slicer);
    draw_distances(options.out + "/distances.png", options, input, material, result, slicer);
    std::string pictures = "cells.png distances.png";
    bool same = true;
    if (options.trace) {
        const Trace traced = trace(input, material.graph.get(), result);
        draw_trace(options.out + "/trace.png", options.title + ": activity of the relaxation", traced.active);
        row("trace", std::to_string(traced.active.size()) + " iterations of the relaxation, " +
                         (traced.same_labels ? "labels the same" : "LABELS DIFFER"));
        same = traced.same_labels;
        pictures += " trace.png";
    }
    if (options.weights) {
        show_weights(options, input, material, result, slicer);
        pictures += " weights.png";
    }
    if (options.waves) {
        same = show_waves(options, input, material, result, slicer) && same;
        pictures += " waves.png waves-series.png";
    }
    if (options.cut) {
        same = show_cut(options, input, material, result, slicer) && same;
        pictures += " cut.png cutting.png";
    }
    if (!options.motions.empty()) {
        same = show_deformation(options, input, material, result, slicer) && same;
        pictures += " deform.png";
    }
    write_volumes(options.out, input, result);
    write_seeds(options.out + "/seeds.txt", result.seeds);
    row("written", options.out + ": " + pictures + " labels.nrrd distances.nrrd seeds.txt");
    row("total", demo::duration_text(seconds_since(begin)));
    return same ? 0 : 1;
}

} // namespace
} // namespace volume

int main(int count, char **words) {
    try {
        volume::Options options;
        if (const auto status = volume::parse_options(count, words, options))
            return *status;
        return volume::run(options);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "volume: %s\n", error.what());
        return 1;
    }
}
