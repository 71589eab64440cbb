// The program's pictures: sheets of three slices, and the trace of active voxels.
#pragma once

#include "volume/model.hpp"
#include "volume/slices.hpp"

#include <string>
#include <vector>

namespace volume {

// Cells in distinct colours over the grey volume, and distances in a colour map, both with contour lines of distance.
// Distances are shown in lengths of the softest material.
void draw_cells(const std::string &path, const Options &options, const Input &input, const Material &material,
                const Result &result, const Slicer &slicer);
void draw_distances(const std::string &path, const Options &options, const Input &input, const Material &material,
                    const Result &result, const Slicer &slicer);

// Active voxels per iteration, as in the thesis' figure 2.10.
void draw_trace(const std::string &path, const std::string &title, const std::vector<uint64_t> &active);

} // namespace volume
