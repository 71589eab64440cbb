// What can be told of each voxel of a solved diagram.
#pragma once

#include <locus/graph.h>

#include <cstdint>
#include <span>

namespace locus::graph {

enum class Told : uint32_t {
    ids,            // uint32_t, LOCUS_NO_SEED where no seed reaches
    distances,      // float, infinite there
    exact_distances // uint64_t in steps, UINT64_MAX there
};

// The same of all voxels of a box, x fastest.
struct Reading {
    Told told;
    locus_voxel_box box;
    std::span<const uint32_t> ids; // of seeds, by label
    double scale;                  // steps of a unit of distance
};

} // namespace locus::graph
