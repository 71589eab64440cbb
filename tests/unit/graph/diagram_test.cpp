// Diagrams through the C interface: analytic distances, ties, cut-off, ids, paths, cells, and everything that must be
// refused.
#include "tests/unit/graph/api.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numeric>
#include <random>

namespace {

using namespace api;

constexpr uint32_t engines[] = {LOCUS_ENGINE_AUTO, LOCUS_ENGINE_HEAP, LOCUS_ENGINE_BUCKET, LOCUS_ENGINE_RELAX};
constexpr float air = std::numeric_limits<float>::quiet_NaN();

// The length of the shortest path on an unobstructed uniform grid of spacing 1: diagonal steps as far as they go.
double chamfer(std::array<double, 3> offset, uint32_t connectivity) {
    for (double &d : offset)
        d = std::abs(d);
    std::sort(offset.begin(), offset.end(), std::greater<>());
    const auto [a, b, c] = offset;
    if (connectivity == 6)
        return a + b + c;
    if (connectivity == 26)
        return (a - b) + (b - c) * std::sqrt(2.0) + c * std::sqrt(3.0);
    // 18: pairs of axes; where the largest exceeds the other two together, the rest are straight steps.
    const double diagonal = std::min(b + c, std::floor((a + b + c) / 2));
    return diagonal * std::sqrt(2.0) + (a + b + c - 2 * diagonal);
}

TEST(Distances, AreTheChamferMetricOnUniformGrids) {
    for (const uint32_t engine : engines)
        for (const uint32_t connectivity : {6u, 18u, 26u}) {
            auto o = options(15, 11, 9);
            o.connectivity = connectivity;
            const Graph g = uniform_graph(o);
            const Diagram d = diagram(g, {{4, 7, 2, 0, 5, 0}}, engine);
            solve(d);
            const auto found = distances(d, voxels(o));
            size_t i = 0;
            for (double z = 0; z < 9; ++z)
                for (double y = 0; y < 11; ++y)
                    for (double x = 0; x < 15; ++x, ++i) {
                        const double expected = chamfer({x - 4, y - 7, z - 2}, connectivity);
                        ASSERT_NEAR(found[i], expected, 1e-6 * (1 + expected)) << i;
                    }
        }
}

TEST(Distances, ScaleWithComplianceAndSpacing) {
    auto o = options(6, 1, 1);
    o.spacing[0] = 0.25;
    for (const uint32_t rule : std::initializer_list<uint32_t>{
             LOCUS_WEIGHT_MEAN_COMPLIANCE, LOCUS_WEIGHT_MAX_COMPLIANCE, LOCUS_WEIGHT_MEAN_STIFFNESS}) {
        o.weight_rule = rule;
        const Graph g = graph(o, {8, 8, 8, 8, 2, 2});
        const Diagram d = diagram(g, {{0, 0, 0, 1.5, 1, 0}});
        solve(d);
        const auto found = distances(d, 6);
        const double step = rule == LOCUS_WEIGHT_MEAN_COMPLIANCE  ? 5
                            : rule == LOCUS_WEIGHT_MAX_COMPLIANCE ? 8
                                                                  : 1 / ((0.5 + 0.125) / 2);
        EXPECT_NEAR(found[0], 1.5, 1e-6);
        EXPECT_NEAR(found[3], 1.5 + 0.25 * 24, 1e-5);
        EXPECT_NEAR(found[5], 1.5 + 0.25 * (24 + step + 2), 1e-5);
    }
}

TEST(Ties, GoToTheSeedAddedEarlier) {
    for (const uint32_t engine : engines) {
        const auto o = options(9, 1, 1);
        const Graph g = uniform_graph(o);
        // The ids run against the order of addition on purpose.
        const Diagram d = diagram(g, {{8, 0, 0, 0, 70, 0}, {0, 0, 0, 0, 30, 0}, {0, 0, 0, 0, 10, 0}}, engine);
        solve(d);
        EXPECT_EQ(labels(d, 9), (std::vector<uint32_t>{30, 30, 30, 30, 70, 70, 70, 70, 70}));
        std::vector<uint64_t> sizes(3);
        size_t count = 0;
        EXPECT_STATUS(locus_diagram_cell_sizes(d.get(), sizes.data(), 3, &count), LOCUS_OK);
        EXPECT_EQ(sizes, (std::vector<uint64_t>{5, 4, 0}));
        const uint32_t gone = 70;
        EXPECT_STATUS(locus_diagram_remove_seeds(d.get(), &gone, 1), LOCUS_OK);
        const locus_seed again{8, 0, 0, 0, 70, 0};
        EXPECT_STATUS(locus_diagram_add_seeds(d.get(), &again, 1), LOCUS_OK);
        solve(d);
        EXPECT_EQ(labels(d, 9), (std::vector<uint32_t>{30, 30, 30, 30, 30, 70, 70, 70, 70}));
    }
}

TEST(Seeds, KeepTheirOrderWhenSlotsAreUsedUp) {
    auto o = options(40, 1, 1);
    o.max_seeds = 4;
    const Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{0, 0, 0, 0, 100, 0}, {39, 0, 0, 0, 101, 0}});
    std::mt19937 random(1);
    uint32_t next = 102;
    for (int round = 0; round < 50; ++round) {
        const auto before = seeds(d);
        const uint32_t gone = before[random() % before.size()].id;
        EXPECT_STATUS(locus_diagram_remove_seeds(d.get(), &gone, 1), LOCUS_OK);
        for (size_t n = seeds(d).size(); n < 4; ++n, ++next) {
            const locus_seed seed{random() % 40, 0, 0, 0, next, 0};
            EXPECT_STATUS(locus_diagram_add_seeds(d.get(), &seed, 1), LOCUS_OK);
        }
        const auto now = seeds(d);
        ASSERT_TRUE(std::is_sorted(now.begin(), now.end(), [](auto &a, auto &b) { return a.id < b.id; }));
        solve(d);
        const auto found = labels(d, 40);
        for (uint64_t x = 0; x < 40; ++x) { // ids grow with the order of addition: the smallest id wins ties
            uint32_t best = LOCUS_NO_SEED;
            uint64_t nearest = 1000;
            for (const locus_seed &seed : now) {
                const uint64_t apart = seed.x > x ? seed.x - x : x - seed.x;
                if (apart < nearest) {
                    nearest = apart;
                    best = seed.id;
                }
            }
            ASSERT_EQ(found[x], best) << x;
        }
    }
    const locus_seed fifth{1, 0, 0, 0, 9999, 0};
    EXPECT_FAILS(locus_diagram_add_seeds(d.get(), &fifth, 1), LOCUS_E_RANGE, "2 label bits");
}

TEST(Seeds, AreRefusedWithTheirName) {
    const auto o = options(3, 3, 1);
    std::vector<float> material(9, 1);
    material[4] = air;
    const Graph g = graph(o, material);
    const Diagram d = diagram(g, {{0, 0, 0, 0, 1, 0}});
    const auto refused = [&](locus_seed seed, const char *part) {
        const locus_seed two[2] = {{2, 2, 0, 0, 77, 0}, seed};
        EXPECT_FAILS(locus_diagram_add_seeds(d.get(), two, 2), LOCUS_E_ARGUMENT, part);
        EXPECT_EQ(seeds(d).size(), 1u);
    };
    refused({3, 0, 0, 0, 5, 0}, "seeds[1] (id 5) lies at (3, 0, 0), outside the grid of 3 x 3 x 1");
    refused({UINT64_MAX, 0, 0, 0, 5, 0}, "outside the grid");
    refused({1, 1, 0, 0, 5, 0}, "(1, 1, 0), an impassable voxel");
    refused({1, 0, 0, 0, 1, 0}, "the id 1, which is taken");
    refused({1, 0, 0, 0, 77, 0}, "the id 77, which is taken");
    refused({1, 0, 0, 0, LOCUS_NO_SEED, 0}, "LOCUS_NO_SEED");
    refused({1, 0, 0, -1, 5, 0}, "distance -1");
    refused({1, 0, 0, std::nan(""), 5, 0}, "distance nan");
    refused({1, 0, 0, 0, 5, 2}, "fixed is 2");
    const locus_seed late{1, 0, 0, 1e300, 5, 0};
    EXPECT_FAILS(locus_diagram_add_seeds(d.get(), &late, 1), LOCUS_E_RANGE, "1e+300");
    EXPECT_FAILS(locus_diagram_move_seed(d.get(), 1, 1, 1, 0), LOCUS_E_ARGUMENT, "impassable");
    EXPECT_FAILS(locus_diagram_move_seed(d.get(), 1, 0, 3, 0), LOCUS_E_ARGUMENT, "outside");
    EXPECT_FAILS(locus_diagram_move_seed(d.get(), 2, 0, 0, 0), LOCUS_E_ARGUMENT, "id is 2");
    const uint32_t ids[2] = {1, 9};
    EXPECT_FAILS(locus_diagram_remove_seeds(d.get(), ids, 2), LOCUS_E_ARGUMENT, "ids[1] is 9");
    EXPECT_EQ(seeds(d).size(), 1u);
    EXPECT_FAILS(locus_diagram_add_seeds(nullptr, &late, 1), LOCUS_E_ARGUMENT, "diagram is NULL");
    EXPECT_FAILS(locus_diagram_add_seeds(d.get(), nullptr, 1), LOCUS_E_ARGUMENT, "seeds is NULL");
}

TEST(Solve, NeedsSeedsOnPassableVoxels) {
    const auto o = options(4, 1, 1);
    const Graph g = uniform_graph(o);
    const Diagram none = diagram(g, {});
    EXPECT_FAILS(locus_diagram_solve(none.get(), nullptr, nullptr), LOCUS_E_STATE, "no seeds");
    const Diagram d = diagram(g, {{2, 0, 0, 0, 8, 0}});
    solve(d);
    const auto before = labels(d, 4);
    const locus_voxel_box box{{2, 0, 0}, {1, 1, 1}};
    EXPECT_STATUS(locus_graph_fill_box(g.get(), &box, air), LOCUS_OK);
    EXPECT_FAILS(locus_diagram_solve(d.get(), nullptr, nullptr), LOCUS_E_ARGUMENT,
                 "seed 8 lies at (2, 0, 0), an impassable");
    EXPECT_EQ(labels(d, 4), before); // a failure on the arguments leaves the last result
    EXPECT_STATUS(locus_diagram_move_seed(d.get(), 8, 0, 0, 0), LOCUS_OK);
    solve(d);
    EXPECT_EQ(labels(d, 4), (std::vector<uint32_t>{8, 8, LOCUS_NO_SEED, LOCUS_NO_SEED}));
    EXPECT_EQ(exact(d, 4)[3], UINT64_MAX);
    EXPECT_TRUE(std::isinf(distances(d, 4)[3]));
}

TEST(Solve, KeepsTheGraphAlive) {
    const auto o = options(4, 4, 4);
    Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{2, 0, 0, 0, 8, 0}});
    g.reset();
    solve(d);
    EXPECT_EQ(labels(d, 64), std::vector<uint32_t>(64, 8));
}

TEST(Solve, LeavesWhatLiesBeyondTheCutOff) {
    for (const uint32_t engine : engines) {
        const auto o = options(10, 1, 1);
        const Graph g = uniform_graph(o);
        const Diagram d = diagram(g, {{0, 0, 0, 0, 3, 0}, {9, 0, 0, 5, 4, 0}}, engine, 4);
        solve(d);
        const auto found = labels(d, 10);
        for (size_t x = 0; x < 10; ++x)
            EXPECT_EQ(found[x], x <= 4 ? 3 : LOCUS_NO_SEED) << x;
        const Diagram zero = diagram(g, {{5, 0, 0, 0, 3, 0}}, engine, 0);
        solve(zero);
        const auto only = labels(zero, 10);
        EXPECT_EQ(std::count(only.begin(), only.end(), 3u), 1);
    }
}

TEST(Solve, ReportsProgressAndStops) {
    const auto o = options(60, 60, 60);
    const Graph g = uniform_graph(o);
    struct Heard {
        std::vector<double> fractions;
        size_t stop_after = SIZE_MAX;
    };
    const auto hear = [](double fraction, void *user) -> int32_t {
        auto &heard = *static_cast<Heard *>(user);
        heard.fractions.push_back(fraction);
        return heard.fractions.size() > heard.stop_after ? 1 : 0;
    };
    for (const uint32_t engine : engines) {
        const Diagram d = diagram(g, {{0, 0, 0, 0, 3, 0}}, engine);
        Heard all;
        EXPECT_STATUS(locus_diagram_solve(d.get(), hear, &all), LOCUS_OK);
        // How often the default engine's calling thread gets to report depends on the other threads.
        const size_t sure = engine == LOCUS_ENGINE_AUTO ? 1 : 10;
        EXPECT_GE(all.fractions.size(), sure);
        EXPECT_LE(all.fractions.size(), 300u);
        EXPECT_TRUE(std::is_sorted(all.fractions.begin(), all.fractions.end()));
        EXPECT_EQ(all.fractions.back(), 1.0);
        Heard some;
        some.stop_after = sure / 2;
        EXPECT_FAILS(locus_diagram_solve(d.get(), hear, &some), LOCUS_E_STOPPED, "stopped");
        EXPECT_EQ(some.fractions.size(), sure / 2 + 1);
        uint32_t label = 0;
        const locus_voxel_box box{{0, 0, 0}, {1, 1, 1}};
        EXPECT_FAILS(locus_diagram_labels(d.get(), &box, &label, 1), LOCUS_E_STATE, "not solved");
        solve(d);
        EXPECT_EQ(locus_diagram_labels(d.get(), &box, &label, 1), LOCUS_OK);
    }
}

TEST(Solve, FindsDistancesThatDoNotFit) {
    for (const uint32_t engine : engines) {
        auto o = options(3000, 1, 1);
        o.word_bits = 32;
        o.max_seeds = 1 << 16; // leaves 14 bits of distance: 16,383 steps
        const Graph g = uniform_graph(o);
        EXPECT_EQ(info(g).overflow_free, 0u);
        const Diagram d = diagram(g, {{0, 0, 0, 0, 3, 0}}, engine);
        EXPECT_FAILS(locus_diagram_solve(d.get(), nullptr, nullptr), LOCUS_E_RANGE, "a scale of 1.99");
        std::vector<uint32_t> unread(3000);
        EXPECT_STATUS(locus_diagram_labels(d.get(), nullptr, unread.data(), 3000), LOCUS_E_STATE);
        const Diagram near = diagram(g, {{0, 0, 0, 0, 3, 0}}, engine, 40);
        solve(near);
        // A wall between: what lies behind is unreached, not too far.
        const locus_voxel_box wall{{30, 0, 0}, {1, 1, 1}};
        EXPECT_STATUS(locus_graph_fill_box(g.get(), &wall, air), LOCUS_OK);
        solve(d);
        EXPECT_EQ(labels(d, 3000)[31], LOCUS_NO_SEED);
        o.scale = 1.99; // as the message advises: all paths fit
        const Graph coarse = uniform_graph(o);
        EXPECT_EQ(info(coarse).overflow_free, 1u);
        const Diagram whole = diagram(coarse, {{0, 0, 0, 0, 3, 0}}, engine);
        solve(whole);
        EXPECT_EQ(labels(whole, 3000)[2999], 3u);
    }
}

TEST(Results, AreReadBoxByBox) {
    const auto o = options(7, 6, 5);
    const Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{0, 0, 0, 0, 3, 0}, {6, 5, 4, 0, 9, 0}});
    uint32_t label = 0;
    EXPECT_FAILS(locus_diagram_labels(d.get(), nullptr, &label, 1000), LOCUS_E_STATE, "not solved");
    solve(d);
    const auto all = labels(d, 210);
    const auto steps = exact(d, 210);
    const auto scale = info(g).scale;
    const locus_voxel_box box{{2, 1, 3}, {4, 5, 2}};
    std::vector<uint32_t> part(40);
    std::vector<float> length(40);
    EXPECT_STATUS(locus_diagram_labels(d.get(), &box, part.data(), 40), LOCUS_OK);
    EXPECT_STATUS(locus_diagram_distances(d.get(), &box, length.data(), 40), LOCUS_OK);
    size_t i = 0;
    for (uint64_t z = 3; z < 5; ++z)
        for (uint64_t y = 1; y < 6; ++y)
            for (uint64_t x = 2; x < 6; ++x, ++i) {
                const size_t voxel = x + 7 * (y + 6 * z);
                EXPECT_EQ(part[i], all[voxel]);
                EXPECT_EQ(length[i], static_cast<float>(static_cast<double>(steps[voxel]) / scale));
            }
    EXPECT_FAILS(locus_diagram_labels(d.get(), &box, part.data(), 39), LOCUS_E_CAPACITY, "capacity is 39");
    EXPECT_FAILS(locus_diagram_labels(d.get(), &box, nullptr, 40), LOCUS_E_ARGUMENT, "labels is NULL");
    const locus_voxel_box outside{{2, 1, 3}, {4, 5, 3}};
    EXPECT_FAILS(locus_diagram_labels(d.get(), &outside, part.data(), 40), LOCUS_E_ARGUMENT, "extent[2] is 3");
}

TEST(Results, PathsLeadToTheirSeedAtTheirLength) {
    auto o = options(12, 10, 8);
    std::mt19937 random(3);
    std::vector<float> material(960);
    for (float &value : material)
        value = random() % 5 == 0 ? air : static_cast<float>(1 + random() % 9);
    const size_t places[3] = {5, 400, 900};
    for (const size_t place : places)
        material[place] = 1;
    const Graph g = graph(o, material);
    std::vector<locus_seed> starts;
    for (uint32_t i = 0; i < 3; ++i)
        starts.push_back({places[i] % 12, places[i] / 12 % 10, places[i] / 120, i == 1 ? 2.5 : 0, 40 + i, 0});
    const Diagram d = diagram(g, starts);
    solve(d);
    const auto steps = exact(d, 960);
    const auto cells = labels(d, 960);
    const auto offset = static_cast<uint64_t>(std::rint(2.5 * info(g).scale));
    for (size_t v = 0; v < 960; ++v) {
        std::vector<uint64_t> path(960);
        size_t count = 7;
        EXPECT_STATUS(locus_diagram_path(d.get(), v % 12, v / 12 % 10, v / 120, path.data(), 960, &count), LOCUS_OK);
        if (cells[v] == LOCUS_NO_SEED) {
            EXPECT_EQ(count, 0u);
            continue;
        }
        ASSERT_GE(count, 1u);
        EXPECT_EQ(path[0], v);
        EXPECT_EQ(path[count - 1], places[cells[v] - 40]);
        uint64_t length = cells[v] == 41 ? offset : 0;
        for (size_t i = 1; i < count; ++i) {
            uint64_t weight = 0;
            EXPECT_STATUS(locus_graph_edge_weight(g.get(), path[i - 1], path[i], &weight), LOCUS_OK);
            EXPECT_GT(weight, 0u);
            length += weight;
        }
        EXPECT_EQ(length, steps[v]);
        for (uint64_t lower = 0; count > 1 && lower < path[1]; ++lower) { // of equal ways on, the lowest index
            uint64_t weight = 0;
            if (cells[lower] != cells[v] || steps[lower] >= steps[v])
                continue;
            EXPECT_STATUS(locus_graph_edge_weight(g.get(), v, lower, &weight), LOCUS_OK);
            EXPECT_FALSE(weight > 0 && steps[lower] + weight == steps[v]) << v << " by " << lower;
        }
        if (count > 1) {
            EXPECT_FAILS(locus_diagram_path(d.get(), v % 12, v / 12 % 10, v / 120, path.data(), count - 1, &count),
                         LOCUS_E_CAPACITY, "capacity");
        }
    }
    size_t count = 0;
    EXPECT_FAILS(locus_diagram_path(d.get(), 12, 0, 0, nullptr, 0, &count), LOCUS_E_ARGUMENT, "(12, 0, 0)");
    const locus_voxel_box box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_STATUS(locus_graph_fill_box(g.get(), &box, 2), LOCUS_OK);
    EXPECT_FAILS(locus_diagram_path(d.get(), 0, 0, 0, nullptr, 0, &count), LOCUS_E_STATE, "edited");
    EXPECT_FAILS(locus_diagram_cell_pairs(d.get(), nullptr, 0, &count), LOCUS_E_STATE, "edited");
}

TEST(Results, CellPairsCountTheEdgesBetweenCells) {
    const auto o = options(6, 2, 1);
    const Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{5, 0, 0, 0, 7, 0}, {0, 0, 0, 0, 2, 0}, {2, 0, 0, 0, 5, 0}});
    solve(d);
    // x: 2 2 5 5 7 7 in both rows (the voxel at x = 1 is as far from 0 as from 2, and 2 was added earlier).
    locus_cell_pair pairs[4];
    size_t count = 0;
    EXPECT_STATUS(locus_diagram_cell_pairs(d.get(), pairs, 4, &count), LOCUS_OK);
    ASSERT_EQ(count, 2u);
    EXPECT_EQ(pairs[0].a, 7u);
    EXPECT_EQ(pairs[0].b, 5u);
    EXPECT_EQ(pairs[0].edges, 4u);
    EXPECT_EQ(pairs[1].a, 2u);
    EXPECT_EQ(pairs[1].b, 5u);
    EXPECT_EQ(pairs[1].edges, 4u);
    EXPECT_STATUS(locus_diagram_cell_pairs(d.get(), pairs, 1, &count), LOCUS_E_CAPACITY);
    EXPECT_EQ(count, 2u);
    const locus_seed more{3, 0, 0, 0, 99, 0};
    EXPECT_STATUS(locus_diagram_add_seeds(d.get(), &more, 1), LOCUS_OK);
    EXPECT_FAILS(locus_diagram_cell_sizes(d.get(), nullptr, 0, &count), LOCUS_E_STATE, "seeds were changed");
}

TEST(Results, StatsAndTraceTellWhatTheSolveDid) {
    const auto o = options(9, 9, 9);
    const Graph g = uniform_graph(o);
    for (const uint32_t engine : engines) {
        const Diagram d = diagram(g, {{4, 4, 4, 0, 0, 0}}, engine, std::numeric_limits<double>::infinity(), true);
        locus_diagram_stats stats{};
        stats.struct_size = sizeof stats;
        EXPECT_STATUS(locus_diagram_get_stats(d.get(), &stats), LOCUS_E_STATE);
        solve(d);
        EXPECT_STATUS(locus_diagram_get_stats(d.get(), &stats), LOCUS_OK);
        EXPECT_EQ(stats.reached, 729u);
        EXPECT_EQ(stats.seeds, 1u);
        EXPECT_NEAR(stats.max_distance, 4 * std::sqrt(3.0), 1e-6);
        EXPECT_EQ(static_cast<double>(stats.max_exact), stats.max_distance * info(g).scale);
        EXPECT_GE(stats.relaxations, 729u);
        std::vector<uint64_t> active(1000);
        size_t count = 0;
        if (engine == LOCUS_ENGINE_HEAP) {
            EXPECT_STATUS(locus_diagram_trace(d.get(), active.data(), 1000, &count), LOCUS_E_STATE);
        } else if (engine == LOCUS_ENGINE_RELAX) {
            // A wave of cubic shells, each voxel settled as its shell is reached.
            EXPECT_STATUS(locus_diagram_trace(d.get(), active.data(), 1000, &count), LOCUS_OK);
            active.resize(count);
            EXPECT_EQ(stats.iterations, count);
            EXPECT_EQ(active[0], 1u);
            EXPECT_EQ(active[1], 26u);
            EXPECT_GE(std::accumulate(active.begin(), active.end(), uint64_t{0}), 729u);
        }
    }
    const Diagram untraced = diagram(g, {{4, 4, 4, 0, 0, 0}}, LOCUS_ENGINE_RELAX);
    solve(untraced);
    size_t count = 0;
    EXPECT_FAILS(locus_diagram_trace(untraced.get(), nullptr, 0, &count), LOCUS_E_STATE, "record_trace");
}

TEST(Parts, WithoutSeedsStayUnreached) {
    for (const uint32_t engine : engines) {
        const auto o = options(9, 5, 5); // two blocks with air between
        std::vector<float> material(225, 1);
        for (size_t i = 4; i < 225; i += 9)
            material[i] = air;
        const Graph g = graph(o, material);
        const Diagram d = diagram(g, {{0, 0, 0, 0, 6, 0}}, engine);
        solve(d);
        const auto found = labels(d, 225);
        for (size_t i = 0; i < 225; ++i)
            EXPECT_EQ(found[i], i % 9 < 4 ? 6 : LOCUS_NO_SEED);
    }
}

TEST(Options, AreChecked) {
    const auto o = options(3, 3, 3);
    const Graph g = uniform_graph(o);
    locus_diagram *made = nullptr;
    locus_diagram_options bad;
    const auto refused = [&](const char *part) {
        EXPECT_FAILS(locus_diagram_create(g.get(), &bad, &made), LOCUS_E_ARGUMENT, part);
        EXPECT_EQ(made, nullptr);
        EXPECT_STATUS(locus_diagram_options_init(&bad, sizeof bad), LOCUS_OK);
    };
    EXPECT_STATUS(locus_diagram_options_init(&bad, sizeof bad), LOCUS_OK);
    bad.engine = 77;
    refused("engine is 77");
    bad.max_distance = -1;
    refused("max_distance is -1");
    bad.max_distance = std::nan("");
    refused("max_distance is nan");
    bad.record_trace = 2;
    refused("record_trace is 2");
    EXPECT_FAILS(locus_diagram_create(nullptr, nullptr, &made), LOCUS_E_ARGUMENT, "graph is NULL");
    EXPECT_FAILS(locus_diagram_create(g.get(), nullptr, nullptr), LOCUS_E_ARGUMENT, "diagram is NULL");
    locus_diagram_destroy(nullptr);
}

} // namespace
