// Alerts on streams made by hand: what stands out is told once, and nothing else is.
#include "core/zcurve.hpp"
#include "tests/unit/pmq/tracked_store.hpp"

#include <locus/alerts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace locus::test {
namespace {

constexpr int64_t second = 1'000'000, minute = 60 * second, hour = 60 * minute;

locus_alerts_options default_alerts() {
    locus_alerts_options options;
    EXPECT_EQ(locus_alerts_options_init(&options, sizeof options), LOCUS_OK);
    return options;
}

// Batches of ten seconds: a number of records a minute at each of some places, as regular as chance allows.
class Stream {
public:
    struct Source {
        double latitude, longitude, spread; // degrees
        double per_minute;
    };

    explicit Stream(locus_alerts_options options, const LayoutChoice &layout = layouts[0]) : random(5) {
        locus_pmq_options store = default_options();
        layout.apply(store);
        store.horizon = 2 * hour;
        EXPECT_EQ(locus_pmq_create(&store, &pmq), LOCUS_OK);
        options.alert = [](const locus_alert *alert, void *user) {
            auto &self = *static_cast<Stream *>(user);
            self.found.push_back(*alert);
            return self.answer;
        };
        options.alert_user = this;
        EXPECT_EQ(locus_alerts_create(pmq, &options, &alerts), LOCUS_OK) << locus_last_error();
    }
    ~Stream() {
        locus_alerts_destroy(alerts);
        locus_pmq_destroy(pmq);
    }
    Stream(const Stream &) = delete;
    Stream &operator=(const Stream &) = delete;

    locus_status run(int64_t duration, const std::vector<Source> &sources, int64_t late = 0) {
        locus_status worst = LOCUS_OK;
        for (const int64_t end = now + duration; now < end;) {
            std::vector<locus_point32> batch;
            for (const Source &source : sources) {
                std::normal_distribution<double> away(0, source.spread);
                for (int n = std::poisson_distribution<int>(source.per_minute / 6)(random); n > 0; --n)
                    batch.push_back({source.latitude + away(random), source.longitude + away(random),
                                     now - late + std::uniform_int_distribution<int64_t>(0, 10 * second - 1)(random), 0,
                                     0, 0, 0});
            }
            now += 10 * second;
            worst = std::max(worst, locus_pmq_insert(pmq, batch.data(), batch.size(), now));
        }
        return worst;
    }

    std::vector<locus_alert> active() const {
        std::vector<locus_alert> list(256);
        size_t count = 0;
        EXPECT_EQ(locus_alerts_active(alerts, list.data(), list.size(), &count), LOCUS_OK);
        list.resize(count);
        return list;
    }

    std::mt19937_64 random;
    int64_t now = 1000 * hour;
    locus_pmq *pmq = nullptr;
    locus_alerts *alerts = nullptr;
    std::vector<locus_alert> found;
    int32_t answer = 0;
};

bool holds(const locus_alert &alert, double latitude, double longitude) {
    return in_box(alert.box, {latitude, longitude, 0, 0, 0});
}

const std::vector<Stream::Source> usual = {
    {48.8, 2.3, 0.1, 60}, {51.5, -0.1, 0.1, 80}, {40.4, -3.7, 0.1, 40}, {41.9, 12.5, 0.2, 30}, {52.5, 13.4, 0.1, 50}};

std::vector<Stream::Source> with(std::vector<Stream::Source> sources, const Stream::Source &more) {
    sources.push_back(more);
    return sources;
}

TEST(Alerts, ABurstIsToldOnceWithItsRegion) {
    for (const LayoutChoice &layout : layouts) {
        Stream stream(default_alerts(), layout);
        stream.run(2 * hour, usual);
        EXPECT_TRUE(stream.found.empty()) << "a steady stream";
        const int64_t begin = stream.now;
        stream.run(20 * minute, with(usual, {45.76, 4.84, 0.005, 30}));
        ASSERT_EQ(stream.found.size(), 1u);
        const locus_alert &alert = stream.found[0];
        EXPECT_EQ(alert.number, 1u);
        EXPECT_EQ(alert.kind, 0u);
        EXPECT_EQ(alert.zoom, 12u);
        EXPECT_TRUE(holds(alert, 45.76, 4.84));
        EXPECT_EQ(Quadrant::of_tile(12, alert.x, alert.y).code, key_of(45.76, 4.84) >> 26);
        EXPECT_EQ(alert.box.west, map_longitude(alert.x, 12));
        EXPECT_EQ(alert.box.north, map_latitude(alert.y, 12));
        EXPECT_GT(alert.time, begin);
        EXPECT_LE(alert.time, begin + 2 * minute);
        EXPECT_GE(alert.records, 20);
        EXPECT_NEAR(alert.rate, alert.records / (300 / std::log(2)), 1e-9);
        EXPECT_LT(alert.expected * 4, alert.rate);
        const auto active = stream.active();
        ASSERT_EQ(active.size(), 1u);
        EXPECT_EQ(active[0].number, 1u);
        EXPECT_GT(active[0].records, 100) << "the numbers of the latest batch";
        stream.run(2 * hour, usual);
        EXPECT_TRUE(stream.active().empty());
        EXPECT_EQ(stream.found.size(), 1u);
        stream.run(10 * minute, with(usual, {45.76, 4.84, 0.005, 30}));
        EXPECT_EQ(stream.found.size(), 2u) << "another one, after the first has cooled down";
    }
}

TEST(Alerts, WhatLiesOnASeamIsOne) {
    const double north = map_latitude(1440, 12), west = map_longitude(2074, 12); // the seam of four tiles of zoom 12
    for (const auto &[latitude, longitude] : {std::pair{0.0, 0.0}, {north, west}, {-12.0, 180.0}, {50.0, 0.0}}) {
        Stream stream(default_alerts());
        stream.run(hour, usual);
        const double spread = 0.01, there = longitude == 180 ? 179.999 : longitude;
        std::vector<Stream::Source> sources = with(usual, {latitude, there - 0.01, spread, 60});
        sources.push_back({latitude, longitude == 180 ? -179.99 : longitude + 0.01, spread, 60});
        if (longitude == 180) // stay on the map
            sources[sources.size() - 2] = {latitude, 179.99, 0.001, 60}, sources.back().spread = 0.001;
        stream.run(25 * minute, sources);
        EXPECT_EQ(stream.found.size(), 1u) << latitude << ", " << longitude;
    }
}

TEST(Alerts, BurstsApartAreToldApart) {
    Stream stream(default_alerts());
    stream.run(hour, usual);
    stream.run(20 * minute, with(with(usual, {45.76, 4.84, 0.005, 40}), {45.44, 4.39, 0.005, 40})); // 50 km
    ASSERT_EQ(stream.found.size(), 2u);
    EXPECT_TRUE(holds(stream.found[0], 45.76, 4.84) || holds(stream.found[1], 45.76, 4.84));
    EXPECT_TRUE(holds(stream.found[0], 45.44, 4.39) || holds(stream.found[1], 45.44, 4.39));
}

TEST(Alerts, AWideJumpIsOneOfAWideRegion) {
    Stream stream(default_alerts());
    stream.run(2 * hour, usual);
    stream.run(20 * minute, with(usual, {-24, 134, 2, 300})); // all over a desert
    ASSERT_GE(stream.found.size(), 1u);
    EXPECT_LE(stream.found.size(), 4u);
    for (const locus_alert &alert : stream.found)
        EXPECT_LE(alert.zoom, 9u);
}

TEST(Alerts, TheWholeStreamsPaceRaisesNothing) {
    Stream stream(default_alerts());
    std::vector<Stream::Source> faster = usual;
    for (Stream::Source &source : faster)
        source.per_minute *= 10;
    stream.run(20 * minute, usual);
    stream.run(30 * minute, faster);
    stream.run(30 * minute, usual);
    stream.now += 50 * minute; // silence
    stream.run(30 * minute, usual);
    stream.now += 5 * hour;
    stream.run(30 * minute, faster);
    EXPECT_TRUE(stream.found.empty());
}

TEST(Alerts, LateRecordsRaiseNothing) {
    Stream stream(default_alerts());
    stream.run(hour, usual);
    stream.run(20 * minute, {{45.76, 4.84, 0.005, 400}}, hour);
    EXPECT_TRUE(stream.found.empty());
}

TEST(Alerts, RatesAndSharesHaveThresholds) {
    locus_alerts_options options = default_alerts();
    options.factor = std::numeric_limits<double>::infinity();
    options.rate = 4; // a second
    options.zoom_from = 6;
    options.zoom_to = 8;
    Stream rates(options);
    rates.run(hour, usual);
    EXPECT_TRUE(rates.found.empty());
    rates.run(hour, with(usual, {-33.9, 18.4, 0.005, 400}));
    ASSERT_EQ(rates.found.size(), 1u);
    EXPECT_EQ(rates.found[0].kind, static_cast<uint32_t>(LOCUS_ALERT_RATE));
    EXPECT_EQ(rates.found[0].zoom, 8u);
    EXPECT_GE(rates.found[0].rate, 4);
    EXPECT_EQ(rates.active().size(), 1u);

    options.rate = std::numeric_limits<double>::infinity();
    options.share = 0.45;
    Stream shares(options);
    shares.run(hour, usual);
    const size_t before = shares.found.size();
    shares.run(hour, with(usual, {-33.9, 18.4, 0.005, 400}));
    ASSERT_EQ(shares.found.size(), before + 1);
    EXPECT_EQ(shares.found.back().kind, static_cast<uint32_t>(LOCUS_ALERT_SHARE));
    EXPECT_EQ(shares.found.back().zoom, 8u);
    EXPECT_GE(shares.found.back().share, 0.45);
    EXPECT_TRUE(holds(shares.found.back(), -33.9, 18.4));
}

TEST(Alerts, ACallbackMayStopWhatIsStored) {
    Stream stream(default_alerts());
    stream.answer = 1;
    EXPECT_EQ(stream.run(hour, usual), LOCUS_OK);
    const auto two = with(with(usual, {45.76, 4.84, 0.005, 4000}), {-33.9, 18.4, 0.005, 4000});
    EXPECT_EQ(stream.run(10 * second, two), LOCUS_E_STOPPED);
    EXPECT_EQ(stream.found.size(), 1u);
    EXPECT_EQ(stream.active().size(), 2u) << "what was not told is known";
    uint64_t count = 0;
    const locus_pmq_query there = box_query({45, 4, 46, 5});
    EXPECT_EQ(locus_pmq_count(stream.pmq, &there, &count), LOCUS_OK);
    EXPECT_GT(count, 400u);
}

// With room for a few hundred regions of many thousand: no false alert, and the bound holds.
TEST(Alerts, MemoryIsBounded) {
    locus_alerts_options options = default_alerts();
    options.max_bytes = 65536;
    Stream stream(options);
    std::vector<Stream::Source> everywhere;
    for (int i = 0; i < 300; ++i)
        everywhere.push_back({std::uniform_real_distribution<double>(-60, 70)(stream.random),
                              std::uniform_real_distribution<double>(-180, 180)(stream.random), 0.2, 1.2});
    locus_alerts_stats stats{};
    stats.struct_size = sizeof stats;
    for (int i = 0; i < 12; ++i) {
        stream.run(10 * minute, everywhere);
        ASSERT_EQ(locus_alerts_get_stats(stream.alerts, &stats), LOCUS_OK);
        EXPECT_LE(stats.regions * 64, 65536u);
        EXPECT_LT(stats.bytes, 65536u * 8) << "what does not grow is there, too";
    }
    EXPECT_GT(stats.regions, 500u);
    EXPECT_TRUE(stream.found.empty());
}

TEST(Alerts, RegionsAreGivenUpWhenNothingComes) {
    Stream stream(default_alerts());
    std::vector<Stream::Source> wide = {{0, 0, 40, 600}};
    stream.run(10 * minute, wide);
    locus_alerts_stats stats{};
    stats.struct_size = sizeof stats;
    ASSERT_EQ(locus_alerts_get_stats(stream.alerts, &stats), LOCUS_OK);
    const uint64_t before = stats.regions;
    EXPECT_GT(before, 5000u);
    stream.run(8 * hour, usual);
    ASSERT_EQ(locus_alerts_get_stats(stream.alerts, &stats), LOCUS_OK);
    EXPECT_LT(stats.regions, before / 4);
    EXPECT_TRUE(stream.found.empty());
}

} // namespace
} // namespace locus::test
