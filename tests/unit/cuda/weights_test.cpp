// Sibson's rows by the emulated device against those of the CPU.
#include "graph/device/weights.hpp"
#include "tests/emulated/device.hpp"
#include "tests/unit/weights/fields.hpp"

#include <locus/weights.h>

#include <gtest/gtest.h>

#include <numeric>

namespace locus::graph {
namespace {

namespace emulated = device::emulated;

void expect_cpus_rows(const Solved &solved, const std::vector<uint64_t> &voxels, uint32_t most = 0,
                      uint64_t bytes = uint64_t{1} << 30) {
    Progress progress;
    const Field field = solved.field();
    const NaturalJob job{field, LOCUS_METHOD_SIBSON, most, bytes, 1, Simd::scalar, voxels, {}};
    const Rows expected = assemble(voxels.size(), natural_rows(job, progress));
    ++emulated::settings().seed;
    device::Device device(emulated::table());
    const Rows rows = assemble(voxels.size(), device::sibson_rows(device, job, progress));
    for (uint64_t i = 0; i < voxels.size(); ++i)
        ASSERT_TRUE(std::ranges::equal(rows.row(i), expected.row(i))) << "voxel " << voxels[i];
}

std::vector<uint64_t> every(const Solved &solved, uint64_t step) {
    std::vector<uint64_t> voxels;
    for (uint64_t v = 0; v < solved.graph.grid().voxels(); v += step)
        voxels.push_back(v);
    return voxels;
}

TEST(CudaSibson, GivesTheCpusRowsForEveryRuleAndWord) {
    uint32_t seed = 0;
    for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule)
        for (const uint32_t word : {32u, 64u}) {
            auto options = options_for(15, 11, 9);
            options.weight_rule = rule;
            options.word_bits = word;
            options.max_seeds = 64;
            options.precision = 1.0 / 32;
            options.connectivity = ++seed % 3 == 0 ? 6 : seed % 3 == 1 ? 18 : 26;
            if (seed % 2 == 0)
                options.spacing[0] = 1.6;
            const Solved solved(options, noise(15 * 11 * 9, seed, 0.2), 7, seed);
            expect_cpus_rows(solved, every(solved, 2));
            expect_cpus_rows(solved, every(solved, 7), 2);
        }
}

TEST(CudaSibson, WidensWindowsThatAreTooSmall) {
    const Solved solved(options_for(60, 20, 6), noise(60 * 20 * 6, 3), 2, 5);
    expect_cpus_rows(solved, every(solved, 97));
    expect_cpus_rows(solved, every(solved, 97), 0, 1 << 22);
}

// Windows in shared memory of several sizes, and in scratch memory; tables of labels that are too small.
TEST(CudaSibson, HoldsWindowsWhereTheyFit) {
    const emulated::KeepSettings keep;
    for (const uint32_t word : {32u, 64u}) {
        auto options = options_for(24, 17, 9);
        options.word_bits = word;
        options.max_seeds = 2000;
        options.precision = 1.0 / 16;
        const Solved few(options, noise(24 * 17 * 9, 3, 0.1), 3, 5), many(options, noise(24 * 17 * 9, 4), 1500, 6);
        for (const uint64_t memory : {0u, 9000u, 12000u, 20000u, 40000u, 100000u}) {
            emulated::settings().block_memory = memory;
            expect_cpus_rows(few, every(few, 53));
            expect_cpus_rows(many, every(many, 53), 3);
        }
    }
}

// Seeds all over the faces of a cube around the queries.
TEST(CudaSibson, StealsFromMoreSeedsThanItsFirstTableHolds) {
    auto options = options_for(25, 25, 25);
    options.weight_rule = LOCUS_WEIGHT_UNIFORM;
    options.precision = 1.0 / 64;
    Solved solved(options, std::vector<float>(25 * 25 * 25, 1.0f), 1, 1);
    solved.sources.clear();
    for (uint64_t v = 0; v < solved.graph.grid().voxels(); ++v) {
        const auto at = solved.graph.grid().place(v);
        uint64_t far = 0;
        for (const uint64_t each : at)
            far = std::max(far, each > 12 ? each - 12 : 12 - each);
        if (far == 12)
            solved.sources.push_back({v, 0, static_cast<uint32_t>(solved.sources.size())});
    }
    solved.solve();
    const uint64_t middle = solved.graph.grid().index(12, 12, 12);
    Progress progress;
    const Field field = solved.field();
    const std::vector<uint64_t> voxels = {middle, middle + 1};
    const NaturalJob job{field, LOCUS_METHOD_SIBSON, 0, 1 << 30, 1, Simd::scalar, voxels, {}};
    EXPECT_GT(assemble(2, natural_rows(job, progress)).row(0).size(), 256u);
    expect_cpus_rows(solved, voxels);
    expect_cpus_rows(solved, voxels, 300);
}

TEST(CudaSibson, KeepsToCutEdgesAndToWhatWasReached) {
    Solved solved(options_for(14, 13, 12), noise(14 * 13 * 12, 8, 0.3), 5, 9);
    std::vector<uint64_t> voxels;
    std::vector<uint16_t> masks;
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
        voxels.push_back(random() % solved.graph.grid().voxels());
        masks.push_back(static_cast<uint16_t>(random() & 0x1FFF));
    }
    solved.graph.cut_edges(voxels, masks);
    solved.solve(12 * solved.graph.smallest_weight());
    expect_cpus_rows(solved, every(solved, 1));
}

TEST(CudaSibson, RunsQueriesAtTheSameTime) {
    emulated::settings().threads = 3;
    const Solved solved(options_for(20, 16, 10), noise(20 * 16 * 10, 6), 9, 4);
    expect_cpus_rows(solved, every(solved, 5));
    emulated::settings().threads = 1;
}

TEST(CudaSibson, RunsThreadsAtTheSameTime) {
    const emulated::KeepSettings keep;
    emulated::settings().lanes = 5;
    emulated::settings().threads = emulated::settings().blocks = 2;
    const Solved solved(options_for(12, 9, 5), noise(12 * 9 * 5, 6, 0.1), 5, 4);
    expect_cpus_rows(solved, every(solved, 45));
}

TEST(CudaSibson, SaysThatItsMemoryDoesNotSuffice) {
    const Solved solved(options_for(60, 60, 60), std::vector<float>(216000, 1.0f), 2, 5);
    Progress progress;
    const Field field = solved.field();
    const std::vector<uint64_t> voxels = {0, 12345};
    const NaturalJob job{field, LOCUS_METHOD_SIBSON, 0, 4096, 1, Simd::scalar, voxels, {}};
    device::Device device(emulated::table());
    try {
        device::sibson_rows(device, job, progress);
        FAIL() << "it sufficed";
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), LOCUS_E_MEMORY);
        EXPECT_NE(std::string(error.what()).find("batch_bytes is 4096"), std::string::npos);
    }
}

TEST(CudaSibson, LeavesTheDeviceEmptyAfterAnyFailure) {
    const Solved solved(options_for(12, 10, 8), noise(960, 3), 4, 5);
    Progress progress;
    const Field field = solved.field();
    const auto voxels = every(solved, 50);
    const NaturalJob job{field, LOCUS_METHOD_SIBSON, 0, 1 << 20, 1, Simd::scalar, voxels, {}};
    bool failed = true;
    for (int64_t calls = 1; failed; ++calls) {
        device::Device device(emulated::table());
        emulated::settings().calls_left = calls;
        failed = false;
        try {
            device::sibson_rows(device, job, progress);
        } catch (const Error &error) {
            failed = true;
            EXPECT_EQ(error.status(), emulated::settings().failure);
        }
        emulated::settings().calls_left = -1;
        EXPECT_EQ(emulated::counters().allocated, 0u);
    }
}

} // namespace
} // namespace locus::graph
