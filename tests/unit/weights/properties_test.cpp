// What the weights must be whatever the material, and Sibson's on uniform material against Euclidean space.
#include "fields.hpp"
#include "graph/weights/natural.hpp"
#include "graph/weights/ratio.hpp"
#include "naive.hpp"

#include <locus/weights.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace locus::graph {
namespace {

constexpr uint32_t all_methods[] = {LOCUS_METHOD_SIBSON, LOCUS_METHOD_LAPLACE, LOCUS_METHOD_DISTANCE_RATIO};

Rows rows_of(const Solved &solved, uint32_t method, const std::vector<uint64_t> &voxels) {
    Progress progress;
    const uint64_t bytes = uint64_t{1} << 30;
    if (method == LOCUS_METHOD_DISTANCE_RATIO) {
        const Field field = solved.field();
        const std::vector<Cell> cells = survey_cells(field);
        return ratio_rows(ratio_parts({field, cells, solved.sources, bytes, 2, simd_best(), voxels}, progress), 0);
    }
    return assemble(voxels.size(),
                    natural_rows({solved.field(), method, 0, bytes, 2, simd_best(), voxels, {}}, progress));
}

Rows rows_of(const Solved &solved, uint32_t method) {
    std::vector<uint64_t> voxels(solved.graph.grid().voxels());
    std::iota(voxels.begin(), voxels.end(), 0);
    return rows_of(solved, method, voxels);
}

double weight_in(std::span<const Share> row, uint32_t label) {
    const auto share = std::ranges::find(row, label, &Share::label);
    return share == row.end() ? 0 : double{share->weight};
}

TEST(Properties, RowsArePartitionsOfUnityByFallingWeight) {
    const Solved solved(options_for(19, 13, 8), noise(19 * 13 * 8, 21, 0.25), 9, 22);
    for (const uint32_t method : all_methods) {
        const Rows rows = rows_of(solved, method);
        for (uint64_t v = 0; v < solved.graph.grid().voxels(); ++v) {
            double sum = 0, last = 1;
            for (const Share &share : rows.row(v)) {
                ASSERT_GT(share.weight, 0) << "method " << method << ", voxel " << v;
                ASSERT_LE(double{share.weight}, last) << "method " << method << ", voxel " << v;
                last = double{share.weight};
                sum += last;
            }
            ASSERT_NEAR(sum, solved.field().reached(v) ? 1 : 0, 1e-6) << "method " << method << ", voxel " << v;
        }
    }
}

TEST(Properties, TheRowOfANodeIsItsSeedAlone) {
    const Solved solved(options_for(19, 13, 8), noise(19 * 13 * 8, 23), 9, 24);
    for (const uint32_t method : all_methods) {
        const Rows rows = rows_of(solved, method);
        for (const Source &seed : solved.sources) {
            ASSERT_EQ(rows.row(seed.voxel).size(), 1) << "method " << method << ", seed " << seed.label;
            ASSERT_EQ(rows.row(seed.voxel)[0], (Share{seed.label, 1})) << "method " << method;
        }
    }
}

// On the line between two seeds the two ratios add up to 1 before they are normalised, so the rows show them as they
// are: 1 at the node, falling evenly, and 1/2 on the frontier. With a third seed they do not, and the formulas
// themselves, the oracle of the rows, have to say 1/2.
TEST(Properties, TheDistanceRatioIsOneHalfOnTheFrontier) {
    Solved solved(options_for(21, 5, 1), std::vector<float>(21 * 5, 1), 0, 0);
    const auto voxel = [](uint64_t x, uint64_t y) { return x + 21 * y; };
    solved.sources = {{voxel(2, 2), 0, 0}, {voxel(18, 2), 0, 1}};
    solved.solve();
    const Rows rows = rows_of(solved, LOCUS_METHOD_DISTANCE_RATIO);
    for (uint64_t x = 2; x <= 18; ++x) {
        const double expected = 1 - (static_cast<double>(x) - 2) / 16;
        ASSERT_NEAR(weight_in(rows.row(voxel(x, 2)), 0), expected, 1e-6) << "x " << x;
        ASSERT_NEAR(weight_in(rows.row(voxel(x, 2)), 1), 1 - expected, 1e-6) << "x " << x;
    }

    Solved three(options_for(21, 12, 1), std::vector<float>(21 * 12, 1), 0, 0);
    three.sources = {{voxel(2, 2), 0, 0}, {voxel(10, 2), 0, 1}, {voxel(6, 9), 0, 2}};
    three.solve();
    const auto raw = naive::ratio(three.field(), three.sources)[voxel(6, 2)];
    ASSERT_DOUBLE_EQ(raw.at(0), 0.5);
    ASSERT_DOUBLE_EQ(raw.at(1), 0.5);
    ASSERT_GT(raw.at(2), 0);
    const Rows of_three = rows_of(three, LOCUS_METHOD_DISTANCE_RATIO, {voxel(6, 2)});
    ASSERT_NEAR(weight_in(of_three.row(0), 0), 0.5 / (1 + raw.at(2)), 1e-6);
}

// Sibson's weights in Euclidean space, by counting voxels, and between which bounds those of a metric d with
// dE <= d <= most * dE must lie.
struct Euclidean {
    std::vector<double> weights, low, high;
};

double euclidean(const Graph &graph, uint64_t a, uint64_t b) {
    const auto [ax, ay, az] = graph.grid().place(a);
    const auto [bx, by, bz] = graph.grid().place(b);
    const auto apart = [](uint64_t i, uint64_t k) { return static_cast<double>(i) - static_cast<double>(k); };
    return std::hypot(apart(ax, bx), apart(ay, by), apart(az, bz));
}

// A voxel v is surely stolen by q where most * dE(q, v) < DE(v), as then d(q, v) < D(v), and surely not where
// dE(q, v) >= most * DE(v); and its label may be that of any seed within most * DE(v). So the count of every seed lies
// between its sure and its possible voxels.
Euclidean euclidean_sibson(const Solved &solved, uint64_t query, double most) {
    const size_t seeds = solved.sources.size();
    std::vector<double> count(seeds), sure(seeds), possible(seeds), far(seeds);
    for (uint64_t v = 0; v < solved.graph.grid().voxels(); ++v) {
        for (size_t i = 0; i < seeds; ++i)
            far[i] = euclidean(solved.graph, solved.sources[i].voxel, v);
        const size_t nearest = static_cast<size_t>(std::ranges::min_element(far) - far.begin());
        const double to_query = euclidean(solved.graph, query, v);
        if (to_query >= most * far[nearest])
            continue;
        count[nearest] += to_query < far[nearest] ? 1 : 0;
        const auto rivals = std::ranges::count_if(far, [&](double d) { return d <= most * far[nearest]; });
        sure[nearest] += rivals == 1 && most * to_query < far[nearest] ? 1 : 0;
        for (size_t i = 0; i < seeds; ++i)
            possible[i] += far[i] <= most * far[nearest] ? 1 : 0;
    }
    const double all = std::reduce(count.begin(), count.end()), all_sure = std::reduce(sure.begin(), sure.end()),
                 all_possible = std::reduce(possible.begin(), possible.end());
    Euclidean result;
    for (size_t i = 0; i < seeds; ++i) {
        result.weights.push_back(count[i] / all);
        result.low.push_back(sure[i] / std::max(1.0, sure[i] + all_possible - possible[i]));
        result.high.push_back(possible[i] / std::max(1.0, possible[i] + all_sure - sure[i]));
    }
    return result;
}

// The 26-neighbour distance of (a >= b >= c) is a + (sqrt 2 - 1) b + (sqrt 3 - sqrt 2) c: at least Euclid's and, by
// Cauchy and Schwarz, at most 1.128 times that (the length of the factors). That bounds every single weight, if loosely
// (a voxel's rivals may all gain or all lose); on the whole the errors cancel, and the mean difference, 0.0065 here,
// must stay below 0.015.
TEST(Properties, SibsonOnUniformMaterialIsNearEuclids) {
    const Solved solved(options_for(22, 20, 18), std::vector<float>(22 * 20 * 18, 1), 8, 25);
    const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0), rounding = 1.0 / 256;
    const double most = std::hypot(1, root2 - 1, root3 - root2) * (1 + rounding) / (1 - rounding);
    std::vector<uint64_t> queries;
    std::mt19937 random(26);
    while (queries.size() < 60)
        if (const uint64_t voxel = random() % solved.graph.grid().voxels(); solved.field().distance(voxel) > 0)
            queries.push_back(voxel);
    const Rows rows = rows_of(solved, LOCUS_METHOD_SIBSON, queries);
    double difference = 0, width = 0;
    for (size_t q = 0; q < queries.size(); ++q) {
        const Euclidean expected = euclidean_sibson(solved, queries[q], most);
        for (uint32_t i = 0; i < solved.sources.size(); ++i) {
            const double weight = weight_in(rows.row(q), i);
            ASSERT_GE(weight, expected.low[i] - 1e-6) << "query " << queries[q] << ", seed " << i;
            ASSERT_LE(weight, expected.high[i] + 1e-6) << "query " << queries[q] << ", seed " << i;
            difference += std::abs(weight - expected.weights[i]);
            width += expected.high[i] - expected.low[i];
        }
    }
    const double numbers = static_cast<double>(queries.size() * solved.sources.size());
    EXPECT_LT(difference / numbers, 0.015);
    RecordProperty("mean_difference", std::to_string(difference / numbers));
    RecordProperty("mean_width", std::to_string(width / numbers));
}

} // namespace
} // namespace locus::graph
