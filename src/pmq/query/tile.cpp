// Heat-map tiles: counts per bin (thesis section 3.5.1).
#include "pmq/query/queries.hpp"
#include "pmq/query/scan.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace locus::pmq {
namespace {

class TileCount {
public:
    TileCount(const View &view, const Selection &live, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins)
        : view_(view), live_(live), tile_(tile), log2_bins_(log2_bins), bin_level_(tile.level + log2_bins),
          bins_(bins) {}

    uint64_t run() {
        descend(tile_, view_.everywhere());
        return total_;
    }

private:
    void descend(const Quadrant &quadrant, const Place &outer) {
        const Place place = view_.narrow(outer, quadrant);
        if (place.empty())
            return;
        const RangeAt range{place, quadrant.keys(), true};
        if (quadrant.level == bin_level_) {
            add(bin(quadrant.x(), quadrant.y()), count_in(view_, live_, range));
        } else if (quadrant.level == key_levels || place.last - place.first <= bins_within(quadrant)) {
            scan(range);
        } else {
            for (unsigned child = 0; child < 4; ++child)
                descend(quadrant.child(child), place);
        }
    }

    uint64_t bins_within(const Quadrant &quadrant) const noexcept {
        return uint64_t{1} << 2 * (bin_level_ - quadrant.level);
    }

    // A block whose keys lie in one bin is counted as a whole.
    void scan(const RangeAt &range) {
        const Acceptance accepted(view_, live_, range);
        view_.scan(range.place, range.keys, Order::any, [&](const Block &block) {
            const bool all = accepted.all_of(block);
            if (all && bin_level_ <= key_levels && bin_of(block.lowest) == bin_of(block.highest) &&
                block.lowest >= range.keys.lo && block.highest < range.keys.hi) {
                add(bin_of(block.lowest), block.count);
                return true;
            }
            for (size_t i = 0; i < block.count; ++i)
                if (const size_t entry = block.entry(i); all || accepted(block, entry))
                    add(bin_level_ <= key_levels ? bin_of(block.key(entry)) : bin_of(block.record(entry)), 1);
            return true;
        });
    }

    // The bits of a code's byte, x and y apart.
    static constexpr auto halves = [] {
        std::array<uint16_t, 256> table{};
        for (unsigned code = 0; code < 256; ++code)
            table[code] = static_cast<uint16_t>(morton_x(code) | morton_y(code) << 8);
        return table;
    }();

    size_t bin_of(uint64_t key) const noexcept {
        const auto code = static_cast<uint32_t>(key >> 2 * (key_levels - bin_level_));
        const uint32_t low = halves[code & 0xFF], high = halves[code >> 8 & 0xFF];
        return bin((low & 0xFF) | (high & 0xFF) << 4, low >> 8 | high >> 8 << 4);
    }

    size_t bin_of(Bytes record) const noexcept {
        const MapPoint point = map_point(view_.format().latitude(record), view_.format().longitude(record));
        return bin(map_cell(point.x, bin_level_), map_cell(point.y, bin_level_));
    }

    // Columns and rows count from the tile's corner.
    size_t bin(uint64_t column, uint64_t row) const noexcept {
        const uint64_t mask = (uint64_t{1} << log2_bins_) - 1;
        return static_cast<size_t>((row & mask) << log2_bins_ | (column & mask));
    }

    void add(size_t bin, uint64_t count) noexcept {
        constexpr uint64_t most = std::numeric_limits<uint32_t>::max();
        bins_[bin] = static_cast<uint32_t>(std::min(most, bins_[bin] + count));
        total_ += count;
    }

    const View &view_;
    const Selection &live_;
    Quadrant tile_;
    unsigned log2_bins_;
    unsigned bin_level_; // may be finer than the keys
    std::span<uint32_t> bins_;
    uint64_t total_ = 0;
};

} // namespace

uint64_t tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins) {
    Selection live = selection.at(view.moment());
    live.region = nullptr;
    std::fill(bins.begin(), bins.end(), 0);
    return TileCount(view, live, tile, log2_bins, bins).run();
}

} // namespace locus::pmq
