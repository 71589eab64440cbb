// The choice of word width, label bits and scale when a graph is made.
#pragma once

#include "core/word.hpp"

#include <cstdint>

namespace locus::graph {

// What the choice depends on. A "share" is a number that gets rounded to steps: half an edge's weight where the weight
// is a sum of two halves, a whole weight elsewhere; here in units of distance.
struct ScalingNeeds {
    uint32_t word_bits; // LOCUS_WORD_
    uint32_t label_bits;
    double scale;          // > 0: taken as it is; 0: to be chosen
    double precision;      // largest relative rounding error wanted
    double smallest_share; // > 0
    double largest_share;
    double shares_per_edge; // 1 or 2
    double longest_path;    // no shortest path is longer, in units of distance,
    double shares_in_path;  // nor made of more shares
};

struct Scaling {
    WordLayout layout;
    double scale;
};

// The relative error of a share of `steps` steps before rounding.
double rounding_error(double steps);

// The smallest width in which no path can overflow at the precision wanted, and in it the largest such scale; where 64
// bits (or the width asked for) cannot guarantee that, the smallest scale that keeps the precision. Chosen scales are
// powers of two where one lies in between. Throws LOCUS_E_RANGE where a single edge would not fit.
Scaling choose_scaling(const ScalingNeeds &needs);

} // namespace locus::graph
