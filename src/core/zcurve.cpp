// Web-Mercator projection and keys.
#include "core/zcurve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

constexpr double last_coordinate = 1.0 - 0x1p-40; // below 1 at every level in use

} // namespace

MapPoint map_point(double latitude, double longitude) noexcept {
    const double x = longitude >= 180.0 ? 0.0 : std::min((longitude + 180.0) / 360.0, last_coordinate);
    if (latitude >= mercator_latitude)
        return {x, 0.0};
    if (latitude <= -mercator_latitude)
        return {x, last_coordinate};
    const double sine = std::sin(latitude * (std::numbers::pi / 180.0));
    const double y = 0.5 - std::log((1.0 + sine) / (1.0 - sine)) / (4.0 * std::numbers::pi);
    return {x, std::clamp(y, 0.0, last_coordinate)};
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
