// locus/cold.hpp: the cold tier as a C++ object, against a plain list of records.
#include <gtest/gtest.h>

#include <locus/cold.hpp>
#include <locus/locus.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

namespace {

const int64_t second = 1000000;

struct CppCold : testing::Test {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("locus-cpp-cold-" + std::to_string(::getpid()));
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const char *name) const { return (folder / name).string(); }
};

std::vector<locus_point32> posts(size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> latitude(-90, 90), longitude(-180, 180);
    std::vector<locus_point32> records(count);
    for (size_t i = 0; i < count; ++i)
        records[i] = {latitude(random), longitude(random), int64_t(i) * second, uint16_t(i % 7), 0, 0, uint16_t(i)};
    return records;
}

locus::pmq_options<> last_100_seconds() {
    locus::pmq_options<> window;
    window.horizon = 100 * second;
    return window;
}

// Numbers of records, in the order of a plain sort by (key, time): what reading both tiers gives.
std::vector<uint16_t> in_order(std::vector<locus_point32> records) {
    const auto place = [](const locus_point32 &r) {
        return std::pair(locus::pmq_key(r.latitude, r.longitude), r.time);
    };
    std::sort(records.begin(), records.end(), [&](const auto &a, const auto &b) { return place(a) < place(b); });
    std::vector<uint16_t> numbers;
    for (const auto &record : records)
        numbers.push_back(record.spare);
    return numbers;
}

std::vector<uint16_t> numbers_of(const std::vector<locus_point32> &records) {
    std::vector<uint16_t> numbers;
    for (const auto &record : records)
        numbers.push_back(record.spare);
    return numbers;
}

TEST_F(CppCold, StoreAndTierAnswerTogether) {
    using query = locus::query<>;
    const auto records = posts(1000);
    locus::cold<> tier(path("tier.db"));
    auto window = last_100_seconds();
    tier.attach(window);
    locus::pmq<> store(window);
    for (size_t i = 0; i < 1000; i += 50)
        store.insert({&records[i], 50}, records[i + 49].time);
    EXPECT_EQ(tier.count(store), 1000u);
    store.sweep(999 * second);
    tier.flush();
    tier.check();
    const uint64_t live = store.count();
    EXPECT_EQ(live, 101u);
    EXPECT_EQ(tier.count(), 1000 - live);
    EXPECT_EQ(numbers_of(tier.read(store)), in_order(records));
    const locus_box box{-10, -20, 40, 60};
    const auto wanted = std::count_if(records.begin(), records.end(), [&](const auto &r) {
        return r.latitude >= -10 && r.latitude <= 40 && r.longitude >= -20 && r.longitude <= 60;
    });
    EXPECT_EQ(tier.count(store, query().in(box)), uint64_t(wanted));
    EXPECT_EQ(tier.count(store, query().where([](const auto &r) { return r.device == 3; })), 143u);
    EXPECT_EQ(tier.read(query().between(0, 9 * second)).size(), 10u);
    EXPECT_EQ(tier.read(store, query().between(890 * second, 909 * second)).size(), 20u);
    std::vector<locus_point32> room(10);
    locus::status status;
    EXPECT_EQ(tier.read(room, store, {}, &status), 1000u);
    EXPECT_EQ(status.code(), LOCUS_E_CAPACITY);
    EXPECT_EQ(tier.read(room, query().between(0, 4 * second)), 5u);
    const locus::snapshot moment = store.snapshot();
    store.erase(query().in(box));
    EXPECT_EQ(tier.count(store, query().at(moment)), 1000u);
    EXPECT_EQ(tier.count(store), 1000u);
    EXPECT_EQ(tier.stats().received + store.count(), 1000u);
}

TEST_F(CppCold, LambdasStopAndThrow) {
    const auto records = posts(100);
    locus::cold<> tier(path("tier.db"));
    auto window = last_100_seconds();
    tier.attach(window);
    locus::pmq<> store(window);
    store.insert(records, 99 * second);
    store.erase(locus::query<>().between(0, 49 * second));
    std::vector<locus_point32> seen;
    tier.visit([&](const locus_point32 &r) { seen.push_back(r); }, store);
    EXPECT_EQ(numbers_of(seen), in_order(records));
    locus::status status;
    int shown = 0;
    tier.visit([&](const locus_point32 &) { return ++shown < 4; }, store, {}, &status);
    EXPECT_EQ(status.code(), LOCUS_E_STOPPED);
    EXPECT_EQ(shown, 4);
    EXPECT_THROW(tier.visit([](const locus_point32 &) { throw 5; }), int);
    EXPECT_THROW(tier.count(store, locus::query<>().where([](const locus_point32 &) -> bool { throw 6; })), int);
    EXPECT_EQ(tier.count(store), 100u);
}

TEST_F(CppCold, AgeRestartAndRewind) {
    const auto records = posts(300);
    {
        locus::cold_options<> options;
        options.max_age = 200 * second;
        locus::cold<> tier(path("tier.db"), options);
        auto window = last_100_seconds();
        tier.attach(window);
        locus::pmq<> store(window);
        store.insert(records, 299 * second);
        store.sweep(299 * second);
        EXPECT_EQ(tier.stats().received, 199u);
        tier.sweep(299 * second);
        tier.flush();
        EXPECT_EQ(tier.stats().removed, 99u);
        EXPECT_EQ(tier.count(store), 201u);
        EXPECT_THROW(tier.sweep(0), locus::error);
        EXPECT_THROW(tier.rewind(0), locus::error);
    }
    locus::cold<> again(path("tier.db"));
    EXPECT_EQ(again.count(), 100u);
    again.rewind(150);
    EXPECT_EQ(again.count(), 51u);
    locus::status status;
    again.rewind(1000, &status);
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    EXPECT_NE(status.text().find("received is 1000"), std::string::npos) << status.text();
}

TEST_F(CppCold, Refusals) {
    locus::status status;
    EXPECT_FALSE(locus::cold<>(path("none/tier.db"), {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_IO);
    EXPECT_NE(status.text().find("none/tier.db"), std::string::npos) << status.text();
    std::ofstream(path("text")) << "this is no database";
    EXPECT_FALSE(locus::cold<>(path("text"), {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_FORMAT);
    locus::cold<> tier(path("tier.db"));
    EXPECT_FALSE(locus::cold<>(path("tier.db"), {}, &status));
    EXPECT_EQ(status.code(), LOCUS_E_BUSY);
    locus::pmq<> alone;
    tier.count(alone, {}, &status);
    EXPECT_EQ(status.code(), LOCUS_E_STATE);
    // A store has one sink: the tier's or a lambda.
    auto window = last_100_seconds();
    window.sink = [](const locus_point32 &) {};
    tier.attach(window, &status);
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    auto attached = last_100_seconds();
    tier.attach(attached);
    EXPECT_THROW(tier.attach(attached), locus::error);
    attached.sink = [](const locus_point32 &) {};
    EXPECT_FALSE(locus::pmq<>(attached, &status));
    EXPECT_EQ(status.code(), LOCUS_E_ARGUMENT);
    EXPECT_NE(status.text().find("sink"), std::string::npos) << status.text();
}

TEST_F(CppCold, Texts) {
    locus::cold_options<locus_text156> options;
    locus::cold<locus_text156> tier(path("tier.db"), options);
    locus::pmq_options<locus_text156> window;
    tier.attach(window);
    locus::pmq<locus_text156> store(window);
    const locus_text156 record{48.8566F, 2.3522F, second, {"Bonjour"}};
    store.insert({&record, 1}, second);
    store.erase({});
    EXPECT_STREQ(tier.read(store).at(0).text, "Bonjour");
}

} // namespace
