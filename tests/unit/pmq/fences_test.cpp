// Fences against asking every fence about every record, and what callbacks may do.
#include "tests/unit/pmq/tracked_store.hpp"

#include <locus/alerts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <map>

namespace locus::test {
namespace {

using Shown = std::vector<std::pair<uint64_t, uint64_t>>; // record, fence

int32_t odd_only(const void *record, void *) {
    return static_cast<int32_t>(unpack(record, LOCUS_RECORD_POINT32).id % 2);
}

class Fences : public testing::TestWithParam<LayoutChoice> {
protected:
    Fences() : draw(51) {
        locus_pmq_options options = default_options();
        GetParam().apply(options);
        options.horizon = 5000;
        EXPECT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
        locus_alerts_options watch;
        EXPECT_EQ(locus_alerts_options_init(&watch, sizeof watch), LOCUS_OK);
        watch.fence = [](uint64_t fence, const void *record, void *user) {
            auto &self = *static_cast<Fences *>(user);
            self.shown.emplace_back(unpack(record, LOCUS_RECORD_POINT32).id, fence);
            return self.in_callback ? self.in_callback(fence) : 0;
        };
        watch.fence_user = this;
        EXPECT_EQ(locus_alerts_create(pmq, &watch, &alerts), LOCUS_OK);
    }
    ~Fences() override {
        locus_alerts_destroy(alerts);
        locus_pmq_destroy(pmq);
    }

    locus_pmq_query draw_fence() {
        locus_pmq_query query = default_query();
        const Item at = draw.place();
        switch (draw.below(8)) {
        case 0:
            break; // everywhere
        case 1:
        case 2:
            query = box_query(draw.box());
            break;
        case 3:
        case 4: {
            const double south = std::clamp(at.latitude, -80.0, 80.0), west = at.longitude, size = draw.uniform(0.1, 9);
            vertices = {{south, west}, {south, west + size}, {south + size, west + size / 2}};
            query.region = LOCUS_REGION_POLYGON;
            query.polygon = {vertices.data(), &three, 1};
            break;
        }
        default:
            query.region = LOCUS_REGION_CIRCLE;
            query.circle = {at.latitude, at.longitude, std::pow(10.0, draw.uniform(1, 7))};
        }
        if (draw.chance(0.2)) {
            query.time_from = now - 2000;
            query.time_to = now + 3000;
        }
        if (draw.chance(0.2))
            query.filter = odd_only;
        return query;
    }

    std::vector<Item> draw_batch(size_t count) {
        std::vector<Item> items(count);
        for (Item &item : items) {
            item = draw.place();
            item.id = next_id++;
            item.time = now - static_cast<int64_t>(draw.chance(0.9) ? draw.below(50) : draw.below(7000));
        }
        return items;
    }

    locus_status insert(const std::vector<Item> &items) {
        const auto bytes = pack(items, LOCUS_RECORD_POINT32);
        return locus_pmq_insert(pmq, bytes.data(), items.size(), now);
    }

    // What each fence selects of a store that holds the batch alone.
    Shown expected(const std::vector<Item> &items, const std::map<uint64_t, locus_pmq_query> &fences) {
        Shown wanted;
        for (const Item &item : items) {
            if (item.time < now - 5000)
                continue;
            locus_pmq *single = nullptr;
            EXPECT_EQ(locus_pmq_create(nullptr, &single), LOCUS_OK);
            const auto bytes = pack({item}, LOCUS_RECORD_POINT32);
            EXPECT_EQ(locus_pmq_insert(single, bytes.data(), 1, now), LOCUS_OK);
            for (const auto &[id, query] : fences) {
                uint64_t count = 0;
                EXPECT_EQ(locus_pmq_count(single, &query, &count), LOCUS_OK);
                if (count == 1)
                    wanted.emplace_back(item.id, id);
            }
            locus_pmq_destroy(single);
        }
        return wanted;
    }

    Places draw;
    locus_pmq *pmq = nullptr;
    locus_alerts *alerts = nullptr;
    int64_t now = 100000;
    uint64_t next_id = 1;
    Shown shown;
    std::function<int32_t(uint64_t)> in_callback;
    std::vector<locus_position> vertices;
    uint64_t three = 3;
};

TEST_P(Fences, ShowWhatTheirQueriesSelect) {
    std::map<uint64_t, locus_pmq_query> fences;
    std::list<std::vector<locus_position>> rings;
    size_t total = 0;
    for (int round = 0; round < 40; ++round) {
        for (uint64_t n = draw.below(6); n > 0; --n) {
            const uint64_t id = draw.below(1000);
            locus_pmq_query query = draw_fence();
            const bool there = fences.contains(id);
            ASSERT_EQ(locus_alerts_add_fence(alerts, id, &query), there ? LOCUS_E_ARGUMENT : LOCUS_OK);
            if (there)
                continue;
            if (query.region == LOCUS_REGION_POLYGON)
                query.polygon.vertices = rings.emplace_back(vertices).data();
            fences[id] = query;
        }
        if (draw.chance(0.5) && !fences.empty()) {
            const auto gone = std::next(fences.begin(), static_cast<ptrdiff_t>(draw.below(fences.size())));
            ASSERT_EQ(locus_alerts_remove_fence(alerts, gone->first), LOCUS_OK);
            ASSERT_EQ(locus_alerts_remove_fence(alerts, gone->first), LOCUS_E_ARGUMENT);
            fences.erase(gone);
        }
        now += 100;
        const std::vector<Item> items = draw_batch(draw.below(12) == 0 ? 600 : draw.below(60));
        shown.clear();
        ASSERT_EQ(insert(items), LOCUS_OK);
        ASSERT_EQ(shown, expected(items, fences)) << "round " << round;
        total += shown.size();
    }
    EXPECT_GT(total, 1000u);
    locus_alerts_stats stats{};
    stats.struct_size = sizeof stats;
    ASSERT_EQ(locus_alerts_get_stats(alerts, &stats), LOCUS_OK);
    EXPECT_EQ(stats.fences, fences.size());
    EXPECT_EQ(stats.shown, total);
}

TEST_P(Fences, ManyFencesAtOnePlaceAndFarAway) {
    const Item here{48, 2, now, 1, 0};
    for (uint64_t id = 0; id < 3000; ++id) {
        locus_pmq_query query = default_query();
        query.region = LOCUS_REGION_CIRCLE;
        query.circle = {id < 1500 ? 48.0 : -30.0, 2, 10 + static_cast<double>(id)};
        ASSERT_EQ(locus_alerts_add_fence(alerts, 3000 - id, &query), LOCUS_OK);
    }
    ASSERT_EQ(insert({here, here, here}), LOCUS_OK);
    ASSERT_EQ(shown.size(), 3 * 1500u);
    EXPECT_TRUE(std::is_sorted(shown.begin(), shown.begin() + 1500)) << "by rising id";
    EXPECT_EQ(shown[0].second, 1501u);
}

TEST_P(Fences, CallbacksMayChangeThem) {
    const locus_pmq_query all = default_query();
    for (uint64_t id = 1; id <= 3; ++id)
        ASSERT_EQ(locus_alerts_add_fence(alerts, id, &all), LOCUS_OK);
    in_callback = [&](uint64_t fence) {
        if (fence == 1) {
            EXPECT_EQ(locus_alerts_remove_fence(alerts, 2), shown.size() == 1 ? LOCUS_OK : LOCUS_E_ARGUMENT);
            EXPECT_EQ(locus_alerts_add_fence(alerts, 10, &all), shown.size() == 1 ? LOCUS_OK : LOCUS_E_ARGUMENT);
        }
        uint64_t count = 0;
        EXPECT_EQ(locus_pmq_count(pmq, nullptr, &count), LOCUS_OK);
        EXPECT_EQ(count, next_id - 1) << "the batch is visible";
        EXPECT_EQ(insert({}), LOCUS_E_BUSY);
        locus_alerts *other = nullptr;
        EXPECT_EQ(locus_alerts_create(pmq, nullptr, &other), LOCUS_E_BUSY);
        EXPECT_EQ(other, nullptr);
        return 0;
    };
    const std::vector<Item> two = draw_batch(0);
    next_id = 3;
    ASSERT_EQ(insert({{48, 2, now, 1, 0}, {49, 2, now, 2, 0}}), LOCUS_OK);
    EXPECT_EQ(shown, (Shown{{1, 1}, {1, 3}, {2, 1}, {2, 3}}));
    shown.clear();
    next_id = 4;
    in_callback = nullptr;
    ASSERT_EQ(insert({{48, 2, now, 3, 0}}), LOCUS_OK);
    EXPECT_EQ(shown, (Shown{{3, 1}, {3, 3}, {3, 10}}));
}

TEST_P(Fences, StopAndEndWithinACallback) {
    const locus_pmq_query all = default_query();
    ASSERT_EQ(locus_alerts_add_fence(alerts, 1, &all), LOCUS_OK);
    in_callback = [&](uint64_t) { return static_cast<int32_t>(shown.size() == 2); };
    EXPECT_EQ(insert(draw_batch(5)), LOCUS_E_STOPPED);
    EXPECT_EQ(shown.size(), 2u);
    uint64_t count = 0;
    EXPECT_EQ(locus_pmq_count(pmq, nullptr, &count), LOCUS_OK);
    EXPECT_GE(count, 1u);
    shown.clear();
    in_callback = [&](uint64_t) {
        locus_alerts_destroy(alerts);
        alerts = nullptr;
        return 0;
    };
    EXPECT_EQ(insert({{48, 2, now, 1, 0}, {48, 2, now, 2, 0}}), LOCUS_OK);
    EXPECT_EQ(shown.size(), 1u) << "an object that has ended is told no more";
    EXPECT_EQ(insert({{48, 2, now, 3, 0}}), LOCUS_OK);
    EXPECT_EQ(shown.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Fences, testing::ValuesIn(layouts),
                         [](const auto &instance) { return std::string(instance.param.name); });

} // namespace
} // namespace locus::test
