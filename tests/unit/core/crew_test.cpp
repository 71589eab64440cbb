// Threads that stay for many loops.
#include "core/crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace {

TEST(Crew, RunsEveryPieceOfEveryLoopOnce) {
    for (const uint32_t threads : {0u, 1u, 2u, 5u}) {
        locus::Crew crew(threads);
        for (uint64_t count = 0; count < 300; ++count) {
            std::vector<int> seen(count); // plain: a piece is one thread's, and all is seen afterwards
            crew.for_each(count, 7, [&](uint64_t begin, uint64_t end) {
                EXPECT_LT(begin, end);
                EXPECT_LE(end - begin, 7u);
                for (; begin < end; ++begin)
                    ++seen[begin];
            });
            ASSERT_EQ(seen, std::vector<int>(count, 1)) << threads << " threads";
        }
    }
}

// The caller has its piece done at once, the helper takes its time.
TEST(Crew, WaitsForPiecesOfOthers) {
    locus::Crew crew(2);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> begun = 0, done = 0;
    crew.for_each(2, 1, [&](uint64_t, uint64_t) {
        ++begun;
        for (int i = 0; begun < 2 && i < 1000; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (std::this_thread::get_id() != caller)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        ++done;
    });
    EXPECT_EQ(done, 2);
}

} // namespace
