// What an update of distance-ratio rows has to compute anew.
#pragma once

#include "graph/weights/field.hpp"
#include "graph/weights/rows.hpp"

#include <span>
#include <vector>

namespace locus::graph {

struct RatioScope {
    std::vector<uint64_t> rows; // those that can have changed, rising
    std::vector<Source> seeds;  // those that can weigh in them
};

// `changed`: changed_voxels() since `rows`, the rows of `voxels`, were made; labels mean the same seeds as then.
//
// What a seed weighs where depends on its cell, the voxels next to it and the edges on its searches' shortest paths as
// far as weights go. These lie within 2 * max(support, crossing) of the seed (a path from the border that matters at a
// voxel is no longer than the way to the seed and on from there); and a path that reaches the changed voxels is as long
// as before up to the first neighbour of one. So a seed nearer to those is affected, and with it the rows that it was
// in or now has in its support.
RatioScope ratio_scope(const Field &field, std::span<const Source> seeds, std::span<const uint64_t> voxels,
                       const std::vector<bool> &changed, const Rows &rows);

} // namespace locus::graph
