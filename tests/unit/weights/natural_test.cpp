// Sibson and Laplace rows against their definitions, on every instruction set.
#include "fields.hpp"
#include "graph/weights/natural.hpp"
#include "graph/weights/settle.hpp"
#include "naive.hpp"

#include <locus/weights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace locus::graph {
namespace {

Rows fast_rows(const Solved &solved, uint32_t method, const std::vector<uint64_t> &voxels, Simd simd,
               uint64_t bytes = uint64_t{1} << 30, uint32_t most = 0, uint32_t threads = 2) {
    Progress progress;
    const Field field = solved.field();
    const auto piles = natural_rows({field, method, most, bytes, threads, simd, voxels, {}}, progress);
    return assemble(voxels.size(), piles);
}

std::vector<uint64_t> all_voxels(const Solved &solved) {
    std::vector<uint64_t> voxels(solved.graph.grid().voxels());
    std::iota(voxels.begin(), voxels.end(), 0);
    return voxels;
}

std::string text(std::span<const Share> row) {
    std::string text;
    for (const Share &share : row)
        text += std::to_string(share.label) + ":" + std::to_string(share.weight) + " ";
    return text;
}

void expect_as_defined(const Solved &solved, const Rows &rows, uint32_t method, const std::vector<uint64_t> &voxels,
                       uint32_t most = 0) {
    const Field field = solved.field();
    for (size_t i = 0; i < voxels.size(); ++i) {
        const auto row =
            method == LOCUS_METHOD_SIBSON ? naive::sibson(field, voxels[i]) : naive::laplace(field, voxels[i]);
        const auto expected = naive::finished(row, most);
        ASSERT_TRUE(std::ranges::equal(rows.row(i), expected)) << "method " << method << ", voxel " << voxels[i] << ": "
                                                               << text(rows.row(i)) << "instead of " << text(expected);
    }
}

std::vector<Simd> targets() {
    std::vector<Simd> targets;
    for (const Simd simd : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon})
        if (simd_available(simd))
            targets.push_back(simd);
    return targets;
}

TEST(Natural, EveryInstructionSetGivesTheRowsOfTheDefinition) {
    for (const auto &options : both_widths(options_for(13, 9, 8))) {
        const Solved solved(options, noise(13 * 9 * 8, 1, 0.2), 7, 2);
        ASSERT_EQ(solved.field().farthest() < uint64_t{1} << 29, options.word_bits == LOCUS_WORD_32);
        const auto voxels = all_voxels(solved);
        for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE})
            for (const Simd simd : targets())
                expect_as_defined(solved, fast_rows(solved, method, voxels, simd), method, voxels);
    }
}

TEST(Natural, EveryRuleAndConnectivityAndSpacing) {
    uint32_t random = 10;
    for (const uint32_t rule :
         {LOCUS_WEIGHT_MEAN_COMPLIANCE, LOCUS_WEIGHT_MAX_COMPLIANCE, LOCUS_WEIGHT_MEAN_STIFFNESS, LOCUS_WEIGHT_UNIFORM})
        for (const uint32_t connectivity : {6u, 18u, 26u}) {
            auto options = options_for(9, 8, 7);
            options.weight_rule = rule;
            options.connectivity = connectivity;
            options.spacing[1] = 1.5, options.spacing[2] = 0.7;
            ++random;
            const Solved solved(options, noise(9 * 8 * 7, random, 0.1), 5, random);
            const auto voxels = all_voxels(solved);
            for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE})
                expect_as_defined(solved, fast_rows(solved, method, voxels, simd_best()), method, voxels);
        }
}

TEST(Natural, WindowsGrowAndMemoryIsBounded) {
    auto options = options_for(70, 40, 30);
    const Solved solved(options, std::vector<float>(70 * 40 * 30, 1.f), 3, 5);
    const std::vector<uint64_t> voxels = {0, 5, 69, 70 * 40 * 15 + 35, 70 * 40 * 30 - 1, 35, 35};
    for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE}) {
        const uint64_t whole = 32u << 20; // bytes: room for one thread's window of the whole grid, not for two
        expect_as_defined(solved, fast_rows(solved, method, voxels, simd_best(), whole), method, voxels);
    }
    try {
        fast_rows(solved, LOCUS_METHOD_SIBSON, voxels, simd_best(), 1 << 20);
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), LOCUS_E_MEMORY);
    }
}

// Calls of one query, of two and of some: searches alone, and batches over several blocks.
void expect_as_defined_in_parts(const Solved &solved, uint32_t method, uint64_t every) {
    const auto all = all_voxels(solved);
    for (const uint64_t size : {1u, 2u, 7u, 40u})
        for (uint64_t first = 0; first + size <= all.size(); first += every * size) {
            const std::vector<uint64_t> voxels(all.begin() + static_cast<ptrdiff_t>(first),
                                               all.begin() + static_cast<ptrdiff_t>(first + size));
            expect_as_defined(solved, fast_rows(solved, method, voxels, simd_best()), method, voxels);
        }
}

TEST(Natural, FewQueries) {
    auto narrow = options_for(37, 12, 9), wide = narrow;
    narrow.word_bits = LOCUS_WORD_32;
    wide.word_bits = LOCUS_WORD_64;
    wide.scale = 1e8;
    for (const auto &options : {narrow, wide})
        for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE}) {
            Solved solved(options, noise(37 * 12 * 9, 14, 0.2), 9, 15);
            const std::vector<uint64_t> cut = {5, 700, 1234, 2000};
            const std::vector<uint16_t> masks(cut.size(), 0x1fff);
            solved.graph.cut_edges(cut, masks);
            solved.solve();
            expect_as_defined_in_parts(solved, method, 15);
        }
}

// The middle of rods one voxel thick, from one seed to another. Sweeps follow a helix a quarter of a turn at a time,
// and a zigzag across z a voxel at a time: batches are given up.
void expect_along_a_rod(const locus_graph_options &options, const std::vector<uint64_t> &rod) {
    std::vector<float> material(options.dims[0] * options.dims[1] * options.dims[2],
                                std::numeric_limits<float>::quiet_NaN());
    for (const uint64_t voxel : rod)
        material[voxel] = 1 + static_cast<float>(voxel % 3);
    Solved solved(options, material, 1, 16);
    solved.sources = {{rod.front(), 0, 0}, {rod.back(), 0, 1}};
    solved.solve();
    const std::vector<uint64_t> voxels(rod.begin() + static_cast<ptrdiff_t>(rod.size() / 2 - 40),
                                       rod.begin() + static_cast<ptrdiff_t>(rod.size() / 2 + 40));
    for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE})
        expect_as_defined(solved, fast_rows(solved, method, voxels, simd_best()), method, voxels);
}

TEST(Natural, ThinWindingRods) {
    std::vector<uint64_t> helix, zigzag;
    for (uint64_t x = 0; x < 300; ++x) {
        const auto y = static_cast<uint64_t>(std::lround(4 + 4 * std::cos(0.3 * static_cast<double>(x))));
        const auto z = static_cast<uint64_t>(std::lround(4 + 4 * std::sin(0.3 * static_cast<double>(x))));
        helix.push_back(x + 300 * (y + 9 * z));
    }
    expect_along_a_rod(options_for(300, 9, 9), helix);
    for (uint64_t y = 0; y < 4000; ++y)
        zigzag.push_back(y + 4000 * (y % 2));
    expect_along_a_rod(options_for(1, 4000, 2), zigzag);
}

// Seeds inside hard grains: no distance is long, but the edges out of the grains are.
TEST(Natural, LaplaceCountsFacesWithEdgesLongerThanAllDistances) {
    auto options = options_for(12, 9, 8);
    options.word_bits = LOCUS_WORD_64;
    options.scale = 1e8;
    std::vector<float> material(12 * 9 * 8, 0.01f);
    const uint64_t grains[] = {3 + 12 * (4 + 9 * 3), 9 + 12 * (4 + 9 * 4)};
    for (const uint64_t grain : grains)
        material[grain] = 20;
    Solved solved(options, material, 1, 18);
    for (const uint64_t grain : grains)
        solved.sources.push_back({grain, 0, static_cast<uint32_t>(solved.sources.size())});
    solved.solve();
    ASSERT_LT(solved.field().farthest(), uint64_t{1} << 29);
    ASSERT_GT(solved.graph.weight(grains[0], solved.graph.grid().neighbour(backward_face[0])), uint64_t{1} << 29);
    const auto voxels = all_voxels(solved);
    for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE})
        for (const Simd simd : targets())
            expect_as_defined(solved, fast_rows(solved, method, voxels, simd), method, voxels);
}

TEST(Natural, BeyondACutOffNothingIsStolen) {
    Solved solved(options_for(15, 9, 6), noise(15 * 9 * 6, 4), 3, 6);
    solved.solve(solved.field().farthest() / 2);
    const auto voxels = all_voxels(solved);
    for (const uint32_t method : {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE})
        expect_as_defined(solved, fast_rows(solved, method, voxels, simd_best()), method, voxels);
}

TEST(Natural, PrunedRowsKeepTheLargestWeights) {
    const Solved solved(options_for(20, 12, 8), noise(20 * 12 * 8, 7), 12, 8);
    const auto voxels = all_voxels(solved);
    expect_as_defined(solved, fast_rows(solved, LOCUS_METHOD_SIBSON, voxels, simd_best(), 1 << 30, 3),
                      LOCUS_METHOD_SIBSON, voxels, 3);
}

TEST(Natural, TheThreadsDoNotMatter) {
    const Solved solved(options_for(40, 40, 6), noise(40 * 40 * 6, 11), 9, 12);
    const auto voxels = all_voxels(solved);
    const Rows one = fast_rows(solved, LOCUS_METHOD_LAPLACE, voxels, simd_best(), 1 << 30, 0, 1);
    for (const uint32_t threads : {2u, 3u, 8u}) {
        const Rows several = fast_rows(solved, LOCUS_METHOD_LAPLACE, voxels, simd_best(), 1 << 30, 0, threads);
        EXPECT_EQ(one.offsets, several.offsets);
        EXPECT_EQ(one.shares, several.shares);
    }
}

} // namespace
} // namespace locus::graph
