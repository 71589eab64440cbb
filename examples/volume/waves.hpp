// The waves that leave the seeds (thesis figure 2.7): its algorithm 2.2 voxel by voxel, on the graph's edge weights.
#pragma once

#include "volume/model.hpp"
#include "volume/slices.hpp"
#include "volume/weights.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace volume {

// An iteration as one slice shows it.
struct Wave {
    uint64_t active = 0;          // voxels of the whole object
    std::vector<uint32_t> labels; // of the plane's rows, so far
    std::vector<bool> front;      // active now
};

struct Waves {
    std::vector<Wave> waves;
    uint64_t activations = 0; // of all voxels in all iterations
    bool same = false;        // the fixed point is the diagram
};
Waves propagate(const Input &input, const Material &material, const Result &result, const Slicer &slicer);

// waves.png: an animation, or every n-th iteration of it where they are many. waves-series.png: some of them side by
// side.
void draw_waves(const std::string &folder, const Options &options, const Input &input, const Result &result,
                const Slicer &slicer, const Waves &waves);

} // namespace volume
