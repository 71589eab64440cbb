// The T-bone steak of the thesis: 12,276 voxels of stiffness 5e3 to 1.5e10 Pa, with 3 and 10 seeds.
#include "tests/unit/graph/api.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <queue>
#include <sstream>

namespace {

using namespace api;

struct Steak {
    std::vector<float> stiffness;
    std::vector<locus_seed> seeds;
};

bool load(Steak &steak, const std::string &seed_file) {
    const char *data = std::getenv("LOCUS_DATA");
    const std::string folder = std::string(data != nullptr ? data : "") + "/steak/";
    std::ifstream raw(folder + "steak_64x64x15.raw", std::ios::binary);
    std::ifstream list(folder + seed_file);
    if (!raw || !list)
        return false;
    std::vector<char> bytes(64 * 64 * 15);
    raw.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (const char byte : bytes) { // the transfer function of the scenes
        const auto value = static_cast<unsigned char>(byte);
        const double meat = 20000 - 15000 * (value - 1) / 253.0;
        steak.stiffness.push_back(value == 0 ? 0 : value == 255 ? 1.5e10f : static_cast<float>(meat));
    }
    for (std::string line; std::getline(list, line);) {
        if (line.empty() || line[0] == '#')
            continue;
        std::istringstream numbers(line);
        locus_seed seed{0, 0, 0, 0, static_cast<uint32_t>(steak.seeds.size()), 0};
        numbers >> seed.x >> seed.y >> seed.z;
        steak.seeds.push_back(seed);
    }
    return true;
}

locus_graph_options steak_options() {
    auto o = options(64, 64, 15);
    for (double &s : o.spacing)
        s = 0.15;
    o.material = LOCUS_MATERIAL_STIFFNESS;
    return o;
}

// Dijkstra in double over the formula of the mean rule, knowing nothing of words and steps.
std::vector<double> plain_distances(const Steak &steak) {
    std::vector<double> distance(steak.stiffness.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const locus_seed &seed : steak.seeds) {
        const auto voxel = static_cast<int>(seed.x + 64 * (seed.y + 64 * seed.z));
        distance[static_cast<size_t>(voxel)] = 0;
        queue.push({0, voxel});
    }
    while (!queue.empty()) {
        const auto [d, u] = queue.top();
        queue.pop();
        if (d > distance[static_cast<size_t>(u)])
            continue;
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = u % 64 + dx, y = u / 64 % 64 + dy, z = u / 4096 + dz;
                    if (x < 0 || y < 0 || z < 0 || x > 63 || y > 63 || z > 14)
                        continue;
                    const int v = x + 64 * (y + 64 * z);
                    const double ku = static_cast<double>(steak.stiffness[static_cast<size_t>(u)]);
                    const double kv = static_cast<double>(steak.stiffness[static_cast<size_t>(v)]);
                    if (kv == 0 || u == v)
                        continue;
                    const double through = d + 0.15 * std::sqrt(dx * dx + dy * dy + dz * dz) * (1 / ku + 1 / kv) / 2;
                    if (through < distance[static_cast<size_t>(v)]) {
                        distance[static_cast<size_t>(v)] = through;
                        queue.push({through, v});
                    }
                }
    }
    return distance;
}

class SteakTest : public testing::TestWithParam<const char *> {};

TEST_P(SteakTest, EveryEngineGivesTheDistancesOfTheFormula) {
    Steak steak;
    if (!load(steak, GetParam()))
        GTEST_SKIP() << "no steak in the folder named by LOCUS_DATA";
    const Graph g = graph(steak_options(), steak.stiffness);
    const auto about = info(g);
    EXPECT_EQ(about.passable, 12276u);
    EXPECT_EQ(about.word_bits, 64u);
    EXPECT_EQ(about.overflow_free, 1u);
    EXPECT_LE(about.weight_error, 1.0 / 256 + 1e-9);
    const Diagram d = diagram(g, steak.seeds, LOCUS_ENGINE_HEAP);
    solve(d);
    const auto expected = plain_distances(steak);
    const auto found = distances(d, expected.size());
    size_t reached = 0;
    for (size_t v = 0; v < expected.size(); ++v) {
        ASSERT_EQ(std::isinf(found[v]), std::isinf(expected[v])) << v;
        if (std::isinf(expected[v]))
            continue;
        ++reached;
        ASSERT_NEAR(static_cast<double>(found[v]), expected[v], expected[v] * (about.weight_error + 1e-6)) << v;
    }
    EXPECT_EQ(reached, 12276u); // one component
    for (const uint32_t engine :
         std::initializer_list<uint32_t>{LOCUS_ENGINE_AUTO, LOCUS_ENGINE_BUCKET, LOCUS_ENGINE_RELAX}) {
        const Diagram other = diagram(g, steak.seeds, engine);
        solve(other);
        EXPECT_EQ(exact(other, expected.size()), exact(d, expected.size()));
        EXPECT_EQ(labels(other, expected.size()), labels(d, expected.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SteakTest, testing::Values("seeds_3.txt", "seeds_10.txt"));

TEST(Steak, DoesNotFitNarrowWordsAtTheDefaultPrecision) {
    Steak steak;
    if (!load(steak, "seeds_3.txt"))
        GTEST_SKIP() << "no steak in the folder named by LOCUS_DATA";
    auto o = steak_options();
    o.word_bits = LOCUS_WORD_32;
    locus_graph *made = nullptr;
    EXPECT_FAILS(locus_graph_create(&o, steak.stiffness.data(), &made), LOCUS_E_RANGE, "64-bit words would do");
}

} // namespace
