// Distance-ratio rows against the formulas.
#include "fields.hpp"
#include "graph/weights/ratio.hpp"
#include "graph/weights/ratio_scope.hpp"
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
    const RowPile pile = ratio_rows({field, solved.sources, 0, bytes, 2, simd_best(), voxels, {}}, progress);
    const Rows rows = assemble(voxels.size(), {&pile, 1});
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

// A change in a bar of many cells concerns what lies around it, whatever the rows are asked for.
TEST(Ratio, AnUpdateStaysNearTheChange) {
    const Solved solved(options_for(400, 4, 4), std::vector<float>(400 * 4 * 4, 1), 100, 12);
    const Field field = solved.field();
    std::vector<uint64_t> voxels(field.grid().voxels());
    std::iota(voxels.begin(), voxels.end(), 0);
    Progress progress;
    const RowPile pile = ratio_rows({field, solved.sources, 0, 1u << 30, 1, simd_best(), voxels, {}}, progress);
    const Rows rows = assemble(voxels.size(), {&pile, 1});
    std::vector<bool> changed(voxels.size());
    EXPECT_TRUE(ratio_scope(field, solved.sources, voxels, changed, rows).rows.empty());
    changed[field.grid().index(200, 2, 2)] = true;
    const RatioScope scope = ratio_scope(field, solved.sources, voxels, changed, rows);
    EXPECT_GT(scope.rows.size(), 0u);
    EXPECT_LT(scope.rows.size(), voxels.size() / 3);
    EXPECT_LT(scope.seeds.size(), solved.sources.size() / 2);
    // The seeds of the scope suffice for its rows.
    const RatioJob job{field, scope.seeds, 0, 1u << 30, 1, simd_best(), voxels, scope.rows};
    const RowPile part = ratio_rows(job, progress);
    const Rows again = assemble(voxels.size(), {&part, 1});
    for (const uint64_t row : scope.rows)
        ASSERT_TRUE(std::ranges::equal(rows.row(row), again.row(row))) << "row " << row;
}

TEST(Ratio, LittleMemoryMeansFewerThreads) {
    const Solved solved(options_for(60, 20, 20), std::vector<float>(60 * 20 * 20, 1), 50, 9);
    expect_the_formulas(solved, 20u << 20);
    EXPECT_THROW(expect_the_formulas(solved, 1u << 20), Error);
}

} // namespace
} // namespace locus::graph
