// Threads that stay for many loops.
#include "core/crew.hpp"

#include <gtest/gtest.h>

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

} // namespace
