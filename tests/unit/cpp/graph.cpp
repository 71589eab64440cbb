// locus/locus.hpp: graphs, diagrams and weights as C++ objects.
#include <gtest/gtest.h>

#include <locus/locus.hpp>

#include <cmath>
#include <numeric>
#include <random>
#include <thread>

namespace {

// A bar of five voxels whose middle is ten times softer.
const std::vector<float> bar = {1, 1, 10, 1, 1};
const locus_seed ends[2] = {{0, 0, 0, 0.0, 7, 0}, {4, 0, 0, 0.0, 8, 0}};

locus::graph bar_graph() { return locus::graph(locus::graph_options(5, 1, 1), bar); }

TEST(CppGraph, HandlesMoveAndDoNotCopy) {
    static_assert(!std::is_copy_constructible_v<locus::graph> && std::is_nothrow_move_constructible_v<locus::graph>);
    static_assert(!std::is_copy_constructible_v<locus::diagram> && std::is_nothrow_move_assignable_v<locus::diagram>);
    static_assert(!std::is_copy_constructible_v<locus::weights> && std::is_nothrow_move_assignable_v<locus::weights>);
    locus::graph first = bar_graph(), second = std::move(first);
    EXPECT_TRUE(second);
    EXPECT_FALSE(first);
    EXPECT_EQ(second.info().passable, 5u);
    EXPECT_THROW(first.info(), locus::error);
    EXPECT_THROW(first.fill_box({{0, 0, 0}, {1, 1, 1}}, 1), locus::error);
    EXPECT_THROW(locus::diagram{first}, locus::error);
}

TEST(CppGraph, DistancesOfABar) {
    locus::graph graph = bar_graph();
    locus::diagram diagram(graph);
    diagram.add_seeds(ends);
    double told = 0;
    diagram.solve([&](double fraction) { told = fraction; });
    EXPECT_EQ(diagram.distances(), (std::vector<float>{0, 1, 6.5, 1, 0}));
    EXPECT_EQ(diagram.labels(), (std::vector<uint32_t>{7, 7, 7, 8, 8}));
    EXPECT_EQ(diagram.labels(locus_voxel_box{{2, 0, 0}, {2, 1, 1}}), (std::vector<uint32_t>{7, 8}));
    const double scale = graph.info().scale;
    EXPECT_EQ(diagram.distances_exact()[2], static_cast<uint64_t>(6.5 * scale));
    EXPECT_EQ(graph.edge_weight(0, 1), static_cast<uint64_t>(scale));
    EXPECT_EQ(diagram.path(2, 0, 0), (std::vector<uint64_t>{2, 1, 0}));
    locus::status refused; // there is no GPU memory to write to
    diagram.labels_on_device(&refused, 5, {}, &refused);
    EXPECT_EQ(refused.code(), LOCUS_E_UNSUPPORTED);
    diagram.distances_on_device(nullptr, 5, {}, &refused);
    EXPECT_EQ(refused.code(), LOCUS_E_ARGUMENT);
    diagram.distances_exact_on_device(&refused, 4, {}, &refused);
    EXPECT_EQ(refused.code(), LOCUS_E_CAPACITY);
    EXPECT_EQ(diagram.cell_sizes(), (std::vector<uint64_t>{3, 2}));
    ASSERT_EQ(diagram.cell_pairs().size(), 1u);
    EXPECT_EQ(diagram.stats().reached, 5u);
    EXPECT_LE(told, 1.0);
    EXPECT_EQ(diagram.seeds().at(1).id, 8u);
    const float two[2] = {3, NAN};
    graph.set_voxels(std::array<uint64_t, 2>{1, 2}, two);
    const auto change = diagram.update();
    EXPECT_EQ(change.voxels, 2u);
    EXPECT_EQ(change.box.origin[0], 1u);
    EXPECT_EQ(diagram.labels()[2], LOCUS_NO_SEED);
    diagram.move_seed(8, 3, 0, 0);
    diagram.remove_seeds(std::array<uint32_t, 1>{7});
    diagram.solve();
    EXPECT_EQ(diagram.labels(), (std::vector<uint32_t>{LOCUS_NO_SEED, LOCUS_NO_SEED, LOCUS_NO_SEED, 8, 8}));
}

TEST(CppGraph, EditsReadBackAndCutsMend) {
    locus::graph graph(locus::graph_options(6, 5, 4), std::vector<float>(120, 1.0F));
    graph.set_box({{1, 1, 1}, {2, 1, 1}}, std::array<float, 2>{2, 3});
    EXPECT_EQ(graph.get_box(locus_voxel_box{{0, 1, 1}, {4, 1, 1}}), (std::vector<float>{1, 2, 3, 1}));
    graph.fill_box({{0, 0, 0}, {1, 1, 1}}, NAN);
    EXPECT_TRUE(std::isnan(graph.get_box()[0]));
    const uint64_t cut = graph.cut_plane({2.5, 0, 0}, {1, 0, 0});
    EXPECT_GT(cut, 0u);
    EXPECT_EQ(graph.mend_box(), cut);
    // Two triangles that make the same plane.
    const std::vector<double> corners = {2.5, -9, -9, 2.5, 19, -9, 2.5, 19, 19, 2.5, -9, 19};
    EXPECT_EQ(graph.cut_mesh(corners, std::array<uint32_t, 6>{0, 1, 2, 0, 2, 3}), cut);
    EXPECT_THROW(graph.cut_mesh(std::vector<double>(7), std::array<uint32_t, 3>{0, 1, 2}), locus::error);
}

TEST(CppGraph, WeightsOfAQuad) {
    locus::graph graph(locus::graph_options(9, 9, 1), std::vector<float>(81, 1.0F));
    locus::diagram diagram(graph);
    locus::place_options place(4);
    place.first_id = 100;
    diagram.place_seeds(place);
    diagram.solve();
    for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE, LOCUS_METHOD_DISTANCE_RATIO}) {
        locus::weights weights(diagram, locus::weights_options(method));
        ASSERT_EQ(weights.row_count(), 81u);
        const locus::weight_rows rows = weights.rows();
        ASSERT_EQ(rows.offsets.size(), 82u);
        ASSERT_EQ(rows.ids.size(), weights.entry_count());
        const std::vector<float> dense = weights.dense(std::array<uint32_t, 4>{100, 101, 102, 103});
        const std::vector<float> values = {1, 2, 3, 4, 10, 20, 30, 40};
        const std::vector<float> out = weights.interpolate(values, 2);
        for (size_t row = 0; row < 81; ++row) {
            double sum = 0, first = 0;
            for (uint64_t i = rows.offsets[row]; i < rows.offsets[row + 1]; ++i) {
                EXPECT_EQ(dense[row * 4 + rows.ids[i] - 100], rows.values[i]);
                sum += rows.values[i];
                first += rows.values[i] * values[(rows.ids[i] - 100) * 2];
            }
            EXPECT_NEAR(sum, 1, 1e-5);
            EXPECT_NEAR(out[row * 2], first, 1e-4);
        }
        EXPECT_EQ(weights.gradients(100).size(), 243u);
        EXPECT_THROW(weights.interpolate(std::vector<float>(3)), locus::error);
        EXPECT_THROW(weights.rows(80, 2), locus::error);
    }
    locus::weights some(diagram, locus::weights_options(), std::array<uint64_t, 2>{40, 0});
    EXPECT_EQ(some.row_count(), 2u);
}

TEST(CppGraph, WeightsFollowSeedsThatCome) {
    locus::graph graph(locus::graph_options(9, 9, 1), std::vector<float>(81, 1.0F));
    locus::weights weights;
    EXPECT_THROW(weights.row_count(), locus::error);
    {
        locus::diagram diagram(graph);
        diagram.add_seeds(std::array<locus_seed, 1>{locus_seed{0, 0, 0, 0, 1, 0}});
        diagram.solve();
        weights = locus::weights(diagram);
        diagram.add_seeds(std::array<locus_seed, 1>{locus_seed{8, 8, 0, 0, 2, 0}});
        diagram.update();
        EXPECT_FALSE(weights.update().empty());
    }
    EXPECT_THROW(weights.interpolate(std::vector<float>{5}), locus::error);
    EXPECT_EQ(weights.interpolate(std::vector<float>{5, 6})[80], 6);
}

TEST(CppGraph, WeightFunctionsOutliveTheirGraph) {
    locus::graph_options options(4, 1, 1);
    options.weight_rule = LOCUS_WEIGHT_CALLER;
    options.material_min = 0.5, options.material_max = 2;
    const auto factor = std::make_shared<double>(1.0);
    options.weight = [factor](uint64_t, uint64_t, double length) { return *factor * length; };
    std::vector<std::string> lines;
    options.log = [&](int32_t, std::string_view line) { lines.emplace_back(line); };
    locus::diagram diagram;
    {
        locus::graph graph(options, std::vector<float>(4, 1.0F));
        diagram = locus::diagram(graph);
    }
    options.weight = {};
    diagram.add_seeds(std::array<locus_seed, 1>{locus_seed{0, 0, 0, 0, 1, 0}});
    *factor = 2;
    diagram.solve();
    EXPECT_EQ(diagram.distances()[3], 6);
    EXPECT_EQ(factor.use_count(), 2);
    diagram = {};
    EXPECT_EQ(factor.use_count(), 1);
    EXPECT_FALSE(lines.empty());
}

struct Mine {
    int number;
};

TEST(CppGraph, ExceptionsOfCallbacksComeThrough) {
    locus::graph_options options(64, 64, 16);
    options.weight_rule = LOCUS_WEIGHT_CALLER;
    options.material_min = options.material_max = 1;
    bool bad = false;
    options.weight = [&](uint64_t u, uint64_t, double length) {
        if (bad && u == 77)
            throw Mine{int(u)};
        return length;
    };
    locus::graph graph(options, std::vector<float>(64 * 64 * 16, 1.0F));
    locus::diagram diagram(graph);
    diagram.add_seeds(std::array<locus_seed, 1>{locus_seed{0, 0, 0, 0, 1, 0}});
    bad = true;
    try {
        diagram.solve();
        FAIL() << "the weight function's exception was lost";
    } catch (const Mine &mine) {
        EXPECT_EQ(mine.number, 77);
    }
    // Nothing was computed without that weight.
    EXPECT_THROW(diagram.labels(), locus::error);
    bad = false;
    EXPECT_THROW(diagram.solve([](double) -> bool { throw Mine{1}; }), Mine);
    locus::status status;
    EXPECT_THROW(diagram.solve([](double) { throw Mine{2}; }, &status), Mine);
    diagram.solve([](double) { return false; }, &status);
    EXPECT_EQ(status.code(), LOCUS_E_STOPPED);
    diagram.solve({}, &status);
    EXPECT_TRUE(status.ok());
    EXPECT_FLOAT_EQ(diagram.distances()[63], 63);
}

TEST(CppGraph, ErrorsByExceptionOrByStatus) {
    try {
        const locus::graph graph(locus::graph_options(0, 1, 1), {});
        FAIL();
    } catch (const locus::error &error) {
        EXPECT_EQ(error.code(), LOCUS_E_ARGUMENT);
        EXPECT_STREQ(error.name(), "LOCUS_E_ARGUMENT");
        EXPECT_NE(std::string(error.what()).find("dims"), std::string::npos) << error.what();
    }
    locus::status status;
    locus::graph graph(locus::graph_options(0, 1, 1), {}, &status);
    EXPECT_FALSE(graph);
    EXPECT_FALSE(status.ok());
    EXPECT_STREQ(status.name(), "LOCUS_E_ARGUMENT");
    EXPECT_NE(status.text().find("dims"), std::string::npos) << status.text();
    graph = locus::graph(locus::graph_options(5, 1, 1), std::vector<float>(4), &status);
    EXPECT_EQ(status.text(), "material holds 4 elements instead of 5");
    graph = locus::graph(locus::graph_options(5, 1, 1), bar, &status);
    EXPECT_TRUE(status.ok() && graph && status.text().empty());
    graph.set_box({{4, 0, 0}, {2, 1, 1}}, std::vector<float>(2), &status);
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    locus::diagram diagram(graph, {}, &status);
    EXPECT_TRUE(diagram.labels({}, &status).size() == 5 && status.code() == LOCUS_E_STATE);
    EXPECT_THROW(diagram.labels(locus_voxel_box{{0, 0, 0}, {~0ULL, ~0ULL, 1}}), locus::error);
}

} // namespace
