// Great-circle distances on the sphere of LOCUS_EARTH_RADIUS.
#pragma once

#include "core/zcurve.hpp"

namespace locus {

// The metres between opposite ends of the globe: no distance is larger.
double half_globe() noexcept;

// A place as seen for its distances to others. 180 and -180 degrees are one meridian, a pole is one place.
class Site {
public:
    Site(double latitude, double longitude) noexcept;
    // Radians, 0..pi, to about 1e-15; zero for the same place.
    double angle_to(const Site &other) const noexcept;
    // At most the angle to any place whose key lies in the quadrant, whatever the rounding; too small by 1e-8 at most.
    double least_angle_to(const Quadrant &quadrant) const noexcept;
    // Likewise the largest one.
    double largest_angle_to(const Quadrant &quadrant) const noexcept;
    // Metres.
    double distance_to(const Site &other) const noexcept;
    double least_distance_to(const Quadrant &quadrant) const noexcept;

private:
    double least_angle_to_meridian(double longitude, double south, double north) const noexcept;

    double latitude_, longitude_; // degrees
    double x_, y_, z_;            // of the unit vector
};

} // namespace locus
