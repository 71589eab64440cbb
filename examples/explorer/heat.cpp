// Counts, smoothing, scales.
#include "explorer/heat.hpp"

#include "explorer/selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace explorer {
namespace {

constexpr double darkest = 0.34; // of the colour map: what is less is hard to see on a dark ground
constexpr uint32_t deepest = 25; // zoom

// A tile's counts with a margin around it, which its neighbours give.
class Grid {
public:
    Grid(const std::vector<uint32_t> &counts, const TilePlace &place, const Grain &grain, const Count &beside)
        : beside_(beside), place_(place), log2_bins_(grain.log2_bins), bins_(grain.bins()),
          margin_(static_cast<int>(grain.blur)), width_(bins_ + 2 * margin_),
          heat_(static_cast<size_t>(width_ * width_)) {
        put(counts, 0, 0, bins_);
        // Only the rim of a neighbour is asked for, in squares as wide as the margin or a little wider: a whole tile
        // takes long where many records are. Squares are tiles, too, of zoom 25 at most.
        const auto wide = static_cast<uint32_t>(std::bit_width(grain.blur - 1));
        const uint32_t level = place.zoom + log2_bins_;
        const uint32_t log2_square = std::min(std::max(wide, level - std::min(level, deepest)), log2_bins_);
        const int square = 1 << log2_square;
        const int reach = (margin_ + square - 1) / square * square;
        for (int top = -reach; top < bins_ + reach; top += square)
            for (int left = -reach; left < bins_ + reach; left += square)
                if (top < 0 || top >= bins_ || left < 0 || left >= bins_)
                    add(left, top, log2_square);
    }

    std::vector<float> take() { return std::move(heat_); } // row by row, the margin included

private:
    // The bins of a square, whose corner lies at (left, top) from the tile's; round the world, and not beyond the
    // poles.
    void add(int left, int top, uint32_t log2_square) {
        const uint32_t zoom = place_.zoom + log2_bins_ - log2_square;
        const int64_t squares = int64_t{1} << zoom;
        const int64_t x = (int64_t{place_.x} * bins_ + left) >> log2_square;
        const int64_t y = (int64_t{place_.y} * bins_ + top) >> log2_square;
        if (y < 0 || y >= squares)
            return;
        const TilePlace square{zoom, static_cast<uint32_t>(x & (squares - 1)), static_cast<uint32_t>(y)};
        put(beside_(square, log2_square), left, top, 1 << log2_square);
    }

    void put(const std::vector<uint32_t> &counts, int left, int top, int side) {
        for (int row = std::max(0, -margin_ - top); row < side && top + row < bins_ + margin_; ++row)
            for (int column = std::max(0, -margin_ - left); column < side && left + column < bins_ + margin_; ++column)
                heat_[static_cast<size_t>((top + row + margin_) * width_ + left + column + margin_)] =
                    static_cast<float>(counts[static_cast<size_t>(row * side + column)]);
    }

    const Count &beside_;
    TilePlace place_;
    uint32_t log2_bins_;
    int bins_, margin_, width_;
    std::vector<float> heat_;
};

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

// Counts of bins four times as large: sums of two by two, `side` of them a side.
std::vector<uint32_t> coarser(const std::vector<uint32_t> &counts, size_t side) {
    std::vector<uint32_t> sums(side * side);
    for (size_t y = 0; y < 2 * side; ++y)
        for (size_t x = 0; x < 2 * side; ++x)
            sums[y / 2 * side + x / 2] += counts[y * 2 * side + x];
    return sums;
}

} // namespace

std::vector<uint32_t> counts_of(const locus_pmq *store, const TilePlace &place, uint32_t log2_bins,
                                const locus_pmq_query &query, uint64_t *total) {
    std::vector<uint32_t> counts(size_t{1} << 2 * log2_bins);
    check(locus_pmq_tile(store, place.zoom, place.x, place.y, log2_bins, &query, counts.data(), counts.size(), total));
    return counts;
}

std::vector<float> heat_of(const std::vector<uint32_t> &counts, const TilePlace &place, const Grain &grain,
                           const Count &beside) {
    if (grain.blur == 0)
        return {counts.begin(), counts.end()};
    const int bins = static_cast<int>(grain.bins());
    const int margin = static_cast<int>(grain.blur);
    const int width = bins + 2 * margin;
    std::vector<float> grid = Grid(counts, place, grain, beside).take();
    for (uint32_t i = 0; i < grain.blur; ++i) {
        smooth(grid, width, 1, width);
        smooth(grid, width, width, 1);
    }
    std::vector<float> heat(size_t{grain.bins()} * grain.bins());
    for (int y = 0; y < bins; ++y)
        std::copy_n(grid.begin() + (y + margin) * width + margin, bins, heat.begin() + y * bins);
    return heat;
}

Peaks peaks_of(const Count &count) {
    Peaks peaks;
    for (uint32_t zoom = 0; zoom < deepest;) {
        const TilePlace outer = peaks[zoom];
        const uint32_t steps = std::min(8u, deepest - zoom);
        auto counts = count(outer, steps);
        for (uint32_t step = steps; step > 0; --step) {
            const auto fullest = static_cast<uint32_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
            peaks[zoom + step] = {zoom + step, (outer.x << step) + (fullest & ((1u << step) - 1)),
                                  (outer.y << step) + (fullest >> step)};
            counts = coarser(counts, size_t{1} << (step - 1));
        }
        zoom += steps;
    }
    return peaks;
}

Reference reference_of(std::vector<float> heat, const Grain &grain) {
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
