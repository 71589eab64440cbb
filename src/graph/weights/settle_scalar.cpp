// The batched search as plain loops.
#include "graph/weights/settle.hpp"

#include "graph/bricks/lanes_scalar.hpp"

#include "graph/weights/settle-inl.hpp"

namespace locus::graph {

const SettleTable &scalar_settle_kernels() noexcept { return scalar::settle_table; }

} // namespace locus::graph
