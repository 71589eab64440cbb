// The launcher that runs the threads of a block at the same time: phases come one after the other as on a GPU, and it
// sees when threads come to different barriers.
#include "tests/emulated/lanes.hpp"

#include <gtest/gtest.h>

namespace {

using locus::device::emulated::run_lanes;

constexpr unsigned size = 64;

struct Sum {
    static constexpr unsigned threads = size;
    struct Shared {
        unsigned value[size];
    };
    struct Local {
        unsigned own;
    };
    unsigned *sums; // by thread

    template <typename Block>
    void operator()(Block &block) const {
        auto &s = block.shared;
        block.each([&](unsigned thread, Local &local) { s.value[thread] = local.own = thread; });
        for (unsigned step = 1; step < threads; step *= 2) {
            block.each([&](unsigned thread, Local &local) { local.own += s.value[(thread + step) % threads]; });
            block.each([&](unsigned thread, Local &local) { s.value[thread] = local.own; });
        }
        block.each([&](unsigned thread, Local &local) { sums[thread] = local.own + 100 * unsigned(block.index()); });
    }
};

// Lanes from `leaves` on leave the body early; those from `elsewhere` on wait at another barrier.
struct Apart {
    static constexpr unsigned threads = size;
    struct Shared {};
    struct Local {};
    unsigned leaves, elsewhere;

    template <typename Block>
    void operator()(Block &block) const {
        block.each([](unsigned, Local &) {});
        if (block.number() >= leaves)
            return;
        if (block.number() >= elsewhere)
            block.each([](unsigned, Local &) {});
        else
            block.each([](unsigned, Local &) {});
        block.each([](unsigned, Local &) {});
    }
};

TEST(CudaLanes, RunPhasesOneAfterTheOther) {
    for (const unsigned lanes : {1u, 2u, 7u, size})
        for (uint64_t index = 0; index < 3; ++index) {
            std::vector<unsigned> sums(size);
            EXPECT_TRUE(run_lanes(Sum{sums.data()}, index, lanes, lanes + index));
            EXPECT_EQ(sums, std::vector<unsigned>(size, size * (size - 1) / 2 + 100 * unsigned(index)));
        }
}

TEST(CudaLanes, SeeThreadsAtDifferentBarriers) {
    constexpr unsigned lanes = 6;
    const auto together = [](unsigned leaves, unsigned elsewhere) {
        return run_lanes(Apart{leaves, elsewhere}, 0, lanes, 1);
    };
    EXPECT_TRUE(together(lanes, lanes));
    EXPECT_TRUE(together(0, lanes));
    EXPECT_TRUE(together(lanes, 0));
    EXPECT_FALSE(together(lanes - 1, lanes));
    EXPECT_FALSE(together(1, lanes));
    EXPECT_FALSE(together(lanes, 1));
    EXPECT_FALSE(together(lanes, lanes - 1));
}

} // namespace
