// What a heat-map tile shows: counts per bin, smoothed or not, and the scale that turns them into colours.
#pragma once

#include "common/colour_map.hpp"

#include <locus/pmq.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace explorer {

struct TilePlace {
    uint32_t zoom = 0, x = 0, y = 0;
};

// How counts become heat.
struct Grain {
    uint32_t log2_bins = 8;
    uint32_t blur = 0; // times that the kernel 1 2 1 is applied, both ways
    uint32_t bins() const { return 1u << log2_bins; }
};

// Bins row by row from the north-west.
std::vector<uint32_t> counts_of(const locus_pmq *store, const TilePlace &place, uint32_t log2_bins,
                                const locus_pmq_query &query, uint64_t *total = nullptr);

// How tiles are counted: by the store, or by who remembers.
using Count = std::function<std::vector<uint32_t>(const TilePlace &place, uint32_t log2_bins)>;

// The counts of a tile as numbers, smoothed across its borders, too: `beside` counts what its neighbours give.
std::vector<float> heat_of(const std::vector<uint32_t> &counts, const TilePlace &place, const Grain &grain,
                           const Count &beside);

// The densest tile of each zoom: down to 8 of all, deeper of those in the densest one 8 above, and so on.
using Peaks = std::array<TilePlace, 26>;
Peaks peaks_of(const Count &count);

// What the heat of a zoom is measured by: that of its densest place.
struct Reference {
    static constexpr size_t parts = 8;
    double high = 1;                           // the greatest, rounded up to 1, 2 or 5 times a power of ten
    std::array<double, parts + 1> quantiles{}; // of the bins there that are not empty: least, eighths, greatest
};

Reference reference_of(std::vector<float> heat, const Grain &grain);

enum class ScaleKind { linear, log, quantile };

// Heat as a place along the colours, 0..1, and back.
class Scale {
public:
    Scale(ScaleKind kind, const Grain &grain, const Reference &reference);

    double low() const { return low_; }
    double high() const { return high_; }
    bool shows(double heat) const { return heat > least_; } // less is transparent
    double place(double heat) const;
    double value(double place) const;

private:
    ScaleKind kind_;
    double least_, low_, high_;
    std::array<double, Reference::parts + 1> quantiles_;
};

// The colour at a place of the scale; the dark end of a map is left out, for it would not be seen on a dark ground.
demo::Colour scale_colour(demo::ColourMap map, double place);

// The tile as a PNG file: 256 x 256 pixels, transparent where nothing is.
std::string tile_png(const std::vector<float> &heat, const Grain &grain, const Scale &scale, demo::ColourMap map);

} // namespace explorer
