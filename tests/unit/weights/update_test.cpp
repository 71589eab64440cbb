// Updates of the weights object after edits, cuts and changes of the seeds: as if made anew.
#include "graph/cuts.hpp"
#include "model.hpp"

#include <algorithm>

namespace locus::graph {
namespace {

TEST(Update, UpdatesEqualFreshWeightsAndTouchFewRows) {
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
TEST(Update, DistanceRatiosFollowChangesAmongManySeeds) {
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

// Labels for sixteen seeds, so that seeds often get those of others that went.
TEST(Update, UpdatesFollowSeedsThatAreNumberedAnew) {
    for (const uint32_t kind : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE, LOCUS_METHOD_DISTANCE_RATIO}) {
        auto options = options_for(20, 12, 7);
        options.max_seeds = 15;
        Model model(options, noise(20 * 12 * 7, 61 + kind));
        ASSERT_EQ(model.graph->layout().labels(), 16u);
        std::mt19937 rng(kind);
        uint32_t id = 0;
        const auto add = [&](size_t seeds) {
            for (size_t i = 0; i < seeds; ++i)
                model.seed(id++, rng() % model.graph->grid().voxels());
        };
        add(12);
        model.solve();
        Interpolation weights(model.diagram, method(kind), model.graph->grid().whole());
        for (uint32_t round = 0; round < 20; ++round) {
            std::vector<uint32_t> ids = weights.ids();
            std::ranges::shuffle(ids, rng);
            ids.resize(std::min<size_t>(1 + rng() % 3, ids.size() - 1));
            model.diagram->remove_seeds(ids);
            if (round % 2 == 0) { // see the gaps before they are closed
                model.solve();
                weights.update();
            }
            add(1 + rng() % (16 - model.diagram->seeds().size()));
            model.solve();
            weights.update();
            expect_same(weights, Interpolation(model.diagram, method(kind), model.graph->grid().whole()));
        }
    }
}

} // namespace
} // namespace locus::graph
