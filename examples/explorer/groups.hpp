// Aggregates of a selection: records by time, by tile. Not with locus_pmq_groups, for a client may ask for as many
// groups as there are records: these need memory for what they answer alone.
#pragma once

#include "explorer/tiers.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace explorer {

struct CellCount {
    uint32_t x, y;
    uint64_t count;
};

// Records per bucket of `step` microseconds, by the bucket's begin. Throws a Failure for more than 2,000 buckets.
std::map<int64_t, uint64_t> count_by_time(const Tiers &tiers, const locus_pmq_query &query, int64_t step,
                                          uint64_t &total);

// The `count` fullest tiles of a zoom, fullest first.
std::vector<CellCount> count_by_cell(const Tiers &tiers, const locus_pmq_query &query, uint32_t zoom, size_t count,
                                     uint64_t &total);

// The corners of a tile.
locus_box tile_box(uint32_t zoom, uint32_t x, uint32_t y);

} // namespace explorer
