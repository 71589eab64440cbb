// The bodies of the voxel handles.
#pragma once

#include "graph/diagram.hpp"
#include "graph/graph.hpp"
#include "graph/weights/interpolation.hpp"

#include <memory>

struct locus_graph {
    std::shared_ptr<locus::graph::Graph> graph; // diagrams hold it too
};

struct locus_diagram {
    std::shared_ptr<locus::graph::Diagram> diagram; // weights hold it too
};

struct locus_weights {
    locus::graph::Interpolation weights;
};

namespace locus {

// The box an argument means (NULL: the whole grid), checked against the grid and the room of the caller's memory.
inline graph::Box checked_box(const graph::Grid &grid, const locus_voxel_box *box, size_t capacity) {
    if (box != nullptr)
        grid.check(*box);
    const graph::Box whole = box != nullptr ? *box : grid.whole();
    const uint64_t voxels = whole.extent[0] * whole.extent[1] * whole.extent[2];
    if (capacity < voxels)
        fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ": the box has ", voxels, " voxels");
    return whole;
}

} // namespace locus
