// What the tier lets go: by age, by bytes, and after the store was lost.
#include "tests/unit/cold/tiers.hpp"

#include <set>

namespace locus::test {
namespace {

std::vector<Item> batch(Places &draw, size_t count, int64_t now, uint64_t late) {
    std::vector<Item> items(count);
    for (Item &item : items) {
        item = draw.place();
        item.time = now - static_cast<int64_t>(draw.below(draw.chance(0.1) ? late : 50));
    }
    return items;
}

// Answers lack what is too old in the tier, at once; the file follows.
TEST(Retention, ByAgeIsExact) {
    for (const uint32_t record : {LOCUS_RECORD_POINT32, LOCUS_RECORD_TEXT156}) {
        const Folder folder;
        locus_pmq_options window = default_options();
        window.record = record;
        window.horizon = 1000;
        locus_cold_options options = cold_options(record);
        options.max_age = 4000;
        options.batch_records = 200;
        options.run_records = 600;
        options.delay = 2000;
        Tiers tiers(folder.file(), window, options);
        Queries queries(51);
        uint64_t most = 0;
        for (int64_t now = 10000; now < 24000; now += 50) {
            ASSERT_EQ(tiers.insert(batch(queries.draw, queries.draw.below(60), now, 6000), now), LOCUS_OK);
            if (now % 250 == 0) {
                ASSERT_EQ(locus_cold_sweep(tiers.cold, now), LOCUS_OK) << locus_cold_last_error();
            }
            if (now % 1000 == 0) {
                ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
                most = std::max(most, stats_of(tiers.cold).stored);
            }
            std::set<uint64_t> in_store;
            locus_pmq_query stored = default_query();
            stored.expired = 1;
            struct Collect {
                std::set<uint64_t> &ids;
                uint32_t record;
            } collect{in_store, record};
            ASSERT_EQ(locus_pmq_visit(
                          tiers.pmq, &stored,
                          [](const void *bytes, void *user) -> int32_t {
                              auto &c = *static_cast<Collect *>(user);
                              c.ids.insert(unpack(bytes, c.record).id);
                              return 0;
                          },
                          &collect),
                      LOCUS_OK);
            const int64_t cutoff = now / 250 * 250 - options.max_age;
            std::erase_if(tiers.model, [&](const auto &entry) {
                return entry.second.time < cutoff && !in_store.contains(entry.first);
            });
            tiers.expect(queries.next(now));
            if (HasFatalFailure())
                FAIL() << "at " << now;
        }
        ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
        ASSERT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
        const locus_cold_stats stats = stats_of(tiers.cold);
        EXPECT_EQ(stats.stored + stats.removed, stats.written);
        EXPECT_LT(most, stats.written / 2); // 5000 microseconds' worth of 14,000
    }
}

// The records that came first go; the file stays within its limit and uses its room again.
TEST(Retention, ByBytesKeepsTheLatest) {
    const Folder folder;
    locus_pmq_options window = default_options();
    window.record = LOCUS_RECORD_TEXT156;
    locus_cold_options options = cold_options(LOCUS_RECORD_TEXT156);
    options.max_bytes = 8 << 20;
    options.delay = 2000;
    Tiers tiers(folder.file(), window, options);
    uint64_t largest = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<Item> items(2000); // of one place: they leave as they came
        for (Item &item : items)
            item = {48, 2, round, 0, 0};
        ASSERT_EQ(tiers.insert(items, round), LOCUS_OK);
        ASSERT_EQ(locus_pmq_erase(tiers.pmq, nullptr, nullptr), LOCUS_OK);
        if (round % 10 == 9) {
            ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
            largest = std::max(largest, stats_of(tiers.cold).file_bytes);
        }
    }
    const locus_cold_stats stats = stats_of(tiers.cold);
    EXPECT_LE(stats.file_bytes - stats.free_bytes, options.max_bytes);
    EXPECT_LT(largest, options.max_bytes * 5 / 4);
    EXPECT_GT(stats.stored * 156, options.max_bytes / 2);
    const std::vector<Item> found = tiers.read(default_query());
    ASSERT_EQ(found.size(), stats.stored);
    EXPECT_EQ(stats.stored + stats.removed, 120000u);
    for (size_t i = 0; i < found.size(); ++i)
        ASSERT_EQ(found[i].id, stats.removed + i + 1);
    ASSERT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
}

// Room that is far too much is given back.
TEST(Retention, ShrinksTheFile) {
    const Folder folder;
    locus_cold_options options = cold_options();
    options.max_age = 100;
    options.run_records = 20000;
    Tiers tiers(folder.file(), default_options(), options);
    Places draw(6);
    ASSERT_EQ(tiers.insert(batch(draw, 400000, 50, 50), 50), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(tiers.pmq, nullptr, nullptr), LOCUS_OK);
    ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
    const uint64_t full = stats_of(tiers.cold).file_bytes;
    ASSERT_EQ(locus_cold_sweep(tiers.cold, 1000), LOCUS_OK);
    for (int step = 0; step < 10; ++step)
        ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
    EXPECT_EQ(stats_of(tiers.cold).stored, 0u);
    EXPECT_LT(stats_of(tiers.cold).file_bytes, full * 3 / 4);
    ASSERT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
}

// The store is saved, lost and loaded: the tier forgets what came after.
TEST(Retention, RewindsToAnEarlierMoment) {
    const Folder folder;
    locus_cold_options options = cold_options();
    options.batch_records = 300;
    options.run_records = 700;
    Places draw(8);
    Tiers tiers(folder.file(), default_options(), options);
    std::vector<std::vector<Item>> moments;
    std::vector<uint64_t> marks;
    for (int64_t now = 1; now <= 12; ++now) {
        ASSERT_EQ(tiers.insert(batch(draw, 250, now, 1), now), LOCUS_OK);
        ASSERT_EQ(locus_pmq_erase(tiers.pmq, nullptr, nullptr), LOCUS_OK);
        ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
        marks.push_back(stats_of(tiers.cold).received);
        moments.push_back(tiers.read(default_query(), false));
    }
    tiers.close();
    for (const size_t moment : {11, 10, 7, 6, 2, 0}) {
        locus_cold *cold = nullptr;
        ASSERT_EQ(locus_cold_open(folder.file().c_str(), &options, &cold), LOCUS_OK) << locus_cold_last_error();
        ASSERT_EQ(locus_cold_rewind(cold, marks[moment]), LOCUS_OK) << locus_cold_last_error();
        ASSERT_EQ(locus_cold_check(cold), LOCUS_OK) << locus_cold_last_error();
        std::swap(cold, tiers.cold);
        const std::vector<Item> found = tiers.read(default_query(), false);
        std::swap(cold, tiers.cold);
        ASSERT_EQ(found.size(), moments[moment].size());
        for (size_t i = 0; i < found.size(); ++i)
            ASSERT_EQ(found[i].id, moments[moment][i].id);
        locus_cold_close(cold);
    }
    tiers.open(); // and it goes on from there
    tiers.model.clear();
    for (const Item &item : moments[0])
        tiers.model[item.id] = item;
    ASSERT_EQ(tiers.insert(batch(draw, 250, 50, 1), 50), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(tiers.pmq, nullptr, nullptr), LOCUS_OK);
    ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
    tiers.expect(default_query());
}

// A queue that is full makes the store wait, or refuses; nothing is lost either way.
TEST(Queue, HoldsWhatItMayAndLosesNothing) {
    for (const uint32_t when_full : {LOCUS_COLD_FULL_WAIT, LOCUS_COLD_FULL_REFUSE}) {
        const Folder folder;
        locus_cold_options options = cold_options();
        options.when_full = when_full;
        Tiers tiers(folder.file(), default_options(), options);
        Places draw(9);
        ASSERT_EQ(tiers.insert(batch(draw, 150000, 50, 50), 50), LOCUS_OK); // 4.8 MB, the queue takes 1
        locus_status status = locus_pmq_erase(tiers.pmq, nullptr, nullptr);
        int refusals = 0;
        for (; status == LOCUS_E_STOPPED; ++refusals) {
            EXPECT_LE(stats_of(tiers.cold).queue_bytes, 3u << 20);
            ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
            status = locus_pmq_sweep(tiers.pmq, 50, nullptr);
        }
        ASSERT_EQ(status, LOCUS_OK);
        EXPECT_EQ(refusals > 0, when_full == LOCUS_COLD_FULL_REFUSE);
        EXPECT_EQ(stats_of(tiers.cold).waits > 0, when_full == LOCUS_COLD_FULL_WAIT);
        EXPECT_LE(stats_of(tiers.cold).queue_bytes, 3u << 20);
        tiers.expect(default_query());
    }
}

} // namespace
} // namespace locus::test
