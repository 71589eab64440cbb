// The weights object: rows of boxes and lists, what is derived from them, and updates after edits.
#include "fields.hpp"
#include "graph/cuts.hpp"
#include "graph/weights/interpolation.hpp"
#include "naive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::graph {
namespace {

locus_weights_options method(uint32_t method, uint32_t most = 0) {
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

Model noisy(uint32_t random) {
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

void expect_same(const Interpolation &a, const Interpolation &b) {
    ASSERT_EQ(a.ids(), b.ids());
    ASSERT_EQ(a.rows().offsets, b.rows().offsets);
    ASSERT_EQ(a.rows().shares, b.rows().shares);
}

TEST(Interpolation, BoxesAndListsGiveTheSameRows) {
    const Model model = noisy(1);
    const Interpolation all(model.diagram, method(LOCUS_METHOD_LAPLACE), model.graph->grid().whole());
    const Box box = {{3, 2, 1}, {9, 5, 6}};
    const Interpolation part(model.diagram, method(LOCUS_METHOD_LAPLACE), box);
    std::vector<uint64_t> list;
    for (uint64_t row = 0; row < part.count(); ++row)
        list.push_back(model.graph->grid().index(3 + row % 9, 2 + row / 9 % 5, 1 + row / 45));
    const Interpolation listed(model.diagram, method(LOCUS_METHOD_LAPLACE), list);
    expect_same(part, listed);
    for (uint64_t row = 0; row < list.size(); ++row)
        ASSERT_TRUE(std::ranges::equal(part.rows().row(row), all.rows().row(list[row])));
}

// Voxels of a list may repeat, also in updates.
TEST(Interpolation, DistanceRatiosOfAListWithRepeatedVoxels) {
    Model model = noisy(10);
    std::vector<uint64_t> list;
    for (uint64_t i = 0; i < 300; ++i)
        list.push_back(i * 37 % 200 * 16);
    Interpolation listed(model.diagram, method(LOCUS_METHOD_DISTANCE_RATIO), list);
    for (const float value : {40.0f, 1.0f}) {
        const Interpolation all(model.diagram, method(LOCUS_METHOD_DISTANCE_RATIO), model.graph->grid().whole());
        for (uint64_t row = 0; row < list.size(); ++row)
            ASSERT_TRUE(std::ranges::equal(listed.rows().row(row), all.rows().row(list[row])));
        model.graph->fill_box({{10, 5, 3}, {4, 3, 3}}, value);
        model.solve();
        EXPECT_GT(listed.update().size(), 0u);
    }
}

TEST(Interpolation, DenseAndInterpolatedValuesFollowTheRows) {
    const Model model = noisy(2);
    const Interpolation weights(model.diagram, method(LOCUS_METHOD_SIBSON), model.graph->grid().whole());
    const size_t seeds = weights.ids().size();
    std::vector<float> dense(weights.count() * seeds), out(weights.count() * 2), values(seeds * 2);
    for (size_t i = 0; i < seeds; ++i)
        values[2 * i] = static_cast<float>(i), values[2 * i + 1] = 1;
    weights.dense(0, weights.count(), weights.ids(), dense.data());
    weights.interpolate(0, weights.count(), values.data(), 2, out.data());
    for (uint64_t row = 0; row < weights.count(); ++row) {
        double sum = 0, mean = 0;
        for (size_t i = 0; i < seeds; ++i)
            sum += double{dense[row * seeds + i]}, mean += double{dense[row * seeds + i]} * static_cast<double>(i);
        if (weights.rows().row(row).empty()) {
            ASSERT_TRUE(std::isnan(out[2 * row]));
            continue;
        }
        ASSERT_NEAR(sum, 1, 1e-6);
        ASSERT_NEAR(out[2 * row], mean, 1e-4);
        ASSERT_NEAR(out[2 * row + 1], 1, 1e-6);
    }
    const uint32_t twice[] = {weights.ids()[0], weights.ids()[0]};
    EXPECT_THROW(weights.dense(0, 1, twice, dense.data()), Error);
    const uint32_t unknown[] = {99};
    EXPECT_THROW(weights.dense(0, 1, unknown, dense.data()), Error);
}

TEST(Interpolation, AVoxelOfASeedIsThatSeedAlone) {
    const Model model = noisy(3);
    for (const uint32_t kind : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE}) {
        const Interpolation weights(model.diagram, method(kind), model.graph->grid().whole());
        for (uint32_t i = 0; i < weights.ids().size(); ++i) {
            const auto row = weights.rows().row(model.diagram->solved_seeds()[i].voxel);
            ASSERT_EQ(row.size(), 1u);
            EXPECT_EQ(row[0], (Share{i, 1}));
        }
    }
}

// On a uniform bar with a seed at either end the distance ratio is linear: from 0 to 1 over 20 units of length.
TEST(Interpolation, GradientsOfABar) {
    auto options = options_for(41, 1, 1);
    options.spacing[0] = 0.5;
    Model model(options, std::vector<float>(41, 1));
    model.seed(1, 0);
    model.seed(2, 40);
    model.solve();
    const Interpolation weights(model.diagram, method(LOCUS_METHOD_DISTANCE_RATIO), model.graph->grid().whole());
    std::vector<float> gradients(41 * 3);
    weights.gradients(0, 41, 2, gradients.data());
    for (size_t x = 1; x < 40; ++x) {
        ASSERT_NEAR(gradients[3 * x], 1.0 / 20, 1e-3) << x;
        ASSERT_EQ(gradients[3 * x + 1], 0);
    }
}

TEST(Interpolation, UpdatesEqualFreshWeightsAndTouchFewRows) {
    for (const uint32_t kind : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE, LOCUS_METHOD_DISTANCE_RATIO}) {
        Model model = noisy(4 + kind);
        const Grid &grid = model.graph->grid();
        Interpolation weights(model.diagram, method(kind, 5), grid.whole());
        std::mt19937 rng(kind);
        for (int round = 0; round < 12; ++round) {
            const Rows before = weights.rows();
            const std::vector<uint32_t> ids_before = weights.ids();
            const Box box = {{rng() % 23, rng() % 11, rng() % 7}, {2, 2, 2}};
            const std::vector<uint32_t> ids = weights.ids();
            switch (round % 4) {
            case 0:
                model.graph->fill_box(box, 40);
                break;
            case 1:
                model.graph->fill_box(box, 0.6f);
                break;
            case 2: {
                const auto [x, y, z] = grid.place(rng() % grid.voxels());
                if (model.graph->passable(grid.index(x, y, z)))
                    model.diagram->move_seed(ids[rng() % ids.size()], x, y, z);
                break;
            }
            default:
                if (round == 7)
                    model.diagram->remove_seeds({&ids[2], 1});
                else if (model.graph->passable(round * 100ul))
                    model.seed(200 + static_cast<uint32_t>(round), round * 100ul);
            }
            model.solve();
            const std::vector<uint64_t> changed = weights.update();
            expect_same(weights, Interpolation(model.diagram, method(kind, 5), grid.whole()));
            EXPECT_TRUE(std::ranges::is_sorted(changed));
            if (round % 4 < 2) {
                EXPECT_LT(changed.size(), grid.voxels());
            }
            // Rows that were not named are as they were.
            std::vector<bool> named(grid.voxels());
            for (const uint64_t row : changed)
                named[row] = true;
            for (uint64_t row = 0; row < grid.voxels(); ++row) {
                if (named[row])
                    continue;
                const auto a = before.row(row), b = weights.rows().row(row);
                ASSERT_EQ(a.size(), b.size());
                for (size_t i = 0; i < a.size(); ++i) {
                    ASSERT_EQ(ids_before[a[i].label], weights.ids()[b[i].label]);
                    ASSERT_EQ(a[i].weight, b[i].weight);
                }
            }
        }
        EXPECT_TRUE(weights.update().empty());
    }
}

// Boxes closed, softened and stiffened, a cut, seeds moved among many: fresh weights each time.
TEST(Interpolation, DistanceRatiosFollowChangesAmongManySeeds) {
    auto options = options_for(60, 26, 12);
    options.material_min = 0.5, options.material_max = 50;
    Model model(options, noise(60 * 26 * 12, 31, 0.02));
    const Grid &grid = model.graph->grid();
    std::mt19937 rng(32);
    const auto anywhere = [&] {
        uint64_t voxel = rng() % grid.voxels();
        while (!model.graph->passable(voxel))
            voxel = rng() % grid.voxels();
        return voxel;
    };
    for (uint32_t id = 0; id < 150; ++id)
        model.seed(id, anywhere());
    model.solve();
    for (const uint32_t most : {0u, 4u}) {
        Interpolation weights(model.diagram, method(LOCUS_METHOD_DISTANCE_RATIO, most), grid.whole());
        uint64_t touched = 0;
        const float values[] = {std::numeric_limits<float>::quiet_NaN(), 40, 0.6f, 3};
        for (uint32_t round = 0; round < 5; ++round) {
            if (round == 2) {
                cut_by_plane(*model.graph, {20.3, 0, 0}, {1, 0.2, 0}, {{14, 3, 2}, {14, 9, 8}});
            } else if (round % 5 == 4) {
                const auto [x, y, z] = grid.place(anywhere());
                model.diagram->move_seed(static_cast<uint32_t>(rng() % 150), x, y, z);
            } else {
                model.graph->fill_box({{rng() % 57, rng() % 23, rng() % 9}, {3, 3, 3}}, values[round % 4]);
                for (const Seed &seed : model.diagram->solved_seeds())
                    if (!model.graph->passable(seed.voxel)) {
                        const auto [x, y, z] = grid.place(anywhere());
                        model.diagram->move_seed(seed.id, x, y, z);
                    }
            }
            model.solve();
            const std::vector<uint64_t> rows = weights.update();
            touched += rows.size();
            expect_same(weights, Interpolation(model.diagram, method(LOCUS_METHOD_DISTANCE_RATIO, most), grid.whole()));
        }
        EXPECT_LT(touched, 5 * grid.voxels() / 2);
    }
}

TEST(Interpolation, StaleDiagramsAreRefused) {
    Model model = noisy(9);
    Interpolation weights(model.diagram, method(LOCUS_METHOD_SIBSON), model.graph->grid().whole());
    model.graph->fill_box({{0, 0, 0}, {1, 1, 1}}, 2);
    EXPECT_THROW(weights.update(), Error);
    EXPECT_THROW(Interpolation(model.diagram, method(LOCUS_METHOD_SIBSON), model.graph->grid().whole()), Error);
    model.solve();
    model.seed(77, model.diagram->solved_seeds()[0].voxel);
    EXPECT_THROW(weights.update(), Error);
}

} // namespace
} // namespace locus::graph
