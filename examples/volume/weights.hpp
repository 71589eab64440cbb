// Interpolation weights of the seeds: over one slice for the pictures, over the whole grid for a file.
#pragma once

#include "volume/call.hpp"
#include "volume/model.hpp"
#include "volume/slices.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace volume {

struct Method {
    uint32_t number; // LOCUS_METHOD_
    const char *name;
};
constexpr std::array<Method, 3> methods{{{LOCUS_METHOD_SIBSON, "Sibson"},
                                         {LOCUS_METHOD_LAPLACE, "Laplace"},
                                         {LOCUS_METHOD_DISTANCE_RATIO, "distance ratio"}}};

// Rows of the box; NULL: of the whole grid. The bar (may be NULL) is used by later updates too and must live that long.
Weights make_weights(locus_diagram *diagram, uint32_t method, const locus_voxel_box *box, Call *call);

// The voxels of a slice as a box, and which of the rows made for that box is a voxel's.
struct Plane {
    Plane(const Slice &slice, const Input &input);
    size_t rows() const { return static_cast<size_t>(box.extent[0] * box.extent[1] * box.extent[2]); }
    size_t row(size_t voxel) const;               // of a voxel of the slice, by its index
    std::array<uint64_t, 3> at(size_t row) const; // the voxel of a row
    // The row of the voxel so many steps away along the grid axes that the slice shows across and down.
    std::optional<size_t> beside(size_t row, int across_steps, int down_steps) const;

    locus_voxel_box box{};
    std::array<uint64_t, 3> dims{};
    size_t across, down;
};

// The weight of each of `ids` in every row, row by row.
std::vector<float> dense(const locus_weights *weights, const std::vector<uint32_t> &ids);

// The ids asked for with --weight-seeds, else those of the first seeds; throws where one is no seed's.
std::vector<uint32_t> weight_seeds(const Options &options, const Result &result);

// weights.nrrd: Sibson's weights of all voxels, one component a seed in the order of seeds.txt. Returns what was done,
// or why it was left out, for the summary.
std::string write_weights(const std::string &folder, const Input &input, const Result &result, locus_diagram *diagram);

// weights.png: heat maps over the first slice, a row of panels for each method and a column for each seed, as the
// thesis' figure 2.17.
void draw_weights(const std::string &path, const Options &options, const Input &input, const Result &result,
                  const Slicer &slicer, locus_diagram *diagram);

} // namespace volume
