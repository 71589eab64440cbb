// From a graph to what kernels need of it: operands, weight rules, which edges are open.
#pragma once

#include "graph/device/device.hpp"
#include "graph/device/rules.hpp"
#include "graph/graph.hpp"

#include <cmath>
#include <optional>

namespace locus::device {

// Whether kernels can compute the graph's weights: all but the caller's function.
inline bool has_rule(const graph::Graph &graph) { return graph.rule() != LOCUS_WEIGHT_CALLER; }

// How many axes an edge may move along.
inline uint32_t classes_of(const graph::Grid &grid) {
    return grid.connectivity() == 6 ? 1 : grid.connectivity() == 18 ? 2 : 3;
}

// Operands of voxels; what is impassable is so for every edge.
class Operands {
public:
    explicit Operands(const graph::Graph &graph)
        : graph_(graph),
          impassable_(graph.rule() == LOCUS_WEIGHT_MEAN_STIFFNESS ? std::numeric_limits<float>::quiet_NaN()
                                                                  : std::numeric_limits<float>::infinity()) {}
    float impassable() const { return impassable_; }
    float operator()(uint64_t voxel) const {
        const float operand = graph_.operand().of<float>(graph_.materials()[voxel]);
        return operand == operand ? operand : impassable_;
    }

private:
    const graph::Graph &graph_;
    float impassable_;
};

// The tables of a graph's rule that a device must hold.
template <typename Word>
class RuleTables {
public:
    RuleTables(Device &device, const graph::Graph &graph) {
        const auto *rule = std::get_if<graph::PowerStiffness<Word>>(&graph.weights());
        if (rule == nullptr)
            return;
        const auto tables = rule->power->tables();
        mantissa_ = device.copy_of(std::span<const Real<Word>>(tables.mantissa, rule->power->mantissas()));
        exponent_ = device.copy_of(std::span<const Real<Word>>(tables.exponent, rule->power->exponents()));
    }
    graph::PowerTables<Real<Word>> power() const { return {mantissa_.get(), exponent_.get()}; }

private:
    Memory<Real<Word>> mantissa_, exponent_;
};

// Call run(rule, launch), `launch` with rule, word and spacing filled in.
template <typename Word, typename Run>
void with_rule_of(const graph::Graph &graph, const RuleTables<Word> &tables, Run &&run) {
    const graph::Grid &grid = graph.grid();
    const auto with = [&](auto rule, const auto &factor) {
        rule.most = static_cast<Real<Word>>(graph.layout().weight_limit());
        rule.cap = static_cast<Word>(graph.layout().infinity());
        rule.factor[0] = 0;
        for (unsigned axes = 1; axes < 8; ++axes) {
            const unsigned position = 13 + (axes & 1) + 3 * (axes >> 1 & 1) + 9 * (axes >> 2);
            rule.factor[axes] = factor[grid.neighbour(position - 1).kind];
        }
        Launch launch{};
        launch.rule = static_cast<uint32_t>(rule.kind);
        launch.word_bits = graph.layout().bits;
        launch.simple = grid.isotropic() ? 1 : 0;
        run(rule, launch);
    };
    if (const auto *sum = std::get_if<graph::HalfSum<Word>>(&graph.weights()))
        with(HalfSumRule<Word>{}, sum->factor);
    else if (const auto *larger = std::get_if<graph::Larger<Word>>(&graph.weights()))
        with(LargerRule<Word>{}, larger->factor);
    else if (const auto *mean = std::get_if<graph::MeanStiffness<Word>>(&graph.weights()))
        with(StiffnessRule<Word>{}, mean->factor);
    else if (const auto *power = std::get_if<graph::PowerStiffness<Word>>(&graph.weights())) {
        PowerRule<Word> rule{};
        rule.power = tables.power();
        with(rule, power->factor);
    } else {
        fail(LOCUS_E_UNSUPPORTED, "the CUDA backend has no caller's weight functions");
    }
}

// The word of a voxel that nothing has reached: just above the largest that is kept.
template <typename Word>
Word beyond_of(const graph::Graph &graph, uint64_t limit) {
    return static_cast<Word>(graph.layout().pack(limit + 1, 0));
}

} // namespace locus::device
