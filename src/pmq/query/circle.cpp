// Circles: distances of records and of quadrants.
#include "pmq/query/circle.hpp"

#include "core/error.hpp"

#include <cmath>
#include <numbers>

namespace locus::pmq {
namespace {

const locus_circle &checked(const locus_circle &circle) {
    check_degrees(circle.latitude, 90, "circle.latitude");
    check_degrees(circle.longitude, 180, "circle.longitude");
    require(circle.radius >= 0 && circle.radius <= half_globe(), "circle.radius is ", circle.radius, ", not within 0..",
            half_globe(), " metres, half the globe");
    return circle;
}

// A circle that covers a pole is as wide as the map; else the farthest longitudes are where it touches a meridian.
locus_box bounds(const locus_circle &circle) {
    constexpr double radian = std::numbers::pi / 180;
    const double reach = circle.radius / LOCUS_EARTH_RADIUS / radian; // degrees of latitude
    const double south = circle.latitude - reach, north = circle.latitude + reach;
    double width = 360;
    if (south > -89.999 && north < 89.999)
        width = std::asin(std::min(1.0, std::sin(reach * radian) / std::cos(circle.latitude * radian))) / radian;
    return covering_box(south, circle.longitude - width, north, circle.longitude + width);
}

} // namespace

CircleRegion::CircleRegion(const locus_circle &circle)
    : centre_(checked(circle).latitude, circle.longitude), radius_(circle.radius),
      angle_(circle.radius / LOCUS_EARTH_RADIUS), bounds_(bounds(circle)) {}

Relation CircleRegion::relate(const Quadrant &quadrant) const noexcept {
    if (bounds_.relate(quadrant) == Relation::outside || centre_.least_angle_to(quadrant) > angle_)
        return Relation::outside;
    return centre_.largest_angle_to(quadrant) < angle_ ? Relation::inside : Relation::edge;
}

Relation CircleRegion::relate(uint64_t key) const noexcept {
    return bounds_.relate(key) == Relation::outside ? Relation::outside : Relation::edge;
}

bool CircleRegion::contains(double latitude, double longitude) const noexcept {
    return centre_.distance_to({latitude, longitude}) <= radius_;
}

} // namespace locus::pmq
