// Keys, quadrants and the projection.
#include "core/zcurve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace locus;

TEST(Zcurve, InterleavesBitByBit) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto x = static_cast<uint32_t>(random()), y = static_cast<uint32_t>(random());
        uint64_t code = 0;
        for (int bit = 0; bit < 32; ++bit)
            code |= uint64_t{x >> bit & 1} << (2 * bit) | uint64_t{y >> bit & 1} << (2 * bit + 1);
        ASSERT_EQ(morton(x, y), code);
        ASSERT_EQ(morton_x(code), x);
        ASSERT_EQ(morton_y(code), y);
    }
}

TEST(Zcurve, QuadrantsSplitTheirKeysInOrder) {
    const Quadrant tile = Quadrant::of_tile(5, 17, 9);
    EXPECT_EQ(tile.x(), 17u);
    EXPECT_EQ(tile.y(), 9u);
    uint64_t next = tile.keys().lo;
    for (unsigned number = 0; number < 4; ++number) {
        const Quadrant child = tile.child(number);
        EXPECT_EQ(child.keys().lo, next);
        EXPECT_EQ(child.x(), 2 * 17 + (number & 1));
        EXPECT_EQ(child.y(), 2 * 9 + (number >> 1));
        next = child.keys().hi;
    }
    EXPECT_EQ(next, tile.keys().hi);
    EXPECT_EQ(Quadrant{}.keys(), (KeyRange{0, key_end}));
    EXPECT_FALSE((KeyRange{5, 9}).contains(4));
    EXPECT_TRUE((KeyRange{5, 9}).contains(5));
    EXPECT_FALSE((KeyRange{5, 9}).contains(9));
}

// The textbook formula, unlike the library's own.
TEST(Zcurve, KeysAreWebMercatorTiles) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> latitudes(-85, 85), longitudes(-180, 180);
    for (int i = 0; i < 20000; ++i) {
        const double latitude = latitudes(random), longitude = longitudes(random);
        const double radians = latitude * std::numbers::pi / 180;
        const double x = (longitude + 180) / 360 * (1 << 25);
        const double y = (1 - std::log(std::tan(radians) + 1 / std::cos(radians)) / std::numbers::pi) / 2 * (1 << 25);
        const uint64_t key = key_of(latitude, longitude);
        ASSERT_EQ(morton_x(key), static_cast<uint32_t>(x));
        ASSERT_NEAR(morton_y(key), y - 0.5, 0.5 + 1e-6);
    }
}

TEST(Zcurve, TheEdgesOfTheMap) {
    constexpr uint32_t last = (1u << key_levels) - 1;
    EXPECT_EQ(key_of(90, -180), 0u);
    EXPECT_EQ(key_of(mercator_latitude, -180), 0u);
    EXPECT_EQ(key_of(-90, std::nextafter(180.0, 0.0)), morton(last, last));
    EXPECT_EQ(key_of(-mercator_latitude, 0), key_of(-90, 0));
    EXPECT_EQ(key_of(12, 180), key_of(12, -180)) << "one meridian";
    EXPECT_EQ(key_of(0, 0), morton(1u << 24, 1u << 24));
    for (const double latitude : {-90.0, -89.0, -85.06, 85.06, 90.0}) {
        const MapPoint point = map_point(latitude, 0);
        EXPECT_GE(point.y, 0.0);
        EXPECT_LT(point.y, 1.0);
        EXPECT_LT(map_cell(point.y, 33), uint64_t{1} << 33);
    }
}

TEST(Zcurve, NorthernAndWesternEdgesOfTilesComeBack) {
    for (unsigned level = 1; level <= key_levels; level += 3)
        for (uint32_t cell = 0; cell < 1u << level; cell += std::max(1u, (1u << level) / 37)) {
            const double step = std::ldexp(0.5, -static_cast<int>(level));
            EXPECT_NEAR(map_point(0, map_longitude(cell, level)).x, 2 * step * cell, 1e-14);
            EXPECT_NEAR(map_point(map_latitude(cell, level), 0).y, 2 * step * cell, 1e-13);
        }
}

} // namespace
