// The sign of a determinant: in double precision where that is certain, else by exact sums.
#include "core/orientation.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace locus {
namespace {

int sign(double value) noexcept { return (value > 0) - (value < 0); }

// A sum held as doubles of growing magnitude that do not overlap.
class ExactSum {
public:
    void add_product(double a, double b) noexcept {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }
    int sign_of() const noexcept {
        for (size_t i = count_; i-- > 0;)
            if (parts_[i] != 0)
                return sign(parts_[i]);
        return 0;
    }

private:
    void add(double value) noexcept {
        for (size_t i = 0; i < count_; ++i) {
            const double sum = value + parts_[i], part = sum - value;
            parts_[i] = (value - (sum - part)) + (parts_[i] - part);
            value = sum;
        }
        parts_[count_++] = value;
    }

    double parts_[12];
    size_t count_ = 0;
};

} // namespace

int orientation(const PlanePoint &a, const PlanePoint &b, const PlanePoint &c) noexcept {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
    const double determinant = left - right;
    constexpr double bound = 4 * std::numeric_limits<double>::epsilon();
    if (std::abs(determinant) > bound * (std::abs(left) + std::abs(right)))
        return sign(determinant);
    ExactSum sum; // the same multiplied out; the products of c by itself cancel
    sum.add_product(a.x, b.y);
    sum.add_product(-a.x, c.y);
    sum.add_product(-c.x, b.y);
    sum.add_product(-a.y, b.x);
    sum.add_product(a.y, c.x);
    sum.add_product(c.y, b.x);
    return sum.sign_of();
}

} // namespace locus
