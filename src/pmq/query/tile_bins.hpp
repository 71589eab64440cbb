// The bins of a heat-map tile, and in which of them a record lies.
#pragma once

#include "core/zcurve.hpp"
#include "pmq/record.hpp"

#include <array>

namespace locus::pmq {

class TileBins {
public:
    TileBins(const RecordFormat &format, const Quadrant &tile, unsigned log2_bins) noexcept
        : format_(format), log2_bins_(log2_bins), level_(tile.level + log2_bins) {}

    unsigned level() const noexcept { return level_; } // whose quadrants the bins are
    bool by_key() const noexcept { return level_ <= key_levels; }

    size_t of(uint64_t key, Bytes record) const noexcept { return by_key() ? of(key) : of(record); }
    // Where by_key(): a bin's Morton code, the smallest key with it, and its bin.
    unsigned shift() const noexcept { return 2 * (key_levels - level_); }
    unsigned log2_bins() const noexcept { return log2_bins_; }
    uint64_t code(uint64_t key) const noexcept { return key >> shift(); }
    uint64_t lowest(uint64_t code) const noexcept { return code << shift(); }
    size_t of(uint64_t key) const noexcept { return of_code(code(key)); }
    size_t of_code(uint64_t code) const noexcept {
        const uint32_t low = halves[code & 0xFF], high = halves[code >> 8 & 0xFF];
        return at((low & 0xFF) | (high & 0xFF) << 4, low >> 8 | high >> 8 << 4);
    }
    // Columns and rows count from the tile's corner, or from the map's.
    size_t at(uint64_t column, uint64_t row) const noexcept {
        const uint64_t mask = (uint64_t{1} << log2_bins_) - 1;
        return static_cast<size_t>((row & mask) << log2_bins_ | (column & mask));
    }

private:
    size_t of(Bytes record) const noexcept {
        const MapPoint point = map_point(format_.latitude(record), format_.longitude(record));
        return at(map_cell(point.x, level_), map_cell(point.y, level_));
    }

    // The bits of a code's byte, x and y apart.
    static constexpr auto halves = [] {
        std::array<uint16_t, 256> table{};
        for (unsigned code = 0; code < 256; ++code)
            table[code] = static_cast<uint16_t>(morton_x(code) | morton_y(code) << 8);
        return table;
    }();

    const RecordFormat &format_;
    unsigned log2_bins_;
    unsigned level_; // may be finer than the keys
};

} // namespace locus::pmq
