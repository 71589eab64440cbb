// Seed placement: every sampled seed is a farthest voxel, every free seed ends at the centre of its cell, failures
// change nothing.
#include "tests/unit/graph/api.hpp"

#include <algorithm>
#include <initializer_list>
#include <random>
#include <set>

namespace {

using namespace api;

constexpr float air = std::numeric_limits<float>::quiet_NaN();

locus_place_options place(uint64_t count, uint32_t first_id, uint32_t lloyd, uint32_t metric = LOCUS_PLACE_COMPLIANCE) {
    locus_place_options options;
    EXPECT_STATUS(locus_place_options_init(&options, sizeof options), LOCUS_OK);
    options.count = count;
    options.first_id = first_id;
    options.lloyd_iterations = lloyd;
    options.metric = metric;
    return options;
}

std::vector<float> blobs(const locus_graph_options &o, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> material(voxels(o));
    for (float &value : material)
        value = random() % 4 == 0 ? air : static_cast<float>(1 + random() % 5);
    return material;
}

std::vector<uint64_t> places(const std::vector<locus_seed> &seeds, const locus_graph_options &o) {
    std::vector<uint64_t> voxels;
    for (const locus_seed &s : seeds)
        voxels.push_back(s.x + o.dims[0] * (s.y + o.dims[1] * s.z));
    return voxels;
}

TEST(Sampling, TakesTheFarthestVoxelEachTime) {
    for (const uint32_t metric : std::initializer_list<uint32_t>{LOCUS_PLACE_COMPLIANCE, LOCUS_PLACE_UNIFORM})
        for (uint32_t seed = 0; seed < 5; ++seed) {
            const auto o = options(9, 8, 7);
            const auto material = blobs(o, seed);
            const Graph g = graph(o, material);
            auto uniform = o;
            uniform.weight_rule = LOCUS_WEIGHT_UNIFORM;
            const Graph other = graph(uniform, material);
            const Graph &measured = metric == LOCUS_PLACE_UNIFORM ? other : g;
            const Diagram d = diagram(g, {});
            const auto how = place(12, 100, 0, metric);
            EXPECT_EQ(locus_diagram_place_seeds(d.get(), &how), LOCUS_OK) << locus_last_error();
            const auto all = seeds(d);
            ASSERT_EQ(all.size(), 12u);
            const auto at = places(all, o);
            // The start: the lowest passable voxel stands in for a seed.
            const uint64_t lowest = static_cast<uint64_t>(
                std::find_if(material.begin(), material.end(), [](float v) { return v > 0; }) - material.begin());
            std::vector<locus_seed> known{{lowest % 9, lowest / 9 % 8, lowest / 72, 0, 1, 0}};
            for (size_t i = 0; i < 12; ++i) {
                EXPECT_EQ(all[i].id, 100 + i);
                EXPECT_EQ(all[i].fixed, 0u);
                const Diagram so_far = diagram(measured, known);
                solve(so_far);
                const auto distance = exact(so_far, material.size());
                uint64_t farthest = UINT64_MAX;
                for (uint64_t v = 0; v < material.size(); ++v)
                    if (material[v] > 0 && (farthest == UINT64_MAX || distance[v] > distance[farthest]))
                        farthest = v;
                ASSERT_EQ(at[i], farthest) << "seed " << seed << ", sample " << i;
                if (i == 0)
                    known.clear();
                known.push_back(all[i]);
            }
        }
}

TEST(Lloyd, EndsWithEverySeedAtTheCentreOfItsCell) {
    auto o = options(14, 9, 6);
    o.spacing[2] = 2.5;
    const auto material = blobs(o, 3);
    const Graph g = graph(o, material);
    const auto fixed = static_cast<uint64_t>(
        std::find_if(material.begin(), material.end(), [](float v) { return v > 0; }) - material.begin());
    const Diagram d = diagram(g, {{fixed % 14, fixed / 14 % 9, fixed / 126, 0, 7, 1}});
    const auto how = place(6, 20, 1000);
    EXPECT_STATUS(locus_diagram_place_seeds(d.get(), &how), LOCUS_OK);
    const auto all = seeds(d);
    EXPECT_EQ(places(all, o)[0], fixed);
    EXPECT_EQ(all[0].fixed, 1u);
    uint32_t unread = 0;
    EXPECT_STATUS(locus_diagram_labels(d.get(), nullptr, &unread, SIZE_MAX), LOCUS_E_STATE);
    solve(d);
    const auto cells = labels(d, voxels(o));
    for (size_t i = 1; i < all.size(); ++i) {
        double centre[3] = {0, 0, 0};
        double count = 0;
        for (size_t v = 0; v < cells.size(); ++v)
            if (cells[v] == all[i].id) {
                centre[0] += static_cast<double>(v % 14);
                centre[1] += static_cast<double>(v / 14 % 9);
                centre[2] += static_cast<double>(v / 126);
                ++count;
            }
        ASSERT_GT(count, 0);
        const auto apart = [&](size_t v) {
            const double x = static_cast<double>(v % 14) - centre[0] / count;
            const double y = static_cast<double>(v / 14 % 9) - centre[1] / count;
            const double z = (static_cast<double>(v / 126) - centre[2] / count) * 2.5;
            return x * x + y * y + z * z;
        };
        const double own = apart(places(all, o)[i]);
        for (size_t v = 0; v < cells.size(); ++v)
            if (cells[v] == all[i].id) {
                EXPECT_GE(apart(v), own - 1e-9);
            }
    }
}

TEST(Lloyd, FollowsTheMetricAskedFor) {
    const auto o = options(40, 1, 1);
    std::vector<float> material(40, 1);
    std::fill(material.begin() + 20, material.end(), 9.0f);
    const Graph g = graph(o, material);
    const Diagram by_length = diagram(g, {});
    const Diagram by_compliance = diagram(g, {});
    auto how = place(2, 0, 100, LOCUS_PLACE_UNIFORM);
    EXPECT_STATUS(locus_diagram_place_seeds(by_length.get(), &how), LOCUS_OK);
    how.metric = LOCUS_PLACE_COMPLIANCE;
    EXPECT_STATUS(locus_diagram_place_seeds(by_compliance.get(), &how), LOCUS_OK);
    auto even = places(seeds(by_length), o);
    auto odd = places(seeds(by_compliance), o);
    std::sort(even.begin(), even.end());
    std::sort(odd.begin(), odd.end());
    EXPECT_NEAR(static_cast<double>(even[0]), 9.5, 1);
    EXPECT_NEAR(static_cast<double>(even[1]), 29.5, 1);
    EXPECT_GT(odd[0], even[0]); // cells of equal compliance distance: the stiff end's is longer
}

TEST(Placing, ReachesEveryPartOfTheObject) {
    const auto o = options(11, 3, 3);
    std::vector<float> material(99, 1);
    for (size_t i = 0; i < 99; ++i)
        if (i % 11 == 3 || i % 11 == 7)
            material[i] = air;
    const Graph g = graph(o, material);
    const Diagram d = diagram(g, {});
    const auto how = place(3, 0, 10);
    EXPECT_STATUS(locus_diagram_place_seeds(d.get(), &how), LOCUS_OK);
    solve(d);
    const auto found = labels(d, 99);
    for (size_t i = 0; i < 99; ++i)
        EXPECT_EQ(found[i] == LOCUS_NO_SEED, std::isnan(material[i]));
}

TEST(Placing, CanFillEveryVoxel) {
    const auto o = options(3, 2, 2);
    const Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{1, 1, 1, 0, 50, 0}});
    const auto how = place(11, 0, 5);
    EXPECT_STATUS(locus_diagram_place_seeds(d.get(), &how), LOCUS_OK);
    const auto at = places(seeds(d), o);
    EXPECT_EQ(std::set<uint64_t>(at.begin(), at.end()).size(), 12u);
}

TEST(Placing, FailsWithoutATrace) {
    auto o = options(4, 4, 4);
    o.max_seeds = 32;
    const Graph g = uniform_graph(o);
    const Diagram d = diagram(g, {{0, 0, 0, 0, 5, 0}, {1, 0, 0, 0, 6, 0}});
    const auto before = places(seeds(d), o);
    const auto refused = [&](const locus_place_options &how, locus_status status, const char *part) {
        EXPECT_EQ(locus_diagram_place_seeds(d.get(), &how), status);
        EXPECT_NE(std::string(locus_last_error()).find(part), std::string::npos) << locus_last_error();
        EXPECT_EQ(places(seeds(d), o), before);
    };
    refused(place(63, 10, 5), LOCUS_E_ARGUMENT, "count is 63");
    refused(place(UINT64_MAX, 10, 5), LOCUS_E_ARGUMENT, "count is 18446744073709551615");
    refused(place(31, 10, 5), LOCUS_E_RANGE, "5 label bits");
    refused(place(4, 3, 5), LOCUS_E_ARGUMENT, "the id 5 is taken");
    refused(place(4, LOCUS_NO_SEED - 3, 5), LOCUS_E_ARGUMENT, "LOCUS_NO_SEED");
    refused(place(4, 10, 5, 9), LOCUS_E_ARGUMENT, "metric is 9");
    auto how = place(4, 10, 50);
    int calls = 0;
    how.progress = [](double, void *user) -> int32_t { return ++*static_cast<int *>(user) == 3; };
    how.progress_user = &calls;
    refused(how, LOCUS_E_STOPPED, "stopped");
    std::vector<double> fractions;
    how.progress = [](double fraction, void *user) -> int32_t {
        static_cast<std::vector<double> *>(user)->push_back(fraction);
        return 0;
    };
    how.progress_user = &fractions;
    EXPECT_STATUS(locus_diagram_place_seeds(d.get(), &how), LOCUS_OK);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
    EXPECT_LE(fractions.size(), 300u);
    EXPECT_FAILS(locus_diagram_place_seeds(d.get(), nullptr), LOCUS_E_ARGUMENT, "options is NULL");
}

} // namespace
