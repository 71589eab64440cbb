// The instruction sets the SIMD code is compiled for, and which of them this machine and this build can run.
#pragma once

#include <cstdint>

namespace locus {

// Numbered as LOCUS_SIMD_ in locus/graph.h.
enum class Simd : uint32_t { automatic = 0, scalar = 1, sse4 = 2, avx2 = 3, avx512 = 4, neon = 5 };

// Compiled into this library and supported by this processor and its operating system.
bool simd_available(Simd target) noexcept;

// The widest available one.
Simd simd_best() noexcept;

// `requested`, or the widest one for `automatic`. Throws LOCUS_E_UNSUPPORTED if it is not available, LOCUS_E_ARGUMENT
// if the number is unknown.
Simd simd_choose(uint32_t requested);

const char *simd_name(Simd target) noexcept;

} // namespace locus
