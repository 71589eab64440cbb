// Web-Mercator projection and keys.
#include "core/zcurve.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#define LOCUS_LANES_NAMESPACE scalar
#define LOCUS_INLINE inline
#include "core/mercator-inl.hpp"

namespace locus {
namespace {

struct ScalarOps {
    double set(double value) const noexcept { return value; }
    double min(double a, double b) const noexcept { return std::min(a, b); }
    double max(double a, double b) const noexcept { return std::max(a, b); }
    double zero_where_at_least(double a, double bound, double b) const noexcept { return a >= bound ? 0.0 : b; }
    // q = 2^k m with m in sqrt(1/2)..sqrt(2): subtracting the bits of sqrt(1/2) leaves k in the exponent's place; its
    // 12 bits, put into the last places of 2^52 with a bias, make a double of it.
    void split(double q, double &k, double &m) const noexcept {
        const auto bits = std::bit_cast<uint64_t>(q);
        const uint64_t exponent = (bits - scalar::half_root_bits) >> 52;
        m = std::bit_cast<double>(bits - (exponent << 52));
        k = std::bit_cast<double>(((exponent + 0x800) & 0xFFF) | scalar::two_52_bits) - (0x1p52 + 0x800);
    }
};

} // namespace

MapPoint map_point(double latitude, double longitude) noexcept {
    return {scalar::map_x(ScalarOps(), longitude), scalar::map_y(ScalarOps(), latitude)};
}

uint64_t key_of(double latitude, double longitude) noexcept {
    const MapPoint point = map_point(latitude, longitude);
    return morton(static_cast<uint32_t>(map_cell(point.x, key_levels)),
                  static_cast<uint32_t>(map_cell(point.y, key_levels)));
}

double map_longitude(uint32_t x, unsigned level) noexcept {
    return std::ldexp(x, -static_cast<int>(level)) * 360.0 - 180.0;
}

double map_latitude(uint32_t y, unsigned level) noexcept {
    const double north = std::numbers::pi * (1.0 - 2.0 * std::ldexp(y, -static_cast<int>(level)));
    return std::atan(std::sinh(north)) * (180.0 / std::numbers::pi);
}

} // namespace locus
