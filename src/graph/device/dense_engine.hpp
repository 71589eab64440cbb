// The thesis' two forms of the solver on a device: its base algorithm, and coarse stream compaction.
#pragma once

#include "graph/device/device.hpp"
#include "graph/engine.hpp"

namespace locus::device {

// Voxels of a grain in x, y and z; 0: no compaction, every voxel gets a thread in every iteration.
using Grain = std::array<uint32_t, 3>;

graph::Report solve_dense(Device &device, const Grain &grain, const graph::Problem &problem, graph::Words &words,
                          Progress &progress);

} // namespace locus::device
