// Every allocation of alerts objects and of snapshots fails in turn: what could not be made leaves no trace, a batch is
// stored and told of as a whole or not at all, and a snapshot stays as it was.
#include "tests/unit/pmq/failing_memory.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include <locus/alerts.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace locus::test {
namespace {

using Shown = std::vector<std::pair<uint64_t, uint64_t>>; // fence, record

// Call with every allocation failing in turn until none does; how often one failed.
size_t insist(const std::function<locus_status()> &call, const std::function<void()> &unchanged) {
    for (size_t after = 0;; ++after) {
        locus_status status = LOCUS_OK;
        bool failed = false;
        {
            FailingMemory failing(after);
            status = call();
            failed = failing.failed();
        }
        if (status == LOCUS_OK)
            return after;
        EXPECT_EQ(status, LOCUS_E_MEMORY) << locus_last_error();
        EXPECT_TRUE(failed) << locus_last_error();
        SCOPED_TRACE("allocation " + std::to_string(after));
        unchanged();
        if (testing::Test::HasFailure())
            return after;
    }
}

// A store that is watched, and what its callbacks were told.
class Watched {
public:
    explicit Watched(const LayoutChoice &layout) {
        shown.reserve(200000); // the callbacks must not allocate
        raised.reserve(300);
        locus_pmq_options store = default_options();
        layout.apply(store);
        store.horizon = 5000;
        EXPECT_EQ(locus_pmq_create(&store, &pmq), LOCUS_OK);
        EXPECT_EQ(locus_alerts_options_init(&options, sizeof options), LOCUS_OK);
        options.factor = std::numeric_limits<double>::infinity(); // a history may be lost with its region
        options.rate = 1;
        options.alert = [](const locus_alert *alert, void *user) {
            static_cast<Watched *>(user)->raised.push_back(*alert);
            return 0;
        };
        options.fence = [](uint64_t fence, const void *record, void *user) {
            static_cast<Watched *>(user)->shown.emplace_back(fence, unpack(record, LOCUS_RECORD_POINT32).id);
            return 0;
        };
        options.alert_user = options.fence_user = this;
    }
    ~Watched() {
        locus_alerts_destroy(alerts);
        locus_pmq_destroy(pmq);
    }
    Watched(const Watched &) = delete;
    Watched &operator=(const Watched &) = delete;

    locus_status create() { return locus_alerts_create(pmq, &options, &alerts); }
    locus_status insert(const std::vector<unsigned char> &batch, int64_t now) {
        return locus_pmq_insert(pmq, batch.data(), batch.size() / sizeof(locus_point32), now);
    }
    uint64_t fences() const {
        locus_alerts_stats stats{};
        stats.struct_size = sizeof stats;
        EXPECT_EQ(locus_alerts_get_stats(alerts, &stats), LOCUS_OK);
        return stats.fences;
    }

    locus_alerts_options options;
    locus_pmq *pmq = nullptr;
    locus_alerts *alerts = nullptr;
    Shown shown;
    std::vector<locus_alert> raised;
};

std::vector<locus_pmq_query> draw_fences(Places &draw) {
    static const locus_position triangle[] = {{40, -5}, {40, 10}, {55, 2}};
    static const uint64_t three = 3;
    std::vector<locus_pmq_query> fences{default_query()};
    for (int i = 0; i < 4; ++i)
        fences.push_back(box_query(draw.box()));
    fences.push_back(default_query());
    fences.back().region = LOCUS_REGION_CIRCLE;
    fences.back().circle = {48, 2, 20000};
    fences.push_back(default_query());
    fences.back().region = LOCUS_REGION_POLYGON;
    fences.back().polygon = {triangle, &three, 1};
    return fences;
}

class WatchedMemory : public testing::TestWithParam<LayoutChoice> {};

// Beside a twin that never runs out of memory.
TEST_P(WatchedMemory, BatchesAreToldOfWholeOrNotAtAll) {
    Watched watched(GetParam()), twin(GetParam());
    size_t failures = insist([&] { return watched.create(); }, [&] { EXPECT_EQ(watched.alerts, nullptr); });
    ASSERT_EQ(twin.create(), LOCUS_OK);
    Changes changes(61);
    const std::vector<locus_pmq_query> fences = draw_fences(changes.draw);
    for (uint64_t id = 0; id < fences.size(); ++id) {
        failures += insist([&] { return locus_alerts_add_fence(watched.alerts, id, &fences[id]); },
                           [&] { EXPECT_EQ(watched.fences(), id); });
        ASSERT_EQ(locus_alerts_add_fence(twin.alerts, id, &fences[id]), LOCUS_OK);
    }
    for (int step = 0; step < 60 && !HasFailure(); ++step) {
        changes.now += 100;
        const auto batch = changes.batch(100);
        failures += insist([&] { return watched.insert(batch, changes.now); },
                           [&] { EXPECT_EQ(watched.shown, twin.shown) << "told of a batch that is not stored"; });
        ASSERT_EQ(twin.insert(batch, changes.now), LOCUS_OK);
        ASSERT_EQ(watched.shown, twin.shown) << step;
        ASSERT_EQ(content_of(watched.pmq, LOCUS_RECORD_POINT32), content_of(twin.pmq, LOCUS_RECORD_POINT32));
    }
    EXPECT_GT(failures, 60u);
    EXPECT_GT(watched.shown.size(), 3000u);

    std::vector<locus_point32> burst(2000, {-33.9, 18.4, changes.now, 0, 0, 0, 0});
    for (Watched *one : {&watched, &twin}) {
        one->raised.clear();
        ASSERT_EQ(locus_pmq_insert(one->pmq, burst.data(), burst.size(), changes.now), LOCUS_OK);
        ASSERT_EQ(one->raised.size(), 1u);
        EXPECT_EQ(one->raised[0].zoom, one->options.zoom_to);
    }
    EXPECT_EQ(watched.raised[0].x, twin.raised[0].x);
    EXPECT_EQ(watched.raised[0].y, twin.raised[0].y);
}

INSTANTIATE_TEST_SUITE_P(Layouts, WatchedMemory, testing::ValuesIn(layouts),
                         [](const auto &instance) { return instance.param.name; });

// Changes work on copies while a snapshot is held, and every one of them may fail.
TEST(SnapshotMemory, StaysAsItWas) {
    locus_pmq_options options = default_options();
    options.horizon = 5000;
    locus_pmq *pmq = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    const StoreHandle owner(pmq);
    Changes changes(62);
    size_t failures = 0;
    for (int round = 0; round < 12 && !HasFailure(); ++round) {
        const Content present = content_of(pmq, options.record);
        locus_pmq_snapshot *snapshot = nullptr;
        failures +=
            insist([&] { return locus_pmq_snapshot_create(pmq, &snapshot); }, [&] { EXPECT_EQ(snapshot, nullptr); });
        const auto kept = [&] { return content_of(pmq, options.record, snapshot).records; };
        for (int step = 0; step < 5 && !HasFailure(); ++step) {
            changes.now += 300;
            const auto batch = changes.batch(700);
            const Content before = content_of(pmq, options.record);
            const auto unchanged = [&] {
                EXPECT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
                EXPECT_EQ(content_of(pmq, options.record), before);
                EXPECT_EQ(kept(), present.records);
            };
            failures +=
                insist([&] { return locus_pmq_insert(pmq, batch.data(), batch.size() / options.record, changes.now); },
                       unchanged);
            ASSERT_EQ(kept(), present.records) << round << ", " << step;
        }
        // A question about it answers rightly, or says that there is no memory.
        locus_pmq_query query = box_query({-90, -180, 90, 180});
        query.snapshot = snapshot;
        uint64_t count = 0;
        failures += insist([&] { return locus_pmq_count(pmq, &query, &count); }, [] {});
        EXPECT_EQ(count * options.record, present.records.size());
        ASSERT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
        locus_pmq_snapshot_destroy(snapshot);
    }
    EXPECT_GT(failures, 120u);
}

} // namespace
} // namespace locus::test
