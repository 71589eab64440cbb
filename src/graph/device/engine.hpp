// Engines that solve on a device.
#pragma once

#include "graph/device/dense_engine.hpp"
#include "graph/device/device.hpp"
#include "graph/engine.hpp"

namespace locus::device {

// LOCUS_ENGINE_AUTO and LOCUS_ENGINE_BRICKS, which keeps the graph on the device; LOCUS_ENGINE_RELAX; and
// LOCUS_ENGINE_COMPACT, which takes a grain. `stream` as in Table::use_stream. `keeps`: of a result, bricks leave the
// words on the device (Report::kept).
std::unique_ptr<graph::Engine> make_engine(const Table &table, uint32_t kind, const Grain &grain, void *stream,
                                           bool keeps = false);

} // namespace locus::device
