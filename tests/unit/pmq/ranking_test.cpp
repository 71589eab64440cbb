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
        const locus_pmq_query q = draw_times_and_filter(draw);
        const size_t k = 1 + draw.below(draw.chance(0.1) ? 30000 : 150);
        const Site centre(at.latitude, at.longitude);
        const FilledStores::Ranked best = stores.ranked_by(q, k, [&](const Item &item) {
            const double distance = centre.distance_to({item.latitude, item.longitude});
            const auto age = static_cast<double>(filled_now - item.time);
            if (distance > score.radius || age > static_cast<double>(score.period))
                return -1.0;
            return score.alpha * (distance / score.radius) +
                   (1 - score.alpha) * (age / static_cast<double>(score.period));
        });
        found += best.size();
        for (locus_pmq *pmq : stores.stores) {
            std::vector<locus_point32> records(k);
            std::vector<double> scores(k);
            size_t count = 0;
            ASSERT_EQ(locus_pmq_topk(pmq, &score, &q, k, records.data(), scores.data(), &count), LOCUS_OK);
            ASSERT_EQ(FilledStores::ranked(records, scores, count), best);
        }
    }
    EXPECT_GT(found, 5000u);
}

TEST_F(Rankings, NearestIsTheHeadOfASort) {
    for (int i = 0; i < 100; ++i) {
        const Item at = draw.place();
        const locus_pmq_query q = draw_times_and_filter(draw);
        const size_t k = 1 + draw.below(draw.chance(0.1) ? 30000 : 150);
        ASSERT_NO_FATAL_FAILURE(stores.expect_nearest(at, q, k));
    }
}

} // namespace
} // namespace locus::test
