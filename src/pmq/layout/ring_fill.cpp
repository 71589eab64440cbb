// Filling a store that is being made with records in the order of their keys: leaf by leaf, without a split.
#include "pmq/layout/ring_leaves.hpp"

#include "pmq/layout/ring_order.hpp"

#include <algorithm>
#include <numeric>

namespace locus::pmq {
namespace {

// Of four: room is left, so that the first batches that come do not split every leaf, and nodes likewise.
constexpr size_t filled_quarters = 3;
constexpr size_t leaves_together = 21;

} // namespace

size_t RingLeaves::filled_slots() const noexcept { return shape_.slots / 4 * filled_quarters; }
size_t RingLeaves::fill_batch() const noexcept { return filled_slots() * leaves_together; }

void RingLeaves::fill(const Batch &batch, Eviction &, Departures &) {
    const Change change(*this, true);
    slabs_.prepare();
    if (ages_.wanted())
        ages_.reserve(batch.count);
    for (size_t begin = 0; begin < batch.count; begin += filled_slots())
        fill_leaf(batch, begin, std::min(begin + filled_slots(), batch.count));
}

// Records come in the order of their keys. A leaf takes them in that of time, so that what expires is a prefix again:
// arrival is known only among equal keys, and any order that keeps it will do.
void RingLeaves::fill_leaf(const Batch &batch, size_t begin, size_t end) {
    const Node &last = own(directory().size() - 1);
    if (last.leaf[last.leaves - 1].count > 0)
        append_leaf(batch.keys[begin]);
    LeafOrder by_time;
    bool arrival_known = false; // to be another order than that of time
    for (size_t i = begin; i < end; ++i) {
        const int64_t time = format_.time(batch.records + i * format_.size);
        by_time.add(static_cast<uint64_t>(time) ^ uint64_t{1} << 63, i - begin);
        arrival_known = arrival_known || (i > begin && batch.keys[i] == batch.keys[i - 1] &&
                                          time < format_.time(batch.records + (i - 1) * format_.size));
        newest_ = std::max(newest_, time);
        if (ages_.wanted())
            ages_.add(time);
    }
    uint32_t order[LeafShape::most_slots];
    if (arrival_known || !by_time.sortable())
        std::iota(order, order + (end - begin), 0);
    else
        by_time.sort(order);
    Node &node = own(directory().size() - 1);
    const size_t leaf = node.leaves - 1u;
    Target target{node.leaf[leaf].memory};
    for (size_t i = 0; i < end - begin; ++i)
        add(target, batch.keys[begin + order[i]], batch.records + (begin + order[i]) * format_.size);
    install(node, leaf, target);
    edition().stored += target.count;
}

// An empty leaf behind the last one, for keys from `key` on.
void RingLeaves::append_leaf(uint64_t key) {
    const size_t last = directory().size() - 1;
    const LeafMemory memory = slabs_.take();
    if (directory()[last]->leaves < Node::fanout / 4 * filled_quarters) {
        Node &node = *directory()[last];
        node.insert(node.leaves, key, memory);
    } else {
        directory().reserve_one();
        Node *node = take_node();
        node->clear();
        node->version = change_;
        node->insert(0, key, memory);
        directory().insert(last + 1, node);
    }
    ++leaf_count_;
    ++structure_;
}

} // namespace locus::pmq
