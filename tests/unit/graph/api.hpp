// Owners and short-hands for tests through the C interface.
#pragma once

#include <locus/locus.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace api {

struct End {
    void operator()(locus_graph *graph) const { locus_graph_destroy(graph); }
    void operator()(locus_diagram *diagram) const { locus_diagram_destroy(diagram); }
};
using Graph = std::unique_ptr<locus_graph, End>;
using Diagram = std::unique_ptr<locus_diagram, End>;

#define EXPECT_STATUS(call, status) EXPECT_STREQ(locus_status_name(call), #status)
// The call fails with this status, and the error text holds `part`.
#define EXPECT_FAILS(call, status, part)                                                                               \
    do {                                                                                                               \
        EXPECT_STREQ(locus_status_name(call), #status);                                                                \
        EXPECT_NE(std::string(locus_last_error()).find(part), std::string::npos) << locus_last_error();                \
    } while (false)

inline locus_graph_options options(uint64_t nx, uint64_t ny, uint64_t nz) {
    locus_graph_options options;
    EXPECT_STATUS(locus_graph_options_init(&options, sizeof options), LOCUS_OK);
    options.dims[0] = nx;
    options.dims[1] = ny;
    options.dims[2] = nz;
    return options;
}

inline uint64_t voxels(const locus_graph_options &options) {
    return options.dims[0] * options.dims[1] * options.dims[2];
}

inline Graph graph(const locus_graph_options &options, const std::vector<float> &material) {
    locus_graph *made = nullptr;
    EXPECT_EQ(locus_graph_create(&options, material.empty() ? nullptr : material.data(), &made), LOCUS_OK)
        << locus_last_error();
    return Graph(made);
}

inline Graph uniform_graph(const locus_graph_options &options, float value = 1) {
    return graph(options, std::vector<float>(voxels(options), value));
}

inline locus_graph_info info(const Graph &graph) {
    locus_graph_info info{};
    info.struct_size = sizeof info;
    EXPECT_STATUS(locus_graph_get_info(graph.get(), &info), LOCUS_OK);
    return info;
}

inline Diagram diagram(const Graph &graph, const std::vector<locus_seed> &seeds, uint32_t engine = LOCUS_ENGINE_AUTO,
                       double max_distance = std::numeric_limits<double>::infinity(), bool trace = false) {
    locus_diagram_options options;
    EXPECT_STATUS(locus_diagram_options_init(&options, sizeof options), LOCUS_OK);
    options.engine = engine;
    options.max_distance = max_distance;
    options.record_trace = trace ? 1 : 0;
    locus_diagram *made = nullptr;
    EXPECT_EQ(locus_diagram_create(graph.get(), &options, &made), LOCUS_OK) << locus_last_error();
    EXPECT_EQ(locus_diagram_add_seeds(made, seeds.data(), seeds.size()), LOCUS_OK) << locus_last_error();
    return Diagram(made);
}

inline void solve(const Diagram &diagram) {
    EXPECT_EQ(locus_diagram_solve(diagram.get(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
}

inline std::vector<uint32_t> labels(const Diagram &diagram, size_t count) {
    std::vector<uint32_t> labels(count);
    EXPECT_EQ(locus_diagram_labels(diagram.get(), nullptr, labels.data(), count), LOCUS_OK) << locus_last_error();
    return labels;
}

inline std::vector<float> distances(const Diagram &diagram, size_t count) {
    std::vector<float> distances(count);
    EXPECT_EQ(locus_diagram_distances(diagram.get(), nullptr, distances.data(), count), LOCUS_OK) << locus_last_error();
    return distances;
}

inline std::vector<uint64_t> exact(const Diagram &diagram, size_t count) {
    std::vector<uint64_t> distances(count);
    EXPECT_EQ(locus_diagram_distances_exact(diagram.get(), nullptr, distances.data(), count), LOCUS_OK)
        << locus_last_error();
    return distances;
}

inline std::vector<locus_seed> seeds(const Diagram &diagram) {
    size_t count = 0;
    EXPECT_STATUS(locus_diagram_get_seeds(diagram.get(), nullptr, 0, &count), LOCUS_OK);
    std::vector<locus_seed> seeds(count);
    EXPECT_STATUS(locus_diagram_get_seeds(diagram.get(), seeds.data(), count, &count), LOCUS_OK);
    return seeds;
}

} // namespace api
