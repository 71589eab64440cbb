// The queries. Each sees one view; records that have expired by the view's moment are not there.
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/query/selection.hpp"

#include <span>
#include <vector>

namespace locus::pmq {

uint64_t count(const View &view, const Selection &selection);

// Copy the first `capacity` selected records in an order; how many there are.
size_t read(const View &view, const Selection &selection, Order order, std::byte *records, size_t capacity);

// Show the selected records in an order until `visit` returns non-zero; false if it did.
bool visit(const View &view, const Selection &selection, Order order, locus_visit_fn visit, void *user);

// Count per bin of a tile, 2^log2_bins bins a side, row by row; the sum. The selection's region is ignored.
uint64_t tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
              std::span<uint32_t> bins);

// The same with each record counted as its weight, added in the order (key, arrival). Throws Error(LOCUS_E_ARGUMENT)
// for a weight that is not finite.
double weighted_tile(const View &view, const Selection &selection, const Quadrant &tile, unsigned log2_bins,
                     locus_record_weight_fn weight, void *user, std::span<double> bins);

// Copy the selected records behind the cursor, at most `capacity`, and move it behind the last; how many were copied. A
// page ends between two keys, unless `lasting`: the view is a snapshot's. Throws Error(LOCUS_E_CAPACITY), with `needed`
// set, when one key has more.
size_t read_page(const View &view, const Selection &selection, bool lasting, locus_pmq_cursor &cursor,
                 std::byte *records, size_t capacity, size_t &needed);

// The groups of the selected records, the largest first, then by rising value. `group` says which one a record is in.
std::vector<locus_pmq_group> groups(const View &view, const Selection &selection,
                                    FunctionRef<uint64_t(Bytes record)> group);

} // namespace locus::pmq
