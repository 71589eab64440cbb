// Distance-ratio rows against the formulas.
#include "fields.hpp"
#include "graph/weights/concerned.hpp"
#include "graph/weights/ratio.hpp"
#include "naive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace locus::graph {
namespace {

void expect_the_formulas(const Solved &solved, uint64_t bytes = uint64_t{1} << 30, Simd simd = simd_best(),
                         uint32_t most = 0) {
    const Field field = solved.field();
    const auto expected = naive::ratio(field, solved.sources);
    std::vector<uint64_t> voxels(field.grid().voxels());
    std::iota(voxels.begin(), voxels.end(), 0);
    Progress progress;
    const std::vector<Cell> cells = survey_cells(field);
    const Rows rows = ratio_rows(ratio_parts({field, cells, solved.sources, bytes, 2, simd, voxels}, progress), most);
    for (uint64_t v = 0; v < voxels.size(); ++v) {
        std::vector<double> largest;
        for (const auto &[label, weight] : expected[v])
            largest.push_back(weight);
        std::ranges::sort(largest, std::greater<>{});
        if (most != 0 && largest.size() > most)
            largest.resize(most);
        const double sum = std::reduce(largest.begin(), largest.end());
        double total = 0;
        ASSERT_EQ(rows.row(v).size(), largest.size()) << "voxel " << v;
        for (size_t i = 0; i < largest.size(); ++i) {
            const Share &share = rows.row(v)[i];
            ASSERT_NEAR(share.weight, largest[i] / sum, 1e-6) << "voxel " << v;
            ASSERT_NEAR(share.weight, expected[v].at(share.label) / sum, 1e-6) << "voxel " << v;
            total += share.weight;
        }
        ASSERT_NEAR(total, field.reached(v) ? 1 : 0, 1e-6) << "voxel " << v;
    }
}

TEST(Ratio, UniformMaterial) {
    expect_the_formulas({options_for(20, 14, 9), std::vector<float>(20 * 14 * 9, 1), 6, 1});
}

TEST(Ratio, NoiseWithHolesAndManySeeds) {
    expect_the_formulas({options_for(24, 15, 11), noise(24 * 15 * 11, 2, 0.2), 40, 3});
}

TEST(Ratio, SteepMaterialAndFlatVoxels) {
    auto options = options_for(30, 10, 6);
    options.spacing[0] = 0.5, options.spacing[2] = 2;
    options.connectivity = 18;
    std::vector<float> material(30 * 10 * 6, 1);
    for (size_t i = 0; i < material.size(); ++i)
        if (i % 30 > 14)
            material[i] = 1000;
    expect_the_formulas({options, material, 9, 4});
}

TEST(Ratio, OneSeedWeighsOneEverywhere) { expect_the_formulas({options_for(9, 8, 7), noise(9 * 8 * 7, 5, 0.5), 1, 6}); }

TEST(Ratio, TwoSeedsOnOneVoxelAndStartingDistances) {
    Solved solved(options_for(16, 9, 8), noise(16 * 9 * 8, 7), 4, 8);
    solved.sources.push_back({solved.sources[1].voxel, 0, 4});
    solved.sources.push_back({700, solved.field().farthest() / 4, 5});
    solved.solve();
    ASSERT_EQ(solved.field().label(700), 5u);
    expect_the_formulas(solved);
}

TEST(Ratio, EveryInstructionSetAndWidthOfLanes) {
    for (const auto &options : both_widths(options_for(13, 11, 7))) {
        const Solved solved(options, noise(13 * 11 * 7, 13, 0.1), 18, 14);
        ASSERT_EQ(solved.field().farthest() < uint64_t{1} << 27, options.word_bits == LOCUS_WORD_32);
        for (const Simd simd : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon})
            if (simd_available(simd))
                expect_the_formulas(solved, uint64_t{1} << 30, simd);
    }
}

TEST(Ratio, BeyondACutOff) {
    Solved solved(options_for(15, 9, 6), noise(15 * 9 * 6, 15), 3, 16);
    solved.solve(solved.field().farthest() / 2);
    expect_the_formulas(solved);
}

TEST(Ratio, PrunedRowsKeepTheLargestWeights) {
    const Solved solved(options_for(20, 12, 8), noise(20 * 12 * 8, 17), 30, 18);
    for (const uint32_t most : {1u, 3u})
        expect_the_formulas(solved, uint64_t{1} << 30, simd_best(), most);
}

// A change in a bar of many cells concerns the seeds around it.
TEST(Ratio, AnUpdateStaysNearTheChange) {
    const Solved solved(options_for(400, 4, 4), std::vector<float>(400 * 4 * 4, 1), 100, 12);
    const Field field = solved.field();
    const std::vector<Cell> cells = survey_cells(field);
    std::vector<bool> edited(field.grid().voxels());
    const auto concerned = [&] { return concerned_labels(field, field, solved.sources, cells, edited); };
    EXPECT_EQ(std::ranges::count(concerned(), true), 0);
    edited[field.grid().index(200, 2, 2)] = true;
    const auto labels = concerned();
    EXPECT_TRUE(labels[field.label(field.grid().index(200, 2, 2))]);
    EXPECT_LT(std::ranges::count(labels, true), 20);
}

TEST(Ratio, LittleMemoryMeansFewerThreads) {
    const Solved solved(options_for(60, 20, 20), std::vector<float>(60 * 20 * 20, 1), 50, 9);
    expect_the_formulas(solved, 20u << 20);
    EXPECT_THROW(expect_the_formulas(solved, 1u << 20), Error);
}

// What locus/weights.h says of the memory: so much for each voxel of the grid and of a layer around it is enough.
TEST(Ratio, MemoryForTheWholeGridIsEnough) {
    const auto enough = [](const locus_graph_options &options, uint64_t bytes) {
        for (const uint64_t size : options.dims)
            bytes *= size + 2;
        const uint64_t voxels = options.dims[0] * options.dims[1] * options.dims[2];
        expect_the_formulas({options, std::vector<float>(voxels, 1), 2, 19}, bytes);
    };
    for (const auto &options : {options_for(40, 20, 16), options_for(1, 60, 50), options_for(300, 1, 1)}) {
        const auto [narrow, wide] = both_widths(options);
        enough(narrow, 270);
        enough(wide, 510);
        EXPECT_THROW(enough(narrow, 250), Error);
        EXPECT_THROW(enough(wide, 490), Error);
    }
}

} // namespace
} // namespace locus::graph
