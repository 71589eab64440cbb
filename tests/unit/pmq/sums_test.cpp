// Weighted tiles and groups against sums over all records, bit for bit.
#include "tests/unit/pmq/filled_stores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace locus::test {
namespace {

double weight_of(uint64_t id) { return std::sqrt(static_cast<double>(id)) - 60; }
double weigh(const void *record, void *) { return weight_of(unpack(record, LOCUS_RECORD_POINT32).id); }

class Sums : public testing::Test {
protected:
    Sums() : draw(41), stores(draw_items(draw, 12000)) {}

    Places draw;
    FilledStores stores;
};

// Of any size and zoom, finer than the keys too, plain and weighted: these add up in the store's order.
TEST_F(Sums, TilesHoldWhatLiesInTheirBins) {
    for (int i = 0; i < 150; ++i) {
        const locus_pmq_query q = draw_times_and_filter(draw);
        const auto zoom = static_cast<uint32_t>(draw.below(26)), log2_bins = static_cast<uint32_t>(draw.below(9));
        const Item at = draw.place();
        const MapPoint corner = map_point(at.latitude, at.longitude);
        const auto x = static_cast<uint32_t>(map_cell(corner.x, zoom)),
                   y = static_cast<uint32_t>(map_cell(corner.y, zoom));
        const size_t side = size_t{1} << log2_bins;
        std::vector<double> wanted(side * side);
        std::vector<uint32_t> wanted_counts(side * side);
        double sum = 0;
        uint64_t counted = 0;
        for (const Item &item : stores.items) {
            const MapPoint point = map_point(item.latitude, item.longitude);
            const uint64_t column = map_cell(point.x, zoom + log2_bins), row = map_cell(point.y, zoom + log2_bins);
            if (!selects(q, item) || column >> log2_bins != x || row >> log2_bins != y)
                continue;
            wanted[row % side * side + column % side] += weight_of(item.id);
            ++wanted_counts[row % side * side + column % side];
            sum += weight_of(item.id);
            ++counted;
        }
        for (const locus_pmq *pmq : stores.stores) {
            std::vector<double> bins(side * side, 5);
            double total = 5;
            ASSERT_EQ(locus_pmq_weighted_tile(pmq, zoom, x, y, log2_bins, &q, weigh, nullptr, bins.data(), bins.size(),
                                              &total),
                      LOCUS_OK);
            ASSERT_EQ(bins, wanted) << zoom << "/" << x << "/" << y << " with 2^" << log2_bins << " bins";
            EXPECT_EQ(total, sum);
            std::vector<uint32_t> counts(side * side, 5);
            uint64_t count = 5;
            ASSERT_EQ(locus_pmq_tile(pmq, zoom, x, y, log2_bins, &q, counts.data(), counts.size(), &count), LOCUS_OK);
            ASSERT_EQ(counts, wanted_counts) << zoom << "/" << x << "/" << y << " with 2^" << log2_bins << " bins";
            EXPECT_EQ(count, counted);
        }
    }
}

// The tiles of a zoom share their borders: together they hold every record once.
TEST_F(Sums, TilesOfAZoomSumToTheCount) {
    const auto one = [](const void *, void *) { return 1.0; };
    for (const locus_pmq *pmq : stores.stores) {
        for (uint32_t zoom = 0; zoom <= 6; ++zoom) {
            const locus_pmq_query q = zoom % 2 ? draw_times_and_filter(draw) : default_query();
            const auto all = stores.selected(q, [](const Item &) { return true; }).size();
            uint64_t counted = 0;
            double weighed = 0;
            for (uint32_t x = 0; x < 1u << zoom; ++x) {
                for (uint32_t y = 0; y < 1u << zoom; ++y) {
                    std::vector<uint32_t> bins(16);
                    std::vector<double> sums(16);
                    uint64_t count = 0;
                    double sum = 0;
                    ASSERT_EQ(locus_pmq_tile(pmq, zoom, x, y, 2, &q, bins.data(), 16, &count), LOCUS_OK);
                    ASSERT_EQ(locus_pmq_weighted_tile(pmq, zoom, x, y, 2, &q, one, nullptr, sums.data(), 16, &sum),
                              LOCUS_OK);
                    EXPECT_TRUE(std::equal(bins.begin(), bins.end(), sums.begin()));
                    EXPECT_EQ(count, std::accumulate(bins.begin(), bins.end(), uint64_t{0}));
                    counted += count;
                    weighed += sum;
                }
            }
            EXPECT_EQ(counted, all);
            EXPECT_EQ(weighed, static_cast<double>(all));
        }
    }
}

TEST_F(Sums, AWeightThatIsNoNumberIsRefused) {
    double bins[4];
    const auto bad = [](const void *, void *) { return std::numeric_limits<double>::quiet_NaN(); };
    for (const locus_pmq *pmq : stores.stores)
        EXPECT_EQ(locus_pmq_weighted_tile(pmq, 0, 0, 0, 1, nullptr, bad, nullptr, bins, 4, nullptr), LOCUS_E_ARGUMENT);
}

using Counts = std::vector<std::pair<uint64_t, std::pair<uint64_t, int64_t>>>;

TEST_F(Sums, GroupsAreTheLargestFirst) {
    struct Choice {
        uint32_t field;
        std::function<uint64_t(uint64_t id)> of;
    };
    // The id lies in the fields: see pack().
    const Choice choices[] = {{LOCUS_FIELD_DEVICE, [](uint64_t id) { return id & 0xFFFF; }},
                              {LOCUS_FIELD_APPLICATION, [](uint64_t id) { return id >> 16 & 0xFFFF; }},
                              {LOCUS_FIELD_LANGUAGE, [](uint64_t id) { return id >> 32 & 0xFFFF; }},
                              {LOCUS_FIELD_CALLER, [](uint64_t id) { return id * id % 97 + (uint64_t{1} << 40); }}};
    for (int i = 0; i < 40; ++i) {
        locus_pmq_query q = draw_times_and_filter(draw);
        const bool boxed = draw.chance(0.5);
        if (boxed) {
            q.region = LOCUS_REGION_BOX;
            q.box = draw.box();
        }
        for (const auto &[field, of] : choices) {
            std::map<uint64_t, std::pair<uint64_t, int64_t>> all;
            for (const Item &item : stores.items) {
                if (!selects(q, item) || (boxed && !in_box(q.box, item)))
                    continue;
                auto &[count, newest] = all.try_emplace(of(item.id), 0, item.time).first->second;
                ++count;
                newest = std::max(newest, item.time);
            }
            Counts wanted(all.begin(), all.end());
            std::stable_sort(wanted.begin(), wanted.end(),
                             [](const auto &a, const auto &b) { return a.second.first > b.second.first; });
            for (const locus_pmq *pmq : stores.stores) {
                const size_t capacity = draw.below(wanted.size() + 3);
                std::vector<locus_pmq_group> groups(capacity);
                size_t count = 0;
                const locus_status status = locus_pmq_groups(
                    pmq, &q, field,
                    [](const void *record, void *user) {
                        return (*static_cast<const std::function<uint64_t(uint64_t)> *>(user))(
                            unpack(record, LOCUS_RECORD_POINT32).id);
                    },
                    const_cast<std::function<uint64_t(uint64_t)> *>(&of), groups.data(), capacity, &count);
                ASSERT_EQ(status, capacity < wanted.size() ? LOCUS_E_CAPACITY : LOCUS_OK) << locus_last_error();
                ASSERT_EQ(count, wanted.size());
                for (size_t g = 0; g < std::min(capacity, count); ++g) {
                    EXPECT_EQ(groups[g].value, wanted[g].first);
                    EXPECT_EQ(groups[g].count, wanted[g].second.first);
                    EXPECT_EQ(groups[g].newest, wanted[g].second.second);
                }
            }
        }
    }
}

} // namespace
} // namespace locus::test
