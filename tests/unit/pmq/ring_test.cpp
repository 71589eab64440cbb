// The ring leaves by themselves: what many records, few places and views that outlive changes ask of them. The answers
// are compared with a plain vector's.
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <random>

namespace locus::pmq {
namespace {

using Records = std::vector<locus_point32>;

bool same(const Records &a, const Records &b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

uint64_t key(const locus_point32 &r) { return key_of(r.latitude, r.longitude); }

Records read_all(const View &view) {
    Records records(count(view, {}));
    EXPECT_EQ(read(view, {}, Order::key, reinterpret_cast<std::byte *>(records.data()), records.size()),
              records.size());
    return records;
}

class Ring : public testing::Test {
protected:
    explicit Ring(int64_t horizon = LOCUS_NO_HORIZON) {
        locus_pmq_options options = default_options();
        options.layout = LOCUS_LAYOUT_RING_LEAVES;
        options.horizon = horizon;
        horizon_ = horizon;
        store = std::make_unique<Store>(options);
    }

    void insert(const Records &records, int64_t now) {
        ASSERT_TRUE(store->insert(reinterpret_cast<Bytes>(records.data()), records.size(), now));
        model.insert(model.end(), records.begin(), records.end());
        advance(now);
    }
    void advance(int64_t now) {
        if (horizon_ != LOCUS_NO_HORIZON)
            std::erase_if(model, [&](const locus_point32 &r) { return r.time < now - horizon_; });
    }
    Records expected() const {
        std::vector<std::pair<uint64_t, size_t>> order; // key, arrival
        for (const locus_point32 &r : model)
            order.emplace_back(key(r), order.size());
        std::sort(order.begin(), order.end());
        Records sorted;
        for (const auto &[key, arrival] : order)
            sorted.push_back(model[arrival]);
        return sorted;
    }
    void compare() {
        ASSERT_NO_THROW(store->check());
        ASSERT_TRUE(same(read_all(*store->view()), expected()));
    }
    locus_point32 record(double latitude, double longitude, int64_t time) {
        const uint64_t number = ++made_;
        return {latitude,
                longitude,
                time,
                static_cast<uint16_t>(number),
                static_cast<uint16_t>(number >> 16),
                static_cast<uint16_t>(number >> 32),
                0};
    }
    // A batch around a centre that wanders about.
    Records cloud(size_t size, int64_t now, int64_t late) {
        std::normal_distribution<double> spread(0, 0.5);
        std::uniform_int_distribution<int64_t> age(0, late);
        const double latitude = 40 * std::sin(static_cast<double>(now) / 30000);
        const double longitude = 100 * std::cos(static_cast<double>(now) / 50000);
        Records records;
        for (size_t i = 0; i < size; ++i)
            records.push_back(record(latitude + spread(random), longitude + spread(random), now - age(random)));
        return records;
    }

    // Of a window of 20000 units.
    void count_from_any_time(int64_t unit) {
        std::shared_ptr<const View> held;
        for (int64_t now = 0, step = 0; now < 150000; now += random() % 40 == 0 ? 1500 : 50, ++step) {
            Records batch = cloud(100, now, step % 2000 < 1000 ? 0 : 10);
            for (size_t i = 0; i < batch.size(); ++i)
                batch[i].time = batch[i].time * unit - unit + 1 + static_cast<int64_t>(i) * unit / 100;
            insert(batch, now * unit);
            if (step % 50 == 0)
                held = step % 100 == 0 ? store->view() : nullptr;
            if (step % 20 != 0)
                continue;
            Selection selection;
            for (int i = 0; i < 4; ++i) {
                const int64_t most = i == 0 ? 20001 * unit : (20000 + now / 4) * unit;
                selection.times.from = now * unit - static_cast<int64_t>(random() % static_cast<uint64_t>(most));
                const auto counted = std::count_if(
                    model.begin(), model.end(), [&](const locus_point32 &r) { return r.time >= selection.times.from; });
                ASSERT_EQ(count(*store->view(), selection), static_cast<uint64_t>(counted));
            }
            if (step % 200 == 0)
                compare();
        }
    }

    std::unique_ptr<Store> store;
    std::deque<locus_point32> model;
    std::mt19937_64 random{7};
    uint64_t made_ = 0;
    int64_t horizon_;
};

class RingWindow : public Ring {
protected:
    RingWindow() : Ring(20000) {}
};

class RingLongWindow : public Ring {
protected:
    static constexpr int64_t scale = 104;
    RingLongWindow() : Ring(20000 * scale) {}
};

TEST_F(Ring, ThreeMillionRecordsOnFewPlaces) {
    for (int64_t now = 0; now < 1000; ++now) {
        Records batch;
        for (int i = 0; i < 3000; ++i) {
            const auto place = static_cast<double>(random() % 229);
            batch.push_back(record(place / 10, -place / 2, now));
        }
        insert(batch, now);
    }
    compare();
}

TEST_F(Ring, OnePlaceAmidSmallerAndLargerKeys) {
    for (int64_t now = 0; now < 40; ++now) {
        Records batch;
        for (int i = 0; i < 300; ++i) {
            const double offset = random() % 8 == 0 ? static_cast<double>(random() % 1000) / 1e3 - 0.5 : 0;
            batch.push_back(record(48 + offset, 2 + offset, now));
        }
        insert(batch, now);
        compare();
    }
}

TEST_F(RingWindow, WanderingWindowKeepsItsMemory) {
    uint64_t after_one = 0;
    for (int64_t now = 0; now < 300000; now += 50) {
        insert(cloud(100, now, 10), now);
        if (now % 20000 == 0)
            compare();
        if (now == 60000)
            after_one = store->stats().bytes;
    }
    EXPECT_LT(store->stats().bytes, after_one * 5 / 4);
}

// The leaves' times of what expires next, under a clock that goes on by leaps and bounds, and beside a reader.
TEST_F(RingWindow, CountsFromAnyTimeOn) { count_from_any_time(1); }

// A window so long that these times are rounded, and just shorter than a power of two of their units.
TEST_F(RingLongWindow, CountsFromAnyTimeOn) { count_from_any_time(scale); }

TEST_F(RingWindow, LateRecordsKeepTheMemorySteady) {
    uint64_t most_late = 0;
    for (int64_t now = 0; now < 200000; now += 50) {
        insert(cloud(100, now, 19000), now);
        const locus_pmq_stats stats = store->stats();
        if (now > 40000)
            most_late = std::max(most_late, stats.stored * 100 / stats.records);
        if (now % 20000 == 0)
            compare();
    }
    EXPECT_LT(most_late, 150u);
}

// Readers do not wait for a large batch, which is written beside what they see. But what it makes and takes apart
// itself nobody sees.
TEST_F(Ring, ALargeBatchKeepsNothingTwice) {
    constexpr size_t many = 400'000;
    insert(cloud(many, 0, 10), 0);
    compare();
    EXPECT_LT(store->stats().bytes, 84 * many); // 40 bytes a slot, two thirds of which are full
}

TEST_F(RingWindow, MemoryOfABurstIsGivenBack) {
    for (int64_t now = 0; now < 20000; now += 50)
        insert(cloud(100, now, 10), now);
    const uint64_t before = store->stats().bytes;
    for (int64_t now = 20000; now < 22000; now += 50)
        insert(cloud(20000, now, 10), now);
    EXPECT_GT(store->stats().bytes, 4 * before);
    for (int64_t now = 22000; now < 80000; now += 50)
        insert(cloud(100, now, 10), now);
    compare();
    EXPECT_LT(store->stats().bytes, before + (size_t{8} << 20)); // but for one slab
}

// Views see what was there when they were asked for, whatever happens later.
TEST_F(RingWindow, ViewsOutliveChanges) {
    struct Held {
        std::shared_ptr<const View> view;
        Records records;
    };
    std::deque<Held> held;
    for (int64_t now = 0; now < 120000; now += 200) {
        insert(cloud(400, now, random() % 2 ? 10 : 15000), now);
        const uint64_t choice = random() % 16;
        if (choice < 3)
            held.push_back({store->view(), expected()});
        if (choice == 4 || held.size() > 12)
            held.clear();
        if (choice == 5) {
            uint64_t evicted;
            store->sweep(now, evicted);
        }
        if (choice == 6) {
            const BoxRegion box({-30, -60, 30, 90});
            Selection selection;
            selection.region = &box;
            uint64_t erased;
            store->erase(selection, erased);
            std::erase_if(model, [&](const locus_point32 &r) { return box.contains(r.latitude, r.longitude); });
        }
        if (choice == 7) {
            for (const Held &h : held)
                ASSERT_TRUE(same(read_all(*h.view), h.records));
            compare();
        }
    }
    held.clear();
    insert({}, 120000);
    compare();
    EXPECT_LT(store->stats().stored, store->stats().slots);
}

} // namespace
} // namespace locus::pmq
