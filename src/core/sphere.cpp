// Distances of places and of quadrants.
#include "core/sphere.hpp"

#include <locus/pmq.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

constexpr double radian = std::numbers::pi / 180.0;
constexpr double slack = 1e-9; // radians, far above the rounding of projection and distances: 6 millimetres

// The latitude that a pole stands for in the rows at the edge of the map.
double north_of(const Quadrant &quadrant) noexcept {
    return quadrant.y() == 0 ? 90.0 : map_latitude(quadrant.y(), quadrant.level);
}
double south_of(const Quadrant &quadrant) noexcept {
    const uint64_t below = uint64_t{quadrant.y()} + 1;
    return below >> quadrant.level != 0 ? -90.0 : map_latitude(static_cast<uint32_t>(below), quadrant.level);
}

} // namespace

double half_globe() noexcept { return std::numbers::pi * LOCUS_EARTH_RADIUS; }

Site::Site(double latitude, double longitude) noexcept
    : latitude_(latitude), longitude_(longitude == -180 ? 180 : longitude) {
    const double cosine = std::abs(latitude) == 90 ? 0.0 : std::cos(latitude * radian);
    x_ = cosine * std::cos(longitude_ * radian);
    y_ = cosine * std::sin(longitude_ * radian);
    z_ = std::sin(latitude * radian);
}

// Kahan's formula: as good for neighbours as for antipodes.
double Site::angle_to(const Site &other) const noexcept {
    const auto norm = [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); };
    return 2 * std::atan2(norm(x_ - other.x_, y_ - other.y_, z_ - other.z_),
                          norm(x_ + other.x_, y_ + other.y_, z_ + other.z_));
}

double Site::distance_to(const Site &other) const noexcept { return LOCUS_EARTH_RADIUS * angle_to(other); }

double Site::least_distance_to(const Quadrant &quadrant) const noexcept {
    return LOCUS_EARTH_RADIUS * least_angle_to(quadrant);
}

// Along a meridian the cosine of the angle is a sin(latitude) + b cos(latitude): the nearest place is where that is
// largest, or else an end.
double Site::least_angle_to_meridian(double longitude, double south, double north) const noexcept {
    const double nearest = std::atan2(std::sin(latitude_ * radian),
                                      std::cos(latitude_ * radian) * std::cos((longitude - longitude_) * radian)) /
                           radian;
    double least = std::min(angle_to({south, longitude}), angle_to({north, longitude}));
    if (south < nearest && nearest < north)
        least = std::min(least, angle_to({nearest, longitude}));
    return least;
}

double Site::least_angle_to(const Quadrant &quadrant) const noexcept {
    const double south = south_of(quadrant), north = north_of(quadrant);
    const double west = map_longitude(quadrant.x(), quadrant.level);
    const double width = 360.0 / static_cast<double>(uint64_t{1} << quadrant.level), east = west + width;
    const double eastwards = longitude_ < west ? longitude_ + 360 - west : longitude_ - west; // from the western edge
    double least;
    if (eastwards <= width)
        least = std::max({0.0, south - latitude_, latitude_ - north}) * radian;
    else
        least = std::min(least_angle_to_meridian(west, south, north), least_angle_to_meridian(east, south, north));
    return std::max(0.0, least - slack);
}

// As far as the nearest place is from the antipode, so far is the farthest one from being there.
double Site::largest_angle_to(const Quadrant &quadrant) const noexcept {
    const Site antipode(-latitude_, longitude_ > 0 ? longitude_ - 180 : longitude_ + 180);
    return std::numbers::pi - antipode.least_angle_to(quadrant);
}

} // namespace locus
