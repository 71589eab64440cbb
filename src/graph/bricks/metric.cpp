// From a graph to what the kernels need.
#include "graph/bricks/metric.hpp"

#include <bit>

namespace locus::bricks {
namespace {

// The graph's length class of the offsets along the axes in `axes` (bit 0 x, bit 1 y, bit 2 z).
unsigned kind_of(unsigned axes, bool isotropic) {
    constexpr unsigned kinds[8] = {0, 0, 1, 3, 2, 4, 5, 6};
    return isotropic ? static_cast<unsigned>(std::popcount(axes)) - 1 : kinds[axes];
}

template <typename Word>
void set_factors(Metric<Word> &metric, const graph::Graph &graph, const std::array<Real<Word>, 7> &factor) {
    for (unsigned axes = 1; axes < 8; ++axes) {
        const int moves = std::popcount(axes);
        const bool left_out = moves > (graph.grid().connectivity() == 26   ? 3
                                       : graph.grid().connectivity() == 18 ? 2
                                                                           : 1);
        metric.factor[axes] = factor[kind_of(axes, metric.isotropic)];
        metric.low[axes] = left_out ? metric.cap : Real<Word>(1);
    }
}

} // namespace

template <typename Word>
Recipe<Word> recipe_of(const graph::Graph &graph) {
    const MeanKernels<Word> &mean_table = mean_kernels<Word>(graph.simd());
    const EdgeKernels<Word> &edge_table = edge_kernels<Word>(graph.simd());
    Recipe<Word> recipe;
    Metric<Word> &metric = recipe.metric;
    metric.graph = &graph;
    metric.label_bits = graph.layout().label_bits;
    metric.infinity = static_cast<Word>(graph.layout().unreached());
    metric.cap = static_cast<Real<Word>>(graph.layout().infinity());
    metric.isotropic = graph.grid().isotropic();
    recipe.impassable = std::numeric_limits<float>::infinity();
    if (const auto *sum = std::get_if<graph::HalfSum<Word>>(&graph.weights())) {
        set_factors(metric, graph, sum->factor);
        recipe.visit = metric.isotropic ? mean_table.isotropic : mean_table.anisotropic;
        recipe.visit_cut = edge_table.mean;
    } else if (const auto *larger = std::get_if<graph::Larger<Word>>(&graph.weights())) {
        set_factors(metric, graph, larger->factor);
        recipe.visit = recipe.visit_cut = edge_table.max;
    } else if (const auto *mean = std::get_if<graph::MeanStiffness<Word>>(&graph.weights())) {
        set_factors(metric, graph, mean->factor);
        recipe.visit = recipe.visit_cut = edge_table.stiffness;
        recipe.impassable = 0;
    } else {
        recipe.visit = recipe.visit_cut = visit_by_graph<Word>;
    }
    return recipe;
}

template Recipe<uint32_t> recipe_of(const graph::Graph &);
template Recipe<uint64_t> recipe_of(const graph::Graph &);

} // namespace locus::bricks
