// Which instruction sets are there: asked of the processor at run time, so that one library runs everywhere.
#include "core/simd.hpp"

#include "core/error.hpp"

#if !defined(LOCUS_SIMD_SCALAR_ONLY) && defined(__x86_64__)
#include <cpuid.h>
#endif

namespace locus {

#if !defined(LOCUS_SIMD_SCALAR_ONLY) && defined(__x86_64__)
namespace {

// clang 14's __builtin_cpu_supports does not know the name.
bool has_f16c() noexcept {
    unsigned a = 0, b = 0, c = 0, d = 0;
    return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}

} // namespace
#endif

// The lists name every feature that Highway 1.0.3 lets the compiler use for its target, not the vector width alone.
bool simd_available(Simd target) noexcept {
    if (target == Simd::scalar)
        return true;
#if !defined(LOCUS_SIMD_SCALAR_ONLY) && defined(__x86_64__)
    __builtin_cpu_init();
    const bool sse4 = __builtin_cpu_supports("ssse3") && __builtin_cpu_supports("sse4.1") &&
                      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                      __builtin_cpu_supports("aes");
    const bool avx2 = sse4 && __builtin_cpu_supports("avx") && __builtin_cpu_supports("avx2") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                      __builtin_cpu_supports("fma") && has_f16c();
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
    if (target == Simd::sse4)
        return sse4;
    if (target == Simd::avx2)
        return avx2;
    if (target == Simd::avx512)
        return avx512;
#elif !defined(LOCUS_SIMD_SCALAR_ONLY) && defined(__aarch64__)
    if (target == Simd::neon)
        return true;
#endif
    return false;
}

Simd simd_best() noexcept {
    for (const Simd target : {Simd::avx512, Simd::avx2, Simd::sse4, Simd::neon})
        if (simd_available(target))
            return target;
    return Simd::scalar;
}

Simd simd_choose(uint32_t requested) {
    require(requested <= static_cast<uint32_t>(Simd::neon), "simd is ", requested, ", none of LOCUS_SIMD_");
    const auto target = static_cast<Simd>(requested);
    if (target == Simd::automatic)
        return simd_best();
    if (!simd_available(target))
        fail(LOCUS_E_UNSUPPORTED, "simd is ", simd_name(target), ", which this machine or this build lacks");
    return target;
}

const char *simd_name(Simd target) noexcept {
    switch (target) {
    case Simd::scalar:
        return "scalar";
    case Simd::sse4:
        return "sse4";
    case Simd::avx2:
        return "avx2";
    case Simd::avx512:
        return "avx512";
    case Simd::neon:
        return "neon";
    default:
        return "automatic";
    }
}

} // namespace locus
