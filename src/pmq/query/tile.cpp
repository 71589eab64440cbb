// Heat-map tiles: counts, or sums of weights, per bin (thesis section 3.5.1).
#include "pmq/query/queries.hpp"

#include "core/error.hpp"
#include "pmq/query/scan.hpp"
#include "pmq/query/tile_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace locus::pmq {
namespace {

constexpr uint64_t few_bins = 16; // so few that counting the keys below their borders is quicker
constexpr uint64_t most_in_bin = std::numeric_limits<uint32_t>::max();
constexpr size_t cache_line = 64;

class TileCount {
public:
    TileCount(const View &view, const Selection &live, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins)
        : view_(view), live_(live), tile_(tile), places_(view.format(), tile, log2_bins), bins_(bins) {}

    uint64_t run() {
        descend(tile_, view_.everywhere());
        if (waiting_.count > 0)
            add_keys(waiting_);
        return total_;
    }

private:
    void descend(const Quadrant &quadrant, const Place &outer) {
        const Place place = view_.narrow(outer, quadrant);
        if (place.empty())
            return;
        const RangeAt range{place, quadrant.keys(), true};
        if (quadrant.level == places_.level()) {
            add(places_.at(quadrant.x(), quadrant.y()), count_in(view_, live_, range));
        } else if (quadrant.level == key_levels || place.last - place.first <= bins_within(quadrant)) {
            scan(range);
        } else {
            for (unsigned child = 0; child < 4; ++child)
                descend(quadrant.child(child), place);
        }
    }

    uint64_t bins_within(const Quadrant &quadrant) const noexcept {
        return uint64_t{1} << 2 * (places_.level() - quadrant.level);
    }

    void scan(const RangeAt &range) {
        const Acceptance accepted(view_, live_, range);
        view_.scan(range.place, range.keys, live_.times.from, Order::any, [&](const Block &block) {
            if (places_.by_key() && accepted.all_of(block)) {
                add_all(block, range.keys);
                return true;
            }
            for (size_t i = 0; i < block.count; ++i)
                if (const size_t entry = block.entry(i); accepted(block, entry))
                    add(places_.of(block.key(entry), block.record(entry)), 1);
            return true;
        });
    }

    // A block whose keys lie in one bin is counted as a whole. Others are looked at when the next one comes, so that
    // memory is not waited for.
    void add_all(Block block, const KeyRange &keys) noexcept {
        block.lowest = std::max(block.lowest, keys.lo);
        block.highest = std::min(block.highest, keys.hi - 1);
        if (places_.code(block.lowest) == places_.code(block.highest)) {
            add(places_.of(block.lowest), block.count);
        } else if (block.count < worthwhile || block.key_stride != sizeof(uint64_t)) {
            add_singly(block);
        } else {
            for (size_t i = 0; i < block.count; i += cache_line / sizeof(uint64_t))
                __builtin_prefetch(block.keys + i * sizeof(uint64_t));
            add_keys(std::exchange(waiting_, block));
        }
    }

    // Few bins, side by side on the Z-curve: how many keys lie below each border. Many: one by one.
    void add_keys(const Block &block) noexcept {
        const uint64_t first = places_.code(block.lowest), last = places_.code(block.highest);
        if (last - first < few_bins)
            add_by_borders(block, first, last);
        else
            add_by_bins(block);
    }

    void add_by_borders(const Block &block, uint64_t first, uint64_t last) noexcept {
        const auto *keys = reinterpret_cast<const uint64_t *>(block.keys);
        size_t before = 0;
        for (uint64_t code = first; code < last && before < block.count; ++code) {
            const size_t below = many_keys().count_below(places_.lowest(code + 1), keys, block.count);
            if (below > before)
                add(places_.of_code(code), below - before);
            before = below;
        }
        if (before < block.count)
            add(places_.of_code(last), block.count - before);
    }

    void add_by_bins(const Block &block) noexcept {
        const auto *keys = reinterpret_cast<const uint64_t *>(block.keys);
        uint64_t where[most_keys];
        for (size_t begin = 0; begin < block.count; begin += most_keys) {
            const size_t count = std::min(block.count - begin, most_keys);
            many_keys().bins(places_.shift(), places_.log2_bins(), keys + begin, count, where);
            add_at({where, count});
        }
    }

    // As long as all bins together have no more than one can hold, none is full.
    void add_at(std::span<const uint64_t> where) noexcept {
        uint32_t *bins = bins_.data();
        total_ += where.size();
        if (total_ <= most_in_bin)
            for (const uint64_t bin : where)
                ++bins[bin];
        else
            for (const uint64_t bin : where)
                add_one(bins[bin]);
    }

    void add_singly(const Block &block) noexcept {
        const TileBins places = places_; // counting cannot change it, as the compiler sees
        uint32_t *bins = bins_.data();
        for (size_t i = 0; i < block.count; ++i)
            add_one(bins[places.of(block.key(block.entry(i)))]);
        total_ += block.count;
    }

    static void add_one(uint32_t &bin) noexcept { bin += bin != most_in_bin; }
    void add(size_t bin, uint64_t count) noexcept {
        bins_[bin] = static_cast<uint32_t>(std::min(most_in_bin, bins_[bin] + count));
        total_ += count;
    }

    const View &view_;
    const Selection &live_;
    Quadrant tile_;
    TileBins places_;
    std::span<uint32_t> bins_;
    uint64_t total_ = 0;
    Block waiting_; // keys that are being fetched, all in the tile
};

} // namespace

uint64_t tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins) {
    Selection live = selection.at(view.moment());
    live.region = nullptr;
    std::fill(bins.begin(), bins.end(), 0);
    return TileCount(view, live, tile, log2_bins, bins).run();
}

double weighted_tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
                     locus_record_weight_fn weight, void *user, std::span<double> bins) {
    Selection live = selection.at(view.moment());
    live.region = nullptr;
    std::fill(bins.begin(), bins.end(), 0);
    const TileBins places(view.format(), tile, log2_bins);
    double total = 0;
    const RangeAt range{view.narrow(view.everywhere(), tile), tile.keys(), true};
    scan_accepted(view, live, range, Order::key, [&](const Block &block, size_t entry) {
        const Bytes record = block.record(entry);
        const double value = weight(record, user);
        require(std::isfinite(value), "weight returned ", value, " for the record at ", view.format().latitude(record),
                ", ", view.format().longitude(record), ", not a finite number");
        bins[places.of(block.key(entry), record)] += value;
        total += value;
        return true;
    });
    return total;
}

} // namespace locus::pmq
