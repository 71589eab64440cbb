// The searches under the natural neighbours' weights: what each query steals, integer for integer.
#include "fields.hpp"
#include "graph/weights/lone.hpp"
#include "graph/weights/window.hpp"
#include "naive.hpp"

#include <gtest/gtest.h>

namespace locus::graph {
namespace {

// The voxels that may steal.
std::vector<uint64_t> queries_of(const Field &field) {
    std::vector<uint64_t> queries;
    for (uint64_t v = 0; v < field.grid().voxels(); ++v)
        if (field.reached(v) && field.distance(v) != 0)
            queries.push_back(v);
    return queries;
}

using Stolen = std::map<uint64_t, uint64_t>; // distances by voxel

Stolen expected(const Field &field, uint64_t query) {
    const auto stolen = naive::stolen(field, query);
    return {stolen.begin(), stolen.end()};
}

template <typename Word>
void expect_alone(const Field &field) {
    LoneSearch<Word> search(field);
    for (const uint64_t query : queries_of(field)) {
        ASSERT_TRUE(search.steal(query, uint64_t{1} << 30));
        Stolen stolen;
        for (const auto &each : search.stolen())
            ASSERT_TRUE(stolen.emplace(each.voxel, each.distance).second) << "query " << query;
        ASSERT_EQ(stolen, expected(field, query)) << "query " << query;
    }
}

// What one lane of a settled window says.
template <typename Word>
Stolen stolen_by(const Window<Word> &window, const Field &field, unsigned lane) {
    Stolen stolen;
    for (uint64_t v = 0; v < field.grid().voxels(); ++v) {
        const size_t local = window.local(field.grid().place(v));
        if ((window.stolen(local) >> lane & 1) != 0)
            stolen.emplace(v, window.reach(local)[lane]);
    }
    return stolen;
}

template <typename Word>
void expect_together(const Field &field, Simd simd) {
    const SettleKernels<Word> &kernels = settle_kernels(simd).of<Word>();
    const std::vector<uint64_t> queries = queries_of(field);
    Window<Word> window;
    window.open(field, field.grid().whole());
    for (size_t first = 0; first < queries.size(); first += batch_lanes) {
        const auto lanes = static_cast<unsigned>(std::min<size_t>(batch_lanes, queries.size() - first));
        for (unsigned lane = 0; lane < lanes; ++lane)
            window.start(window.local(field.grid().place(queries[first + lane])), lane);
        ASSERT_TRUE(window.settle(kernels));
        window.mark(kernels);
        for (unsigned lane = 0; lane < lanes; ++lane)
            ASSERT_EQ(stolen_by(window, field, lane), expected(field, queries[first + lane]))
                << simd_name(simd) << ", query " << queries[first + lane];
        window.restore(kernels);
    }
}

template <typename Word>
void expect_as_defined(const Field &field) {
    expect_alone<Word>(field);
    for (const Simd simd : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon})
        if (simd_available(simd))
            expect_together<Word>(field, simd);
}

void expect_as_defined(const Solved &solved) {
    solved.field().farthest() < far_away<uint32_t> ? expect_as_defined<uint32_t>(solved.field())
                                                   : expect_as_defined<uint64_t>(solved.field());
}

TEST(Search, NoiseWithHolesAndACut) {
    for (const auto &options : both_widths(options_for(9, 8, 7))) {
        Solved solved(options, noise(9 * 8 * 7, 41, 0.15), 4, 42);
        const std::vector<uint64_t> cut = {5, 100, 234, 300};
        const std::vector<uint16_t> masks(cut.size(), 0x1fff);
        solved.graph.cut_edges(cut, masks);
        solved.solve();
        expect_as_defined(solved);
    }
}

TEST(Search, OneMaterialWhereManyDistancesAreEqual) {
    for (const auto &options : both_widths(options_for(9, 8, 6)))
        expect_as_defined({options, std::vector<float>(9 * 8 * 6, 1), 3, 43});
}

} // namespace
} // namespace locus::graph
