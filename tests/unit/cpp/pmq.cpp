// locus/locus.hpp: stores, queries and snapshots as C++ objects, against a plain list of records.
#include <gtest/gtest.h>

#include <locus/locus.hpp>

#include <algorithm>
#include <cstring>
#include <random>

namespace {

const int64_t noon = int64_t{1700000000} * 1000000;

std::vector<locus_point32> some_records(size_t count, int64_t from, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> latitude(-90, 90), longitude(-180, 180);
    std::vector<locus_point32> records(count);
    for (size_t i = 0; i < count; ++i)
        records[i] = {latitude(random), longitude(random), from + int64_t(i), uint16_t(i % 7), 0, 0, uint16_t(i)};
    return records;
}

bool inside(const locus_point32 &record, const locus_box &box) {
    return record.latitude >= box.south && record.latitude <= box.north && record.longitude >= box.west &&
           record.longitude <= box.east;
}

TEST(CppPmq, QueriesMatchAPlainList) {
    const auto records = some_records(5000, noon, 1);
    locus::pmq<> store;
    store.insert(records, noon + 5000);
    using query = locus::query<>;
    const locus_box box{-10, -20, 40, 60};
    const auto wanted = std::count_if(records.begin(), records.end(), [&](const auto &r) { return inside(r, box); });
    EXPECT_EQ(store.count(), 5000u);
    EXPECT_EQ(store.count(query().in(box)), uint64_t(wanted));
    EXPECT_EQ(store.read(query().in(box)).size(), size_t(wanted));
    EXPECT_EQ(store.read(query().in(box).in_any_order()).size(), size_t(wanted));
    EXPECT_EQ(store.count(query().between(noon + 10, noon + 19)), 10u);
    const auto third = [](const locus_point32 &r) { return r.device == 3; };
    EXPECT_EQ(store.count(query().where(third)), uint64_t(std::count_if(records.begin(), records.end(), third)));
    const locus_position ring[4] = {{-10, -20}, {-10, 60}, {40, 60}, {40, -20}};
    EXPECT_EQ(store.count(query().in(locus::polygon(ring))), uint64_t(wanted));
    EXPECT_EQ(store.count(query().in(locus_circle{0, 0, 20015114.0})), 5000u);
    uint64_t seen = 0;
    store.visit([&](const locus_point32 &r) { seen += inside(r, box); });
    EXPECT_EQ(seen, uint64_t(wanted));
    const auto bins = store.tile(0, 0, 0, 3);
    uint64_t sum = 0;
    for (const uint32_t bin : bins)
        sum += bin;
    EXPECT_EQ(bins.size(), 64u);
    EXPECT_EQ(sum, 5000u);
    std::vector<locus_point32> room(10);
    locus::status status;
    EXPECT_EQ(store.read(room, {}, &status), 5000u);
    EXPECT_EQ(status.code(), LOCUS_E_CAPACITY);
    store.check();
    EXPECT_EQ(store.stats().records, 5000u);
    EXPECT_EQ(locus::pmq_key(0, 0), uint64_t{3} << 48);
}

TEST(CppPmq, PagesGroupsAndWeightedTiles) {
    const auto records = some_records(1000, noon, 9);
    locus::pmq<> store;
    store.insert(records, noon + 1000);
    locus_pmq_cursor cursor{};
    std::vector<locus_point32> page(64);
    std::vector<uint16_t> seen;
    while (const size_t count = store.read_page(cursor, page))
        for (size_t i = 0; i < count; ++i)
            seen.push_back(page[i].spare);
    std::vector<uint16_t> all;
    for (const auto &record : store.read())
        all.push_back(record.spare);
    EXPECT_EQ(seen, all);
    std::vector<uint64_t> counts(7);
    double sum = 0;
    for (const auto &record : records)
        ++counts[record.device], sum += record.device;
    for (const auto &group : store.groups(LOCUS_FIELD_DEVICE))
        EXPECT_EQ(group.count, counts.at(group.value));
    EXPECT_EQ(store.groups([](const locus_point32 &r) { return uint64_t(r.spare); }).size(), 1000u);
    EXPECT_THROW(store.groups([](const locus_point32 &) -> uint64_t { throw 5; }), int);
    EXPECT_THROW(store.groups(99), locus::error);
    const auto bins = store.weighted_tile([](const locus_point32 &r) { return double(r.device); }, 0, 0, 0, 1);
    ASSERT_EQ(bins.size(), 4u);
    EXPECT_EQ(bins[0] + bins[1] + bins[2] + bins[3], sum);
    EXPECT_THROW(store.weighted_tile([](const locus_point32 &) -> double { throw 5; }, 0, 0, 0, 1), int);
}

TEST(CppPmq, TheNearestAndTheBest) {
    const auto records = some_records(500, noon, 2);
    locus::pmq<> store;
    store.insert(records, noon + 500);
    const auto near = store.nearest(10, 20, 5);
    ASSERT_EQ(near.records.size(), 5u);
    EXPECT_TRUE(std::is_sorted(near.values.begin(), near.values.end()));
    locus::pmq_score score(10, 20);
    score.radius = 20015114.0;
    const auto best = store.topk(score, 7);
    ASSERT_EQ(best.records.size(), 7u);
    EXPECT_TRUE(std::is_sorted(best.values.begin(), best.values.end()));
    EXPECT_EQ(store.nearest(10, 20, 1000).records.size(), 500u);
    EXPECT_THROW(store.nearest(10, 20, 0), locus::error);
}

TEST(CppPmq, EvictionThroughLambdas) {
    std::vector<locus_point32> gone;
    locus::pmq_options<> options;
    options.horizon = 1000;
    options.remove = [](const locus_point32 &record) { return record.device == 6; };
    options.sink = [&](const locus_point32 &record) { gone.push_back(record); };
    locus::pmq<> store(options);
    locus::pmq<> moved = std::move(store);
    const auto records = some_records(1000, noon, 3);
    moved.insert(records, noon + 1000);
    moved.sweep(noon + 1500);
    const auto goes = [](const locus_point32 &r) { return r.device == 6 || r.time < noon + 500; };
    EXPECT_EQ(gone.size(), size_t(std::count_if(records.begin(), records.end(), goes)));
    EXPECT_EQ(moved.count(), 1000 - gone.size());
    const uint64_t left = moved.count();
    EXPECT_EQ(moved.erase(locus::query<>()), left);
    EXPECT_EQ(gone.size(), 1000u);
}

TEST(CppPmq, ExpiredRecordsUntilTheyLeave) {
    locus::pmq_options<> options;
    options.horizon = 1000;
    locus::pmq<> store(options);
    store.insert(some_records(1000, noon, 10), noon + 1000);
    store.insert({}, noon + 1010);
    EXPECT_EQ(store.count(), 990u);
    EXPECT_EQ(store.count(locus::query<>().expired()), store.stats().stored);
    locus::status status;
    store.erase(locus::query<>().expired(), &status);
    EXPECT_NE(status.text().find("expired"), std::string::npos) << status.text();
}

TEST(CppPmq, ASinkThatThrowsLosesNothing) {
    size_t taken = 0;
    bool full = true;
    locus::pmq_options<> options;
    options.sink = [&](const locus_point32 &) {
        if (++taken == 3 && full)
            throw std::runtime_error("the sink is full");
    };
    locus::pmq<> store(options);
    store.insert(some_records(10, noon, 4), noon + 10);
    locus::status status;
    try {
        store.erase({}, &status);
        FAIL() << "the sink's exception was lost";
    } catch (const std::runtime_error &error) {
        EXPECT_STREQ(error.what(), "the sink is full");
    }
    EXPECT_EQ(store.stats().pending, 7u);
    full = false;
    store.sweep(noon + 20);
    EXPECT_EQ(taken, 10u);
    EXPECT_EQ(store.count(), 0u);
}

TEST(CppPmq, ExceptionsOfFiltersAndVisitors) {
    locus::pmq<> store;
    store.insert(some_records(10, noon, 5), noon + 10);
    int asked = 0;
    const auto throws = locus::query<>().where([&](const locus_point32 &) -> bool {
        ++asked;
        throw 5;
    });
    EXPECT_THROW(store.count(throws), int);
    EXPECT_EQ(asked, 1);
    EXPECT_THROW(store.read(throws), int);
    EXPECT_THROW(store.visit([](const locus_point32 &) { throw 6; }), int);
    locus::status status;
    int seen = 0;
    store.visit([&](const locus_point32 &) { return ++seen < 4; }, {}, &status);
    EXPECT_EQ(status.code(), LOCUS_E_STOPPED);
    EXPECT_EQ(seen, 4);
}

TEST(CppPmq, SnapshotsKeepTheirMoment) {
    locus::pmq<> store;
    store.insert(some_records(100, noon, 6), noon + 100);
    const locus::snapshot before = store.snapshot();
    store.insert(some_records(50, noon + 100, 7), noon + 200);
    EXPECT_EQ(store.count(), 150u);
    EXPECT_EQ(store.count(locus::query<>().at(before)), 100u);
    EXPECT_EQ(store.read(locus::query<>().at(before)).size(), 100u);
    locus::pmq_options<> packed;
    packed.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    locus::status status;
    EXPECT_FALSE(locus::pmq<>(packed).snapshot(&status));
    EXPECT_EQ(status.code(), LOCUS_E_UNSUPPORTED);
}

TEST(CppPmq, Texts) {
    locus::pmq<locus_text156> store;
    locus_text156 record{48.8566F, 2.3522F, noon, {}};
    std::memcpy(record.text, "Bonjour", 7);
    store.insert({&record, 1}, noon);
    EXPECT_STREQ(store.read().at(0).text, "Bonjour");
    EXPECT_EQ(store.count(locus::query<locus_text156>().where(
                  [](const locus_text156 &r) { return std::strcmp(r.text, "Bonjour") == 0; })),
              1u);
}

TEST(CppPmq, ErrorsNameTheRecord) {
    locus::pmq<> store;
    auto records = some_records(3, noon, 8);
    records[2].latitude = 91;
    locus::status status;
    store.insert(records, noon + 5, &status);
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    EXPECT_NE(status.text().find("91"), std::string::npos) << status.text();
    EXPECT_EQ(store.count(), 0u);
    EXPECT_THROW(store.tile(26, 0, 0, 0), locus::error);
    EXPECT_THROW(store.tile(0, 0, 0, 60), locus::error);
}

} // namespace
