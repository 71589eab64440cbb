// The cells of a field as the distance ratio sees them: where each lies, and how far its searches have to go.
#pragma once

#include "graph/weights/field.hpp"

#include <vector>

namespace locus::graph {

struct Cell {
    Box box{}; // around its voxels; extent 0 for a seed without a cell
    uint64_t farthest =
        0; // the largest distance in the cell and, of their own seeds, of the voxels that share a face with it
    uint64_t crossing =
        0;             // no shorter than the shortest path from the seed to any voxel that shares a face with the cell
    bool alone = true; // it has no border

    bool empty() const { return box.extent[0] == 0; }
    // Distances beyond have no weight.
    uint64_t support() const { return 2 * farthest; }
};

// By label.
std::vector<Cell> survey_cells(const Field &field);

} // namespace locus::graph
