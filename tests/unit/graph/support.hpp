// What the graph tests share: random materials, a brute-force oracle that knows nothing of the engines, and
// short-hands.
#pragma once

#include "graph/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace locus::graph::test {

constexpr float impassable = std::numeric_limits<float>::quiet_NaN();

inline locus_graph_options options_for(uint64_t nx, uint64_t ny, uint64_t nz) {
    locus_graph_options options{};
    options.struct_size = sizeof options;
    options.dims[0] = nx;
    options.dims[1] = ny;
    options.dims[2] = nz;
    for (double &s : options.spacing)
        s = 1;
    options.connectivity = 26;
    options.stiffness_exponent = 1;
    options.max_seeds = 65535;
    options.precision = 1.0 / 256;
    options.material_min = options.material_max = std::numeric_limits<double>::quiet_NaN();
    return options;
}

inline std::vector<float> random_materials(uint64_t count, double low, double high, double air, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> logarithm(std::log(low), std::log(high));
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<float> materials(count);
    for (float &value : materials)
        value = part(random) < air ? impassable : static_cast<float>(std::exp(logarithm(random)));
    return materials;
}

// The words by Bellman and Ford over Graph::weight, in 64-bit (distance, label) pairs.
inline std::vector<uint64_t> brute_force(const Problem &problem) {
    const Graph &graph = problem.graph;
    const WordLayout &layout = graph.layout();
    std::vector<uint64_t> words(graph.grid().voxels(), layout.unreached());
    for (const Source &source : problem.sources)
        if (source.distance <= problem.limit())
            words[source.voxel] = std::min(words[source.voxel], layout.pack(source.distance, source.label));
    for (bool changed = true; changed;) {
        changed = false;
        for (uint64_t u = 0; u < words.size(); ++u) {
            if (!layout.reached(words[u]))
                continue;
            const auto [x, y, z] = graph.grid().place(u);
            for (const Neighbour &to : graph.grid().neighbours()) {
                const auto vx = x + static_cast<uint64_t>(to.dx);
                const auto vy = y + static_cast<uint64_t>(to.dy);
                const auto vz = z + static_cast<uint64_t>(to.dz);
                if (!graph.grid().holds(vx, vy, vz))
                    continue;
                const uint64_t weight = graph.weight(u, to);
                if (weight == 0 || layout.distance(words[u]) + weight > problem.limit())
                    continue;
                const uint64_t word = layout.pack(layout.distance(words[u]) + weight, layout.label(words[u]));
                uint64_t &there = words[graph.grid().index(vx, vy, vz)];
                if (word < there) {
                    there = word;
                    changed = true;
                }
            }
        }
    }
    return words;
}

inline std::vector<uint64_t> wide(const Words &words) {
    return std::visit([](const auto &each) { return std::vector<uint64_t>(each.begin(), each.end()); }, words);
}

// What an update says it changed, against the words before and after it.
inline void expect_change(const Graph &graph, const Change &change, const std::vector<uint64_t> &before,
                          const std::vector<uint64_t> &after, const std::string &what) {
    uint64_t changed = 0;
    std::array<uint64_t, 3> first{UINT64_MAX, UINT64_MAX, UINT64_MAX}, last{};
    for (uint64_t v = 0; v < after.size(); ++v) {
        if (before[v] == after[v])
            continue;
        ++changed;
        const auto place = graph.grid().place(v);
        for (size_t a = 0; a < 3; ++a) {
            first[a] = std::min(first[a], place[a]);
            last[a] = std::max(last[a], place[a]);
        }
    }
    EXPECT_EQ(change.voxels, changed) << what;
    for (size_t a = 0; a < 3; ++a) {
        EXPECT_EQ(change.box.origin[a], changed > 0 ? first[a] : 0) << what;
        EXPECT_EQ(change.box.extent[a], changed > 0 ? last[a] - first[a] + 1 : 0) << what;
    }
}

inline std::vector<uint64_t> solve(uint32_t engine, const Problem &problem, Report *report = nullptr) {
    Words words;
    Progress progress;
    const Report done = make_engine(engine)->solve(problem, words, progress);
    if (report != nullptr)
        *report = done;
    return wide(words);
}

} // namespace locus::graph::test
