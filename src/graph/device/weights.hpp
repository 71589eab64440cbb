// Sibson's weights on a device.
#pragma once

#include "graph/device/device.hpp"
#include "graph/weights/natural.hpp"

namespace locus::device {

// As graph::natural_rows for LOCUS_METHOD_SIBSON, with equal rows. `job.bytes` bounds the scratch memory on the device.
std::vector<graph::RowPile> sibson_rows(Device &device, const graph::NaturalJob &job, Progress &progress);

} // namespace locus::device
