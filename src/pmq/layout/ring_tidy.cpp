// Upkeep of the directory: neighbours that have become small are merged, and leaves leave slabs that are to be given
// back. All of it can wait: where there is no memory for it, things stay as they are.
#include "pmq/layout/ring_leaves.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

// Neighbours are merged that together fill less than this part of a leaf. A window of constant size splits leaves all
// the time, so what is merged decides how full they are; what is left free lets a merged leaf take some records before
// it is split.
constexpr double merged_part = 7.0 / 8;

} // namespace

void RingLeaves::tidy(size_t position) noexcept {
    try {
        const auto small = static_cast<size_t>(merged_part * static_cast<double>(shape_.slots));
        for (size_t i = directory()[position]->leaves; i-- > 0;) {
            const Node &node = *directory()[position];
            if (i + 1 < node.leaves && size_t{node.leaf[i].count} + node.leaf[i + 1].count < small)
                merge_leaves(position, i);
            else if (slabs_.vacating(node.leaf[i].memory)) {
                own(position);
                relocate(position, i);
            }
        }
        if (position + 1 < directory().size())
            merge_nodes(position);
    } catch (const std::bad_alloc &) {
    }
}

void RingLeaves::tidy_all() noexcept {
    for (size_t i = directory().size(); i-- > 0;)
        tidy(i);
    cursor_ = 0;
}

// Take an empty leaf out; the one before, or for the first the one behind, takes over its keys.
void RingLeaves::drop_leaf(Node &node, size_t leaf) noexcept {
    const uint64_t separator = node.separators[leaf];
    retire(node.leaf[leaf].memory, node.leaf[leaf].born);
    node.remove(leaf);
    if (leaf == 0)
        node.separators[0] = separator;
    --leaf_count_;
    ++structure_;
}

void RingLeaves::merge_leaves(size_t position, size_t leaf) {
    expect_garbage(2);
    Node &node = own(position);
    expect_garbage(2);
    for (const size_t empty : {leaf + 1, leaf}) {
        if (node.leaf[empty].count == 0) {
            drop_leaf(node, empty);
            return;
        }
    }
    Target both = target(slabs_.take());
    merge_in_time(both, node, leaf, leaf + 1);
    counters_.moved += both.count;
    ++counters_.rebalances;
    retire(node.leaf[leaf].memory, node.leaf[leaf].born);
    install(node, leaf, both);
    node.total -= node.leaf[leaf + 1].count;
    node.leaf[leaf + 1].count = 0;
    drop_leaf(node, leaf + 1);
}

// Merge by time, so that what expires stays a prefix. Where that might put equal keys out of the order of their
// arrival, the left leaf's entries come first.
void RingLeaves::merge_in_time(Target &target, const Node &node, size_t left, size_t right) const noexcept {
    const size_t lefts = node.leaf[left].count, rights = node.leaf[right].count;
    bool in_time = node.is_ordered(left) && node.is_ordered(right);
    for (size_t i = 0; i < lefts && in_time; ++i)
        in_time = key_at(node, left, i) != node.separators[right];
    size_t l = 0, r = 0;
    while (l < lefts || r < rights) {
        const bool take_left =
            l < lefts && (r == rights || !in_time || time_at(node, left, l) <= time_at(node, right, r));
        const size_t leaf = take_left ? left : right, entry = take_left ? l++ : r++;
        add(target, key_at(node, leaf, entry), record_at(node, leaf, entry));
    }
}

void RingLeaves::merge_nodes(size_t position) {
    const Node &first = *directory()[position], &second = *directory()[position + 1];
    const size_t together = first.leaves + second.leaves;
    const bool empty = first.total == 0 || second.total == 0;
    if (together > (empty ? Node::fanout - 4 : Node::fanout / 2))
        return;
    expect_garbage(2);
    Node &target = own(position);
    expect_garbage(1);
    Node *source = directory()[position + 1];
    target.append(*source, 0, source->leaves);
    directory().remove(position + 1);
    retire(source);
    ++structure_;
}

} // namespace locus::pmq
