// Weights edge by edge for every instruction set: Highway compiles this file once per target, and edge_kernels()
// chooses from a table of our own, so that a handle can force its target and nothing of Highway's run-time library is
// linked.
#include "graph/bricks/visit.hpp"

#ifndef LOCUS_SIMD_SCALAR_ONLY

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "graph/bricks/edge_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#undef LOCUS_LANES_NAMESPACE
#define LOCUS_LANES_NAMESPACE HWY_NAMESPACE
#undef LOCUS_INLINE
#define LOCUS_INLINE HWY_INLINE
#undef LOCUS_NOINLINE
#define LOCUS_NOINLINE HWY_NOINLINE

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON
HWY_BEFORE_NAMESPACE();
#include "graph/bricks/lanes_highway-inl.hpp"
#include "graph/bricks/pull-inl.hpp"

#include "graph/bricks/edge-inl.hpp"
HWY_AFTER_NAMESPACE();
#endif

#endif

#if defined(LOCUS_SIMD_SCALAR_ONLY) || HWY_ONCE
namespace locus::bricks {

template <typename Word>
const EdgeKernels<Word> &edge_kernels(Simd target) noexcept {
    switch (target) {
#ifndef LOCUS_SIMD_SCALAR_ONLY
#if (HWY_TARGETS & HWY_SSE4)
    case Simd::sse4:
        return N_SSE4::edge_table<Word>;
#endif
#if (HWY_TARGETS & HWY_AVX2)
    case Simd::avx2:
        return N_AVX2::edge_table<Word>;
#endif
#if (HWY_TARGETS & HWY_AVX3)
    case Simd::avx512:
        return N_AVX3::edge_table<Word>;
#endif
#if (HWY_TARGETS & HWY_NEON)
    case Simd::neon:
        return N_NEON::edge_table<Word>;
#endif
#endif
    default:
        return scalar_edge_kernels<Word>();
    }
}

template const EdgeKernels<uint32_t> &edge_kernels(Simd) noexcept;
template const EdgeKernels<uint64_t> &edge_kernels(Simd) noexcept;

} // namespace locus::bricks
#endif
