// The Z-curve over the Web-Mercator square: keys of places, quadrants of the map and the key ranges they cover.
// Source: thesis section 3.2.2 and 3.2.3 (Morton codes, linear quadtrees).
#pragma once

#include <cstdint>

namespace locus {

constexpr unsigned key_levels = 25;                                 // the quadtree's depth: tiles at zoom 25
constexpr uint64_t key_end = uint64_t{1} << (2 * key_levels);       // one past the last key
constexpr double mercator_latitude = 85.05112877980659;             // where the Web-Mercator square ends
constexpr double last_coordinate = 1.0 - 0x1p-40;                   // below 1 at every level in use
constexpr uint64_t key_x_mask = 0x5555555555555555 & (key_end - 1); // the bits of x; y has the others, the higher ones
constexpr uint64_t key_y_mask = 0xAAAAAAAAAAAAAAAA & (key_end - 1);

// Keys lo <= key < hi.
struct KeyRange {
    uint64_t lo = 0;
    uint64_t hi = key_end;
    bool contains(uint64_t key) const noexcept { return key - lo < hi - lo; }
    bool operator==(const KeyRange &) const = default;
};

// Spread the 32 bits of `v` to the even bits of the result, and gather them again.
constexpr uint64_t spread_bits(uint32_t v) noexcept {
    uint64_t x = v;
    x = (x | x << 16) & 0x0000FFFF0000FFFF;
    x = (x | x << 8) & 0x00FF00FF00FF00FF;
    x = (x | x << 4) & 0x0F0F0F0F0F0F0F0F;
    x = (x | x << 2) & 0x3333333333333333;
    return (x | x << 1) & 0x5555555555555555;
}
constexpr uint32_t gather_bits(uint64_t x) noexcept {
    x &= 0x5555555555555555;
    x = (x | x >> 1) & 0x3333333333333333;
    x = (x | x >> 2) & 0x0F0F0F0F0F0F0F0F;
    x = (x | x >> 4) & 0x00FF00FF00FF00FF;
    x = (x | x >> 8) & 0x0000FFFF0000FFFF;
    return static_cast<uint32_t>(x | x >> 16);
}
constexpr uint64_t morton(uint32_t x, uint32_t y) noexcept { return spread_bits(x) | spread_bits(y) << 1; }
constexpr uint32_t morton_x(uint64_t code) noexcept { return gather_bits(code); }
constexpr uint32_t morton_y(uint64_t code) noexcept { return gather_bits(code >> 1); }

// A place in the unit square of the Web-Mercator map: x eastwards from -180 degrees, y southwards from the northern
// edge, both in [0, 1). 180 degrees is the meridian of -180 and has x = 0; latitudes beyond the square are clamped to
// its edge. Latitudes must be -90..90, longitudes -180..180.
struct MapPoint {
    double x, y;
};
MapPoint map_point(double latitude, double longitude) noexcept;
// The number of the map's column or row of `1 << level` ones, level 0..33, in which a coordinate lies.
inline uint64_t map_cell(double coordinate, unsigned level) noexcept {
    return static_cast<uint64_t>(coordinate * static_cast<double>(uint64_t{1} << level));
}

// The key of a place; see map_point.
uint64_t key_of(double latitude, double longitude) noexcept;

// The longitude and the latitude in degrees of the western and the northern edge of a column and a row of `1 << level`.
double map_longitude(uint32_t x, unsigned level) noexcept;
double map_latitude(uint32_t y, unsigned level) noexcept;

// A node of the quadtree: the tile (level, x, y), which covers one range of keys.
struct Quadrant {
    unsigned level = 0; // 0 (the world) .. key_levels
    uint64_t code = 0;  // the Morton code of x and y, 2 * level bits

    static Quadrant of_tile(unsigned level, uint32_t x, uint32_t y) noexcept { return {level, morton(x, y)}; }
    uint32_t x() const noexcept { return morton_x(code); }
    uint32_t y() const noexcept { return morton_y(code); }
    // One of the four quadrants within, in the order of their keys.
    Quadrant child(unsigned number) const noexcept { return {level + 1, code << 2 | number}; }
    unsigned shift() const noexcept { return 2 * (key_levels - level); }
    KeyRange keys() const noexcept { return {code << shift(), (code + 1) << shift()}; }
};

} // namespace locus
