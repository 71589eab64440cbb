// Counts, smoothing, scales.
#include "explorer/heat.hpp"

#include "explorer/selection.hpp"

#include <algorithm>
#include <cmath>

namespace explorer {
namespace {

constexpr double darkest = 0.18;

// One tile of the 3 x 3 around `place`, written into the middle or the rim of a grid with a margin.
void add_tile(std::vector<float> &grid, int width, int margin, int bins, int dx, int dy,
              const std::vector<uint32_t> &counts) {
    const int left = margin + dx * bins, top = margin + dy * bins;
    for (int y = std::max(0, -top); y < bins && top + y < width; ++y)
        for (int x = std::max(0, -left); x < bins && left + x < width; ++x)
            grid[static_cast<size_t>((top + y) * width + left + x)] =
                static_cast<float>(counts[static_cast<size_t>(y * bins + x)]);
}

// The kernel 1 2 1 along the rows or, with a stride of a row, the columns. What lies beyond the grid counts as nothing,
// and reaches one bin further in each time: as far as the margin is wide.
void smooth(std::vector<float> &grid, int width, int step, int along) {
    for (int line = 0; line < width; ++line) {
        float before = 0;
        for (int i = 0; i < width; ++i) {
            float &here = grid[static_cast<size_t>(line * along + i * step)];
            const float after = i + 1 < width ? grid[static_cast<size_t>(line * along + (i + 1) * step)] : 0;
            const float old = here;
            here = (before + 2 * here + after) / 4;
            before = old;
        }
    }
}

// 1, 2 or 5 times a power of ten, `value` or more.
double round_up(double value) {
    const double power = std::pow(10, std::floor(std::log10(std::max(value, 1e-3))));
    for (const double factor : {1.0, 2.0, 5.0})
        if (value <= factor * power * (1 + 1e-9))
            return factor * power;
    return 10 * power;
}

// From the whole world down to `zoom`, each time into the fullest bin.
TilePlace densest(const locus_pmq *store, uint32_t zoom, const locus_pmq_query &query) {
    TilePlace place;
    while (place.zoom < zoom) {
        const uint32_t step = std::min(8u, zoom - place.zoom);
        const auto counts = counts_of(store, place, step, query);
        const auto fullest = static_cast<uint32_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
        place = {place.zoom + step, (place.x << step) + (fullest & ((1u << step) - 1)),
                 (place.y << step) + (fullest >> step)};
    }
    return place;
}

} // namespace

std::vector<uint32_t> counts_of(const locus_pmq *store, const TilePlace &place, uint32_t log2_bins,
                                const locus_pmq_query &query, uint64_t *total) {
    std::vector<uint32_t> counts(size_t{1} << 2 * log2_bins);
    check(locus_pmq_tile(store, place.zoom, place.x, place.y, log2_bins, &query, counts.data(), counts.size(), total));
    return counts;
}

std::vector<float> heat_of(const locus_pmq *store, const TilePlace &place, const Grain &grain,
                           const locus_pmq_query &query) {
    if (grain.blur == 0) {
        const auto counts = counts_of(store, place, grain.log2_bins, query);
        return {counts.begin(), counts.end()};
    }
    const int bins = static_cast<int>(grain.bins());
    const int margin = static_cast<int>(grain.blur);
    const int width = bins + 2 * margin;
    const uint32_t tiles = 1u << place.zoom;
    std::vector<float> grid(static_cast<size_t>(width * width));
    // One bin a side is narrower than the margin: then the tiles two and more away reach in, too.
    const int reach = (margin + bins - 1) / bins;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const int64_t y = int64_t{place.y} + dy;
            if (y < 0 || y >= tiles)
                continue;
            const auto x = static_cast<uint32_t>(int64_t{place.x} + dx) & (tiles - 1); // round the world
            const TilePlace other{place.zoom, x, static_cast<uint32_t>(y)};
            add_tile(grid, width, margin, bins, dx, dy, counts_of(store, other, grain.log2_bins, query));
        }
    for (uint32_t i = 0; i < grain.blur; ++i) {
        smooth(grid, width, 1, width);
        smooth(grid, width, width, 1);
    }
    std::vector<float> heat(size_t{grain.bins()} * grain.bins());
    for (int y = 0; y < bins; ++y)
        std::copy_n(grid.begin() + (y + margin) * width + margin, bins, heat.begin() + y * bins);
    return heat;
}

Reference reference_of(const locus_pmq *store, uint32_t zoom, const Grain &grain, const locus_pmq_query &query) {
    auto heat = heat_of(store, densest(store, zoom, query), grain, query);
    const double least = Scale(ScaleKind::linear, grain, {}).low() / 4;
    heat.erase(std::remove_if(heat.begin(), heat.end(), [&](float value) { return !(value > least); }), heat.end());
    Reference reference;
    if (heat.empty())
        return reference;
    std::sort(heat.begin(), heat.end());
    for (size_t i = 0; i <= Reference::parts; ++i)
        reference.quantiles[i] = heat[i * (heat.size() - 1) / Reference::parts];
    reference.high = round_up(heat.back());
    return reference;
}

Scale::Scale(ScaleKind kind, const Grain &grain, const Reference &reference)
    : kind_(kind), low_(grain.blur == 0 ? 1 : 0.1), high_(reference.high), quantiles_(reference.quantiles) {
    least_ = low_ / 4;
    if (kind_ == ScaleKind::log)
        high_ = std::max(high_, 2 * low_);
    if (kind_ == ScaleKind::linear)
        low_ = 0;
    if (kind_ == ScaleKind::quantile && quantiles_.back() > 0) {
        low_ = quantiles_.front();
        high_ = quantiles_.back();
    }
}

double Scale::place(double heat) const {
    if (kind_ == ScaleKind::log)
        return std::clamp(std::log(heat / low_) / std::log(high_ / low_), 0.0, 1.0);
    if (kind_ == ScaleKind::linear)
        return std::clamp(heat / high_, 0.0, 1.0);
    // Where several eighths are equal, the last of them.
    const auto above = std::upper_bound(quantiles_.begin(), quantiles_.end(), heat);
    if (above == quantiles_.begin())
        return 0;
    if (above == quantiles_.end())
        return 1;
    const double from = *(above - 1), to = *above;
    const double whole = static_cast<double>(above - 1 - quantiles_.begin());
    return (whole + (heat - from) / (to - from)) / static_cast<double>(Reference::parts);
}

double Scale::value(double place) const {
    if (kind_ == ScaleKind::log)
        return low_ * std::pow(high_ / low_, place);
    if (kind_ == ScaleKind::linear)
        return high_ * place;
    const double part = std::clamp(place, 0.0, 1.0) * static_cast<double>(Reference::parts);
    const size_t whole = std::min(static_cast<size_t>(part), Reference::parts - 1);
    return std::lerp(quantiles_[whole], quantiles_[whole + 1], part - static_cast<double>(whole));
}

demo::Colour scale_colour(demo::ColourMap map, double place) {
    return demo::colour_of(map, darkest + (1 - darkest) * place);
}

} // namespace explorer
