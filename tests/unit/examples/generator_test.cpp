// The simulated stream of the examples: what it promises about times, places, day and night, and bursts.
#include "common/generator.hpp"

#include "common/texts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <tuple>

namespace {

using namespace demo;

constexpr int64_t hour = 3'600'000'000;
constexpr int64_t day_start = 20533 * 24 * hour; // 2026-03-21

const World &world() {
    static const World loaded = load_world("examples/data");
    return loaded;
}

std::vector<locus_text156> all_of(Generator &generator, size_t batch) {
    std::vector<locus_text156> all, part;
    for (generator.next(part, batch); !part.empty(); generator.next(part, batch)) {
        EXPECT_LE(part.size(), batch);
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

GeneratorSettings settings(double posts, size_t events) { return {7, posts, day_start, 24 * hour, events}; }

TEST(Generator, TheSameSeedGivesTheSameStreamInAnyBatches) {
    Generator a(world(), settings(5000, 3)), b(world(), settings(5000, 3));
    const auto first = all_of(a, 1000), second = all_of(b, 7);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof first[0]), 0);
    GeneratorSettings other = settings(5000, 3);
    other.seed = 8;
    Generator c(world(), other);
    const auto third = all_of(c, 1000);
    EXPECT_NE(std::memcmp(first.data(), third.data(), std::min(first.size(), third.size()) * sizeof first[0]), 0);
}

TEST(Generator, PostsAreInOrderAndInRange) {
    Generator generator(world(), settings(100'000, 0));
    const auto posts = all_of(generator, 1000);
    EXPECT_NEAR(static_cast<double>(posts.size()), 1e5, 5 * std::sqrt(1e5));
    EXPECT_EQ(generator.fraction(), 1);
    int64_t last = day_start;
    for (const locus_text156 &post : posts) {
        const int64_t time = post.time; // a reference must not point at the member, which may lie at a multiple of 4
        ASSERT_GE(time, last);
        ASSERT_LT(time, day_start + 24 * hour);
        ASSERT_LE(std::fabs(post.latitude), 90);
        ASSERT_LE(std::fabs(post.longitude), 180);
        ASSERT_NE(post.text[0], '\0');
        last = time;
    }
}

// Around New York (UTC-5 by the sun) the evening is at 1 to 2 UTC, and the night's low at 9 UTC.
TEST(Generator, DayAndNightFollowTheSun) {
    Generator generator(world(), settings(400'000, 0));
    size_t evening = 0, night = 0;
    for (const locus_text156 &post : all_of(generator, 10'000)) {
        if (std::fabs(post.longitude + 74) > 3 || std::fabs(post.latitude - 40.7f) > 3)
            continue;
        const int64_t utc = (post.time - day_start) / hour;
        evening += utc == 1;
        night += utc == 9;
    }
    EXPECT_GT(evening, 50u);
    EXPECT_GT(evening, 5 * night);
    EXPECT_GT(activity(20.5), activity(13));
    EXPECT_GT(activity(8), activity(4));
}

TEST(Generator, EventSharesGrowToOne) {
    EXPECT_EQ(event_share(-1), 0);
    EXPECT_EQ(event_share(0), 0);
    EXPECT_NEAR(event_share(1), 1, 1e-12);
    EXPECT_EQ(event_share(2), event_share(1));
    for (int i = 0; i < 100; ++i)
        EXPECT_LT(event_share(i / 100.0), event_share((i + 1) / 100.0));
}

// A plain detector over cells of half a degree and ten minutes finds the planted bursts: those, and no others.
TEST(Generator, BurstsStandOutAndNothingElseDoes) {
    Generator generator(world(), settings(400'000, 12));
    ASSERT_EQ(generator.events().size(), 12u);
    using Cell = std::pair<int, int>;
    std::map<Cell, std::map<int64_t, double>> counts;
    const auto cell_of = [](double latitude, double longitude) {
        return Cell{static_cast<int>(std::floor(latitude * 2)), static_cast<int>(std::floor(longitude * 2))};
    };
    for (const locus_text156 &post : all_of(generator, 10'000))
        counts[cell_of(post.latitude, post.longitude)][(post.time - day_start) / (hour / 6)] += 1;
    std::set<const Place *> found;
    for (const auto &[cell, slots] : counts) {
        double usual = 0;
        for (const auto &[slot, count] : slots)
            usual += count / 144;
        for (const auto &[slot, count] : slots) {
            if (count < 25 + 4 * usual)
                continue;
            bool planted = false;
            for (const Event &event : generator.events()) {
                const int64_t from = (event.start - day_start) / (hour / 6);
                const int64_t to = (event.start + event.duration - day_start) / (hour / 6);
                const Cell home = cell_of(event.place->position.latitude, event.place->position.longitude);
                const bool here = std::abs(home.first - cell.first) <= 1 && std::abs(home.second - cell.second) <= 1;
                if (!here || slot < from || slot > to)
                    continue;
                planted = true;
                found.insert(event.place);
            }
            EXPECT_TRUE(planted) << count << " posts in cell " << cell.first << ' ' << cell.second << " at " << slot;
        }
    }
    EXPECT_EQ(found.size(), 12u);
}

TEST(Texts, AreCutAtACharacter) {
    Random random(1);
    for (size_t size = 1; size < 60; ++size) {
        std::string text(size, '?');
        write_event_post(text.data(), size, "RU", "Санкт-Петербург", 0, random);
        // The last character is whole: what follows its first byte is there.
        const size_t end = std::min(text.find('\0'), size);
        size_t start = end;
        while (start > 0 && (text[start - 1] & 0xc0) == 0x80)
            --start;
        if (start == end)
            continue;
        const auto lead = static_cast<unsigned char>(text[start - 1]);
        EXPECT_EQ(end - start + 1, lead >= 0xf0 ? 4u : lead >= 0xe0 ? 3u : 2u) << size;
    }
}

} // namespace
