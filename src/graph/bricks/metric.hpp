// From a graph to what the kernels need: its weight rule as a Metric and the kernel that computes it.
#pragma once

#include "graph/bricks/visit.hpp"
#include "graph/graph.hpp"

namespace locus::bricks {

// The voxel operand that stands for an impassable voxel: one that makes every edge weight at least infinity, or, for
// the mean stiffness, one that the kernel tells apart.
template <typename Word>
struct Recipe {
    Metric<Word> metric;
    VisitFunction<Word> visit = nullptr;     // for bricks without cut edges
    VisitFunction<Word> visit_cut = nullptr; // for those with some
    float impassable = 0;
};

template <typename Word>
Recipe<Word> recipe_of(const graph::Graph &graph);

// The kernel for every other rule: asks Graph::weight edge by edge, for callers' functions and tabled powers.
template <typename Word>
void visit_by_graph(Visit<Word> &visit);

} // namespace locus::bricks
