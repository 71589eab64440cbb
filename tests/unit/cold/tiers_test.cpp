// Both tiers in one answer, at every point of random histories, for both record layouts and every layout of the store.
#include "tests/unit/cold/tiers.hpp"

#include <locus/storage.h>

#include <atomic>
#include <thread>

namespace locus::test {
namespace {

struct History {
    LayoutChoice layout;
    uint32_t record;
    std::string name() const { return layout.name + std::to_string(record); }
};

void PrintTo(const History &history, std::ostream *out) { *out << history.name(); }

class BothTiers : public testing::TestWithParam<History> {
protected:
    locus_pmq_options window() const {
        locus_pmq_options window = default_options();
        GetParam().layout.apply(window);
        window.record = GetParam().record;
        window.horizon = 2000;
        window.max_records = 1500;
        return window;
    }
    locus_cold_options tier() const {
        locus_cold_options options = cold_options(GetParam().record);
        options.batch_records = 300;
        options.run_records = 900;
        options.delay = 3000;
        return options;
    }
    static std::vector<Item> batch(Places &draw, int64_t now) {
        std::vector<Item> items(draw.below(150));
        for (Item &item : items) {
            item = draw.place();
            item.time = now - static_cast<int64_t>(draw.below(draw.chance(0.1) ? 4000 : 50));
        }
        return items;
    }
};

TEST_P(BothTiers, AnswerAsOne) {
    const Folder folder;
    Tiers tiers(folder.file(), window(), tier());
    Queries queries(41);
    Places &draw = queries.draw;
    for (int64_t now = 10000; now < 16000; now += 50) {
        ASSERT_EQ(tiers.insert(batch(draw, now), now), LOCUS_OK) << locus_last_error();
        if (draw.chance(0.05)) {
            const locus_pmq_query erased = box_query(draw.box());
            ASSERT_EQ(locus_pmq_erase(tiers.pmq, &erased, nullptr), LOCUS_OK); // moves to the tier
        }
        if (draw.chance(0.05)) {
            ASSERT_EQ(locus_pmq_sweep(tiers.pmq, now, nullptr), LOCUS_OK);
        }
        if (draw.chance(0.1)) {
            ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
        }
        tiers.expect(queries.next(now));
        if (HasFatalFailure())
            FAIL() << "at " << now;
    }
    tiers.expect(default_query());
    ASSERT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
    EXPECT_GT(stats_of(tiers.cold).runs, 5u);
    EXPECT_GT(stats_of(tiers.cold).transactions, 20u);

    // The tier's part survives; what was in the store does not.
    const std::vector<Item> before = tiers.read(default_query(), false);
    tiers.close();
    tiers.open();
    const std::vector<Item> after = tiers.read(default_query(), false);
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < after.size(); ++i)
        ASSERT_EQ(after[i].id, before[i].id) << i;
    std::erase_if(tiers.model, [&](const auto &entry) {
        return std::none_of(after.begin(), after.end(), [&](const Item &item) { return item.id == entry.first; });
    });
    for (int64_t now = 30000; now < 32000; now += 50) { // and goes on
        ASSERT_EQ(tiers.insert(batch(draw, now), now), LOCUS_OK);
        tiers.expect(queries.next(now));
    }
}

// Readers beside the writer see everything that was inserted by some moment between two batches: batch i inserts i + 1
// records, so an answer of everything tells which moment it is of, and every other answer must fit one.
TEST_P(BothTiers, AnswerAsOneWhileRecordsMove) {
    const Folder folder;
    Tiers tiers(folder.file(), window(), tier());
    constexpr uint64_t batches = 250;
    std::atomic<uint64_t> begun = 0, ended = 0, answers = 0, wrong = 0;
    const auto inserted = [](uint64_t batch) { return batch * (batch + 1) / 2; };
    const auto read = [&](bool in_order) {
        while (ended < batches) {
            const uint64_t least = inserted(ended);
            uint64_t count = 0;
            bool good;
            if (in_order) {
                struct Seen {
                    uint32_t record;
                    uint64_t count = 0, sum = 0, key = 0;
                    bool ordered = true;
                } seen{GetParam().record};
                good = locus_cold_visit(
                           tiers.cold, tiers.pmq, nullptr,
                           [](const void *record, void *user) -> int32_t {
                               auto &s = *static_cast<Seen *>(user);
                               const Item item = unpack(record, s.record);
                               uint64_t key = 0;
                               locus_pmq_key(item.latitude, item.longitude, &key);
                               s.ordered = s.ordered && key >= s.key;
                               s.key = key;
                               ++s.count;
                               s.sum += item.id;
                               return 0;
                           },
                           &seen) == LOCUS_OK;
                count = seen.count;
                good = good && seen.ordered && seen.sum == count * (count + 1) / 2; // ids 1..count, each once
            } else {
                good = locus_cold_count(tiers.cold, tiers.pmq, nullptr, &count) == LOCUS_OK;
            }
            const uint64_t most = inserted(begun);
            const auto batch = static_cast<uint64_t>(std::sqrt(2.0 * static_cast<double>(count)));
            wrong +=
                !good || count < least || count > most || (inserted(batch) != count && inserted(batch - 1) != count);
            ++answers;
        }
    };
    std::thread readers[] = {std::thread(read, false), std::thread(read, true), std::thread(read, true)};
    Places draw(43);
    for (uint64_t i = 1; i <= batches; ++i) {
        const auto now = static_cast<int64_t>(i * 20);
        std::vector<Item> items(i);
        for (Item &item : items) {
            item = draw.place();
            item.time = now - static_cast<int64_t>(draw.below(draw.chance(0.1) ? 3000 : 50));
        }
        begun = i;
        ASSERT_EQ(tiers.insert(items, now), LOCUS_OK);
        ended = i;
        while (i < batches && answers < i / 10) // readers have their turn
            std::this_thread::yield();
    }
    for (std::thread &reader : readers)
        reader.join();
    EXPECT_EQ(wrong, 0u) << "of " << answers;
    tiers.expect(default_query());
}

INSTANTIATE_TEST_SUITE_P(Histories, BothTiers,
                         testing::Values(History{layouts[0], LOCUS_RECORD_POINT32},
                                         History{layouts[0], LOCUS_RECORD_TEXT156},
                                         History{layouts[1], LOCUS_RECORD_POINT32},
                                         History{layouts[2], LOCUS_RECORD_TEXT156}),
                         [](const auto &info) { return info.param.name(); });

TEST(Tier, KeepsEveryByte) {
    const Folder folder;
    locus_cold *cold = nullptr;
    const locus_cold_options options = cold_options(LOCUS_RECORD_TEXT156);
    ASSERT_EQ(locus_cold_open(folder.file().c_str(), &options, &cold), LOCUS_OK) << locus_cold_last_error();
    locus_pmq_options window = default_options();
    window.record = LOCUS_RECORD_TEXT156;
    ASSERT_EQ(locus_cold_attach(cold, &window), LOCUS_OK);
    locus_pmq *pmq = nullptr;
    ASSERT_EQ(locus_pmq_create(&window, &pmq), LOCUS_OK);
    std::vector<locus_text156> records(500), found(500);
    std::mt19937_64 random(5);
    for (locus_text156 &record : records) {
        for (char &c : record.text)
            c = static_cast<char>(random());
        record.latitude = 48, record.longitude = 2, record.time = 1; // one key: in order of arrival
    }
    ASSERT_EQ(locus_pmq_insert(pmq, records.data(), records.size(), 1), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(pmq, nullptr, nullptr), LOCUS_OK);
    for (int round = 0; round < 2; ++round) { // out of the queue, then out of the file
        size_t count = 0;
        ASSERT_EQ(locus_cold_read(cold, pmq, nullptr, found.data(), found.size(), &count), LOCUS_OK);
        ASSERT_EQ(count, records.size());
        EXPECT_EQ(std::memcmp(found.data(), records.data(), records.size() * sizeof records[0]), 0);
        ASSERT_EQ(locus_cold_flush(cold), LOCUS_OK);
        EXPECT_EQ(stats_of(cold).written, records.size());
    }
    locus_pmq_destroy(pmq);
    locus_cold_close(cold);
}

// The store is saved and loaded, the tier stays: what had expired in the store comes to the tier then.
TEST(Tier, GoesOnWithALoadedStore) {
    const Folder folder;
    const std::string saved = folder.path() + "/store";
    for (const LayoutChoice &layout : layouts) {
        locus_pmq_options window = default_options();
        layout.apply(window);
        window.horizon = 1000;
        const std::string file = folder.path() + "/" + layout.name;
        const locus_cold_options options = cold_options();
        Tiers tiers(file, window, options);
        Places draw(9);
        for (int64_t now = 50; now <= 3000; now += 50) {
            std::vector<Item> items(60);
            for (Item &item : items) {
                item = draw.place();
                item.time = now - static_cast<int64_t>(draw.below(50));
            }
            ASSERT_EQ(tiers.insert(items, now), LOCUS_OK);
        }
        ASSERT_EQ(locus_pmq_save(tiers.pmq, nullptr, saved.c_str(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
        tiers.close();
        ASSERT_EQ(locus_cold_open(file.c_str(), &options, &tiers.cold), LOCUS_OK) << locus_cold_last_error();
        ASSERT_EQ(locus_cold_attach(tiers.cold, &window), LOCUS_OK);
        ASSERT_EQ(locus_pmq_load(saved.c_str(), &window, nullptr, nullptr, &tiers.pmq), LOCUS_OK) << locus_last_error();
        ASSERT_EQ(locus_pmq_sweep(tiers.pmq, 3000, nullptr), LOCUS_OK);
        tiers.expect(default_query());
    }
}

// With a snapshot the answer is that of its moment.
TEST(Tier, AnswersForASnapshot) {
    const Folder folder;
    locus_pmq_options window = default_options();
    window.horizon = 100;
    Tiers tiers(folder.file(), window, cold_options());
    Places draw(7);
    const auto some = [&](int64_t now) {
        std::vector<Item> items(100);
        for (Item &item : items) {
            item = draw.place();
            item.time = now;
        }
        return items;
    };
    for (int64_t now = 10; now <= 500; now += 10)
        ASSERT_EQ(tiers.insert(some(now), now), LOCUS_OK);
    locus_pmq_snapshot *snapshot = nullptr;
    ASSERT_EQ(locus_pmq_snapshot_create(tiers.pmq, &snapshot), LOCUS_OK);
    for (int64_t now = 510; now <= 1000; now += 10)
        ASSERT_EQ(tiers.insert(some(now), now), LOCUS_OK);
    locus_pmq_query query = default_query();
    query.snapshot = snapshot;
    uint64_t count = 0, left = 0;
    query.left = &left;
    for (int round = 0; round < 2; ++round) {
        ASSERT_EQ(locus_cold_count(tiers.cold, tiers.pmq, &query, &count), LOCUS_OK) << locus_cold_last_error();
        EXPECT_EQ(count, 5000u);
        EXPECT_LE(left, 5000u);
        EXPECT_EQ(tiers.read(query).size(), 5000u);
        ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK);
    }
    locus_pmq_snapshot_destroy(snapshot);
    tiers.expect(default_query());
}

} // namespace
} // namespace locus::test
