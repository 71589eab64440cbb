// From a region to key ranges: the disjoint quadrants that make it up, found by descending the quadtree (thesis
// section 3.5.2).
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/query/selection.hpp"

namespace locus::pmq {

// Keys that a query has to look at, and where they are. `inside`: no record there needs the region's test.
struct RangeAt {
    Place place;
    KeyRange keys;
    bool inside;
};

// Show the region's ranges (nullptr: one range of everything) in the order of their keys, neighbours of one kind
// merged, until `visit` says false; false if it did.
bool for_each_range(const View &view, const Region *region, FunctionRef<bool(const RangeAt &)> visit);

// Show every record that the selection accepts, with its key, until `visit` says false; false if it did.
bool for_each_record(const View &view, const Selection &selection, Order order,
                     FunctionRef<bool(uint64_t key, Bytes record)> visit);

} // namespace locus::pmq
