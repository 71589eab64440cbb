// The brick engine against Dijkstra's heap, bit for bit: on every instruction set, word width and number of threads.
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;
using locus::Simd;

std::vector<uint32_t> instruction_sets() {
    std::vector<uint32_t> sets;
    for (const Simd set : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon})
        if (locus::simd_available(set))
            sets.push_back(static_cast<uint32_t>(set));
    return sets;
}

using Field = std::function<float(uint64_t x, uint64_t y, uint64_t z)>;

std::vector<float> sampled(const locus_graph_options &options, const Field &field) {
    std::vector<float> materials;
    for (uint64_t z = 0; z < options.dims[2]; ++z)
        for (uint64_t y = 0; y < options.dims[1]; ++y)
            for (uint64_t x = 0; x < options.dims[0]; ++x)
                materials.push_back(field(x, y, z));
    return materials;
}

// Passable voxels, drawn at random; a third of the sources starts late.
std::vector<Source> seeds(const Graph &graph, uint32_t count, uint32_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Source> sources;
    if (graph.passable_voxels() == 0)
        return sources;
    while (sources.size() < count) {
        const uint64_t voxel = random() % graph.grid().voxels();
        const auto label = static_cast<uint32_t>(sources.size());
        if (graph.passable(voxel))
            sources.push_back({voxel, label % 3 == 1 ? random() % (3 * graph.smallest_weight()) : 0, label});
    }
    return sources;
}

// The heap's words once per word width, the brick engine's on every instruction set with 1 to 4 threads.
void expect_exact(locus_graph_options options, const std::vector<float> &materials, uint32_t seed_count,
                  const std::string &what, double cutoff_steps = 0) {
    for (const uint32_t word : {32u, 64u}) {
        options.word_bits = word;
        std::vector<uint64_t> expected;
        uint32_t threads = 1;
        for (const uint32_t simd : instruction_sets()) {
            options.simd = simd;
            options.threads = 1 + threads++ % 4;
            const Graph graph(options, materials.data());
            const auto sources = seeds(graph, seed_count, seed_count + word);
            Problem problem{graph, sources};
            if (cutoff_steps > 0)
                problem.cutoff = static_cast<uint64_t>(cutoff_steps * static_cast<double>(graph.smallest_weight()));
            if (expected.empty())
                expected = solve(LOCUS_ENGINE_HEAP, problem);
            ASSERT_EQ(solve(LOCUS_ENGINE_BRICKS, problem), expected)
                << what << ", word " << word << ", simd " << simd << ", threads " << options.threads;
        }
    }
}

locus_graph_options small_options(uint64_t nx, uint64_t ny, uint64_t nz) {
    auto options = options_for(nx, ny, nz);
    options.max_seeds = 64;
    options.precision = 1.0 / 8;
    return options;
}

const Field constant = [](uint64_t, uint64_t, uint64_t) { return 1.0f; };
const Field gradient = [](uint64_t x, uint64_t, uint64_t) { return 1.0f / (1.0f + 0.1f * static_cast<float>(x)); };
const Field noise = [](uint64_t x, uint64_t y, uint64_t z) {
    return 1.0f + static_cast<float>((x * 7919 + y * 104729 + z * 1299709) % 9001) / 1000.0f;
};
// Walls with a gap at alternating ends.
const Field maze = [](uint64_t x, uint64_t y, uint64_t z) {
    const bool wall = (y % 4 == 3 && x != (y / 4 % 2 == 0 ? 0u : 5u)) || (z % 6 == 5 && y % 8 > 1);
    return wall ? impassable : 1.0f;
};
const Field islands = [](uint64_t x, uint64_t y, uint64_t z) {
    return x % 9 == 4 || y % 11 == 5 || z % 13 == 6 ? impassable : 2.0f;
};
const Field free_ways = [](uint64_t x, uint64_t, uint64_t z) { return z % 5 == 0 || x % 7 == 0 ? 0.0f : 1.0f; };

TEST(Bricks, EqualTheHeapOnTypicalFields) {
    const struct {
        const char *name;
        const Field &field;
    } fields[] = {{"constant", constant}, {"gradient", gradient}, {"noise", noise},
                  {"maze", maze},         {"islands", islands},   {"free ways", free_ways}};
    for (const auto &[name, field] : fields) {
        const auto options = small_options(45, 27, 19);
        expect_exact(options, sampled(options, field), 10, name);
    }
}

TEST(Bricks, EqualTheHeapOnThinAndOddGrids) {
    const uint64_t shapes[][3] = {{1, 40, 33}, {40, 1, 33}, {40, 33, 1}, {1, 1, 50}, {1, 50, 1},   {50, 1, 1},
                                  {1, 1, 1},   {14, 8, 8},  {15, 9, 9},  {13, 7, 7}, {28, 16, 16}, {29, 17, 15}};
    for (const auto &shape : shapes)
        for (const Field &field : {constant, noise}) {
            const auto options = small_options(shape[0], shape[1], shape[2]);
            const std::string name =
                std::to_string(shape[0]) + "x" + std::to_string(shape[1]) + "x" + std::to_string(shape[2]);
            expect_exact(options, sampled(options, field), 3, name);
        }
}

TEST(Bricks, EqualTheHeapForEveryRuleConnectivityAndSpacing) {
    uint32_t seed = 0;
    for (uint32_t rule = 0; rule <= LOCUS_WEIGHT_CALLER; ++rule)
        for (const uint32_t connectivity : {6u, 18u, 26u})
            for (const bool cubic : {true, false})
                for (const uint32_t material : {LOCUS_MATERIAL_COMPLIANCE, LOCUS_MATERIAL_STIFFNESS})
                    for (const double power : {1.0, 1.7}) {
                        if (power != 1 && rule != LOCUS_WEIGHT_MEAN_STIFFNESS)
                            continue;
                        std::mt19937 random(++seed);
                        auto options = small_options(1 + random() % 31, 1 + random() % 19, 1 + random() % 19);
                        options.weight_rule = rule;
                        options.connectivity = connectivity;
                        options.material = material;
                        options.stiffness_exponent = power;
                        if (!cubic) {
                            options.spacing[1] = 0.4;
                            options.spacing[2] = 2.5;
                        }
                        options.weight = [](uint64_t u, uint64_t v, double length, void *) {
                            return (u * 7 + v * 13) % 11 == 0 ? -1.0 : length * (1 + static_cast<double>(u * v % 17));
                        };
                        const uint64_t voxels = options.dims[0] * options.dims[1] * options.dims[2];
                        expect_exact(options, random_materials(voxels, 0.3, 6, 0.2, seed),
                                     static_cast<uint32_t>(1 + random() % 8), "seed " + std::to_string(seed));
                    }
}

TEST(Bricks, EqualTheHeapWithACutoff) {
    const auto options = small_options(40, 21, 18);
    for (const double steps : {1.0, 3.5, 12.0, 40.0}) {
        expect_exact(options, sampled(options, noise), 4, "cut off noise", steps);
        expect_exact(options, sampled(options, constant), 4, "cut off constant", steps);
    }
}

TEST(Bricks, EqualTheHeapOnCutEdges) {
    for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule)
        for (const uint32_t word : {32u, 64u}) {
            auto options = small_options(33, 18, 17);
            options.weight_rule = rule;
            options.word_bits = word;
            std::vector<uint64_t> expected;
            for (const uint32_t simd : instruction_sets()) {
                options.simd = simd;
                options.threads = 2;
                Graph graph(options, sampled(options, noise).data());
                std::mt19937 random(rule);
                std::vector<uint64_t> voxels;
                std::vector<uint16_t> masks;
                for (uint64_t y = 0; y < 18; ++y) // a wall of cut edges at x = 13 | 14, where bricks meet, and strays
                    for (uint64_t z = 0; z < 17; ++z) {
                        voxels.push_back(graph.grid().index(13, y, z));
                        masks.push_back(0x1FFF);
                        voxels.push_back(random() % graph.grid().voxels());
                        masks.push_back(static_cast<uint16_t>(random() & 0x1FFF));
                    }
                graph.cut_edges(voxels, masks);
                const auto sources = seeds(graph, 5, rule);
                const Problem problem{graph, sources};
                if (expected.empty())
                    expected = solve(LOCUS_ENGINE_HEAP, problem);
                ASSERT_EQ(solve(LOCUS_ENGINE_BRICKS, problem), expected) << "rule " << rule << ", simd " << simd;
            }
        }
}

TEST(Bricks, EqualTheHeapFromOneTo65536Seeds) {
    for (const uint32_t count : {1u, 2u, 1000u, 65536u}) {
        auto options = options_for(45, 40, 41);
        options.max_seeds = 65536;
        options.precision = 1.0 / 2;
        options.scale = 4; // with 16 label bits few are left for the distance
        expect_exact(options, sampled(options, constant), count, std::to_string(count) + " seeds");
    }
}

// Every voxel but one line is equally far from two seeds: ties everywhere, and the earlier seed must have them all.
TEST(Bricks, GiveTiesToTheSmallerLabel) {
    const auto options = small_options(41, 21, 21);
    for (const uint32_t simd : instruction_sets()) {
        auto forced = options;
        forced.simd = simd;
        const Graph graph(forced, sampled(options, constant).data());
        const uint64_t middle = graph.grid().index(20, 10, 10);
        const Source sources[] = {{middle, 0, 9}, {middle, 0, 4}, {middle, 0, 6}};
        const Problem problem{graph, sources};
        const auto words = solve(LOCUS_ENGINE_BRICKS, problem);
        EXPECT_EQ(words, solve(LOCUS_ENGINE_HEAP, problem));
        for (const uint64_t word : words)
            ASSERT_EQ(graph.layout().label(word), 4u);
    }
}

TEST(Bricks, TellWhenAPathIsLongerThanTheWordsHold) {
    auto options = small_options(60, 9, 9);
    options.word_bits = 32;
    options.max_seeds = 256;
    options.scale = 1e5;
    for (const uint32_t simd : instruction_sets()) {
        options.simd = simd;
        const Graph graph(options, sampled(options, constant).data());
        const Source source{0, 0, 0};
        const Problem problem{graph, {&source, 1}};
        ASSERT_TRUE(problem.may_overflow());
        Report report;
        EXPECT_EQ(solve(LOCUS_ENGINE_BRICKS, problem, &report), solve(LOCUS_ENGINE_HEAP, problem));
        EXPECT_TRUE(report.clipped);
    }
}

// One engine solving again: after edits, with other sources, for another graph.
TEST(Bricks, FollowTheGraphFromSolveToSolve) {
    auto options = small_options(31, 17, 9);
    options.material_min = 0.5;
    options.material_max = 10;
    Graph graph(options, sampled(options, noise).data());
    const Graph other(small_options(20, 20, 20), sampled(small_options(20, 20, 20), gradient).data());
    const auto engine = make_engine(LOCUS_ENGINE_BRICKS);
    Words words;
    locus::Progress progress;
    for (uint32_t round = 0; round < 6; ++round) {
        const Graph &now = round == 4 ? other : graph;
        const auto sources = seeds(now, 3 + round, round);
        const Problem problem{now, sources};
        engine->solve(problem, words, progress);
        const auto got = std::visit([](const auto &w) { return std::vector<uint64_t>(w.begin(), w.end()); }, words);
        EXPECT_EQ(got, solve(LOCUS_ENGINE_HEAP, problem)) << "round " << round;
        graph.fill_box({{round, 2, 1}, {12, 9, 5}}, round % 2 == 0 ? impassable : 2.0f);
    }
}

TEST(Bricks, StopWhenTheCallerSaysSo) {
    auto options = small_options(200, 120, 80);
    options.threads = 3;
    const Graph graph(options, sampled(options, constant).data());
    const Source source{0, 0, 0};
    Words words = std::vector<uint32_t>{7};
    locus::Progress progress([](double, void *) -> int32_t { return 1; }, nullptr);
    try {
        make_engine(LOCUS_ENGINE_BRICKS)->solve({graph, {&source, 1}}, words, progress);
        FAIL() << "not stopped";
    } catch (const locus::Error &error) {
        EXPECT_EQ(error.status(), LOCUS_E_STOPPED);
    }
    EXPECT_EQ(words, Words(std::vector<uint32_t>{7}));
}

// The T-bone steak of the thesis: stiffnesses from 5000 Pa (fat) to 1.5e10 Pa (bone).
TEST(Bricks, EqualTheHeapOnTheSteak) {
    const char *folder = std::getenv("LOCUS_DATA");
    std::ifstream file(std::string(folder != nullptr ? folder : "../shared/data") + "/steak/steak_64x64x15.raw",
                       std::ios::binary);
    if (!file)
        GTEST_SKIP() << "no steak_64x64x15.raw in LOCUS_DATA/steak";
    std::vector<char> tissue(64 * 64 * 15);
    ASSERT_TRUE(file.read(tissue.data(), static_cast<std::streamsize>(tissue.size())));
    auto options = options_for(64, 64, 15);
    options.material = LOCUS_MATERIAL_STIFFNESS;
    options.max_seeds = 16;
    std::vector<float> stiffness;
    for (const char t : tissue) {
        const auto grey = static_cast<unsigned char>(t);
        stiffness.push_back(grey == 0 ? 0.0f : 5000.0f * std::pow(3e6f, static_cast<float>(grey) / 255.0f));
    }
    for (const uint32_t rule :
         {LOCUS_WEIGHT_MEAN_COMPLIANCE, LOCUS_WEIGHT_MAX_COMPLIANCE, LOCUS_WEIGHT_MEAN_STIFFNESS}) {
        options.weight_rule = rule;
        for (const uint32_t simd : instruction_sets()) {
            options.simd = simd;
            const Graph graph(options, stiffness.data());
            EXPECT_EQ(graph.layout().bits, 64u);
            const auto sources = seeds(graph, 10, 1);
            const Problem problem{graph, sources};
            ASSERT_EQ(solve(LOCUS_ENGINE_BRICKS, problem), solve(LOCUS_ENGINE_HEAP, problem)) << "simd " << simd;
        }
    }
}

} // namespace
