// Teams of threads.
#include "core/team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

namespace {

TEST(Team, RunsEveryRankOnce) {
    for (const uint32_t threads : {0u, 1u, 2u, 7u}) {
        std::vector<std::atomic<int>> ran(8);
        locus::run_team(threads, [&](uint32_t rank) { ++ran[rank]; });
        for (uint32_t rank = 0; rank < 8; ++rank)
            EXPECT_EQ(ran[rank], rank < std::max(threads, 1u) ? 1 : 0);
    }
}

TEST(Team, HandsTheLowestRanksExceptionOn) {
    std::atomic<int> ran{0};
    try {
        locus::run_team(4, [&](uint32_t rank) {
            ++ran;
            if (rank >= 2)
                throw std::runtime_error(std::to_string(rank));
        });
        FAIL();
    } catch (const std::runtime_error &error) {
        EXPECT_STREQ(error.what(), "2");
    }
    EXPECT_EQ(ran, 4);
}

TEST(Team, SplitsALoopIntoPieces) {
    for (const uint64_t count : {0u, 1u, 99u, 100u, 101u}) {
        std::vector<std::atomic<int>> seen(count);
        locus::parallel_for(3, count, 10, [&](uint64_t begin, uint64_t end) {
            EXPECT_LE(end - begin, 10u);
            for (uint64_t i = begin; i < end; ++i)
                ++seen[i];
        });
        for (const auto &times : seen)
            EXPECT_EQ(times, 1);
    }
}

#ifdef __linux__
TEST(Team, ThreadsMayRunWhereTheirCallerMay) {
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    for (int run = 0; run < 20; ++run)
        locus::run_team(3, [&](uint32_t rank) {
            cpu_set_t now;
            ASSERT_EQ(sched_getaffinity(0, sizeof now, &now), 0);
            EXPECT_TRUE(CPU_EQUAL(&now, &before)) << rank;
        });
    cpu_set_t after;
    ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
    EXPECT_TRUE(CPU_EQUAL(&after, &before));
}
#endif

} // namespace
