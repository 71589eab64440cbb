// Sibson's weights on a device.
#pragma once

#include "graph/device/field.hpp"
#include "graph/weights/natural.hpp"

namespace locus::device {

// As graph::natural_rows for LOCUS_METHOD_SIBSON, with equal rows, from what a field holds. `job.bytes` bounds the
// scratch memory on the device; `kept` is memory for queries and rows that the next call uses again.
template <typename Word>
std::vector<graph::RowPile> sibson_rows(Device &device, const Field<Word> &field, Memory<uint64_t> &kept,
                                        const graph::NaturalJob &job, Progress &progress);

// The same where nothing is on the device yet.
std::vector<graph::RowPile> sibson_rows(Device &device, const graph::NaturalJob &job, Progress &progress);

} // namespace locus::device
