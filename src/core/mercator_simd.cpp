// The projection for every instruction set: Highway compiles this file once per target.
#include "core/mercator.hpp"
#include "core/zcurve.hpp"

#ifndef LOCUS_SIMD_SCALAR_ONLY

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mercator_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#undef LOCUS_LANES_NAMESPACE
#define LOCUS_LANES_NAMESPACE HWY_NAMESPACE
#undef LOCUS_INLINE
#define LOCUS_INLINE HWY_INLINE

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON
HWY_BEFORE_NAMESPACE();
#include "core/mercator-inl.hpp"
namespace locus::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using Words = hn::RebindToUnsigned<Doubles>;
using Double = hn::Vec<Doubles>;
using Word = hn::Vec<Words>;

struct VectorOps {
    HWY_INLINE Double set(double value) const { return hn::Set(Doubles(), value); }
    HWY_INLINE Double min(Double a, Double b) const { return hn::Min(a, b); }
    HWY_INLINE Double max(Double a, Double b) const { return hn::Max(a, b); }
    HWY_INLINE Double zero_where_at_least(Double a, Double bound, Double b) const {
        return hn::IfThenZeroElse(hn::Ge(a, bound), b);
    }
    // See split() in zcurve.cpp.
    HWY_INLINE void split(Double q, Double &k, Double &m) const {
        const Word bits = hn::BitCast(Words(), q);
        const Word exponent = hn::ShiftRight<52>(hn::Sub(bits, hn::Set(Words(), half_root_bits)));
        m = hn::BitCast(Doubles(), hn::Sub(bits, hn::ShiftLeft<52>(exponent)));
        const Word biased = hn::And(hn::Add(exponent, hn::Set(Words(), 0x800)), hn::Set(Words(), 0xFFF));
        k = hn::BitCast(Doubles(), hn::Or(biased, hn::Set(Words(), two_52_bits))) - set(0x1p52 + 0x800);
    }
};

HWY_INLINE Word spread(Word x) {
    const auto step = [](Word v, Word shifted, uint64_t mask)
                          HWY_ATTR { return hn::And(hn::Or(v, shifted), hn::Set(Words(), mask)); };
    x = step(x, hn::ShiftLeft<16>(x), 0x0000FFFF0000FFFF);
    x = step(x, hn::ShiftLeft<8>(x), 0x00FF00FF00FF00FF);
    x = step(x, hn::ShiftLeft<4>(x), 0x0F0F0F0F0F0F0F0F);
    x = step(x, hn::ShiftLeft<2>(x), 0x3333333333333333);
    return step(x, hn::ShiftLeft<1>(x), 0x5555555555555555);
}

HWY_INLINE Word cells(Double coordinate) {
    constexpr hn::Rebind<int32_t, Doubles> integers;
    constexpr hn::RebindToSigned<Doubles> wide;
    const auto scaled = coordinate * hn::Set(Doubles(), double{1u << key_levels});
    return hn::BitCast(Words(), hn::PromoteTo(wide, hn::DemoteTo(integers, scaled)));
}

void keys(const double *latitudes, const double *longitudes, uint64_t *keys, size_t count) {
    const size_t lanes = hn::Lanes(Doubles());
    size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const Word x = cells(map_x(VectorOps(), hn::LoadU(Doubles(), longitudes + i)));
        const Word y = cells(map_y(VectorOps(), hn::LoadU(Doubles(), latitudes + i)));
        hn::StoreU(hn::Or(spread(x), hn::ShiftLeft<1>(spread(y))), Words(), keys + i);
    }
    for (; i < count; ++i)
        keys[i] = key_of(latitudes[i], longitudes[i]);
}

} // namespace locus::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#endif

#if defined(LOCUS_SIMD_SCALAR_ONLY) || HWY_ONCE
namespace locus {
namespace {

void scalar_keys(const double *latitudes, const double *longitudes, uint64_t *keys, size_t count) {
    for (size_t i = 0; i < count; ++i)
        keys[i] = key_of(latitudes[i], longitudes[i]);
}

} // namespace

KeysOf keys_of(Simd target) noexcept {
    switch (target) {
#ifndef LOCUS_SIMD_SCALAR_ONLY
#if (HWY_TARGETS & HWY_SSE4)
    case Simd::sse4:
        return N_SSE4::keys;
#endif
#if (HWY_TARGETS & HWY_AVX2)
    case Simd::avx2:
        return N_AVX2::keys;
#endif
#if (HWY_TARGETS & HWY_AVX3)
    case Simd::avx512:
        return N_AVX3::keys;
#endif
#if (HWY_TARGETS & HWY_NEON)
    case Simd::neon:
        return N_NEON::keys;
#endif
#endif
    default:
        return scalar_keys;
    }
}

} // namespace locus
#endif
