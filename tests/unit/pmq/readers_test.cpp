// Readers beside a writer: every answer is the one of a single moment between batches, by a model that knows them all.
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/store.hpp"
#include "tests/unit/pmq/tracked_store.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <deque>
#include <thread>

namespace locus::test {
namespace {

using pmq::Selection;
using pmq::Store;

uint64_t number_of(const locus_point32 &record) {
    return record.device | uint64_t{record.application} << 16 | uint64_t{record.language} << 32;
}

struct Figures {
    uint64_t records = 0, sum = 0, in_box = 0;
    bool operator==(const Figures &) const = default;
};

struct Step {
    int64_t now;
    bool erases; // what lies in the box, after the batch
    std::vector<locus_point32> batch;
    Figures before_erasing, after;
};

const locus_box box{30, -10, 55, 20};

// What the writer will do, and what readers may see after each step.
std::vector<Step> script(size_t steps, int64_t horizon) {
    Places draw(21);
    std::deque<locus_point32> live;
    std::vector<Step> all;
    uint64_t number = 0;
    for (size_t i = 0; i < steps; ++i) {
        Step step{static_cast<int64_t>(i + 1) * 100, i % 37 == 20, {}, {}, {}};
        const size_t size = i % 11 == 5 ? 9000 : draw.below(300);
        for (size_t n = 0; n < size; ++n) {
            const Item at = draw.place();
            const int64_t late = draw.chance(0.9) ? 0 : static_cast<int64_t>(draw.below(3000));
            ++number;
            step.batch.push_back({at.latitude, at.longitude, step.now - late, static_cast<uint16_t>(number),
                                  static_cast<uint16_t>(number >> 16), static_cast<uint16_t>(number >> 32), 0});
        }
        live.insert(live.end(), step.batch.begin(), step.batch.end());
        std::erase_if(live, [&](const auto &r) { return r.time < step.now - horizon; });
        const auto figures = [&] {
            Figures f;
            for (const locus_point32 &r : live) {
                ++f.records;
                f.sum += number_of(r);
                f.in_box += in_box(box, {r.latitude, r.longitude, 0, 0, 0});
            }
            return f;
        };
        step.before_erasing = figures();
        if (step.erases)
            std::erase_if(live, [](const auto &r) { return in_box(box, {r.latitude, r.longitude, 0, 0, 0}); });
        step.after = figures();
        all.push_back(std::move(step));
    }
    return all;
}

Figures figures_of(const pmq::View &view) {
    Figures f;
    const pmq::BoxRegion region(box);
    Selection in_region;
    in_region.region = &region;
    f.records = pmq::count(view, {});
    f.in_box = pmq::count(view, in_region);
    struct Seen {
        uint64_t sum = 0, key = 0;
        bool ordered = true;
    } seen;
    pmq::visit(
        view, {}, pmq::Order::key,
        [](const void *record, void *user) -> int32_t {
            auto &s = *static_cast<Seen *>(user);
            locus_point32 r;
            std::memcpy(&r, record, sizeof r);
            const uint64_t key = key_of(r.latitude, r.longitude);
            s.ordered = s.ordered && key >= s.key;
            s.key = key;
            s.sum += number_of(r);
            return 0;
        },
        &seen);
    f.sum = seen.ordered ? seen.sum : 0;
    return f;
}

class Readers : public testing::TestWithParam<LayoutChoice> {};

TEST_P(Readers, SeeOneMoment) {
    constexpr int64_t horizon = 4000;
    const std::vector<Step> steps = script(160, horizon);
    locus_pmq_options options = pmq::default_options();
    GetParam().apply(options);
    options.horizon = horizon;
    Store store(options);
    std::atomic<bool> done = false;
    std::atomic<uint64_t> answers = 0, wrong = 0;

    const auto may_be = [&](int64_t now, const Figures &seen) {
        if (now == INT64_MIN)
            return seen == Figures{};
        const Step &step = steps[static_cast<size_t>(now / 100 - 1)];
        return seen == step.after || (step.erases && seen == step.before_erasing);
    };
    const bool snapshots = GetParam().layout == LOCUS_LAYOUT_RING_LEAVES;
    const auto read = [&](bool keeps) {
        while (!done) {
            if (keeps && snapshots) {
                const auto snapshot = store.snapshot();
                const int64_t now = snapshot->view()->moment().now;
                for (int i = 0; i < 3; ++i) {
                    const auto view = snapshot->view();
                    wrong += view->moment().now != now || !may_be(now, figures_of(*view));
                }
            } else {
                const auto view = store.view();
                wrong += !may_be(view->moment().now, figures_of(*view));
            }
            ++answers;
            static_cast<void>(store.stats());
        }
    };
    std::thread readers[] = {std::thread(read, false), std::thread(read, true), std::thread(read, true)};

    const pmq::BoxRegion region(box);
    Selection in_region;
    in_region.region = &region;
    for (const Step &step : steps) {
        EXPECT_TRUE(store.insert(reinterpret_cast<pmq::Bytes>(step.batch.data()), step.batch.size(), step.now));
        if (step.erases) {
            uint64_t erased = 0;
            EXPECT_TRUE(store.erase(in_region, erased));
            EXPECT_EQ(erased, step.before_erasing.in_box);
        }
        EXPECT_EQ(figures_of(*store.view()), step.after);
    }
    done = true;
    for (std::thread &reader : readers)
        reader.join();
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(answers, 0u);
    EXPECT_NO_THROW(store.check());
    uint64_t evicted = 0;
    EXPECT_TRUE(store.insert(nullptr, 0, 1000000000)); // a change after the last reader lets go of what was kept
    EXPECT_TRUE(store.sweep(1000000000, evicted));
    EXPECT_EQ(store.stats().stored, 0u);
    EXPECT_NO_THROW(store.check());
}

INSTANTIATE_TEST_SUITE_P(Layouts, Readers, testing::ValuesIn(layouts),
                         [](const auto &instance) { return instance.param.name; });

locus_point32 point(int64_t time) { return {48, 2, time, 0, 0, 0, 0}; }

class Snapshots : public testing::Test {
protected:
    void create(uint64_t snapshot_bytes) {
        locus_pmq_options options = default_options();
        options.snapshot_bytes = snapshot_bytes;
        ASSERT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    }
    ~Snapshots() override { locus_pmq_destroy(pmq); }
    void insert(size_t count, int64_t now) {
        const std::vector<locus_point32> batch(count, point(now));
        ASSERT_EQ(locus_pmq_insert(pmq, batch.data(), count, now), LOCUS_OK);
    }
    locus_status count(const locus_pmq_snapshot *snapshot, uint64_t &number) const {
        locus_pmq_query query = default_query();
        query.snapshot = snapshot;
        return locus_pmq_count(pmq, &query, &number);
    }
    locus_pmq *pmq = nullptr;
};

TEST_F(Snapshots, KeepTheirMoment) {
    create(uint64_t{1} << 30);
    insert(1000, 1);
    locus_pmq_snapshot *first = nullptr, *second = nullptr;
    ASSERT_EQ(locus_pmq_snapshot_create(pmq, &first), LOCUS_OK);
    insert(1000, 2);
    ASSERT_EQ(locus_pmq_snapshot_create(pmq, &second), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(pmq, nullptr, nullptr), LOCUS_OK);
    uint64_t number = 7;
    EXPECT_EQ(count(first, number), LOCUS_OK);
    EXPECT_EQ(number, 1000u);
    EXPECT_EQ(count(second, number), LOCUS_OK);
    EXPECT_EQ(number, 2000u);
    EXPECT_EQ(count(nullptr, number), LOCUS_OK);
    EXPECT_EQ(number, 0u);
    EXPECT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
    locus_pmq_snapshot_destroy(first);
    locus_pmq_destroy(pmq);
    pmq = nullptr;
    locus_pmq_snapshot_destroy(second); // outlives the store
    locus_pmq_snapshot_destroy(nullptr);
}

TEST_F(Snapshots, TurnStaleBeyondTheirMemory) {
    create(3 << 20);
    insert(100000, 1); // 4 MB
    locus_pmq_snapshot *snapshot = nullptr;
    ASSERT_EQ(locus_pmq_snapshot_create(pmq, &snapshot), LOCUS_OK);
    uint64_t number = 0;
    EXPECT_EQ(count(snapshot, number), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(pmq, nullptr, nullptr), LOCUS_OK);
    EXPECT_EQ(count(snapshot, number), LOCUS_E_STALE);
    EXPECT_NE(std::string(locus_last_error()).find("snapshot_bytes"), std::string::npos) << locus_last_error();
    locus_pmq_snapshot_destroy(snapshot);
    EXPECT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
}

TEST_F(Snapshots, AreTheirStoresAndForReading) {
    create(1 << 20);
    insert(1, 1);
    locus_pmq_snapshot *snapshot = nullptr;
    ASSERT_EQ(locus_pmq_snapshot_create(pmq, &snapshot), LOCUS_OK);
    locus_pmq_query query = default_query();
    query.snapshot = snapshot;
    EXPECT_EQ(locus_pmq_erase(pmq, &query, nullptr), LOCUS_E_ARGUMENT);
    locus_pmq *other = nullptr;
    locus_pmq_options options = default_options();
    options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    ASSERT_EQ(locus_pmq_create(&options, &other), LOCUS_OK);
    uint64_t number = 0;
    EXPECT_EQ(locus_pmq_count(other, &query, &number), LOCUS_E_ARGUMENT);
    locus_pmq_snapshot *none = snapshot;
    EXPECT_EQ(locus_pmq_snapshot_create(other, &none), LOCUS_E_UNSUPPORTED);
    EXPECT_EQ(none, nullptr);
    EXPECT_EQ(locus_pmq_snapshot_create(nullptr, &none), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_pmq_snapshot_create(other, nullptr), LOCUS_E_ARGUMENT);
    locus_pmq_destroy(other);
    locus_pmq_snapshot_destroy(snapshot);
}

// A writer's callback stands for a second writer: it comes while the first is at work.
TEST(Writers, ASecondOneIsTurnedAway) {
    struct Second {
        locus_pmq *pmq = nullptr;
        locus_status insert = LOCUS_OK, sweep = LOCUS_OK, erase = LOCUS_OK, check = LOCUS_OK;
    } second;
    locus_pmq_options options = default_options();
    options.horizon = 10;
    options.sink_user = &second;
    options.sink = [](const void *, void *user) -> int32_t {
        auto &s = *static_cast<Second *>(user);
        std::thread([&s] {
            const locus_point32 record = point(1000);
            s.insert = locus_pmq_insert(s.pmq, &record, 1, 1000);
            s.sweep = locus_pmq_sweep(s.pmq, 1000, nullptr);
            s.erase = locus_pmq_erase(s.pmq, nullptr, nullptr);
            s.check = locus_pmq_check(s.pmq);
        }).join();
        return 0;
    };
    ASSERT_EQ(locus_pmq_create(&options, &second.pmq), LOCUS_OK);
    const locus_point32 record = point(1);
    ASSERT_EQ(locus_pmq_insert(second.pmq, &record, 1, 1), LOCUS_OK);
    ASSERT_EQ(locus_pmq_sweep(second.pmq, 100, nullptr), LOCUS_OK);
    for (const locus_status status : {second.insert, second.sweep, second.erase, second.check})
        EXPECT_EQ(status, LOCUS_E_BUSY);
    EXPECT_EQ(locus_pmq_insert(second.pmq, &record, 1, 100), LOCUS_OK);
    locus_pmq_destroy(second.pmq);
}

} // namespace
} // namespace locus::test
