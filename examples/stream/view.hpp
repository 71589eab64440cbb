// A part of the Web-Mercator world as a picture shows it: one pixel is one bin of the store's heat-map tiles.
#pragma once

#include "common/world.hpp"

#include <locus/pmq.h>

#include <cstdint>

namespace demo {

// At level k the world is 2^k pixels wide and high. The picture shows width x height of them from (left, top).
struct View {
    uint32_t level = 10;
    int64_t left = 0;
    int64_t top = 0;
    int width = 0;
    int height = 0;

    // The point in the picture, in pixels; longitudes are those nearest to the picture's middle.
    double x(double longitude) const;
    double y(double latitude) const;
    Position position(double x, double y) const;
    double pixel_km() const; // at the picture's middle
};

// The inhabited world, 2^level pixels wide.
View world_view(uint32_t level);

// A picture of width x height pixels, around `centre`, that shows `km` from west to east or a little more.
View zoom_view(Position centre, double km, int width, int height);

locus_box box_of(const View &view);

} // namespace demo
