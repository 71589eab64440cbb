// The windows of a packed-memory array: how many records each holds and how many it may hold (thesis section 3.2.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::pmq {

// The options of the packed array.
struct Densities {
    unsigned segment_slots = 8; // a power of two
    double rho_leaf = 0.08, tau_leaf = 0.92, rho_root = 0.30, tau_root = 0.70;
};

// Level 0 has the segments; a window of level l covers 2^l of them; the root, level height(), all.
class Windows {
public:
    Windows() = default;
    Windows(const Densities &densities, unsigned height);

    unsigned height() const noexcept { return height_; }
    size_t segments() const noexcept { return size_t{1} << height_; }
    size_t slots() const noexcept { return segments() << segment_shift_; }
    unsigned segment_shift() const noexcept { return segment_shift_; }
    size_t bytes() const noexcept;
    static size_t bytes(unsigned height) noexcept;

    uint64_t count(unsigned level, size_t window) const noexcept {
        return level == 0 ? segment_[window] : above_[offset(level) + window];
    }
    uint64_t total() const noexcept { return count(height_, 0); }
    // The records of the segments first <= s < last.
    uint64_t between(size_t first, size_t last) const noexcept;

    void set_segment(size_t segment, size_t count) noexcept { segment_[segment] = static_cast<uint16_t>(count); }
    // Add up the levels above the segments of a window, and carry the difference to the windows around it.
    void recount(unsigned level, size_t window) noexcept;

    // The bounds of the density as numbers of records: what an operation may leave in a window,
    uint64_t most(unsigned level) const noexcept { return most_[level]; }
    uint64_t least(unsigned level) const noexcept { return least_[level]; }
    // and what an even spread over a wider window may have left: a whole record more or less.
    uint64_t most_rounded(unsigned level) const noexcept { return most_rounded_[level]; }
    uint64_t least_rounded(unsigned level) const noexcept { return least_rounded_[level]; }

private:
    size_t offset(unsigned level) const noexcept { return segments() - (segments() >> (level - 1)); }

    unsigned height_ = 0;
    unsigned segment_shift_ = 0;
    std::vector<uint16_t> segment_; // counts of level 0
    std::vector<uint64_t> above_;   // counts of levels 1, 2, ..., one after the other
    std::vector<uint64_t> most_, least_, most_rounded_, least_rounded_;
};

// An even spread: segment s of `segments` (a power of two) gets the records from share(s) up to share(s + 1) of
// `count`.
struct EvenSpread {
    uint64_t count, segments;
    uint64_t share(uint64_t segment) const noexcept {
        return count / segments * segment + count % segments * segment / segments;
    }
};

} // namespace locus::pmq
