// The explorer's cache: what is cheap is as new as the store, what is costly is made anew in the background.
#include "explorer/cache.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace explorer {
namespace {

using Texts = Cache<std::string>;

void burn(std::chrono::milliseconds time) {
    for (const auto begin = thread_time(); thread_time() - begin < time;)
        ;
}

struct Fixture : testing::Test {
    // The answer to `key` as of `version`; making it takes so long.
    Texts::Found ask(const std::string &key, uint64_t version, std::chrono::milliseconds cost = {}) {
        return cache.get(key, version, [this, key, version, cost] {
            burn(cost);
            ++made;
            return Texts::Made{key + std::to_string(version), version};
        });
    }

    std::atomic<int> made{0};
    Texts cache{2, renewer, std::chrono::hours(1)};
    Renewer renewer; // ends first
};

using CacheTest = Fixture;

TEST_F(CacheTest, CheapAnswersAreAsNewAsTheStore) {
    for (uint64_t version = 1; version <= 50; ++version)
        for (int time = 0; time < 2; ++time) {
            const auto found = ask("a", version);
            EXPECT_EQ(*found.value, "a" + std::to_string(version));
            EXPECT_EQ(found.version, version);
        }
    EXPECT_EQ(made, 50);
}

TEST_F(CacheTest, CostlyAnswersAreRenewedInTheBackground) {
    constexpr auto cost = std::chrono::milliseconds(10);
    EXPECT_EQ(ask("a", 1, cost).version, 1u);
    EXPECT_EQ(ask("a", 2, cost).version, 1u);
    uint64_t version = 1, asked = 2;
    while (version == 1) {
        const auto found = ask("a", ++asked, cost);
        EXPECT_EQ(*found.value, "a" + std::to_string(found.version)); // it tells of the version that it names
        EXPECT_LE(found.version, asked);
        EXPECT_GE(found.version, version);
        version = found.version;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_LT(made, static_cast<int>(asked));
}

TEST_F(CacheTest, TheOneUsedLongestAgoIsForgotten) {
    ask("a", 1), ask("b", 1), ask("a", 1), ask("c", 1);
    EXPECT_EQ(made, 3);
    ask("a", 1);
    EXPECT_EQ(made, 3);
    ask("b", 1);
    EXPECT_EQ(made, 4);
}

TEST_F(CacheTest, AFailureIsTheCallersAndNothingIsKept) {
    const auto fails = []() -> Texts::Made { throw std::runtime_error("no"); };
    EXPECT_THROW(cache.get("a", 1, fails), std::runtime_error);
    EXPECT_EQ(*ask("a", 1).value, "a1");
    EXPECT_THROW(cache.get("a", 2, fails), std::runtime_error);
    EXPECT_EQ(*ask("a", 2).value, "a2");
}

TEST(RenewerTest, DoesJobsInOrderAndDropsTheRestAtTheEnd) {
    std::vector<int> done;
    std::atomic<bool> first{false};
    {
        Renewer renewer;
        for (int i = 0; i < 3; ++i)
            renewer.add([&done, &first, i] {
                done.push_back(i);
                first = true;
            });
        while (!first)
            std::this_thread::yield();
    }
    for (size_t i = 0; i < done.size(); ++i)
        EXPECT_EQ(done[i], static_cast<int>(i));
    EXPECT_LE(done.size(), 3u);
}

} // namespace
} // namespace explorer
