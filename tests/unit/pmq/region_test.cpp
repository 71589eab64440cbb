// Boxes: what they say about quadrants must never contradict what they say about places.
#include "pmq/query/region.hpp"

#include "core/error.hpp"
#include "tests/unit/pmq/items.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace locus::test {
namespace {

using pmq::BoxRegion;
using pmq::Relation;

TEST(BoxRegion, QuadrantsAgreeWithPlaces) {
    Places draw(5);
    for (int b = 0; b < 400; ++b) {
        const locus_box box = draw.box();
        const BoxRegion region(box);
        for (int i = 0; i < 100; ++i) {
            Item item = draw.place();
            if (draw.chance(0.3))
                item.latitude = draw.chance(0.5) ? box.south : box.north;
            if (draw.chance(0.3))
                item.longitude = draw.chance(0.5) ? box.west : box.east;
            if (draw.chance(0.2))
                item.latitude = std::clamp(std::nextafter(item.latitude, draw.chance(0.5) ? 90.0 : -90.0), -90.0, 90.0);
            const bool inside = in_box(box, item);
            ASSERT_EQ(region.contains(item.latitude, item.longitude), inside);
            const uint64_t key = key_of(item.latitude, item.longitude);
            ASSERT_NE(region.relate(key), inside ? Relation::outside : Relation::inside);
            for (unsigned level = 0; level <= key_levels; ++level)
                ASSERT_NE(region.relate(Quadrant{level, key >> 2 * (key_levels - level)}),
                          inside ? Relation::outside : Relation::inside);
        }
    }
}

TEST(BoxRegion, IsNotVagueWithoutNeed) {
    EXPECT_EQ(BoxRegion({-90, -180, 90, 180}).relate(Quadrant{}), Relation::inside);
    const BoxRegion quarter({0, 0, 90, 180}); // the north-eastern one
    EXPECT_EQ(quarter.relate(Quadrant::of_tile(2, 3, 0)), Relation::inside);
    EXPECT_EQ(quarter.relate(Quadrant::of_tile(2, 1, 3)), Relation::outside);
    EXPECT_EQ(quarter.relate(Quadrant::of_tile(1, 1, 0)), Relation::edge);
    const BoxRegion pacific({-10, 170, 10, -170});
    EXPECT_EQ(pacific.relate(Quadrant{}), Relation::edge);
    EXPECT_EQ(pacific.relate(Quadrant::of_tile(6, 63, 31)), Relation::inside);
    EXPECT_EQ(pacific.relate(Quadrant::of_tile(6, 0, 32)), Relation::inside);
    EXPECT_EQ(pacific.relate(Quadrant::of_tile(6, 30, 31)), Relation::outside);
}

TEST(BoxRegion, RefusesWhatIsNoBox) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const locus_box &box : {locus_box{nan, 0, 1, 1}, locus_box{0, nan, 1, 1}, locus_box{0, 0, nan, 1},
                                 locus_box{0, 0, 1, nan}, locus_box{-91, 0, 1, 1}, locus_box{0, 0, 91, 1},
                                 locus_box{0, -181, 1, 1}, locus_box{0, 0, 1, 181}, locus_box{2, 0, 1, 1}})
        EXPECT_THROW(BoxRegion{box}, Error);
}

} // namespace
} // namespace locus::test
