// Cuts along surfaces: which edges of a grid a plane or a triangle mesh separates.
#pragma once

#include "graph/graph.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace locus::graph {

using Point = std::array<double, 3>; // in units of length; the centre of voxel (x, y, z) is (x * sx, y * sy, z * sz)

// Both return the number of edges that were whole before. A voxel centre exactly on the surface counts as lying on the
// side the normal points to.
uint64_t cut_by_plane(Graph &graph, const Point &point, const Point &normal, const Box &box);

// A triangle's normal is taken with its first non-zero component positive, whatever the order of its corners.
uint64_t cut_by_mesh(Graph &graph, std::span<const double> vertices, std::span<const uint32_t> triangles);

} // namespace locus::graph
