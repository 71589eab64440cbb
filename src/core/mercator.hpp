// Keys of many places at once.
#pragma once

#include "core/simd.hpp"

#include <cstddef>
#include <cstdint>

namespace locus {

// Fills keys[0..count) with key_of(latitudes[i], longitudes[i]).
using KeysOf = void (*)(const double *latitudes, const double *longitudes, uint64_t *keys, size_t count);

// Every target finds the same keys.
KeysOf keys_of(Simd target) noexcept;

} // namespace locus
