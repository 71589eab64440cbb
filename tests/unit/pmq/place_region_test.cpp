// Circles and polygons: against independent formulas, on quadrants, and in stores of every layout.
#include "pmq/query/circle.hpp"
#include "pmq/query/polygon.hpp"

#include "core/error.hpp"
#include "tests/unit/pmq/filled_stores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace locus::test {
namespace {

using pmq::CircleRegion;
using pmq::PolygonRegion;
using pmq::Region;
using pmq::Relation;

// What a region says about the quadrants around a place must not contradict what it says about the place.
void expect_agreement(const Region &region, const Item &item, bool inside) {
    ASSERT_EQ(region.contains(item.latitude, item.longitude), inside) << item.latitude << ", " << item.longitude;
    const uint64_t key = key_of(item.latitude, item.longitude);
    ASSERT_NE(region.relate(key), inside ? Relation::outside : Relation::inside);
    for (unsigned level = 0; level <= key_levels; ++level)
        ASSERT_NE(region.relate(Quadrant{level, key >> 2 * (key_levels - level)}),
                  inside ? Relation::outside : Relation::inside)
            << "level " << level << ": " << item.latitude << ", " << item.longitude;
}

locus_circle draw_circle(Places &draw) {
    const Item centre = draw.place();
    return {centre.latitude, centre.longitude, std::pow(10.0, draw.uniform(0, 7.3013))};
}

TEST(CircleRegion, AgreesWithTheLawOfHaversines) {
    Places draw(11);
    for (int c = 0; c < 400; ++c) {
        const locus_circle circle = draw_circle(draw);
        const CircleRegion region(circle);
        for (int i = 0; i < 60; ++i) {
            Item item = draw.place();
            if (draw.chance(0.5)) { // near the border
                const double bearing = draw.uniform(0, 6.28), reach = circle.radius / 111195 * draw.uniform(0.9, 1.1);
                item.latitude = std::clamp(circle.latitude + reach * std::cos(bearing), -90.0, 90.0);
                item.longitude = std::remainder(
                    circle.longitude + reach * std::sin(bearing) / std::cos(item.latitude * 0.01745), 360.0);
            }
            const long double distance = haversine(circle.latitude, circle.longitude, item);
            if (std::abs(distance - circle.radius) > 0.01L) // the long double near an antipode
                expect_agreement(region, item, distance <= circle.radius);
            else
                expect_agreement(region, item, region.contains(item.latitude, item.longitude));
            if (HasFatalFailure())
                FAIL() << circle.latitude << ", " << circle.longitude << ", " << circle.radius;
        }
    }
}

TEST(CircleRegion, HoldsItsCentreAndThePoleAtAnyLongitude) {
    EXPECT_TRUE(CircleRegion({12.3, -180, 0}).contains(12.3, 180));
    EXPECT_TRUE(CircleRegion({12.3, 45.6, 0}).contains(12.3, 45.6));
    EXPECT_TRUE(CircleRegion({90, 45.6, 0}).contains(90, -77));
    EXPECT_FALSE(CircleRegion({0, 0, 1}).contains(0, 0.00001));
    EXPECT_TRUE(CircleRegion({0, 0, half_globe()}).contains(0, 180));
    EXPECT_EQ(CircleRegion({48, 2, 1e6}).relate(Quadrant{14, key_of(48, 2) >> 22}), Relation::inside);
    EXPECT_EQ(CircleRegion({48, 2, 1e6}).relate(Quadrant{3, key_of(-48, 2) >> 44}), Relation::outside);
}

TEST(CircleRegion, RefusesWhatIsNoCircle) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const locus_circle &circle :
         {locus_circle{nan, 0, 1}, locus_circle{0, nan, 1}, locus_circle{0, 0, nan}, locus_circle{0, 0, -1},
          locus_circle{0, 0, 20015115}, locus_circle{91, 0, 1}, locus_circle{0, 181, 1}})
        EXPECT_THROW(CircleRegion{circle}, Error);
}

struct Rings {
    std::vector<locus_position> vertices;
    std::vector<uint64_t> sizes;
    locus_polygon polygon() const { return {vertices.data(), sizes.data(), sizes.size()}; }
    void add(std::initializer_list<locus_position> ring) {
        vertices.insert(vertices.end(), ring);
        sizes.push_back(ring.size());
    }
};

// Coordinates on a grid of 1/64 degree, where products fit in 64 bits.
int64_t grid(double degrees) { return std::lround(degrees * 64); }
double snap(double degrees) { return static_cast<double>(grid(degrees)) / 64; }

// A star around a place with `arms` vertices: no edge crosses another.
void add_star(Rings &rings, Places &draw, double latitude, double longitude, double size, size_t arms) {
    std::vector<locus_position> ring;
    for (size_t i = 0; i < arms; ++i) {
        const double bearing = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(arms);
        const double reach = size * draw.uniform(0.5, 1);
        ring.push_back({snap(std::clamp(latitude + reach * std::cos(bearing), -90.0, 90.0)),
                        snap(longitude + reach * std::sin(bearing))});
    }
    rings.vertices.insert(rings.vertices.end(), ring.begin(), ring.end());
    rings.sizes.push_back(arms);
}

// In whole numbers: on an edge, or an odd number of edges to the east.
bool in_rings_at(const Rings &rings, int64_t x, int64_t y) {
    bool inside = false;
    size_t first = 0;
    for (const uint64_t size : rings.sizes) {
        for (size_t i = 0; i < size; ++i) {
            const auto &a = rings.vertices[first + i], &b = rings.vertices[first + (i + 1) % size];
            const int64_t ax = grid(a.longitude), ay = grid(a.latitude), bx = grid(b.longitude), by = grid(b.latitude);
            const int64_t turn = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
            if (turn == 0 && std::min(ax, bx) <= x && x <= std::max(ax, bx) && std::min(ay, by) <= y &&
                y <= std::max(ay, by))
                return true;
            if ((ay > y) != (by > y) && (turn > 0) == (by > ay))
                inside = !inside;
        }
        first += size;
    }
    return inside;
}
bool in_rings(const Rings &rings, const Item &item) {
    for (const int64_t turn : {-360, 0, 360})
        if (in_rings_at(rings, grid(item.longitude) + turn * 64, grid(item.latitude)))
            return true;
    return false;
}

// A star with a hole, and sometimes an island in it; all over the globe.
Rings draw_rings(Places &draw) {
    for (;;) {
        Rings rings;
        const double latitude = draw.chance(0.2) ? 80 : draw.uniform(-60, 60);
        const double longitude = draw.chance(0.4) ? draw.uniform(175, 190) : draw.uniform(-180, 180);
        const double size = draw.uniform(2, 60);
        add_star(rings, draw, latitude, longitude, size, 3 + draw.below(30));
        add_star(rings, draw, latitude, longitude, size * 0.2, 4 + draw.below(8));
        if (draw.chance(0.5))
            add_star(rings, draw, latitude, longitude, size * 0.05, 4);
        try {
            PolygonRegion{rings.polygon()};
            return rings;
        } catch (const Error &) { // clamped or rounded onto itself
        }
    }
}

Item draw_near(Places &draw, const Rings &rings) {
    Item item = draw.place();
    if (draw.chance(0.8)) {
        const auto &a = rings.vertices[draw.below(rings.vertices.size())];
        const auto &b = rings.vertices[draw.below(rings.vertices.size())];
        const double share =
            draw.chance(0.3) ? 0.5 : draw.uniform(0, 1); // the middle lies on the grid, often on an edge
        item.latitude = a.latitude + share * (b.latitude - a.latitude);
        item.longitude = a.longitude + share * (b.longitude - a.longitude);
        if (draw.chance(0.2))
            item = {a.latitude, a.longitude};
    }
    item.latitude = snap(item.latitude);
    item.longitude = snap(item.longitude);
    if (std::abs(item.longitude) > 180)
        item.longitude = std::remainder(item.longitude, 360.0);
    return item;
}

TEST(PolygonRegion, AgreesWithWholeNumbers) {
    Places draw(12);
    size_t inside = 0;
    for (int p = 0; p < 300; ++p) {
        const Rings rings = draw_rings(draw);
        const PolygonRegion region(rings.polygon());
        for (int i = 0; i < 60; ++i) {
            const Item item = draw_near(draw, rings);
            inside += in_rings(rings, item);
            ASSERT_NO_FATAL_FAILURE(expect_agreement(region, item, in_rings(rings, item)));
        }
    }
    EXPECT_GT(inside, 5000u);
    EXPECT_LT(inside, 15000u);
}

TEST(PolygonRegion, IncludesBordersAndLeavesHolesOut) {
    Rings rings;
    rings.add({{0, 170}, {0, 190}, {20, 190}, {20, 170}, {0, 170}}); // closed
    rings.add({{5, 175}, {5, 185}, {15, 185}, {15, 175}});
    const PolygonRegion region(rings.polygon());
    EXPECT_TRUE(region.contains(2, 180));
    EXPECT_TRUE(region.contains(2, -180));
    EXPECT_TRUE(region.contains(20, -170));
    EXPECT_TRUE(region.contains(5, 177)); // the hole's border
    EXPECT_FALSE(region.contains(10, 180));
    EXPECT_FALSE(region.contains(10, -169));
    EXPECT_EQ(region.relate(Quadrant::of_tile(10, 2, 510)), Relation::inside);
    EXPECT_EQ(region.relate(Quadrant::of_tile(6, 30, 30)), Relation::outside);
    Rings world;
    world.add({{-90, -180}, {-90, 180}, {90, 180}, {90, -180}});
    EXPECT_EQ(PolygonRegion(world.polygon()).relate(Quadrant::of_tile(2, 1, 1)), Relation::inside);
    EXPECT_TRUE(PolygonRegion(world.polygon()).contains(90, 180));
}

// Points one rounding away from a slanted edge: the border is exact.
TEST(PolygonRegion, DecidesBesideAnEdge) {
    Rings rings;
    rings.add({{0, 0}, {0.3, 0.1}, {0.3, 0}});
    const PolygonRegion region(rings.polygon());
    EXPECT_TRUE(region.contains(0.15, 0.05));
    EXPECT_FALSE(region.contains(0.15, std::nextafter(0.05, 1)));
    EXPECT_TRUE(region.contains(0.15, std::nextafter(0.05, 0)));
    EXPECT_FALSE(region.contains(std::nextafter(0.15, 0), 0.05));
}

TEST(PolygonRegion, RefusesWhatIsNoPolygon) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](std::initializer_list<std::initializer_list<locus_position>> all) {
        Rings rings;
        for (const auto &ring : all)
            rings.add(ring);
        EXPECT_THROW(PolygonRegion{rings.polygon()}, Error);
    };
    refused({{{nan, 0}, {1, 1}, {0, 1}}});
    refused({{{0, 0}, {1, nan}, {0, 1}}});
    refused({{{0, 0}, {91, 1}, {0, 1}}});
    refused({{{0, 0}, {1, 361}, {0, 1}}});
    refused({{{0, -180}, {1, 181}, {0, 1}}});
    refused({{{0, 0}, {1, 1}}});
    refused({{{0, 0}, {1, 1}, {1, 1}, {0, 0}}});
    refused({{{0, 0}, {2, 2}, {1, 1}}});                                           // flat
    refused({{{0, 0}, {2, 2}, {0, 2}, {2, 0}}});                                   // a bow tie
    refused({{{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}});                   // touches itself in a vertex
    refused({{{0, 0}, {0, 4}, {4, 4}, {0, 2}, {4, 0}}});                           // on its own edge
    refused({{{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {{2, 2}, {2, 6}, {3, 6}, {3, 2}}}); // two rings cross
    refused({{{0, 0}, {0, 4}, {4, 4}, {4, 0}}, {{0, 1}, {0, 2}, {1, 1}}});         // share part of an edge
    EXPECT_THROW(PolygonRegion(locus_polygon{nullptr, nullptr, 0}), Error);
    EXPECT_THROW(PolygonRegion(locus_polygon{nullptr, nullptr, 1}), Error);
    Rings touching; // a hole that touches in a point is fine
    touching.add({{0, 0}, {0, 4}, {4, 4}, {4, 0}});
    touching.add({{0, 2}, {1, 1}, {1, 3}});
    EXPECT_NO_THROW(PolygonRegion{touching.polygon()});
}

TEST(Regions, AreTheSameInEveryLayout) {
    Places draw(13);
    std::vector<Item> items = draw_items(draw, 20000);
    for (Item &item : items) {
        item.latitude = snap(item.latitude);
        item.longitude = snap(item.longitude);
    }
    FilledStores stores(items);
    for (int i = 0; i < 60; ++i) {
        locus_pmq_query query = draw_times_and_filter(draw);
        stores.expect_selected(query, [](const Item &) { return true; });
        query.region = LOCUS_REGION_BOX;
        query.box = draw.box();
        stores.expect_selected(query, [&](const Item &item) { return in_box(query.box, item); });
        query.region = LOCUS_REGION_CIRCLE;
        query.circle = draw_circle(draw);
        query.circle.latitude += 0.001 * (query.circle.latitude < 0 ? 1 : -1); // no record on the border
        stores.expect_selected(query, [&](const Item &item) {
            return haversine(query.circle.latitude, query.circle.longitude, item) <= query.circle.radius;
        });
        const Rings rings = draw_rings(draw);
        query.region = LOCUS_REGION_POLYGON;
        query.polygon = rings.polygon();
        stores.expect_selected(query, [&](const Item &item) { return in_rings(rings, item); });
    }
}

} // namespace
} // namespace locus::test
