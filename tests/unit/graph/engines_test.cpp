// Every engine against brute force: all rules, connectivities, word widths and spacings, on small random grids.
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>
#include <initializer_list>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;

constexpr uint32_t engines[] = {LOCUS_ENGINE_HEAP, LOCUS_ENGINE_BUCKET, LOCUS_ENGINE_RELAX, LOCUS_ENGINE_BRICKS};

double callers_weight(uint64_t u, uint64_t v, double length, void *) {
    if ((u * 7 + v * 13) % 11 == 0)
        return -1;
    return length * (1 + static_cast<double>((u * v) % 17));
}

// Sources on random passable voxels, some starting late, some sharing a voxel.
std::vector<Source> random_sources(const Graph &graph, size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Source> sources;
    for (uint32_t label = 0; label < count; ++label) {
        uint64_t voxel = random() % graph.grid().voxels();
        for (uint64_t tries = 0; !graph.passable(voxel) && tries < graph.grid().voxels(); ++tries)
            voxel = (voxel + 1) % graph.grid().voxels();
        if (!graph.passable(voxel))
            break;
        if (label > 0 && label % 5 == 4)
            voxel = sources.back().voxel;
        const uint64_t late = label % 3 == 2 ? random() % (2 * graph.smallest_weight()) : 0;
        sources.push_back({voxel, late, label});
    }
    return sources;
}

void expect_all_engines_equal_brute_force(const Problem &problem, const std::string &what) {
    const std::vector<uint64_t> expected = brute_force(problem);
    for (const uint32_t engine : engines)
        EXPECT_EQ(solve(engine, problem), expected) << "engine " << engine << ", " << what;
}

struct Shape {
    uint64_t dims[3];
    double spacing[3];
};
constexpr Shape shapes[] = {{{5, 4, 6}, {1, 1, 1}},  {{7, 3, 5}, {0.5, 1, 2.25}}, {{9, 8, 1}, {1, 1, 3}},
                            {{1, 1, 17}, {2, 2, 2}}, {{1, 1, 1}, {1, 1, 1}},      {{2, 13, 2}, {0.1, 0.1, 0.7}}};

TEST(Engines, AgreeWithBruteForceForEveryRule) {
    uint32_t seed = 1;
    for (const Shape &shape : shapes)
        for (const uint32_t connectivity : {6u, 18u, 26u})
            for (uint32_t rule = 0; rule <= LOCUS_WEIGHT_CALLER; ++rule)
                for (const uint32_t word : {32u, 64u})
                    for (const uint32_t material :
                         std::initializer_list<uint32_t>{LOCUS_MATERIAL_COMPLIANCE, LOCUS_MATERIAL_STIFFNESS})
                        for (const double p : {1.0, 1.7}) {
                            if (p != 1 && rule != LOCUS_WEIGHT_MEAN_STIFFNESS)
                                continue;
                            auto options = options_for(shape.dims[0], shape.dims[1], shape.dims[2]);
                            std::copy(shape.spacing, shape.spacing + 3, options.spacing);
                            options.connectivity = connectivity;
                            options.weight_rule = rule;
                            options.word_bits = word;
                            options.material = material;
                            options.stiffness_exponent = p;
                            options.weight = callers_weight;
                            options.max_seeds = 256;
                            options.precision = 1.0 / 64;
                            const auto materials =
                                random_materials(shape.dims[0] * shape.dims[1] * shape.dims[2], 0.2, 5, 0.15, ++seed);
                            const Graph graph(options, materials.data());
                            const auto sources = random_sources(graph, 1 + seed % 7, seed);
                            const std::string what = "seed " + std::to_string(seed) + " rule " + std::to_string(rule);
                            expect_all_engines_equal_brute_force({graph, sources}, what);
                            Problem cut_off{graph, sources};
                            cut_off.cutoff = 5 * graph.smallest_weight();
                            expect_all_engines_equal_brute_force(cut_off, what + " cut off");
                        }
}

TEST(Engines, AgreeOnCutEdges) {
    std::mt19937 random(7);
    for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule) {
        auto options = options_for(6, 7, 5);
        options.weight_rule = rule;
        const auto materials = random_materials(6 * 7 * 5, 1, 3, 0.1, rule);
        Graph graph(options, materials.data());
        std::vector<uint64_t> voxels;
        std::vector<uint16_t> masks;
        for (int i = 0; i < 150; ++i) {
            voxels.push_back(random() % graph.grid().voxels());
            masks.push_back(static_cast<uint16_t>(random() & 0x1FFF));
        }
        graph.cut_edges(voxels, masks);
        expect_all_engines_equal_brute_force({graph, random_sources(graph, 4, rule)},
                                             "cut, rule " + std::to_string(rule));
        for (size_t i = 0; i < voxels.size(); ++i)
            for (unsigned bit = 0; bit < 13; ++bit) {
                const Neighbour &to = graph.grid().neighbour(13 + bit);
                if ((masks[i] >> bit & 1) == 0 ||
                    (graph.grid().inside(graph.grid().place(voxels[i])) >> to.number & 1) == 0)
                    continue;
                EXPECT_EQ(graph.weight(voxels[i], to), 0u);
                EXPECT_EQ(graph.open_edges(voxels[i]) >> to.number & 1, 0u);
                EXPECT_EQ(graph.open_edges(voxels[i] + static_cast<uint64_t>(to.step)) >> (25 - to.number) & 1, 0u);
            }
    }
}

TEST(Engines, AgreeOverExtremeRatios) {
    for (const uint32_t rule : std::initializer_list<uint32_t>{
             LOCUS_WEIGHT_MEAN_COMPLIANCE, LOCUS_WEIGHT_MAX_COMPLIANCE, LOCUS_WEIGHT_MEAN_STIFFNESS})
        for (uint32_t seed = 0; seed < 4; ++seed) {
            auto options = options_for(9, 7, 8);
            options.weight_rule = rule;
            const auto materials = random_materials(9 * 7 * 8, 1e-7, 1, 0.1, seed);
            const Graph graph(options, materials.data());
            EXPECT_EQ(graph.layout().bits, 64u);
            EXPECT_LE(graph.info().weight_error, 1.0 / 256 + 1e-6);
            expect_all_engines_equal_brute_force({graph, random_sources(graph, 6, seed)}, "ratio 1e7");
        }
}

} // namespace
