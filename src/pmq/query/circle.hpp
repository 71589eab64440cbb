// Circles on the globe.
#pragma once

#include "core/sphere.hpp"
#include "pmq/query/region.hpp"

namespace locus::pmq {

// The places within `radius` metres along the great circle, border included.
class CircleRegion final : public Region {
public:
    explicit CircleRegion(const locus_circle &circle);
    Relation relate(const Quadrant &quadrant) const noexcept override;
    Relation relate(uint64_t key) const noexcept override;
    bool contains(double latitude, double longitude) const noexcept override;

private:
    Site centre_;
    double radius_; // metres
    double angle_;  // radians
    BoxRegion bounds_;
};

} // namespace locus::pmq
