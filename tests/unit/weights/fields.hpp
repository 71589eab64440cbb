// Small solved diagrams for the tests of the interpolants.
#pragma once

#include "graph/weights/field.hpp"
#include "tests/unit/graph/support.hpp"

#include <array>
#include <limits>
#include <random>
#include <vector>

namespace locus::graph {

using test::options_for;

struct Solved {
    Graph graph;
    std::vector<Source> sources;
    Words words;

    Solved(const locus_graph_options &options, const std::vector<float> &material, uint32_t seeds, uint32_t random)
        : graph(options, material.data()) {
        std::mt19937 rng(random);
        while (sources.size() < seeds) {
            const uint64_t voxel = rng() % graph.grid().voxels();
            if (graph.passable(voxel))
                sources.push_back({voxel, 0, static_cast<uint32_t>(sources.size())});
        }
        solve();
    }
    void solve(uint64_t cutoff = UINT64_MAX) {
        Progress progress;
        make_engine(LOCUS_ENGINE_HEAP)->solve({graph, sources, cutoff}, words, progress);
    }
    Field field() const { return {graph, words}; }
};

// 32-bit words, whose distances fit 32-bit lanes, and 64-bit ones, whose distances do not.
inline std::array<locus_graph_options, 2> both_widths(locus_graph_options options) {
    options.max_seeds = 255;
    options.word_bits = LOCUS_WORD_32;
    auto wide = options;
    wide.word_bits = LOCUS_WORD_64;
    return {options, wide};
}

// Compliances 1..10 at random, `holes` of 1 impassable.
inline std::vector<float> noise(uint64_t voxels, uint32_t random, double holes = 0) {
    std::mt19937 rng(random);
    std::uniform_real_distribution<float> value(1, 10);
    std::uniform_real_distribution<double> chance(0, 1);
    std::vector<float> material(voxels);
    for (float &c : material) {
        c = value(rng);
        if (chance(rng) < holes)
            c = std::numeric_limits<float>::quiet_NaN();
    }
    return material;
}

} // namespace locus::graph
