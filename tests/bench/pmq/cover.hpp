// Key ranges that cover a box, for the peers that are ordered by key. They share the library's key function, so that no
// difference lies there.
#ifndef LOCUS_BENCH_COVER_HPP
#define LOCUS_BENCH_COVER_HPP

#include "core/zcurve.hpp"

#include <locus/pmq.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace bench {

using locus::key_levels;
using locus::key_of;

struct CoverRange {
    locus::KeyRange keys;
    bool whole; ///< every record in it lies inside the box
};

struct TilePlace {
    uint32_t x, y; ///< column from the west and row from the north at zoom 25
};
inline TilePlace place_of(double latitude, double longitude) {
    const uint64_t key = key_of(latitude, longitude);
    return {locus::morton_x(key), locus::morton_y(key)};
}

/// Cover a box by about `budget` key ranges at most: all quadrants on the box's border are split until it is spent.
inline std::vector<CoverRange> cover(const locus_box &box, std::size_t budget = 64) {
    const TilePlace low = place_of(box.north, box.west);
    TilePlace high = place_of(box.south, box.east);
    if (box.east >= 180) { // the key of 180 degrees is that of -180
        high.x = (1U << key_levels) - 1;
    }
    const auto side = [](const locus::Quadrant &q) { return uint64_t{1} << (key_levels - q.level); };
    const auto whole = [&](const locus::Quadrant &q) { // strictly inside: the tiles on the box's border are filtered
        const uint64_t x = q.x() * side(q), y = q.y() * side(q);
        return x > low.x && y > low.y && x + side(q) <= high.x && y + side(q) <= high.y;
    };
    const auto apart = [&](const locus::Quadrant &q) {
        const uint64_t x = q.x() * side(q), y = q.y() * side(q);
        return x > high.x || y > high.y || x + side(q) <= low.x || y + side(q) <= low.y;
    };
    std::vector<locus::Quadrant> border{{}};
    std::vector<CoverRange> ranges;
    while (!border.empty() && border.size() + ranges.size() < budget && border.front().level < key_levels) {
        std::vector<locus::Quadrant> finer;
        for (const locus::Quadrant &q : border) {
            for (unsigned number = 0; number < 4; ++number) {
                const locus::Quadrant child = q.child(number);
                if (whole(child)) {
                    ranges.push_back({child.keys(), true});
                } else if (!apart(child)) {
                    finer.push_back(child);
                }
            }
        }
        border = std::move(finer);
    }
    for (const locus::Quadrant &q : border) {
        ranges.push_back({q.keys(), false});
    }
    std::sort(ranges.begin(), ranges.end(),
              [](const CoverRange &a, const CoverRange &b) { return a.keys.lo < b.keys.lo; });
    std::size_t kept = 0;
    for (const CoverRange &range : ranges) { // join neighbours of one kind
        if (kept > 0 && ranges[kept - 1].keys.hi == range.keys.lo && ranges[kept - 1].whole == range.whole) {
            ranges[kept - 1].keys.hi = range.keys.hi;
        } else {
            ranges[kept++] = range;
        }
    }
    ranges.resize(kept);
    return ranges;
}

} // namespace bench
#endif
