// Queries for records that lie elsewhere, and what a place needs that keeps what leaves a store: expired records, and
// how many had left.
#include "core/zcurve.hpp"
#include "tests/unit/pmq/tracked_store.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::test {
namespace {

locus_pmq_query draw_query(Places &draw, std::vector<locus_position> &vertices, std::vector<uint64_t> &sizes) {
    locus_pmq_query query = default_query();
    query.region = static_cast<uint32_t>(draw.below(4));
    query.box = draw.box();
    const Item centre = draw.place();
    query.circle = {centre.latitude, centre.longitude, std::pow(10.0, draw.uniform(2, 7))};
    vertices.clear();
    for (int i = 0; i < 5; ++i)
        vertices.push_back({std::clamp(centre.latitude + 3 * std::cos(i * 1.25), -90.0, 90.0),
                            centre.longitude + 3 * std::sin(i * 1.25)});
    sizes = {vertices.size()};
    query.polygon = {vertices.data(), sizes.data(), 1};
    if (draw.chance(0.3))
        query.time_from = 200, query.time_to = 700;
    return query;
}

class Selections : public testing::TestWithParam<uint32_t> {};

// The ranges and the answers, record by record, select what a store finds.
TEST_P(Selections, SelectWhatAStoreFinds) {
    const uint32_t record = GetParam();
    Places draw(31);
    std::vector<Item> items(3000);
    for (size_t i = 0; i < items.size(); ++i) {
        items[i] = draw.place();
        items[i].id = i + 1;
        items[i].time = static_cast<int64_t>(draw.below(1000));
    }
    const std::vector<unsigned char> bytes = pack(items, record);
    locus_pmq_options options = default_options();
    options.record = record;
    locus_pmq *pmq = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    ASSERT_EQ(locus_pmq_insert(pmq, bytes.data(), items.size(), 1000), LOCUS_OK);
    std::vector<locus_position> vertices;
    std::vector<uint64_t> sizes;
    for (int round = 0; round < 300; ++round) {
        const locus_pmq_query query = draw_query(draw, vertices, sizes);
        uint64_t wanted = 0, found = 0, finer_wanted = 0;
        ASSERT_EQ(locus_pmq_count(pmq, &query, &wanted), LOCUS_OK) << locus_last_error();
        locus_pmq_selection *selection = nullptr;
        ASSERT_EQ(locus_pmq_selection_create(&query, record, &selection), LOCUS_OK) << locus_last_error();
        const size_t capacity = 1 + draw.below(200);
        std::vector<locus_key_range> ranges(capacity);
        size_t count = 0;
        ASSERT_EQ(locus_pmq_selection_ranges(selection, ranges.data(), capacity, &count), LOCUS_OK);
        ASSERT_LE(count, capacity);
        for (size_t r = 0; r < count; ++r) {
            ASSERT_LE(ranges[r].first, ranges[r].last);
            if (r > 0) {
                ASSERT_GT(ranges[r].first, ranges[r - 1].last);
            }
        }
        for (size_t i = 0; i < items.size(); ++i) {
            const uint64_t key = key_of(items[i].latitude, items[i].longitude);
            for (size_t r = 0; r < count; ++r) {
                if (key < ranges[r].first || key > ranges[r].last)
                    continue;
                int32_t matches = -1, closely = -1;
                ASSERT_EQ(locus_pmq_selection_matches(selection, bytes.data() + i * record, ranges[r].inside, &matches),
                          LOCUS_OK);
                ASSERT_EQ(locus_pmq_selection_matches(selection, bytes.data() + i * record, 0, &closely), LOCUS_OK);
                ASSERT_EQ(matches, closely);
                found += static_cast<uint64_t>(matches);
            }
            int32_t anywhere = -1;
            ASSERT_EQ(locus_pmq_selection_matches(selection, bytes.data() + i * record, 0, &anywhere), LOCUS_OK);
            finer_wanted += static_cast<uint64_t>(anywhere);
        }
        EXPECT_EQ(found, wanted);
        EXPECT_EQ(finer_wanted, wanted);
        locus_pmq_selection_destroy(selection);
    }
    locus_pmq_destroy(pmq);
}
INSTANTIATE_TEST_SUITE_P(Records, Selections, testing::Values(LOCUS_RECORD_POINT32, LOCUS_RECORD_TEXT156));

TEST(SelectionRanges, FollowTheRegionMoreCloselyTheMoreThereMayBe) {
    locus_pmq_query query = default_query();
    query.region = LOCUS_REGION_CIRCLE;
    query.circle = {48.85, 2.35, 30000};
    locus_pmq_selection *selection = nullptr;
    ASSERT_EQ(locus_pmq_selection_create(&query, LOCUS_RECORD_POINT32, &selection), LOCUS_OK);
    uint64_t before = UINT64_MAX;
    for (const size_t capacity : {1, 4, 16, 64, 256}) {
        std::vector<locus_key_range> ranges(capacity);
        size_t count = 0;
        ASSERT_EQ(locus_pmq_selection_ranges(selection, ranges.data(), capacity, &count), LOCUS_OK);
        uint64_t keys = 0;
        for (size_t i = 0; i < count; ++i)
            keys += ranges[i].last - ranges[i].first + 1;
        EXPECT_LT(keys, before) << capacity;
        before = keys;
    }
    locus_pmq_selection_destroy(selection);
    ASSERT_EQ(locus_pmq_selection_create(nullptr, LOCUS_RECORD_POINT32, &selection), LOCUS_OK);
    locus_key_range everything[2];
    size_t count = 0;
    ASSERT_EQ(locus_pmq_selection_ranges(selection, everything, 2, &count), LOCUS_OK);
    EXPECT_EQ(count, 1u);
    EXPECT_EQ(everything[0].first, 0u);
    EXPECT_EQ(everything[0].last, key_end - 1);
    EXPECT_EQ(everything[0].inside, 1u);
    locus_pmq_selection_destroy(selection);
}

// Whatever the layout lets go, and when: with the expired ones every record is in the answer or has left.
class Departing : public testing::TestWithParam<LayoutChoice> {};

TEST_P(Departing, RecordsAreInTheAnswerOrHaveLeft) {
    Places draw(32);
    locus_pmq_options options = default_options();
    GetParam().apply(options);
    options.horizon = 2000;
    options.max_records = 6000;
    uint64_t taken_over = 0;
    options.sink_user = &taken_over;
    options.sink = [](const void *, void *user) -> int32_t {
        ++*static_cast<uint64_t *>(user);
        return 0;
    };
    locus_pmq *pmq = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    uint64_t inserted = 0, most_expired = 0;
    locus_pmq_snapshot *snapshot = nullptr;
    uint64_t inserted_before = 0;
    for (int64_t now = 100; now <= 20000; now += 100) {
        std::vector<Item> items(draw.below(400));
        for (Item &item : items) {
            item = draw.place();
            item.time = now - static_cast<int64_t>(draw.below(draw.chance(0.1) ? 3000 : 100));
        }
        const auto batch = pack(items, LOCUS_RECORD_POINT32);
        ASSERT_EQ(locus_pmq_insert(pmq, batch.data(), items.size(), now), LOCUS_OK);
        inserted += items.size();
        if (draw.chance(0.05)) {
            const locus_pmq_query erased = box_query(draw.box());
            ASSERT_EQ(locus_pmq_erase(pmq, &erased, nullptr), LOCUS_OK);
        }
        if (draw.chance(0.05)) {
            ASSERT_EQ(locus_pmq_sweep(pmq, now, nullptr), LOCUS_OK);
        }
        uint64_t left = UINT64_MAX, all = 0, live = 0, visited = 0;
        locus_pmq_query query = default_query();
        query.left = &left;
        ASSERT_EQ(locus_pmq_count(pmq, &query, &live), LOCUS_OK);
        query.expired = 1;
        ASSERT_EQ(locus_pmq_count(pmq, &query, &all), LOCUS_OK);
        ASSERT_EQ(left, taken_over);
        ASSERT_EQ(all + left, inserted);
        ASSERT_EQ(locus_pmq_visit(
                      pmq, &query,
                      [](const void *, void *user) -> int32_t {
                          ++*static_cast<uint64_t *>(user);
                          return 0;
                      },
                      &visited),
                  LOCUS_OK);
        ASSERT_EQ(visited, all);
        ASSERT_GE(all, live);
        most_expired = std::max(most_expired, all - live);
        if (snapshot) { // an earlier moment, and what had left by then
            query.snapshot = snapshot;
            ASSERT_EQ(locus_pmq_count(pmq, &query, &all), LOCUS_OK);
            ASSERT_EQ(all + left, inserted_before);
            locus_pmq_snapshot_destroy(snapshot);
            snapshot = nullptr;
        }
        if (options.layout == LOCUS_LAYOUT_RING_LEAVES) {
            ASSERT_EQ(locus_pmq_snapshot_create(pmq, &snapshot), LOCUS_OK);
            inserted_before = inserted;
        }
    }
    EXPECT_GT(most_expired, 0u);
    locus_pmq_snapshot_destroy(snapshot);
    locus_pmq_destroy(pmq);
}
INSTANTIATE_TEST_SUITE_P(Layouts, Departing, testing::ValuesIn(layouts),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace locus::test
