// On which side of a line does a point lie? Exactly.
#pragma once

namespace locus {

struct PlanePoint {
    double x, y;
    bool operator==(const PlanePoint &) const = default;
};

// 1 if a, b, c turn to the left, -1 if they turn to the right, 0 if they lie on one line. Exact as long as no product
// of two coordinates underflows. Method: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust
// geometric predicates, 1997.
int orientation(const PlanePoint &a, const PlanePoint &b, const PlanePoint &c) noexcept;

} // namespace locus
