// Every query on real positions against looking at each: the places of the world, and taxis, many of which stand still.
#include "tests/unit/pmq/filled_stores.hpp"

#include <locus/records.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>

namespace locus::test {
namespace {

// To 2^-40 degrees, so that whole numbers decide what lies in a polygon.
__extension__ typedef __int128 Wide;
Wide whole(double degrees) { return std::llrint(std::ldexp(degrees, 40)); }
double snap(double degrees) { return std::ldexp(static_cast<double>(whole(degrees)), -40); }

std::vector<Item> places() {
    std::ifstream file("examples/data/places.tsv");
    std::vector<Item> items;
    for (std::string line; std::getline(file, line);) {
        std::istringstream fields(line);
        Item item;
        if (fields >> item.latitude >> item.longitude) {
            item.time = static_cast<int64_t>(items.size()) * 7 % 5000;
            items.push_back(item);
        }
    }
    return items;
}

// The first ones, with their times; none where the data are not.
std::vector<Item> taxis(size_t count) {
    const char *folder = std::getenv("LOCUS_DATA");
    const std::string path =
        std::string(folder ? folder : "../shared/data") + "/taxis/cabspotting-sf-2008-05-18_31.csv.zst";
    locus_records_options options;
    EXPECT_EQ(locus_records_options_init(&options, sizeof options), LOCUS_OK);
    options.record = LOCUS_RECORD_POINT32;
    locus_records *reader = nullptr;
    std::vector<Item> items;
    if (locus_records_open(path.c_str(), &options, &reader) != LOCUS_OK)
        return items;
    std::vector<locus_point32> records(count);
    for (size_t got = 1; got > 0 && items.size() < count;) {
        if (locus_records_next(reader, records.data(), count - items.size(), &got) != LOCUS_OK)
            break; // built without zstd
        for (size_t i = 0; i < got; ++i)
            items.push_back({records[i].latitude, records[i].longitude, records[i].time, 0, 0});
    }
    locus_records_close(reader);
    return items;
}

// A triangle of records: on an edge, or inside, in whole numbers.
bool in_triangle(const locus_position (&corners)[3], const Item &item) {
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
        const locus_position &a = corners[i], &b = corners[(i + 1) % 3];
        const Wide turn = (whole(b.longitude) - whole(a.longitude)) * (whole(item.latitude) - whole(a.latitude)) -
                          (whole(b.latitude) - whole(a.latitude)) * (whole(item.longitude) - whole(a.longitude));
        left += turn > 0;
        right += turn < 0;
    }
    return left == 0 || right == 0;
}

class RealData : public testing::TestWithParam<const char *> {
protected:
    static std::vector<Item> load() {
        std::vector<Item> items = GetParam() == std::string("places") ? places() : taxis(40'000);
        for (size_t i = 0; i < items.size(); ++i) {
            items[i].id = i + 1;
            items[i].latitude = snap(items[i].latitude);
            items[i].longitude = snap(items[i].longitude);
        }
        return items;
    }
    static int64_t newest(const std::vector<Item> &items) {
        return std::accumulate(items.begin(), items.end(), INT64_MIN,
                               [](int64_t time, const Item &item) { return std::max(time, item.time); });
    }
    static int64_t span(const std::vector<Item> &items) {
        const auto [first, last] = std::minmax_element(items.begin(), items.end(),
                                                       [](const Item &a, const Item &b) { return a.time < b.time; });
        return last->time - first->time;
    }

    const Item &any() { return stores.items[draw.below(stores.items.size())]; }
    locus_pmq_query query() {
        locus_pmq_query query = default_query();
        if (draw.chance(0.3)) {
            query.time_from = any().time;
            query.time_to = std::max(query.time_from, any().time);
        }
        if (draw.chance(0.2))
            query.filter = every_third;
        return query;
    }

    const std::vector<Item> all = load();
    const int64_t now = all.empty() ? 0 : newest(all);
    Places draw{61};
    FilledStores stores{all, now, all.empty() ? 1 : span(all) * 3 / 4};
};

TEST_P(RealData, IsFoundInRegionsWithRecordsOnTheirBorders) {
    if (all.empty())
        GTEST_SKIP() << "no " << GetParam() << " in the folder named by LOCUS_DATA";
    ASSERT_GT(stores.items.size(), 20'000u);
    for (int i = 0; i < 25 && !HasFailure(); ++i) {
        locus_pmq_query q = query();
        const Item a = any(), b = any(), c = any();
        q.region = LOCUS_REGION_BOX;
        q.box = {std::min(a.latitude, b.latitude), a.longitude, std::max(a.latitude, b.latitude), b.longitude};
        stores.expect_selected(q, [&](const Item &item) { return in_box(q.box, item); });
        q.region = LOCUS_REGION_CIRCLE;
        q.circle = {a.latitude, a.longitude, 0};
        stores.expect_selected(
            q, [&](const Item &item) { return item.latitude == a.latitude && item.longitude == a.longitude; });
        q.circle.radius = static_cast<double>(haversine(a.latitude, a.longitude, b)) * 1.0000001;
        stores.expect_selected(
            q, [&](const Item &item) { return haversine(a.latitude, a.longitude, item) <= q.circle.radius; });
        const locus_position corners[3] = {
            {a.latitude, a.longitude}, {b.latitude, b.longitude}, {c.latitude, c.longitude}};
        const uint64_t three = 3;
        q.region = LOCUS_REGION_POLYGON;
        q.polygon = {corners, &three, 1};
        uint64_t count = 0;
        if (locus_pmq_count(stores.stores[0], &q, &count) == LOCUS_OK) // not two of one place
            stores.expect_selected(q, [&](const Item &item) { return in_triangle(corners, item); });
    }
}

TEST_P(RealData, IsRankedAndSummedUp) {
    if (all.empty())
        GTEST_SKIP() << "no " << GetParam() << " in the folder named by LOCUS_DATA";
    for (int i = 0; i < 25 && !HasFailure(); ++i) {
        const locus_pmq_query q = query();
        const Item at = any();
        ASSERT_NO_FATAL_FAILURE(stores.expect_nearest(at, q, 1 + draw.below(300)));
        const auto zoom = static_cast<uint32_t>(draw.below(20));
        const MapPoint point = map_point(at.latitude, at.longitude);
        const auto x = static_cast<uint32_t>(map_cell(point.x, zoom)),
                   y = static_cast<uint32_t>(map_cell(point.y, zoom));
        std::vector<uint32_t> wanted(65536), bins(65536);
        for (const Item &item : stores.items) {
            const MapPoint there = map_point(item.latitude, item.longitude);
            const uint64_t column = map_cell(there.x, zoom + 8), row = map_cell(there.y, zoom + 8);
            if (selects(q, item) && column >> 8 == x && row >> 8 == y)
                ++wanted[row % 256 * 256 + column % 256];
        }
        for (const locus_pmq *pmq : stores.stores) {
            ASSERT_EQ(locus_pmq_tile(pmq, zoom, x, y, 8, &q, bins.data(), bins.size(), nullptr), LOCUS_OK);
            ASSERT_EQ(bins, wanted) << zoom << "/" << x << "/" << y;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Positions, RealData, testing::Values("places", "taxis"),
                         [](const auto &instance) { return std::string(instance.param); });

} // namespace
} // namespace locus::test
