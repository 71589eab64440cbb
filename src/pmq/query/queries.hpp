// The queries. Each sees one view; records that have expired by the view's moment are not there.
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/query/selection.hpp"

#include <span>

namespace locus::pmq {

uint64_t count(const View &view, const Selection &selection);

// Copy the first `capacity` selected records in the order (key, arrival); how many there are.
size_t read(const View &view, const Selection &selection, std::byte *records, size_t capacity);

// Show the selected records in that order until `visit` returns non-zero; false if it did.
bool visit(const View &view, const Selection &selection, locus_visit_fn visit, void *user);

// Count per bin of a tile, 2^log2_bins bins a side, row by row; the sum. The selection's region is ignored.
uint64_t tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins);

} // namespace locus::pmq
