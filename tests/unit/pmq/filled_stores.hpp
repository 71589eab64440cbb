// The same records in a store of each layout, and beside them as a sorted vector.
#pragma once

#include "tests/unit/pmq/tracked_store.hpp"

#include "core/sphere.hpp"
#include "core/zcurve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace locus::test {

inline constexpr int64_t filled_now = 10000, filled_horizon = 9000;

// Items at random places with times up to filled_now, mostly ascending; some have expired by then.
inline std::vector<Item> draw_items(Places &draw, size_t count) {
    std::vector<Item> items(count);
    for (size_t i = 0; i < count; ++i) {
        items[i] = draw.place();
        items[i].id = i + 1;
        items[i].time = static_cast<int64_t>(draw.chance(0.9) ? i * filled_now / count : draw.below(filled_now));
    }
    return items;
}

// A filter, and what it says of an item.
inline int32_t every_third(const void *record, void *) { return unpack(record, LOCUS_RECORD_POINT32).id % 3 == 0; }
inline bool selects(const locus_pmq_query &query, const Item &item) {
    return query.time_from <= item.time && item.time <= query.time_to && (!query.filter || item.id % 3 == 0);
}

// Sometimes a time window, sometimes the filter.
inline locus_pmq_query draw_times_and_filter(Places &draw) {
    locus_pmq_query query = default_query();
    if (draw.chance(0.4)) {
        query.time_from = static_cast<int64_t>(draw.below(6000));
        query.time_to = query.time_from + static_cast<int64_t>(draw.below(6000));
    }
    if (draw.chance(0.3))
        query.filter = every_third;
    return query;
}

class FilledStores {
public:
    explicit FilledStores(const std::vector<Item> &items, int64_t now = filled_now, int64_t horizon = filled_horizon)
        : items(items) {
        for (const LayoutChoice &choice : layouts) {
            locus_pmq_options options = default_options();
            choice.apply(options);
            options.horizon = horizon;
            locus_pmq *pmq = nullptr;
            EXPECT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
            for (size_t i = 0; i < items.size(); i += 500) {
                const size_t end = std::min(items.size(), i + 500);
                const auto batch =
                    pack({items.begin() + static_cast<ptrdiff_t>(i), items.begin() + static_cast<ptrdiff_t>(end)},
                         LOCUS_RECORD_POINT32);
                EXPECT_EQ(locus_pmq_insert(pmq, batch.data(), end - i, now), LOCUS_OK) << locus_last_error();
            }
            stores.push_back(pmq);
        }
        std::erase_if(this->items, [&](const Item &item) { return item.time < now - horizon; });
        for (Item &item : this->items)
            item.key = key_of(item.latitude, item.longitude);
        std::stable_sort(this->items.begin(), this->items.end(),
                         [](const Item &a, const Item &b) { return a.key < b.key; });
    }
    ~FilledStores() {
        for (locus_pmq *pmq : stores)
            locus_pmq_destroy(pmq);
    }
    FilledStores(const FilledStores &) = delete;
    FilledStores &operator=(const FilledStores &) = delete;

    // The live items a query should find, in order.
    std::vector<uint64_t> selected(const locus_pmq_query &query,
                                   const std::function<bool(const Item &)> &contains) const {
        std::vector<uint64_t> ids;
        for (const Item &item : items)
            if (selects(query, item) && contains(item))
                ids.push_back(item.id);
        return ids;
    }

    // Counted, read in either order and shown, and shown no further than the visitor wants it.
    void expect_selected(locus_pmq_query query, const std::function<bool(const Item &)> &contains) const {
        const std::vector<uint64_t> wanted = selected(query, contains);
        for (const locus_pmq *pmq : stores) {
            uint64_t counted = 0;
            ASSERT_EQ(locus_pmq_count(pmq, &query, &counted), LOCUS_OK) << locus_last_error();
            EXPECT_EQ(counted, wanted.size());
            for (const uint32_t order : {LOCUS_ORDER_ANY, LOCUS_ORDER_KEY}) {
                query.order = order;
                std::vector<locus_point32> records(wanted.size() + 1);
                size_t count = 0;
                ASSERT_EQ(locus_pmq_read(pmq, &query, records.data(), records.size(), &count), LOCUS_OK);
                records.resize(count);
                std::vector<uint64_t> ids = ids_of(records);
                EXPECT_TRUE(order == LOCUS_ORDER_KEY ? ids == wanted : same_but_for_order(ids, wanted));
            }
            Visitor visitor{{}, SIZE_MAX};
            ASSERT_EQ(locus_pmq_visit(pmq, &query, Visitor::visit, &visitor), LOCUS_OK);
            EXPECT_EQ(visitor.ids, wanted);
            if (!wanted.empty()) {
                visitor = {{}, wanted.size() / 2 + 1};
                ASSERT_EQ(locus_pmq_visit(pmq, &query, Visitor::visit, &visitor), LOCUS_E_STOPPED);
                EXPECT_TRUE(std::equal(visitor.ids.begin(), visitor.ids.end(), wanted.begin()));
                EXPECT_EQ(visitor.ids.size(), visitor.most);
            }
        }
    }

    static std::vector<uint64_t> ids_of(const std::vector<locus_point32> &records) {
        std::vector<uint64_t> ids;
        for (const locus_point32 &record : records)
            ids.push_back(unpack(&record, LOCUS_RECORD_POINT32).id);
        return ids;
    }

    // The k best items by a score, with it; those without one (negative) do not count.
    using Ranked = std::vector<std::pair<double, uint64_t>>;
    template <typename Score>
    Ranked ranked_by(const locus_pmq_query &query, size_t k, Score &&score) const {
        Ranked all;
        for (const Item &item : items)
            if (const double s = score(item); s >= 0 && selects(query, item))
                all.emplace_back(s, item.id);
        std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
        all.resize(std::min(k, all.size()));
        return all;
    }
    static Ranked ranked(std::vector<locus_point32> records, const std::vector<double> &scores, size_t count) {
        records.resize(count);
        const std::vector<uint64_t> ids = ids_of(records);
        Ranked all;
        for (size_t i = 0; i < count; ++i)
            all.emplace_back(scores[i], ids[i]);
        return all;
    }
    void expect_nearest(const Item &at, const locus_pmq_query &query, size_t k) const {
        const Site centre(at.latitude, at.longitude);
        const Ranked best = ranked_by(query, k, [&](const Item &item) {
            return centre.distance_to({item.latitude, item.longitude});
        });
        for (const locus_pmq *pmq : stores) {
            std::vector<locus_point32> records(k);
            std::vector<double> distances(k);
            size_t count = 0;
            ASSERT_EQ(
                locus_pmq_nearest(pmq, at.latitude, at.longitude, &query, k, records.data(), distances.data(), &count),
                LOCUS_OK);
            ASSERT_EQ(ranked(records, distances, count), best);
        }
    }

    struct Visitor {
        static int32_t visit(const void *record, void *user) {
            auto &self = *static_cast<Visitor *>(user);
            self.ids.push_back(unpack(record, LOCUS_RECORD_POINT32).id);
            return self.ids.size() == self.most;
        }
        std::vector<uint64_t> ids;
        size_t most;
    };
    static bool same_but_for_order(std::vector<uint64_t> a, std::vector<uint64_t> b) {
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        return a == b;
    }

    std::vector<Item> items; // live, in the order (key, arrival)
    std::vector<locus_pmq *> stores;
};

} // namespace locus::test
