// The kernels as plain loops.
#include "graph/bricks/lanes_scalar.hpp"

#include "graph/bricks/pull-inl.hpp"

#include "graph/bricks/edge-inl.hpp"
#include "graph/bricks/mean-inl.hpp"

namespace locus::bricks {

template <typename Word>
const MeanKernels<Word> &scalar_mean_kernels() noexcept {
    return scalar::mean_table<Word>;
}
template <typename Word>
const EdgeKernels<Word> &scalar_edge_kernels() noexcept {
    return scalar::edge_table<Word>;
}

template const MeanKernels<uint32_t> &scalar_mean_kernels() noexcept;
template const MeanKernels<uint64_t> &scalar_mean_kernels() noexcept;
template const EdgeKernels<uint32_t> &scalar_edge_kernels() noexcept;
template const EdgeKernels<uint64_t> &scalar_edge_kernels() noexcept;

} // namespace locus::bricks
