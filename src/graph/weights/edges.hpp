// The weights of a voxel's edges to several neighbours, the rule told apart once for all of them.
#pragma once

#include "graph/graph.hpp"

#include <bit>
#include <type_traits>
#include <variant>

namespace locus::graph {

// give(number, weight) for the edges from a voxel to the neighbours in `mask`; these are passable, the edges whole.
template <typename Give>
void for_weights(const Graph &graph, uint64_t voxel, uint32_t mask, Give give) {
    const auto weigh = [&](const auto &rule) {
        for (; mask != 0; mask &= mask - 1) {
            const Neighbour &to = graph.grid().neighbour(static_cast<unsigned>(std::countr_zero(mask)));
            if constexpr (std::is_same_v<decltype(rule), const CallerWeights &>) {
                give(to.number, graph.weight(voxel, to));
            } else {
                using R = std::remove_cvref_t<decltype(rule.factor[0])>;
                const float *materials = &graph.materials()[voxel];
                give(to.number,
                     rule(graph.operand().of<R>(materials[0]), graph.operand().of<R>(materials[to.step]), to.kind));
            }
        }
    };
    std::visit(weigh, graph.weights());
}

} // namespace locus::graph
