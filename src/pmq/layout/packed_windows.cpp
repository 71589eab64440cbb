// Counts and density bounds of windows.
#include "pmq/layout/packed_windows.hpp"

#include <bit>
#include <cmath>

namespace locus::pmq {

// The bounds are linear from the segment to the root: equations 3.2 and 3.3.
Windows::Windows(const Densities &densities, unsigned height)
    : height_(height), segment_shift_(static_cast<unsigned>(std::countr_zero(densities.segment_slots))),
      segment_(segments()), above_(segments() - 1) {
    for (unsigned level = 0; level <= height; ++level) {
        const double from_root = height == 0 ? 0.0 : static_cast<double>(height - level) / height;
        const auto slots = static_cast<double>(uint64_t{densities.segment_slots} << level);
        const double most = slots * (densities.tau_root + (densities.tau_leaf - densities.tau_root) * from_root);
        const double least = slots * (densities.rho_root + (densities.rho_leaf - densities.rho_root) * from_root);
        most_.push_back(static_cast<uint64_t>(std::floor(most)));
        most_rounded_.push_back(static_cast<uint64_t>(std::ceil(most)));
        least_.push_back(static_cast<uint64_t>(std::ceil(least)));
        least_rounded_.push_back(static_cast<uint64_t>(std::floor(least)));
    }
    least_.back() = height == 0 ? 0 : least_.back(); // the smallest array may be empty
    least_rounded_.back() = least_.back();
    most_rounded_.back() = most_.back();
}

size_t Windows::bytes(unsigned height) noexcept {
    return (size_t{1} << height) * (sizeof(uint16_t) + sizeof(uint64_t)) + (height + 1) * 4 * sizeof(uint64_t);
}

size_t Windows::bytes() const noexcept { return bytes(height_); }

uint64_t Windows::between(size_t first, size_t last) const noexcept {
    uint64_t sum = 0;
    for (unsigned level = 0; first < last; ++level, first >>= 1, last >>= 1) {
        if (first & 1)
            sum += count(level, first++);
        if (last & 1)
            sum += count(level, --last);
    }
    return sum;
}

void Windows::recount(unsigned level, size_t window) noexcept {
    for (unsigned l = 1; l <= level; ++l)
        for (size_t w = window << (level - l), end = (window + 1) << (level - l); w < end; ++w)
            above_[offset(l) + w] = count(l - 1, 2 * w) + count(l - 1, 2 * w + 1);
    for (unsigned l = level + 1; l <= height_; ++l) {
        const size_t w = window >> (l - level);
        above_[offset(l) + w] = count(l - 1, 2 * w) + count(l - 1, 2 * w + 1);
    }
}

} // namespace locus::pmq
