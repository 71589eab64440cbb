// A cut that moves through the object in steps, and the Voronoi diagram that follows it by updates.
#pragma once

#include "volume/model.hpp"
#include "volume/slices.hpp"
#include "volume/weights.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace volume {

// The diagram in one slice after a step.
struct CutStep {
    double reach = 0;             // how far the blade has gone, 0..1
    uint64_t edges = 0;           // that this step cut
    uint64_t changed = 0;         // voxels of the object whose label or distance changed
    double seconds = 0;           // of locus_diagram_update
    std::vector<uint32_t> labels; // of the plane's rows
    std::vector<float> distances;
};

struct Cutting {
    std::vector<CutStep> steps; // the first one: before the cut
    double seconds_full = 0;    // of locus_diagram_solve with the whole cut
    uint64_t edges = 0;         // cut by all steps
    uint64_t passable = 0;      // voxels of the object
    bool same = true;           // after the last update, as after that solve; and mended, as before the cut
    uint64_t changed() const;   // voxels changed by all steps, those that changed twice counted twice
    double slowest() const;     // update, in seconds
    double median() const;
};

// Move the blade of the options through the graph, update by update; the graph is mended at the end.
Cutting cut_in_steps(const Options &options, const Input &input, const Material &material, const Result &result,
                     const Slicer &slicer);

// cut.png: the first slice before and after, and what changed. cutting.png: the same slice, step by step, animated.
void draw_cut(const std::string &path, const Options &options, const Input &input, const Material &material,
              const Result &result, const Slicer &slicer, const Cutting &cutting);
void draw_cutting(const std::string &path, const Options &options, const Input &input, const Material &material,
                  const Result &result, const Slicer &slicer, const Cutting &cutting);

} // namespace volume
