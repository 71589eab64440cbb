// Heat maps: how many records of the store lie on each pixel of a view, on a map of the land.
#pragma once

#include "common/canvas.hpp"
#include "stream/view.hpp"

#include <locus/pmq.h>

#include <string>
#include <vector>

namespace demo {

// Records per pixel, row by row from the north-west, out of the store's tiles.
std::vector<uint32_t> counts_of(const View &view, const locus_pmq *store);

struct Label {
    Position position;
    std::string text;
    bool event = false; // with a ring around it
};

struct MapText {
    std::string title;
    std::string subtitle;
    std::vector<Label> labels;
    bool solar_hours = false; // mark the local solar time of `clock` at the upper edge
    int64_t clock = 0;        // microseconds since the epoch
};

// The picture: heading, map, legend.
Canvas draw_map(const View &view, const World &world, const std::vector<uint32_t> &counts, const MapText &text);

// The colours of such pictures, for a palette: but for blends at the edges of lines, all of them.
std::vector<Colour> map_colours();

} // namespace demo
