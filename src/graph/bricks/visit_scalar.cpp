// The kernels as plain loops.
#include "graph/bricks/lanes_scalar.hpp"

#include "graph/bricks/pull-inl.hpp"

#include "graph/bricks/edge-inl.hpp"
#include "graph/bricks/mean-inl.hpp"

#include "graph/bricks/kernels-inl.hpp"

namespace locus::bricks {

const KernelTable &scalar_kernels() noexcept { return scalar::table; }

} // namespace locus::bricks
