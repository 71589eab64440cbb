// The contract of locus/pmq.h call by call: refusals, clocks, callbacks that stop, limits, extremes.
#include "tests/unit/pmq/tracked_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace locus::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Item at(double latitude, double longitude, int64_t time) { return {latitude, longitude, time, 0, 0}; }

std::vector<Item> scattered(Places &draw, size_t count, int64_t time) {
    std::vector<Item> items(count);
    for (Item &item : items) {
        item = draw.place();
        item.time = time;
    }
    return items;
}

locus_status insert_one(locus_pmq *pmq, double latitude, double longitude, int64_t time, int64_t now) {
    const locus_point32 records[2] = {{1, 2, 0, 0, 0, 0, 0}, {latitude, longitude, time, 0, 0, 0, 0}};
    return locus_pmq_insert(pmq, records, 2, now);
}

TEST(Insert, RefusesWithIndexAndValueAndStoresNothing) {
    TrackedStore store(default_options(), {});
    ASSERT_EQ(store.insert({at(3, 4, 5)}, 10), LOCUS_OK);
    const struct {
        double latitude, longitude;
        int64_t time;
        const char *text;
    } bad[] = {{nan, 0, 0, "records[1].latitude is nan"},          {90.5, 0, 0, "records[1].latitude is 90.5"},
               {-infinity, 0, 0, "records[1].latitude is -inf"},   {0, nan, 0, "records[1].longitude is nan"},
               {0, -180.25, 0, "records[1].longitude is -180.25"}, {0, infinity, 0, "records[1].longitude is inf"},
               {0, 0, 21, "records[1].time is 21, after now, 20"}};
    for (const auto &b : bad) {
        EXPECT_EQ(insert_one(store.pmq(), b.latitude, b.longitude, b.time, 20), LOCUS_E_ARGUMENT);
        EXPECT_NE(std::string(locus_last_error()).find(b.text), std::string::npos) << locus_last_error();
    }
    EXPECT_EQ(locus_pmq_insert(store.pmq(), nullptr, 1, 20), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_pmq_insert(store.pmq(), nullptr, 0, 9), LOCUS_E_ARGUMENT) << "the clock ran back";
    EXPECT_EQ(locus_pmq_sweep(store.pmq(), 9, nullptr), LOCUS_E_ARGUMENT);
    store.compare();
    EXPECT_EQ(store.insert({}, 10), LOCUS_OK);
    EXPECT_EQ(insert_one(store.pmq(), 90, 180, 10, 10), LOCUS_OK);
}

TEST(Insert, ClampsFutureTimesOnRequest) {
    locus_pmq_options options = default_options();
    options.future = LOCUS_FUTURE_CLAMP;
    options.horizon = 100;
    locus_pmq *pmq = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    const locus_point32 records[] = {{1, 1, INT64_MAX, 1, 0, 0, 0}, {2, 2, 40, 2, 0, 0, 0}};
    ASSERT_EQ(locus_pmq_insert(pmq, records, 2, 50), LOCUS_OK);
    locus_point32 out[2];
    size_t count = 0;
    ASSERT_EQ(locus_pmq_read(pmq, nullptr, out, 2, &count), LOCUS_OK);
    for (const locus_point32 &record : out)
        EXPECT_EQ(record.time, record.device == 1 ? 50 : 40);
    EXPECT_EQ(records[0].time, INT64_MAX) << "the caller's copy is the caller's";
    uint64_t evicted = 0;
    EXPECT_EQ(locus_pmq_sweep(pmq, 141, &evicted), LOCUS_OK);
    EXPECT_EQ(evicted, 1u) << "one record from the far future must not expire the window, nor outlive it";
    EXPECT_EQ(locus_pmq_check(pmq), LOCUS_OK);
    locus_pmq_destroy(pmq);
}

TEST(Insert, TimesAtTheEndsOfTheirRange) {
    for (const int64_t horizon : {int64_t{1}, INT64_MAX - 1, LOCUS_NO_HORIZON}) {
        locus_pmq_options options = default_options();
        options.horizon = horizon;
        TrackedStore store(options, {});
        int64_t last = INT64_MIN;
        for (const int64_t now : {INT64_MIN, INT64_MIN + 5, int64_t{-1}, int64_t{0}, INT64_MAX - 1, INT64_MAX}) {
            ASSERT_EQ(store.insert({at(1, 1, now), at(2, 2, INT64_MIN), at(3, 3, last)}, now), LOCUS_OK);
            last = now;
            store.compare();
            locus_pmq_query query = default_query();
            query.time_from = now;
            store.compare_query(query);
            query.time_from = INT64_MIN;
            query.time_to = INT64_MIN;
            store.compare_query(query);
        }
        ASSERT_EQ(store.sweep(INT64_MAX), LOCUS_OK);
        store.compare();
        store.expect_conserved();
    }
}

// 229 airports: many records of one key, in the order of their arrival.
TEST(Insert, EqualKeysWithoutLimit) {
    for (const LayoutChoice &layout : layouts) {
        locus_pmq_options options = default_options();
        layout.apply(options);
        TrackedStore store(options, {});
        Places draw(3);
        std::vector<Item> airports = scattered(draw, 229, 0);
        int64_t now = 0;
        for (int batch = 0; batch < 12; ++batch) {
            std::vector<Item> items(2500);
            for (Item &item : items) {
                item = airports[batch % 4 == 3 ? 7 : draw.below(airports.size())];
                item.time = ++now;
            }
            ASSERT_EQ(store.insert(items, now), LOCUS_OK);
            ASSERT_EQ(locus_pmq_check(store.pmq()), LOCUS_OK) << locus_last_error();
        }
        store.compare();
        for (const Item &airport : airports)
            store.compare_query(box_query({airport.latitude, airport.longitude, airport.latitude, airport.longitude}));
        ASSERT_EQ(store.erase(box_query(
                      {airports[7].latitude, airports[7].longitude, airports[7].latitude, airports[7].longitude})),
                  LOCUS_OK);
        store.compare();
    }
}

TEST(Insert, BatchesThatDoubleAndErasuresThatHalveManyTimes) {
    for (const LayoutChoice &layout : layouts) {
        locus_pmq_options options = default_options();
        layout.apply(options);
        TrackedStore store(options, {});
        Places draw(4);
        ASSERT_EQ(store.insert(scattered(draw, 20000, 1), 1), LOCUS_OK);
        store.compare();
        const uint64_t least = layout.layout == LOCUS_LAYOUT_PACKED_ARRAY ? 11 : 3;
        EXPECT_GE(stats_of(store.pmq()).grows, least);
        locus_pmq_query query = box_query({40, -3, 60, 8});
        ASSERT_EQ(store.erase(query), LOCUS_OK);
        store.compare();
        ASSERT_EQ(store.erase(default_query()), LOCUS_OK);
        store.compare();
        EXPECT_GE(stats_of(store.pmq()).shrinks, least);
        // Ascending and descending keys: the ends of the array.
        for (int i = 0; i < 300; ++i) {
            std::vector<Item> items;
            for (int j = 0; j < 5; ++j)
                items.push_back(at(i * 0.2 - 30, (i & 1 ? 1 : -1) * (i * 0.3 + j * 0.01), 2));
            ASSERT_EQ(store.insert(items, 2), LOCUS_OK);
        }
        store.compare();
    }
}

TEST(Predicate, WithStateIsAskedOncePerRecordAndPass) {
    int budget = 0;
    TrackedStore store(default_options(),
                       {.remove = [&](const Item &) { return budget > 0 && budget-- > 0 ? 1 : 0; }, .sink_stops = {}});
    Places draw(6);
    for (int64_t now = 1; now < 60; ++now) {
        budget = 37; // the tracker sees to "once"
        ASSERT_EQ(store.insert(scattered(draw, 100, now), now), LOCUS_OK);
        store.compare();
        ASSERT_GE(budget, 0);
    }
    const size_t before = store.stored().size();
    budget = 11;
    locus_pmq_sweep(store.pmq(), 60, nullptr);
    EXPECT_EQ(stats_of(store.pmq()).records, before - 11);
}

TEST(Predicate, ANegativeAnswerStoresTheBatchAndTakesPermissionsBack) {
    locus_pmq_options options = default_options();
    options.horizon = 50;
    int answers = -1; // how many permissions before the negative answer; -1: keep all
    TrackedStore store(options, {.remove =
                                     [&](const Item &) {
                                         if (answers < 0)
                                             return 0;
                                         return answers-- > 0 ? 1 : -5;
                                     },
                                 .sink_stops = {}});
    Places draw(7);
    ASSERT_EQ(store.insert(scattered(draw, 80, 1), 1), LOCUS_OK);
    ASSERT_EQ(store.insert(scattered(draw, 80, 40), 40), LOCUS_OK);
    const uint64_t evicted = stats_of(store.pmq()).evicted;
    answers = 5;
    EXPECT_EQ(store.sweep(60), LOCUS_E_STOPPED);
    EXPECT_EQ(stats_of(store.pmq()).evicted, evicted + 80) << "the expired ones, and no other";
    EXPECT_EQ(store.live().size(), 80u);
    store.compare();
    bool stopped = false;
    for (int64_t now = 61; now < 80 && !stopped; ++now) {
        answers = 3;
        const locus_status status = store.insert(scattered(draw, 60, now), now);
        ASSERT_TRUE(status == LOCUS_OK || status == LOCUS_E_STOPPED);
        stopped = status == LOCUS_E_STOPPED;
        EXPECT_EQ(store.live().size(), 80u + 60u * static_cast<size_t>(now - 60));
        store.compare();
    }
    EXPECT_TRUE(stopped);
}

TEST(Sink, ThatStopsMidwayGetsTheRestFirstAndOnce) {
    locus_pmq_options options = default_options();
    options.horizon = 10;
    int until_stop = -1;
    TrackedStore store(options, {.remove = {}, .sink_stops = [&] { return until_stop > 0 && --until_stop == 0; }});
    Places draw(8);
    ASSERT_EQ(store.insert(scattered(draw, 100, 1), 1), LOCUS_OK);
    until_stop = 30;
    EXPECT_EQ(store.sweep(20), LOCUS_E_STOPPED);
    EXPECT_EQ(store.handed_over(), 30u);
    EXPECT_EQ(stats_of(store.pmq()).pending, 70u);
    EXPECT_EQ(stats_of(store.pmq()).records, 0u);
    store.compare();
    until_stop = 20; // stops again, in an insert: the batch is there all the same
    EXPECT_EQ(store.insert(scattered(draw, 5, 21), 21), LOCUS_E_STOPPED);
    EXPECT_EQ(store.live().size(), 5u);
    EXPECT_EQ(stats_of(store.pmq()).pending, 50u);
    until_stop = -1;
    EXPECT_EQ(store.erase(default_query()), LOCUS_OK);
    EXPECT_EQ(stats_of(store.pmq()).pending, 0u);
    store.compare();
    store.expect_conserved();
}

TEST(Limits, TheOldestGoFirstWhateverTheOrderOfArrival) {
    locus_pmq_options options = default_options();
    options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    options.max_records = 160;
    TrackedStore store(options, {});
    std::vector<Item> items;
    for (int i = 0; i < 161; ++i)
        items.push_back(at(i % 50, i % 90, (i * 37) % 161));
    ASSERT_EQ(store.insert(items, 1000), LOCUS_OK);
    EXPECT_EQ(store.live().size(), 150u) << "a sixteenth below the limit";
    for (const Item &item : store.live())
        EXPECT_GE(item.time, 11);
    store.compare();
    std::vector<Item> same(500, at(1, 1, 1000));
    ASSERT_EQ(store.insert(same, 1000), LOCUS_OK);
    EXPECT_EQ(store.live().size(), 150u) << "of one time not all go";
    store.compare();
    store.expect_conserved();
}

TEST(Limits, MemoryStaysWithinTheBudget) {
    for (const LayoutChoice &layout : layouts) {
        locus_pmq_options options = default_options();
        options.max_bytes = 200000;
        layout.apply(options);
        TrackedStore store(options, {});
        Places draw(11);
        for (int64_t now = 1; now < 80; ++now) {
            ASSERT_EQ(store.insert(scattered(draw, 100, now), now), LOCUS_OK);
            const locus_pmq_stats stats = stats_of(store.pmq());
            EXPECT_LE(stats.slots * 41, options.max_bytes);
        }
        store.compare();
        EXPECT_GT(store.live().size(), 2000u);
        ASSERT_EQ(store.sweep(80), LOCUS_OK); // hands over what the limit has cut off and still lies in slots
        store.expect_conserved();
    }
}

TEST(Queries, StopAndOverflow) {
    TrackedStore store(default_options(), {});
    Places draw(12);
    ASSERT_EQ(store.insert(scattered(draw, 50, 1), 1), LOCUS_OK);
    int seen = 0;
    const auto visit = [](const void *, void *user) -> int32_t { return ++*static_cast<int *>(user) == 20; };
    EXPECT_EQ(locus_pmq_visit(store.pmq(), nullptr, visit, &seen), LOCUS_E_STOPPED);
    EXPECT_EQ(seen, 20);
    std::vector<locus_point32> out(50);
    size_t count = 0;
    EXPECT_EQ(locus_pmq_read(store.pmq(), nullptr, out.data(), 49, &count), LOCUS_E_CAPACITY);
    EXPECT_EQ(count, 50u);
    EXPECT_EQ(out[49].time, 0) << "written beyond the capacity";
    locus_pmq_query query = default_query();
    query.filter = [](const void *record, void *user) -> int32_t {
        return unpack(record, LOCUS_RECORD_POINT32).id % *static_cast<uint64_t *>(user) == 0;
    };
    uint64_t divisor = 5, number = 0;
    query.filter_user = &divisor;
    EXPECT_EQ(locus_pmq_count(store.pmq(), &query, &number), LOCUS_OK);
    EXPECT_EQ(number, 10u);
    uint32_t bin = 0;
    EXPECT_EQ(locus_pmq_tile(store.pmq(), 0, 0, 0, 0, &query, &bin, 1, &number), LOCUS_OK);
    EXPECT_EQ(bin, 10u);
    EXPECT_EQ(locus_pmq_erase(store.pmq(), &query, &number), LOCUS_OK);
    EXPECT_EQ(number, 10u);
    EXPECT_EQ(stats_of(store.pmq()).records, 40u);
}

// The tiles of a zoom share the records out.
TEST(Queries, TilesSumToTheCount) {
    TrackedStore store(default_options(), {});
    Places draw(13);
    ASSERT_EQ(store.insert(scattered(draw, 3000, 1), 1), LOCUS_OK);
    for (uint32_t zoom = 0; zoom < 5; ++zoom) {
        uint64_t sum = 0;
        for (uint32_t x = 0; x < 1u << zoom; ++x)
            for (uint32_t y = 0; y < 1u << zoom; ++y) {
                store.compare_tile(zoom, x, y, 3);
                uint32_t bin = 0;
                uint64_t total = 0;
                ASSERT_EQ(locus_pmq_tile(store.pmq(), zoom, x, y, 0, nullptr, &bin, 1, &total), LOCUS_OK);
                ASSERT_EQ(bin, total);
                sum += total;
            }
        EXPECT_EQ(sum, 3000u);
    }
}

TEST(Options, RefusedByNameAndValue) {
    const struct {
        void (*spoil)(locus_pmq_options &);
        const char *text;
    } cases[] = {
        {[](auto &o) { o.record = 33; }, "options.record is 33"},
        {[](auto &o) { o.layout = 77; }, "options.layout is 77"},
        {[](auto &o) { o.index = 9; }, "options.index is 9"},
        {[](auto &o) { o.future = 2; }, "options.future is 2"},
        {[](auto &o) { o.horizon = 0; }, "options.horizon is 0"},
        {[](auto &o) { o.horizon = -5; }, "options.horizon is -5"},
        {[](auto &o) { o.max_records = 0; }, "options.max_records is 0"},
        {[](auto &o) { o.max_bytes = 65535; }, "options.max_bytes is 65535"},
        {[](auto &o) { o.segment_slots = 12; }, "options.segment_slots is 12"},
        {[](auto &o) { o.segment_slots = 2; }, "options.segment_slots is 2"},
        {[](auto &o) { o.segment_slots = 8192; }, "options.segment_slots is 8192"},
        {[](auto &o) { o.reserved0 = 1; }, "options.reserved0 is 1"},
        {[](auto &o) { o.rho_leaf = nan; }, "options.rho_leaf nan"},
        {[](auto &o) { o.rho_leaf = 0.3; }, "rho_root 0.29999"},
        {[](auto &o) { o.tau_leaf = 1.5; }, "tau_leaf 1.5"},
        {[](auto &o) { o.tau_root = 0.95; }, "tau_root 0.9499"},
        {[](auto &o) { o.rho_root = 0.35; }, "options.rho_root 0.34999"},
        {[](auto &o) {
             o.segment_slots = 4096;
             o.max_bytes = 100000;
         },
         "options.max_bytes is 100000, too little"},
    };
    for (const auto &c : cases) {
        locus_pmq_options options = default_options();
        options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
        c.spoil(options);
        locus_pmq *pmq = nullptr;
        EXPECT_EQ(locus_pmq_create(&options, &pmq), LOCUS_E_ARGUMENT) << c.text;
        EXPECT_EQ(pmq, nullptr);
        EXPECT_NE(std::string(locus_last_error()).find(c.text), std::string::npos) << locus_last_error();
    }
}

TEST(Options, LogTellsOfResizes) {
    std::vector<std::string> lines;
    locus_pmq_options options = default_options();
    options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    options.log = [](int32_t, const char *text, void *user) {
        static_cast<std::vector<std::string> *>(user)->emplace_back(text);
    };
    options.log_user = &lines;
    TrackedStore store(options, {});
    Places draw(14);
    store.insert(scattered(draw, 100, 1), 1);
    store.erase(default_query());
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0], "grown from 8 to 256 slots for 100 records");
    EXPECT_EQ(lines[1], "shrunk from 256 to 8 slots for 0 records");
}

TEST(Arguments, OfQueries) {
    TrackedStore store(default_options(), {});
    uint64_t number = 0;
    size_t count = 0;
    uint32_t bin = 0;
    const auto refused = [](locus_status status, const char *text) {
        EXPECT_EQ(status, LOCUS_E_ARGUMENT) << text;
        EXPECT_NE(std::string(locus_last_error()).find(text), std::string::npos) << locus_last_error();
    };
    locus_pmq_query query = default_query();
    query.region = 99;
    refused(locus_pmq_count(store.pmq(), &query, &number), "query.region is 99");
    query = default_query();
    query.time_from = 5;
    query.time_to = 4;
    refused(locus_pmq_count(store.pmq(), &query, &number), "query.time_from is 5");
    query = box_query({5, 0, 4, 0});
    refused(locus_pmq_read(store.pmq(), &query, nullptr, 0, &count), "box.south 5");
    refused(locus_pmq_tile(store.pmq(), 2, 1, 1, 3, &query, &bin, 1, nullptr), "box.south 5");
    query = box_query({3, 0, 4, 0});
    refused(locus_pmq_tile(store.pmq(), 2, 1, 1, 0, &query, &bin, 1, nullptr), "query.region");
    refused(locus_pmq_tile(store.pmq(), 26, 1, 1, 0, nullptr, &bin, 1, nullptr), "zoom is 26");
    refused(locus_pmq_tile(store.pmq(), 2, 4, 1, 0, nullptr, &bin, 1, nullptr), "x is 4");
    refused(locus_pmq_tile(store.pmq(), 2, 1, 4, 0, nullptr, &bin, 1, nullptr), "y is 4");
    refused(locus_pmq_tile(store.pmq(), 2, 1, 1, 9, nullptr, &bin, 1, nullptr), "log2_bins is 9");
    EXPECT_EQ(locus_pmq_tile(store.pmq(), 2, 1, 1, 1, nullptr, &bin, 3, nullptr), LOCUS_E_CAPACITY);
    refused(locus_pmq_read(store.pmq(), nullptr, nullptr, 1, &count), "records is NULL");
    refused(locus_pmq_count(nullptr, nullptr, &number), "pmq is NULL");
    refused(locus_pmq_count(store.pmq(), nullptr, nullptr), "count is NULL");
    refused(locus_pmq_visit(store.pmq(), nullptr, nullptr, nullptr), "visit is NULL");
    locus_pmq_destroy(nullptr);
}

} // namespace
} // namespace locus::test
