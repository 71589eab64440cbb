// Distance-ratio rows against the formulas.
#include "fields.hpp"
#include "graph/weights/concerned.hpp"
#include "graph/weights/ratio.hpp"
#include "naive.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace locus::graph {
namespace {

void expect_the_formulas(const Solved &solved, uint64_t bytes = uint64_t{1} << 30) {
    const Field field = solved.field();
    const auto expected = naive::ratio(field, solved.sources);
    std::vector<uint64_t> voxels(field.grid().voxels());
    std::iota(voxels.begin(), voxels.end(), 0);
    Progress progress;
    const std::vector<Cell> cells = survey_cells(field);
    const Rows rows =
        ratio_rows(ratio_parts({field, cells, solved.sources, bytes, 2, simd_best(), voxels}, progress), 0);
    for (uint64_t v = 0; v < voxels.size(); ++v) {
        double sum = 0, total = 0;
        for (const auto &[label, weight] : expected[v])
            sum += weight;
        ASSERT_EQ(rows.row(v).size(), expected[v].size()) << "voxel " << v;
        for (const Share &share : rows.row(v)) {
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
    solved.sources.push_back({700, 500, 5});
    solved.solve();
    expect_the_formulas(solved);
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

} // namespace
} // namespace locus::graph
