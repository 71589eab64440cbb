// Building, repairing and checking the explicit quadtree.
#include "pmq/layout/quadtree_index.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>

namespace locus::pmq {
namespace {

constexpr size_t none = std::numeric_limits<size_t>::max();

// A quadrant's records lie in the segments first..last; there are none if first > last.
struct Span {
    size_t first = 1, last = 0;
    bool empty() const noexcept { return first > last; }
    bool divided(unsigned level) const noexcept { return first < last && level < key_levels; }
};

// The windows that reach into first..last.
std::span<const Dirty> touching(std::span<const Dirty> dirty, size_t first, size_t last) {
    const auto begin =
        std::partition_point(dirty.begin(), dirty.end(), [=](const Dirty &window) { return window.last < first; });
    const auto end =
        std::partition_point(begin, dirty.end(), [=](const Dirty &window) { return window.first <= last; });
    return {begin, end};
}

Span whole(const Segments &segments) {
    if (segments.windows.total() == 0)
        return {};
    Span span{0, segments.count() - 1};
    while (segments.size(span.first) == 0)
        ++span.first;
    while (segments.size(span.last) == 0)
        --span.last;
    return span;
}

} // namespace

class QuadtreeIndex::Builder {
public:
    Builder(const Segments &segments, size_t &nodes) : segments_(segments), nodes_(nodes) {}

    // `span` is where the records of the quadrant lie, from here on.
    void build(Node &node, const Quadrant &quadrant, const Span &span) {
        set(node, span);
        if (!span.divided(quadrant.level))
            return;
        divide(node);
        const auto spans = children(quadrant, fresh_borders(quadrant, span), nullptr);
        for (unsigned child = 0; child < 4; ++child)
            if (!spans[child].empty())
                build((*node.children)[child], quadrant.child(child), spans[child]);
    }

    void repair(Node &node, const Quadrant &quadrant, const Span &span, std::span<const Dirty> dirty) {
        dirty = touching(dirty, std::min<size_t>(node.first, span.first), std::max<size_t>(node.last, span.last));
        if (dirty.empty() && node.first == span.first && node.last == span.last)
            return;
        if (!span.divided(quadrant.level) || !node.children) {
            prune(node);
            build(node, quadrant, span);
            return;
        }
        const auto spans = children(quadrant, renewed_borders(node, quadrant, span, dirty), node.children.get());
        set(node, span);
        for (unsigned number = 0; number < 4; ++number) {
            Node &child = (*node.children)[number];
            if (spans[number].empty())
                prune(child);
            else if (child.empty())
                build(child, quadrant.child(number), spans[number]);
            else
                repair(child, quadrant.child(number), spans[number], dirty);
        }
    }

    void prune(Node &node) noexcept {
        if (node.children) {
            for (Node &child : *node.children)
                prune(child);
            nodes_ -= 4;
        }
        node = Node{};
    }

    void check(const Node &node, const Quadrant &quadrant, const Span &span) const {
        const auto good = [&](bool equal) {
            if (!equal)
                fail(LOCUS_E_INTERNAL, "quadtree index: node of level ", quadrant.level, ", code ", quadrant.code,
                     " holds segments ", node.first, "..", node.last, ", its records lie in ", span.first, "..",
                     span.last);
        };
        good(node.empty() == span.empty());
        if (span.empty())
            return good(!node.children);
        good(node.first == span.first && node.last == span.last &&
             (node.children != nullptr) == span.divided(quadrant.level));
        if (!node.children)
            return;
        const auto spans = children(quadrant, fresh_borders(quadrant, span), nullptr);
        for (unsigned child = 0; child < 4; ++child)
            check((*node.children)[child], quadrant.child(child), spans[child]);
    }

private:
    void set(Node &node, const Span &span) noexcept {
        node.first = static_cast<uint32_t>(span.first);
        node.last = static_cast<uint32_t>(span.last);
    }

    void divide(Node &node) {
        node.children = std::make_unique<Children>();
        nodes_ += 4;
    }

    // The borders around and between the children.
    Borders fresh_borders(const Quadrant &quadrant, const Span &span) const {
        return {Border{none, span.first, false}, border(1, quadrant, span, span), border(2, quadrant, span, span),
                border(3, quadrant, span, span), Border{span.last, none, false}};
    }

    // A border is where it was if no segment of its neighbours, nor any between them, was rewritten. One without a
    // neighbour on one side is where the records of the quadrant begin or end.
    Borders renewed_borders(const Node &node, const Quadrant &quadrant, const Span &span,
                            std::span<const Dirty> dirty) const {
        const bool same_first = node.first == span.first && touching(dirty, span.first, span.first).empty();
        const bool same_last = node.last == span.last && touching(dirty, span.last, span.last).empty();
        Borders borders{Border{none, span.first, same_first}, {}, {}, {}, Border{span.last, none, same_last}};
        for (unsigned number = 1; number < 4; ++number) {
            const Border old = old_border(node, number);
            const bool same = old.before == none  ? same_first
                              : old.after == none ? same_last
                                                  : touching(dirty, old.before, old.after).empty();
            borders[number] = same ? old : border(number, quadrant, span, hull_of(old, span, dirty));
        }
        return borders;
    }

    // From the borders to the children's spans. A child between two borders that are where they were has kept its own.
    std::array<Span, 4> children(const Quadrant &quadrant, const Borders &borders, const Children *old) const {
        std::array<Span, 4> spans;
        for (unsigned number = 0; number < 4; ++number) {
            if (borders[number].same && borders[number + 1].same) {
                spans[number] = {(*old)[number].first, (*old)[number].last};
                continue;
            }
            const size_t first = borders[number].after, last = borders[number + 1].before;
            if (first == none || last == none || first > last)
                continue;
            const KeyRange keys = quadrant.child(number).keys();
            if (first == last && segments_.below(first, keys.lo) == segments_.below(first, keys.hi))
                continue;
            spans[number] = {first, last};
        }
        return spans;
    }

    // Search the border below child `number` among the segments of `hull`.
    Border border(unsigned number, const Quadrant &quadrant, const Span &span, const Span &hull) const {
        const uint64_t key = quadrant.child(number).keys().lo;
        const size_t segment = segments_.locate(key, hull.first, hull.last);
        const size_t smaller = segments_.below(segment, key);
        Border border{segment, segment, false};
        if (smaller == 0) {
            border.before = none;
            for (size_t s = segment; s > span.first && border.before == none;)
                if (segments_.size(--s) != 0)
                    border.before = s;
        }
        if (smaller == segments_.size(segment)) {
            border.after = none;
            for (size_t s = segment; s < span.last && border.after == none;)
                if (segments_.size(++s) != 0)
                    border.after = s;
        }
        return border;
    }

    // Where the border below child `number` was.
    static Border old_border(const Node &node, unsigned number) {
        Border old{none, none, true};
        for (unsigned i = 0; i < 4; ++i) {
            const Node &child = (*node.children)[i];
            if (child.empty())
                continue;
            if (i < number)
                old.before = child.last;
            else if (old.after == none)
                old.after = child.first;
        }
        return old;
    }

    // The segments within which a border has moved: records never pass a window that was not rewritten.
    static Span hull_of(const Border &old, const Span &span, std::span<const Dirty> dirty) {
        Span hull = span;
        if (old.before != none) {
            const auto window = touching(dirty, old.before, old.before);
            hull.first = std::clamp(window.empty() ? old.before : window.front().first, span.first, span.last);
        }
        if (old.after != none) {
            const auto window = touching(dirty, old.after, old.after);
            hull.last = std::clamp(window.empty() ? old.after : window.front().last, hull.first, span.last);
        }
        return hull;
    }

    const Segments &segments_;
    size_t &nodes_;
};

size_t QuadtreeIndex::bytes() const noexcept { return nodes_ / 4 * (sizeof(Children) + 2 * sizeof(void *)); }

void QuadtreeIndex::drop() noexcept {
    root_ = Node{};
    nodes_ = 0;
    present_ = false;
}

void QuadtreeIndex::build(const Segments &segments) {
    drop();
    if (segments.count() > std::numeric_limits<uint32_t>::max())
        return;
    const Span span = whole(segments);
    if (!span.empty())
        Builder(segments, nodes_).build(root_, {}, span);
    present_ = true;
}

void QuadtreeIndex::repair(const Segments &segments, std::span<const Dirty> dirty) {
    Builder builder(segments, nodes_);
    const Span span = whole(segments);
    span.empty() ? builder.prune(root_) : builder.repair(root_, {}, span, dirty);
}

Place QuadtreeIndex::everywhere() const noexcept {
    return {root_.first, root_.last, reinterpret_cast<uintptr_t>(&root_), 0};
}

Place QuadtreeIndex::narrow(const Place &outer, const Quadrant &quadrant) const noexcept {
    const auto *node = reinterpret_cast<const Node *>(static_cast<uintptr_t>(outer.node));
    unsigned level = outer.level;
    for (; level < quadrant.level && node->children; ++level)
        node = &(*node->children)[quadrant.code >> (2 * (quadrant.level - level - 1)) & 3];
    return {node->first, node->last, reinterpret_cast<uintptr_t>(node), level};
}

void QuadtreeIndex::check(const Segments &segments) const {
    size_t nodes = nodes_;
    if (present_)
        Builder(segments, nodes).check(root_, {}, whole(segments));
}

} // namespace locus::pmq
