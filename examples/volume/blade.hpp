// A blade that cuts the object: edges of the graph are disabled, the voxels stay.
#pragma once

#include "volume/options.hpp"
#include "volume/slices.hpp"

#include <array>
#include <optional>

namespace volume {

// Cut along the part of the blade that is in when it has gone `reach` (0..1) of its way; returns how many edges were
// whole before.
uint64_t cut_along(const Blade &blade, double reach, const Input &input, locus_graph *graph);

// Where that part crosses a slice, in the slice's (right, down) units of length: the ends of a line.
std::optional<std::array<std::array<double, 2>, 2>> line_in(const Blade &blade, double reach, const Slicer &slicer,
                                                            const Slice &slice);

} // namespace volume
