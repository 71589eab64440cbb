// Top-k and nearest against a sort of everything.
#include "core/sphere.hpp"
#include "tests/unit/pmq/filled_stores.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::test {
namespace {

class Rankings : public testing::Test {
protected:
    Rankings() : draw(21), stores(draw_items(draw, 20000)) {}

    // The ids of the k best items by a score; those without one (negative) do not count.
    template <typename Score>
    std::vector<uint64_t> wanted(const locus_pmq_query &query, size_t k, Score &&score) const {
        std::vector<std::pair<double, uint64_t>> all;
        for (const Item &item : stores.items)
            if (const double s = score(item); s >= 0 && query.time_from <= item.time && item.time <= query.time_to &&
                                              (!query.filter || item.id % 3 == 0))
                all.emplace_back(s, item.id);
        std::stable_sort(all.begin(), all.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
        std::vector<uint64_t> ids;
        for (size_t i = 0; i < std::min(k, all.size()); ++i)
            ids.push_back(all[i].second);
        return ids;
    }

    locus_pmq_query query() {
        locus_pmq_query q = default_query();
        if (draw.chance(0.3)) {
            q.time_from = static_cast<int64_t>(draw.below(6000));
            q.time_to = q.time_from + static_cast<int64_t>(draw.below(6000));
        }
        if (draw.chance(0.3))
            q.filter = [](const void *record, void *) {
                return static_cast<int32_t>(unpack(record, LOCUS_RECORD_POINT32).id % 3 == 0);
            };
        return q;
    }

    Places draw;
    FilledStores stores;
};

TEST_F(Rankings, TopKIsTheHeadOfASort) {
    size_t found = 0;
    for (int i = 0; i < 150; ++i) {
        const Item at = draw.place();
        locus_pmq_score score;
        ASSERT_EQ(locus_pmq_score_init(&score, sizeof score), LOCUS_OK);
        score.latitude = at.latitude;
        score.longitude = at.longitude;
        score.radius = std::pow(10.0, draw.uniform(2, 7.3));
        score.alpha = i % 5 == 0 ? 0 : i % 5 == 1 ? 1 : draw.uniform(0, 1);
        score.period = 1 + static_cast<int64_t>(draw.below(12000));
        const locus_pmq_query q = query();
        const size_t k = 1 + draw.below(draw.chance(0.1) ? 30000 : 150);
        const Site centre(at.latitude, at.longitude);
        const auto ids = wanted(q, k, [&](const Item &item) {
            const double distance = centre.distance_to({item.latitude, item.longitude});
            const auto age = static_cast<double>(filled_now - item.time);
            if (distance > score.radius || age > static_cast<double>(score.period))
                return -1.0;
            return score.alpha * (distance / score.radius) +
                   (1 - score.alpha) * (age / static_cast<double>(score.period));
        });
        found += ids.size();
        for (locus_pmq *pmq : stores.stores) {
            std::vector<locus_point32> records(k);
            std::vector<double> scores(k);
            size_t count = 0;
            ASSERT_EQ(locus_pmq_topk(pmq, &score, &q, k, records.data(), scores.data(), &count), LOCUS_OK);
            records.resize(count);
            ASSERT_EQ(FilledStores::ids_of(records), ids);
            EXPECT_TRUE(std::is_sorted(scores.begin(), scores.begin() + static_cast<ptrdiff_t>(count)));
        }
    }
    EXPECT_GT(found, 5000u);
}

TEST_F(Rankings, NearestIsTheHeadOfASort) {
    for (int i = 0; i < 100; ++i) {
        const Item at = draw.place();
        const locus_pmq_query q = query();
        const size_t k = 1 + draw.below(draw.chance(0.1) ? 30000 : 150);
        const Site centre(at.latitude, at.longitude);
        const auto ids = wanted(q, k, [&](const Item &item) {
            return centre.distance_to({item.latitude, item.longitude});
        });
        for (locus_pmq *pmq : stores.stores) {
            std::vector<locus_point32> records(k);
            size_t count = 0;
            ASSERT_EQ(locus_pmq_nearest(pmq, at.latitude, at.longitude, &q, k, records.data(), nullptr, &count),
                      LOCUS_OK);
            records.resize(count);
            ASSERT_EQ(FilledStores::ids_of(records), ids);
        }
    }
}

} // namespace
} // namespace locus::test
