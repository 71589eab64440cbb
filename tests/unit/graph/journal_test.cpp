// The journal of edits that updates follow, the bucket queue against a sorted list, and the uniform twin of a graph.
#include "graph/bucket_queue.hpp"
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;

TEST(Journal, NamesTheBoxesEditedSinceAVersion) {
    const auto options = options_for(6, 5, 4);
    const std::vector<float> ones(120, 1);
    Graph graph(options, ones.data());
    const uint64_t start = graph.version();
    ASSERT_TRUE(graph.edits_since(start).has_value());
    EXPECT_TRUE(graph.edits_since(start)->empty());
    graph.fill_box({{1, 1, 1}, {2, 2, 2}}, 1.5f);
    const uint64_t middle = graph.version();
    EXPECT_GT(middle, start);
    const uint64_t voxels[4] = {3, 4, 5, 6}; // 6 begins the next row
    graph.set_voxels(voxels, ones.data());
    EXPECT_EQ(graph.edits_since(start)->size(), 3u);
    const auto later = *graph.edits_since(middle);
    ASSERT_EQ(later.size(), 2u);
    EXPECT_EQ(later[0].origin[0], 3u);
    EXPECT_EQ(later[0].extent[0], 3u);
    EXPECT_EQ(later[1].origin[1], 1u);
    const uint64_t before = graph.version();
    EXPECT_THROW(graph.fill_box({{0, 0, 0}, {1, 1, 1}}, 1e30f), locus::Error);
    EXPECT_EQ(graph.version(), before);
    const uint64_t corner = 0;
    const uint16_t mask = 1;
    graph.cut_edges({&corner, 1}, {&mask, 1});
    const auto cut = *graph.edits_since(before);
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_EQ(cut[0].origin[0], 0u);
    EXPECT_EQ(cut[0].extent[2], 2u);
}

TEST(Journal, ForgetsWhatIsTooLongToFollow) {
    const auto options = options_for(600, 300, 1);
    const std::vector<float> ones(180000, 1);
    Graph graph(options, ones.data());
    const uint64_t start = graph.version();
    std::vector<uint64_t> scattered;
    for (uint64_t v = 0; v < 180000; v += 2)
        scattered.push_back(v);
    graph.set_voxels(scattered, ones.data());
    EXPECT_FALSE(graph.edits_since(start).has_value());
    EXPECT_TRUE(graph.edits_since(graph.version()).has_value());
}

TEST(Graph, HasAUniformTwinWithItsCuts) {
    auto options = options_for(4, 4, 4);
    options.spacing[1] = 2;
    const auto materials = random_materials(64, 1, 9, 0.2, 1);
    Graph graph(options, materials.data());
    const uint64_t voxel = 21;
    const uint16_t mask = 0x1FFF;
    graph.cut_edges({&voxel, 1}, {&mask, 1});
    const Graph uniform = graph.uniform();
    EXPECT_EQ(uniform.passable_voxels(), graph.passable_voxels());
    for (uint64_t u = 0; u < 64; ++u)
        for (uint64_t v = 0; v < 64; ++v) {
            const uint64_t weight = uniform.weight_between(u, v);
            EXPECT_EQ(weight == 0, graph.weight_between(u, v) == 0);
            if (weight == 0)
                continue;
            const double length = graph.grid().length(graph.grid().neighbour(graph.grid().number_between(u, v)).kind);
            EXPECT_NEAR(static_cast<double>(weight) / uniform.scale(), length, length / 256);
        }
}

TEST(BucketQueue, GivesKeysInOrderOverAllMagnitudes) {
    for (const uint64_t reach : {uint64_t{3}, uint64_t{1000}, uint64_t{1} << 40, uint64_t{1} << 62}) {
        std::mt19937_64 random(reach);
        BucketQueue<uint32_t> queue;
        std::vector<uint64_t> key;
        std::multimap<uint64_t, uint32_t> model;
        const auto push = [&](uint64_t k) {
            const auto item = static_cast<uint32_t>(key.size());
            key.push_back(k);
            queue.push(k, item);
            model.emplace(k, item);
        };
        for (int i = 0; i < 20; ++i)
            push(random() % reach);
        std::vector<uint32_t> items;
        const auto key_of = [&](uint32_t item) { return key[item]; };
        while (!model.empty()) {
            ASSERT_TRUE(queue.pop(items, key_of));
            const uint64_t least = model.begin()->first;
            ASSERT_EQ(queue.last(), least);
            std::vector<uint32_t> expected;
            for (auto [at, end] = model.equal_range(least); at != end; ++at)
                expected.push_back(at->second);
            std::sort(items.begin(), items.end());
            std::sort(expected.begin(), expected.end());
            ASSERT_EQ(items, expected);
            model.erase(least);
            for (uint64_t n = random() % 3; n > 0 && key.size() < 3000; --n)
                if (const uint64_t more = least + 1 + random() % reach; more > least)
                    push(more);
        }
        EXPECT_FALSE(queue.pop(items, key_of));
    }
}

} // namespace
