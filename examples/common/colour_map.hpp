// Colour maps: numbers and labels as colours, and a legend for them.
#pragma once

#include "common/canvas.hpp"

#include <string>
#include <vector>

namespace demo {

enum class ColourMap { inferno, magma, viridis, grey };

// The colour of `value`, 0 (dark) to 1 (bright), clamped.
Colour colour_of(ColourMap map, double value);

// A colour for a label: neighbouring numbers get clearly different hues.
Colour label_colour(uint32_t label);

// Marks of a legend: where (0..1 along the scale) and what to write there.
struct Mark {
    double where;
    std::string text;
};

// A horizontal bar of the map's colours, from that of `darkest` to the brightest, with marks under it.
void draw_legend(Canvas &canvas, int x, int y, int width, int height, ColourMap map, const std::vector<Mark> &marks,
                 Colour ink, double darkest = 0);

} // namespace demo
