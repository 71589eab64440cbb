// The default alerts find the bursts that the demo's generator plants: those, and no others.
#include "common/generator.hpp"
#include "stream/alerts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace demo {
namespace {

constexpr int64_t hour = 3'600'000'000;
constexpr int64_t start = int64_t{20533} * 24 * hour; // 2026-03-21

struct Stream {
    uint64_t seed;
    double posts;
    size_t events;
    size_t batch;
    int64_t until; // of its day
};

Position centre(const locus_alert &alert) {
    return {(alert.box.south + alert.box.north) / 2, (alert.box.west + alert.box.east) / 2};
}

void expect_the_planted(const Stream &stream) {
    SCOPED_TRACE("seed " + std::to_string(stream.seed) + ", " + std::to_string(stream.posts) + " posts");
    const World world = load_world("examples/data");
    Generator generator(world, {stream.seed, stream.posts, start, 24 * hour, stream.events});
    Window window(6 * hour);
    const Watch watch(window);
    std::vector<locus_text156> batch;
    for (generator.next(batch, stream.batch); !batch.empty() && window.clock() < start + stream.until;
         generator.next(batch, stream.batch))
        window.insert(batch);
    const std::vector<locus_alert> &found = watch.found();
    for (const Event &event : generator.events()) {
        if (event.start + event.duration > start + stream.until)
            continue;
        EXPECT_EQ(std::count_if(found.begin(), found.end(), [&](const locus_alert &a) { return tells_of(a, event); }),
                  1)
            << event.place->name << ", " << event.posts << " posts from hour "
            << static_cast<double>(event.start - start) / hour << " for " << static_cast<double>(event.duration) / hour;
    }
    for (const locus_alert &alert : found) {
        EXPECT_TRUE(std::any_of(generator.events().begin(), generator.events().end(),
                                [&](const Event &event) { return tells_of(alert, event); }))
            << "no burst: " << alert.zoom << "/" << alert.x << "/" << alert.y << " at " << centre(alert).latitude
            << ", " << centre(alert).longitude << ", hour " << static_cast<double>(alert.time - start) / hour << ", "
            << alert.records << " records, rate " << alert.rate << " instead of " << alert.expected;
        EXPECT_EQ(alert.kind, static_cast<uint32_t>(LOCUS_ALERT_JUMP));
    }
}

// The demo's stream, and of its day a quarter.
TEST(Alerts, FindThePlantedBurstsAndNoOthers) {
    for (uint64_t seed = 1; seed <= 4; ++seed)
        expect_the_planted({seed, 2e6, 12, 1000, 6 * hour});
}

} // namespace
} // namespace demo
