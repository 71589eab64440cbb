// The batched search for every instruction set: Highway compiles this file once per target.
#include "graph/weights/settle.hpp"

#ifndef LOCUS_SIMD_SCALAR_ONLY

#include "graph/bricks/visit.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "graph/weights/settle_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#undef LOCUS_LANES_NAMESPACE
#undef LOCUS_INLINE
#undef LOCUS_NOINLINE
#define LOCUS_LANES_NAMESPACE HWY_NAMESPACE
#define LOCUS_INLINE HWY_INLINE
#define LOCUS_NOINLINE HWY_NOINLINE

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON
HWY_BEFORE_NAMESPACE();
#include "graph/bricks/lanes_highway-inl.hpp"

#include "graph/weights/settle-inl.hpp"
HWY_AFTER_NAMESPACE();
#endif

#endif

#if defined(LOCUS_SIMD_SCALAR_ONLY) || HWY_ONCE
namespace locus::graph {

const SettleTable &settle_kernels(Simd target) noexcept {
    switch (target) {
#ifndef LOCUS_SIMD_SCALAR_ONLY
#if (HWY_TARGETS & HWY_SSE4)
    case Simd::sse4:
        return N_SSE4::settle_table;
#endif
#if (HWY_TARGETS & HWY_AVX2)
    case Simd::avx2:
        return N_AVX2::settle_table;
#endif
#if (HWY_TARGETS & HWY_AVX3)
    case Simd::avx512:
        return N_AVX3::settle_table;
#endif
#if (HWY_TARGETS & HWY_NEON)
    case Simd::neon:
        return N_NEON::settle_table;
#endif
#endif
    default:
        return scalar_settle_kernels();
    }
}

} // namespace locus::graph
#endif
