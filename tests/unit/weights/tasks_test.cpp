// Which tasks a team of threads gets, in which order, and what happens to those that are given back.
#include "graph/weights/tasks.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <map>

namespace locus::graph {
namespace {

TEST(Tasks, AThreadStaysInAGroupAndBeginsTheLargestThatIsNotBegun) {
    Progress progress;
    const size_t sizes[] = {2, 3, 0, 2};
    Tasks tasks(sizes, 7, progress);
    const auto take = [&](std::optional<size_t> last) {
        const auto task = tasks.take(last);
        return task ? std::pair(task->group, task->number) : std::pair(size_t{9}, size_t{9});
    };
    using Pair = std::pair<size_t, size_t>;
    EXPECT_EQ(take(std::nullopt), Pair(1, 0));
    EXPECT_EQ(take(std::nullopt), Pair(0, 0)); // another thread: of the groups not begun the first of the largest
    EXPECT_EQ(take(0), Pair(0, 1));
    EXPECT_EQ(take(0), Pair(3, 0));
    EXPECT_EQ(take(3), Pair(3, 1));
    EXPECT_EQ(take(3), Pair(1, 1)); // all are begun: help with what has the most left
    EXPECT_EQ(take(1), Pair(1, 2));
    EXPECT_EQ(take(1), Pair(9, 9));
}

TEST(Tasks, EachIsDoneOnceAndWhatIsTooLargeByFewerThreads) {
    Progress progress;
    const size_t sizes[] = {5, 1, 17};
    Tasks tasks(sizes, 23, progress);
    std::map<std::pair<size_t, size_t>, int> done;
    std::mutex mutex;
    uint64_t largest_share = 0;
    tasks.run(4, 400, [&](uint32_t, uint64_t bytes) {
        while (const auto task = tasks.take(std::nullopt)) {
            const uint64_t needed = 40 + 13 * task->number; // up to 248
            if (needed > bytes) {
                tasks.give_back(*task, needed);
                continue;
            }
            const std::lock_guard lock(mutex);
            ++done[{task->group, task->number}];
            largest_share = std::max(largest_share, bytes);
        }
    });
    EXPECT_EQ(largest_share, 400u);
    EXPECT_EQ(done.size(), 23u);
    for (const auto &[task, times] : done)
        EXPECT_EQ(times, 1) << task.first << ", " << task.second;
}

TEST(Tasks, TooLargeForAllIsAnError) {
    Progress progress;
    const size_t sizes[] = {2};
    Tasks tasks(sizes, 2, progress);
    try {
        tasks.run(2, 100, [&](uint32_t, uint64_t) {
            while (const auto task = tasks.take(0))
                tasks.give_back(*task, 101 + task->number);
        });
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), LOCUS_E_MEMORY);
        EXPECT_NE(std::string(error.what()).find("102"), std::string::npos);
    }
}

} // namespace
} // namespace locus::graph
