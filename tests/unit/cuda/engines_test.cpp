// The solvers of the CUDA backend, run by the emulated device, against the heap engine: the same bodies that the GPU
// runs, with items, threads and blocks in changing orders.
#include "graph/device/engine.hpp"
#include "graph/device/field.hpp"
#include "tests/emulated/device.hpp"
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;
namespace device = locus::device;
namespace emulated = locus::device::emulated;

struct Form {
    const char *name;
    uint32_t engine;
    device::Grain grain;
};
const Form forms[] = {{"bricks", LOCUS_ENGINE_BRICKS, {}},
                      {"relax", LOCUS_ENGINE_RELAX, {}},
                      {"grains of 1", LOCUS_ENGINE_COMPACT, {1, 1, 1}},
                      {"grains of 4 x 2 x 1", LOCUS_ENGINE_COMPACT, {4, 2, 1}},
                      {"grains of 8", LOCUS_ENGINE_COMPACT, {8, 8, 8}}};

std::vector<uint64_t> on_device(const Form &form, const Problem &problem, Report *report = nullptr) {
    Words words;
    locus::Progress progress;
    const auto engine = device::make_engine(emulated::table(), form.engine, form.grain, nullptr);
    const Report done = engine->solve(problem, words, progress);
    if (report != nullptr)
        *report = done;
    return std::visit([](const auto &each) { return std::vector<uint64_t>(each.begin(), each.end()); }, words);
}

std::vector<Source> sources_in(const Graph &graph, uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Source> sources;
    for (uint32_t tries = 0; sources.size() < count && tries < 10000; ++tries) {
        const uint64_t voxel = random() % graph.grid().voxels();
        const auto label = static_cast<uint32_t>(sources.size());
        if (graph.passable(voxel))
            sources.push_back({voxel, label % 3 == 2 ? random() % (3 * graph.smallest_weight()) : 0, label});
    }
    return sources;
}

void expect_equal(const Problem &problem, const std::string &what) {
    const std::vector<uint64_t> expected = solve(LOCUS_ENGINE_HEAP, problem);
    for (const Form &form : forms) {
        ++emulated::settings().seed;
        Report report;
        EXPECT_EQ(on_device(form, problem, &report), expected) << form.name << ", " << what;
        const auto reached = std::count_if(expected.begin(), expected.end(),
                                           [&](uint64_t w) { return problem.graph.layout().reached(w); });
        EXPECT_EQ(report.clipped, static_cast<uint64_t>(reached) < problem.graph.passable_voxels())
            << form.name << what;
    }
}

// Materials over a grid: 1, a gradient from 10 to 1, noise, walls with gaps, and two halves that nothing joins.
std::vector<float> materials_of(const std::string &topology, const std::array<uint64_t, 3> &dims, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> materials;
    for (uint64_t z = 0; z < dims[2]; ++z)
        for (uint64_t y = 0; y < dims[1]; ++y)
            for (uint64_t x = 0; x < dims[0]; ++x) {
                float value = 1;
                if (topology == "gradient")
                    value = 10 - 9 * static_cast<float>(x) / static_cast<float>(dims[0]);
                if (topology == "noise")
                    value = 1 + static_cast<float>(random() % 900) / 100;
                if (topology == "maze" && x % 3 == 2 && (y + z + x / 3 * 5) % 11 != 0)
                    value = impassable;
                if (topology == "apart" && x == dims[0] / 2)
                    value = impassable;
                materials.push_back(value);
            }
    return materials;
}

TEST(CudaEngines, EqualTheHeapOnEveryTopologyAndShape) {
    const emulated::KeepSettings keep;
    uint32_t seed = 0;
    for (const auto &dims :
         {std::array<uint64_t, 3>{17, 18, 19}, {8, 8, 8}, {1, 9, 33}, {40, 1, 1}, {25, 16, 3}, {1, 1, 1}})
        for (const std::string topology : {"constant", "gradient", "noise", "maze", "apart"})
            for (const uint32_t word : {32u, 64u}) {
                auto options = options_for(dims[0], dims[1], dims[2]);
                options.word_bits = word;
                options.connectivity = ++seed % 3 == 0 ? 6 : seed % 3 == 1 ? 18 : 26;
                options.precision = 1.0 / 32;
                if (seed % 4 == 0)
                    options.spacing[1] = 2.25;
                emulated::settings().blocks = seed % 2 == 0 ? 3 : 100;
                const Graph graph(options, materials_of(topology, dims, seed).data());
                const auto sources = sources_in(graph, 1 + seed % 6, seed);
                if (!sources.empty())
                    expect_equal({graph, sources}, topology + ", seed " + std::to_string(seed));
            }
}

TEST(CudaEngines, EqualTheHeapForEveryRule) {
    uint32_t seed = 50;
    for (const uint32_t connectivity : {6u, 18u, 26u})
        for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule)
            for (const uint32_t material : {LOCUS_MATERIAL_COMPLIANCE, LOCUS_MATERIAL_STIFFNESS})
                for (const double p : {1.0, 1.7}) {
                    if (p != 1 && rule != LOCUS_WEIGHT_MEAN_STIFFNESS)
                        continue;
                    auto options = options_for(11, 10, 9);
                    options.word_bits = ++seed % 2 == 0 ? 32 : 64;
                    options.connectivity = connectivity;
                    options.weight_rule = rule;
                    options.material = static_cast<uint32_t>(material);
                    options.stiffness_exponent = p;
                    options.max_seeds = 256;
                    options.precision = 1.0 / 64;
                    if (seed % 3 == 0)
                        options.spacing[2] = 0.4;
                    const Graph graph(options, random_materials(11 * 10 * 9, 0.2, 5, 0.15, seed).data());
                    const auto sources = sources_in(graph, 5, seed);
                    expect_equal({graph, sources}, "rule " + std::to_string(rule));
                    Problem cut_off{graph, sources};
                    cut_off.cutoff = 6 * graph.smallest_weight();
                    expect_equal(cut_off, "cut off, rule " + std::to_string(rule));
                }
}

TEST(CudaEngines, EqualTheHeapOnCutEdges) {
    std::mt19937 random(7);
    for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule) {
        auto options = options_for(17, 9, 10);
        options.weight_rule = rule;
        Graph graph(options, random_materials(17 * 9 * 10, 1, 3, 0.1, rule).data());
        std::vector<uint64_t> voxels;
        std::vector<uint16_t> masks;
        for (int i = 0; i < 900; ++i) {
            voxels.push_back(random() % graph.grid().voxels());
            masks.push_back(static_cast<uint16_t>(random() & 0x1FFF));
        }
        graph.cut_edges(voxels, masks);
        expect_equal({graph, sources_in(graph, 4, rule)}, "cut, rule " + std::to_string(rule));
    }
}

TEST(CudaEngines, RunBlocksAtTheSameTime) {
    emulated::settings().threads = 3;
    auto options = options_for(30, 30, 30);
    for (const uint32_t word : {32u, 64u}) {
        options.word_bits = word;
        options.precision = 1.0 / 32;
        const Graph graph(options, random_materials(30 * 30 * 30, 1, 8, 0.2, word).data());
        expect_equal({graph, sources_in(graph, 10, word)}, "three threads");
    }
    emulated::settings().threads = 1;
}

// Threads of a block and blocks at the same time: what races is seen by the thread sanitizer.
TEST(CudaEngines, RunThreadsAtTheSameTime) {
    const emulated::KeepSettings keep;
    emulated::settings().lanes = 5;
    emulated::settings().threads = emulated::settings().blocks = 2;
    uint32_t seed = 30;
    for (const uint32_t rule : {LOCUS_WEIGHT_MEAN_COMPLIANCE, LOCUS_WEIGHT_MEAN_STIFFNESS}) {
        auto options = options_for(17, 9, 8);
        options.word_bits = ++seed % 2 == 0 ? 32 : 64;
        options.weight_rule = static_cast<uint32_t>(rule);
        options.max_seeds = 64;
        options.precision = 1.0 / 32;
        const Graph graph(options, random_materials(17 * 9 * 8, 1, 8, 0.2, seed).data());
        expect_equal({graph, sources_in(graph, 4, seed)}, "threads, seed " + std::to_string(seed));
    }
}

// Where there are blocks for all bricks that wait, none waits for a later round.
TEST(CudaEngines, TakeFewerRoundsWithMoreBlocks) {
    const emulated::KeepSettings keep;
    const Graph graph(options_for(40, 40, 24), random_materials(40 * 40 * 24, 1, 10, 0.1, 5).data());
    const std::vector<Source> sources = sources_in(graph, 3, 5);
    const auto rounds = [&](uint32_t blocks) {
        emulated::settings().blocks = blocks;
        device::Device device(emulated::table());
        device::Field<uint64_t> field(device, graph);
        Words words;
        locus::Progress progress;
        field.solve({graph, sources}, &words, progress);
        return field.work().rounds;
    };
    ASSERT_EQ(graph.layout().bits, 64u);
    EXPECT_LT(rounds(75), rounds(1));
}

TEST(CudaEngines, WorkOnTheCallersStream) {
    const Graph graph(options_for(4, 3, 2), std::vector<float>(24, 1.0f).data());
    const Source source = {0, 0, 0};
    int stream = 0, other = 0;
    const emulated::KeepSettings keep;
    emulated::settings().stream = &stream;
    for (const uint32_t kind : {LOCUS_ENGINE_BRICKS, LOCUS_ENGINE_RELAX, LOCUS_ENGINE_COMPACT}) {
        const auto solve_on = [&](void *where) {
            Words words;
            locus::Progress progress;
            device::make_engine(emulated::table(), static_cast<uint32_t>(kind), {2, 2, 2}, where)
                ->solve({graph, {&source, 1}}, words, progress);
        };
        EXPECT_NO_THROW(solve_on(&stream)) << kind;
        EXPECT_THROW(solve_on(&other), locus::Error) << kind;
        EXPECT_THROW(solve_on(nullptr), locus::Error) << kind;
    }
}

TEST(CudaEngines, TraceTheActiveVoxelsAsTheCpuDoes) {
    auto options = options_for(20, 14, 9);
    const Graph graph(options, random_materials(20 * 14 * 9, 1, 4, 0.1, 3).data());
    const auto sources = sources_in(graph, 4, 3);
    const Problem problem{graph, sources, UINT64_MAX, true};
    Report expected;
    solve(LOCUS_ENGINE_RELAX, problem, &expected);
    for (const Form &form : forms) {
        if (form.engine == LOCUS_ENGINE_BRICKS)
            continue;
        Report report;
        on_device(form, problem, &report);
        EXPECT_EQ(report.trace, expected.trace) << form.name;
        EXPECT_EQ(report.iterations, expected.iterations) << form.name;
    }
}

} // namespace
