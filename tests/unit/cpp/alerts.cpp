// locus/alerts.hpp: fences and alerts as C++ objects.
#include <gtest/gtest.h>

#include <locus/locus.hpp>

namespace {

const int64_t noon = int64_t{1700000000} * 1000000;

locus_point32 post(double latitude, double longitude, int64_t time) { return {latitude, longitude, time, 0, 0, 0, 0}; }

TEST(CppAlerts, FencesShowWhatArrivesInside) {
    locus::pmq<> store;
    std::vector<std::pair<uint64_t, double>> shown;
    locus::alerts_options<> options;
    options.fence = [&](uint64_t fence, const locus_point32 &record) { shown.emplace_back(fence, record.latitude); };
    locus::alerts<> alerts(store, options);
    alerts.add_fence(7, locus::query<>().in(locus_box{40, 0, 50, 10}));
    {
        int asked = 0;
        alerts.add_fence(8,
                         locus::query<>().in(locus_circle{45, 5, 1e6}).where([asked](const locus_point32 &r) mutable {
                             return ++asked > 0 && r.latitude < 46;
                         }));
    }
    store.insert(std::vector<locus_point32>{post(45, 5, noon), post(47, 6, noon), post(0, 0, noon)}, noon);
    EXPECT_EQ(shown, (std::vector<std::pair<uint64_t, double>>{{7, 45}, {8, 45}, {7, 47}}));
    EXPECT_EQ(alerts.stats().fences, 2u);
    EXPECT_EQ(alerts.stats().shown, 3u);
    alerts.remove_fence(7);
    EXPECT_THROW(alerts.remove_fence(7), locus::error);
    alerts.add_fence(9, locus::query<>().where([](const locus_point32 &) -> bool { throw 5; }));
    EXPECT_THROW(store.insert(std::vector<locus_point32>{post(0, 0, noon)}, noon), int);
    EXPECT_EQ(store.count(), 4u);
}

TEST(CppAlerts, AJumpIsToldOnce) {
    locus::pmq<> store;
    std::vector<locus_alert> told;
    locus::alerts_options<> options;
    options.rate = 0.5;
    options.minimum = 50;
    options.alert = [&](const locus_alert &alert) { told.push_back(alert); };
    locus::alerts<> alerts(store, options);
    for (int64_t minute = 0; minute < 5; ++minute) {
        const int64_t now = noon + minute * 60000000;
        store.insert(std::vector<locus_point32>(100, post(48.85, 2.35, now)), now);
    }
    ASSERT_FALSE(told.empty());
    EXPECT_LE(told[0].box.south, 48.85);
    EXPECT_GE(told[0].box.north, 48.85);
    EXPECT_EQ(alerts.active().size(), told.size());
    options.alert = [](const locus_alert &) { throw 6; };
    locus::alerts<> throwing(store, options);
    const int64_t later = noon + 300000000;
    EXPECT_THROW(store.insert(std::vector<locus_point32>(500, post(10, 10, later)), later), int);
    options.minimum = -1;
    locus::status status;
    EXPECT_FALSE(locus::alerts<>(store, options, &status));
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
}

} // namespace
