// From a volume to its Voronoi diagram, by calls of the C interface alone.
#pragma once

#include "volume/options.hpp"

#include <locus/weights.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace volume {

struct Destroy {
    void operator()(locus_volume *volume) const { locus_volume_destroy(volume); }
    void operator()(locus_graph *graph) const { locus_graph_destroy(graph); }
    void operator()(locus_diagram *diagram) const { locus_diagram_destroy(diagram); }
    void operator()(locus_weights *weights) const { locus_weights_destroy(weights); }
};
using Volume = std::unique_ptr<locus_volume, Destroy>;
using Graph = std::unique_ptr<locus_graph, Destroy>;
using Diagram = std::unique_ptr<locus_diagram, Destroy>;
using Weights = std::unique_ptr<locus_weights, Destroy>;

// Throw std::runtime_error with the library's text unless the status is LOCUS_OK.
void check(locus_status status);
void check_io(locus_status status);

struct Input {
    locus_volume_info info{};
    Volume volume; // its numbers, floats
    const float *values() const { return static_cast<const float *>(locus_volume_data(volume.get())); }
    uint64_t voxels() const { return info.dims[0] * info.dims[1] * info.dims[2]; }
};
inline size_t index_of(const Input &input, const std::array<uint64_t, 3> &voxel) {
    return static_cast<size_t>(voxel[0] + input.info.dims[0] * (voxel[1] + input.info.dims[1] * voxel[2]));
}
Input read_input(const Options &options);

struct Material {
    Graph graph;
    uint64_t passable = 0;
    uint64_t dropped = 0; // voxels of all parts but the largest, if they were not wanted
    double softest = std::numeric_limits<double>::infinity(); // of the passable voxels
    double stiffest = 0;
};
Material make_material(const Options &options, const Input &input);

// Make NaN what does not belong to the largest part of the voxels that are numbers, neighbours as in a graph of
// `connectivity`; returns how many voxels that were.
uint64_t keep_largest_part(std::vector<float> &stiffness, const uint64_t dims[3], uint32_t connectivity);

// The seeds of a file, all fixed; throws what is wrong with which line.
std::vector<locus_seed> read_seeds(const std::string &path);
void write_seeds(const std::string &path, const std::vector<locus_seed> &seeds);

// What a solved diagram holds, copied out.
struct Result {
    std::vector<locus_seed> seeds;
    std::vector<uint32_t> labels;
    std::vector<float> distances;
    std::vector<uint64_t> cell_sizes; // in the order of the seeds
    std::vector<locus_cell_pair> pairs;
    locus_diagram_stats stats{};
    double seconds_place = 0;
};
Result solve(const Options &options, const Input &input, locus_graph *graph);

// A solved diagram with these seeds.
Diagram solve_again(const Options &options, locus_graph *graph, const std::vector<locus_seed> &seeds);

// Active voxels per iteration of the thesis' algorithm (section 2.4), and whether it gave the same labels.
struct Trace {
    std::vector<uint64_t> active;
    bool same_labels = false;
};
Trace trace(const Input &input, locus_graph *graph, const Result &result);

// labels.nrrd (seed id + 1, 0 where no seed reaches) and distances.nrrd (-1 there), as 3-D Slicer and ParaView show
// them best.
void write_volumes(const std::string &folder, const Input &input, const Result &result);

} // namespace volume
