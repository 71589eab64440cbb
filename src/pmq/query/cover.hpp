// Key ranges around a region, for records that no layout holds.
#pragma once

#include "pmq/query/region.hpp"

#include <cstddef>
#include <vector>

namespace locus::pmq {

// Ranges that hold every place of the region (nullptr: everywhere), disjoint, ascending, at most `most` >= 1 of them:
// the quadtree as far down as they allow.
std::vector<locus_key_range> cover(const Region *region, size_t most);

} // namespace locus::pmq
