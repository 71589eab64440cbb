// The weights object: rows of boxes and lists, what is derived from them, progress and cancel.
#include "graph/cuts.hpp"
#include "model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace locus::graph {
namespace {

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

// In a box inside the grid, with holes and a cut: from the weights of those neighbours that an edge joins.
TEST(Interpolation, GradientsStopAtHolesAndCutsAndTheBox) {
    auto options = options_for(26, 14, 9);
    options.spacing[1] = 1.5, options.spacing[2] = 0.7;
    Model model(options, noise(26 * 14 * 9, 51, 0.1));
    std::mt19937 rng(52);
    for (uint32_t id = 100; id < 106;)
        if (const uint64_t voxel = rng() % model.graph->grid().voxels(); model.graph->passable(voxel))
            model.seed(id++, voxel);
    ASSERT_GT(cut_by_plane(*model.graph, {12.3, 0, 0}, {1, 0.1, 0}, model.graph->grid().whole()), 0u);
    model.solve();
    const Grid &grid = model.graph->grid();
    const Box box = {{4, 2, 1}, {17, 10, 6}};
    const Interpolation weights(model.diagram, method(LOCUS_METHOD_SIBSON), box);
    const uint32_t id = weights.ids()[2];
    std::vector<float> gradients(weights.count() * 3), of_seed(weights.count());
    weights.gradients(0, weights.count(), id, gradients.data());
    weights.dense(0, weights.count(), {&id, 1}, of_seed.data());
    std::array<uint64_t, 3> met{}; // voxels with 0, 1 and 2 neighbours that count
    for (uint64_t row = 0; row < weights.count(); ++row) {
        const std::array<uint64_t, 3> place = {4 + row % 17, 2 + row / 17 % 10, 1 + row / 170};
        for (unsigned a = 0; a < 3; ++a) {
            std::vector<std::pair<double, double>> line = {{0, of_seed[row]}}; // where, and the weight there
            for (const Neighbour &to : grid.neighbours()) {
                const std::array<int, 3> step = {to.dx, to.dy, to.dz};
                if (std::abs(to.dx) + std::abs(to.dy) + std::abs(to.dz) != 1 || step[a] == 0)
                    continue;
                auto there = place;
                there[a] += static_cast<uint64_t>(step[a]);
                const uint64_t other = there[0] - 4 + 17 * (there[1] - 2 + 10 * (there[2] - 1));
                if (there[a] < box.origin[a] || there[a] >= box.origin[a] + box.extent[a] ||
                    model.graph->weight(grid.index(place[0], place[1], place[2]), to) == 0 ||
                    weights.rows().row(other).empty())
                    continue;
                line.emplace_back(step[a] * grid.spacing()[a], of_seed[other]);
            }
            std::ranges::sort(line);
            const double run = line.back().first - line.front().first;
            const double expected = run > 0 ? (line.back().second - line.front().second) / run : 0;
            ASSERT_NEAR(gradients[row * 3 + a], expected, 1e-6) << "row " << row << ", axis " << a;
            ++met[line.size() - 1];
        }
    }
    for (const uint64_t voxels : met)
        EXPECT_GT(voxels, 0u);
    model.graph->fill_box({{0, 0, 0}, {1, 1, 1}}, 2);
    EXPECT_THROW(weights.gradients(0, 1, id, gradients.data()), Error);
}

// What a caller hears, and when to stop.
struct Listener {
    std::vector<double> heard;
    size_t stop_at = SIZE_MAX; // the call that is answered with a stop

    static int32_t listen(double fraction, void *user) {
        Listener &self = *static_cast<Listener *>(user);
        self.heard.push_back(fraction);
        return self.heard.size() == self.stop_at ? 1 : 0;
    }
    // The work stops at that call, and says so.
    void expect_stop(size_t at, const std::function<void()> &work) {
        heard.clear();
        stop_at = at;
        try {
            work();
            ADD_FAILURE() << "not stopped at call " << at;
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), LOCUS_E_STOPPED);
        }
        EXPECT_EQ(heard.size(), at);
        stop_at = SIZE_MAX;
    }
};

TEST(Interpolation, ProgressRisesAndAStopLeavesTheRowsAsTheyWere) {
    for (const uint32_t kind : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE, LOCUS_METHOD_DISTANCE_RATIO}) {
        auto in_one_thread = options_for(24, 20, 10);
        in_one_thread.threads = 1;
        Model model(in_one_thread, noise(24 * 20 * 10, 71));
        for (uint32_t id = 0; id < 40; ++id)
            model.seed(id, id * 117);
        model.solve();
        Listener listener;
        locus_weights_options options = method(kind);
        options.progress = Listener::listen;
        options.progress_user = &listener;
        const Box all = model.graph->grid().whole();
        Interpolation weights(model.diagram, options, all);
        ASSERT_GE(listener.heard.size(), 3u);
        EXPECT_TRUE(std::ranges::is_sorted(listener.heard));
        EXPECT_EQ(listener.heard.back(), 1);
        listener.expect_stop(2, [&] { Interpolation(model.diagram, options, all); });

        const Rows before = weights.rows();
        model.graph->fill_box({{5, 5, 5}, {3, 3, 3}}, 9);
        model.solve();
        listener.expect_stop(1, [&] { weights.update(); });
        EXPECT_EQ(weights.rows().offsets, before.offsets);
        EXPECT_EQ(weights.rows().shares, before.shares);
        EXPECT_GT(weights.update().size(), 0u);
        expect_same(weights, Interpolation(model.diagram, method(kind), all));
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
