// Graphs with diagrams that can be edited, for the tests of the weights object.
#pragma once

#include "fields.hpp"
#include "graph/weights/interpolation.hpp"

#include <gtest/gtest.h>

namespace locus::graph {

inline locus_weights_options method(uint32_t method, uint32_t most = 0) {
    return {sizeof(locus_weights_options), method, most, uint64_t{1} << 30, nullptr, nullptr};
}

// A graph with a diagram that can be edited.
struct Model {
    std::shared_ptr<Graph> graph;
    std::shared_ptr<Diagram> diagram;

    Model(const locus_graph_options &options, const std::vector<float> &material)
        : graph(std::make_shared<Graph>(options, material.data())),
          diagram(std::make_shared<Diagram>(graph, plain_options())) {}

    static locus_diagram_options plain_options() {
        locus_diagram_options options{};
        options.struct_size = sizeof options;
        options.max_distance = std::numeric_limits<double>::infinity();
        return options;
    }

    void seed(uint32_t id, uint64_t voxel) {
        const auto [x, y, z] = graph->grid().place(voxel);
        const locus_seed seed = {x, y, z, 0, id, 0};
        diagram->add_seeds({&seed, 1});
    }
    void solve() {
        Progress progress;
        diagram->solve(progress);
    }
};

inline Model noisy(uint32_t random) {
    auto options = options_for(26, 14, 9);
    options.material_min = 0.5, options.material_max = 50;
    Model model(options, noise(26 * 14 * 9, random, 0.05));
    std::mt19937 rng(random);
    for (uint32_t id = 100; id < 112;) {
        const uint64_t voxel = rng() % model.graph->grid().voxels();
        if (model.graph->passable(voxel))
            model.seed(id++, voxel);
    }
    model.solve();
    return model;
}

inline void expect_same(const Interpolation &a, const Interpolation &b) {
    ASSERT_EQ(a.ids(), b.ids());
    ASSERT_EQ(a.rows().offsets, b.rows().offsets);
    ASSERT_EQ(a.rows().shares, b.rows().shares);
}

} // namespace locus::graph
