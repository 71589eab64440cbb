// The explicit index: a pointer quadtree whose nodes hold the first and the last segment with records of their
// quadrant, kept up to date through rebalances of windows (thesis section 3.4.3). Quadrants whose records lie in one
// segment are not divided further: that segment is scanned anyway.
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/layout/packed_segments.hpp"

#include <array>
#include <memory>
#include <span>

namespace locus::pmq {

// Segments first <= s <= last, rewritten.
struct Dirty {
    size_t first, last;
};

class QuadtreeIndex {
public:
    // An index that is not wanted, or was dropped for want of memory, is absent: searches are then binary.
    explicit QuadtreeIndex(bool wanted) : wanted_(wanted) {}

    bool wanted() const noexcept { return wanted_; }
    bool present() const noexcept { return present_; }
    size_t bytes() const noexcept;
    void drop() noexcept;

    void build(const Segments &segments);
    // Renew what the rewriting of these windows (ascending, disjoint) has changed.
    void repair(const Segments &segments, std::span<const Dirty> dirty);

    Place everywhere() const noexcept;
    Place narrow(const Place &outer, const Quadrant &quadrant) const noexcept;
    // Throws Error(LOCUS_E_INTERNAL) unless equal to a freshly built index.
    void check(const Segments &segments) const;

private:
    struct Node;
    using Children = std::array<Node, 4>;
    struct Node {
        uint32_t first = 1, last = 0; // empty: first > last
        std::unique_ptr<Children> children;
        bool empty() const noexcept { return first > last; }
    };
    // Where a key would be inserted among the records of a quadrant.
    struct Border {
        size_t before; // the segment of the last record with a smaller key, or none
        size_t after;  // the segment of the first record with another key, or none
        bool same;     // known to be where it was before the repair
    };
    using Borders = std::array<Border, 5>;
    class Builder;

    bool wanted_;
    bool present_ = false;
    size_t nodes_ = 0; // allocated beyond the root
    Node root_;
};

} // namespace locus::pmq
