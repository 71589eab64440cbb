// Which voxels' rows can have changed after a diagram changed.
#pragma once

#include "graph/engine.hpp"

#include <vector>

namespace locus::graph {

// True for the voxels in boxes edited since version `version` of the graph; for all where the journal no longer reaches
// back so far.
std::vector<bool> edited_voxels(const Graph &graph, uint64_t version);
// The same, and the voxels with another word in `now` than in `before`, which was solved at that version.
std::vector<bool> changed_voxels(const Graph &graph, const Words &before, uint64_t version, const Words &now);
// The same voxels and all their neighbours.
std::vector<bool> with_neighbours(const Grid &grid, const std::vector<bool> &voxels);

// True for the voxels whose natural-neighbour rows may differ between the diagram `before`, solved at version `version`
// of the graph, and the one `now`, solved at the present one; slots must mean the same seeds in both.
//
// A row depends on what its search sees: the words and edges of the stolen voxels and of their neighbours. Where none
// of these changed, the search runs as before. So a voxel q is affected if it changed itself or steals a voxel u that
// changed or has a changed neighbour: d(q, u) < D(u). One search from all those u at once finds them: from starting
// values M - D(u), M being the largest D(u), exactly the affected voxels are reached below M.
std::vector<bool> affected_voxels(const Graph &graph, const Words &before, uint64_t version, const Words &now);

} // namespace locus::graph
