// Pages of an ordered iteration: the same as one reading, and what a store that changes in between does to them.
#include "tests/unit/pmq/filled_stores.hpp"

#include <gtest/gtest.h>

#include <set>

namespace locus::test {
namespace {

struct Page {
    locus_status status;
    std::vector<uint64_t> ids;
    size_t count;
};

Page next_page(const locus_pmq *pmq, const locus_pmq_query &query, locus_pmq_cursor &cursor, size_t capacity) {
    std::vector<locus_point32> records(capacity);
    Page page{LOCUS_OK, {}, 77};
    page.status = locus_pmq_read_page(pmq, &query, &cursor, records.data(), capacity, &page.count);
    records.resize(page.status == LOCUS_OK ? page.count : 0);
    page.ids = FilledStores::ids_of(records);
    return page;
}

locus_pmq_query draw_query(Places &draw) {
    locus_pmq_query query = default_query();
    switch (draw.below(4)) {
    case 0:
        query = box_query(draw.box());
        break;
    case 1: {
        const Item at = draw.place();
        query.region = LOCUS_REGION_CIRCLE;
        query.circle = {at.latitude, at.longitude, std::pow(10.0, draw.uniform(3, 7))};
        break;
    }
    }
    if (draw.chance(0.3))
        query.time_from = static_cast<int64_t>(draw.below(9000));
    if (draw.chance(0.2))
        query.filter = every_third;
    return query;
}

std::vector<uint64_t> read_all(const locus_pmq *pmq, const locus_pmq_query &query, size_t most) {
    std::vector<locus_point32> records(most);
    size_t count = 0;
    EXPECT_EQ(locus_pmq_read(pmq, &query, records.data(), most, &count), LOCUS_OK);
    records.resize(count);
    return FilledStores::ids_of(records);
}

TEST(Pages, TogetherAreOneReading) {
    Places draw(31);
    const FilledStores stores(draw_items(draw, 8000));
    size_t too_small = 0;
    for (int i = 0; i < 60; ++i) {
        const locus_pmq_query query = draw_query(draw);
        for (const locus_pmq *pmq : stores.stores) {
            const std::vector<uint64_t> wanted = read_all(pmq, query, stores.items.size());
            locus_pmq_cursor cursor = {0, 0};
            std::vector<uint64_t> ids;
            size_t capacity = 1 + draw.below(700);
            for (;;) {
                const locus_pmq_cursor before = cursor;
                const Page page = next_page(pmq, query, cursor, capacity);
                if (page.status == LOCUS_E_CAPACITY) { // the airports
                    ++too_small;
                    EXPECT_EQ(cursor.key, before.key);
                    EXPECT_GT(page.count, capacity);
                    capacity = page.count;
                    continue;
                }
                ASSERT_EQ(page.status, LOCUS_OK) << locus_last_error();
                ASSERT_LE(page.ids.size(), capacity);
                EXPECT_EQ(cursor.passed, 0u);
                if (page.count == 0)
                    break;
                EXPECT_GT(cursor.key, before.key);
                ids.insert(ids.end(), page.ids.begin(), page.ids.end());
            }
            ASSERT_EQ(ids, wanted);
            EXPECT_EQ(cursor.key, LOCUS_KEY_END);
        }
    }
    EXPECT_GT(too_small, 10u);
}

TEST(Pages, OfASnapshotAreFullWhateverTheStoreDoes) {
    Places draw(32);
    const FilledStores stores(draw_items(draw, 8000));
    locus_pmq *pmq = stores.stores[0]; // ring leaves
    const auto more = pack(draw_items(draw, 300), LOCUS_RECORD_POINT32);
    for (int i = 0; i < 40; ++i) {
        locus_pmq_query query = draw_query(draw);
        locus_pmq_snapshot *snapshot = nullptr;
        ASSERT_EQ(locus_pmq_snapshot_create(pmq, &snapshot), LOCUS_OK);
        query.snapshot = snapshot;
        const std::vector<uint64_t> wanted = read_all(pmq, query, 30000);
        locus_pmq_cursor cursor = {0, 0};
        const size_t capacity = 1 + draw.below(300);
        std::vector<uint64_t> ids;
        for (Page page = next_page(pmq, query, cursor, capacity); page.count > 0;
             page = next_page(pmq, query, cursor, capacity)) {
            ASSERT_EQ(page.status, LOCUS_OK);
            ids.insert(ids.end(), page.ids.begin(), page.ids.end());
            EXPECT_EQ(page.ids.size(), std::min(capacity, wanted.size() - (ids.size() - page.ids.size())));
            if (ids.size() % 3 == 0) {
                ASSERT_EQ(locus_pmq_insert(pmq, more.data(), 300, filled_now), LOCUS_OK);
            }
        }
        EXPECT_EQ(ids, wanted);
        locus_pmq_snapshot_destroy(snapshot);
        const locus_pmq_query some = box_query(draw.box());
        ASSERT_EQ(locus_pmq_erase(pmq, &some, nullptr), LOCUS_OK);
    }
}

// Between two pages records come, expire and are erased, at the places of the page's end above all.
TEST(Pages, ShowOnceWhatStaysWhileTheStoreChanges) {
    for (const LayoutChoice &choice : layouts) {
        Places draw(33);
        locus_pmq_options options = default_options();
        choice.apply(options);
        options.horizon = 3000;
        TrackedStore store(options, {});
        int64_t now = 10000;
        const auto insert = [&](size_t count) {
            std::vector<Item> items(count);
            for (Item &item : items) {
                item = draw.place();
                item.time = now - static_cast<int64_t>(draw.below(1000));
            }
            now += static_cast<int64_t>(draw.below(60));
            ASSERT_EQ(store.insert(std::move(items), now), LOCUS_OK);
        };
        for (int i = 0; i < 20; ++i)
            insert(100);
        for (int round = 0; round < 25; ++round) {
            std::set<uint64_t> always;
            for (const Item &item : store.live())
                always.insert(item.id);
            std::set<uint64_t> shown;
            locus_pmq_cursor cursor = {0, 0};
            uint64_t last_key = 0;
            for (;;) {
                const Page page = next_page(store.pmq(), default_query(), cursor, 400);
                ASSERT_EQ(page.status, LOCUS_OK) << locus_last_error();
                if (page.count == 0)
                    break;
                std::set<uint64_t> present;
                for (const Item &item : store.live())
                    if (item.key >= last_key && item.key < cursor.key)
                        present.insert(item.id);
                EXPECT_EQ(std::set(page.ids.begin(), page.ids.end()), present) << choice.name;
                for (const uint64_t id : page.ids)
                    EXPECT_TRUE(shown.insert(id).second) << "record " << id << " is shown twice";
                last_key = cursor.key;
                insert(60);
                if (draw.chance(0.5))
                    store.erase(box_query(draw.chance(0.5) ? draw.box() : locus_box{9, -101, 11, -99}));
                std::set<uint64_t> left;
                for (const Item &item : store.live())
                    left.insert(item.id);
                std::erase_if(always, [&](uint64_t id) { return !left.contains(id); });
            }
            for (const uint64_t id : always)
                EXPECT_TRUE(shown.contains(id)) << choice.name << ": record " << id << " is not shown";
        }
    }
}

} // namespace
} // namespace locus::test
