// Filling a store that is being made with records in the order of their keys: leaf by leaf, without a split.
#include "pmq/layout/ring_leaves.hpp"

#include "pmq/eviction.hpp"
#include "pmq/layout/ring_order.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

// Of four: room is left, so that the first batches that come do not split every leaf, and nodes likewise.
constexpr size_t filled_quarters = 3;
constexpr size_t leaves_together = 21;

} // namespace

size_t RingLeaves::filled_slots() const noexcept { return shape_.slots / 4 * filled_quarters; }
size_t RingLeaves::fill_batch() const noexcept { return filled_slots() * leaves_together; }

void RingLeaves::fill(const Batch &batch, Eviction &eviction, Departures &) {
    const Change change(*this, true);
    edition().moment = eviction.moment(); // the leaves' times are noted for it
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
    const auto time_of = [&](size_t i) { return format_.time(batch.records + i * format_.size); };
    int64_t oldest = INT64_MAX, newest = INT64_MIN;
    bool in_time = true; // the order of arrival, where it is known
    for (size_t i = begin; i < end; ++i) {
        oldest = std::min(oldest, time_of(i));
        newest = std::max(newest, time_of(i));
        in_time = in_time && (i == begin || batch.keys[i] != batch.keys[i - 1] || time_of(i) >= time_of(i - 1));
        if (ages_.wanted())
            ages_.add(time_of(i));
    }
    newest_ = std::max(newest_, newest);
    const auto age = [&](int64_t time) { return static_cast<uint64_t>(time) - static_cast<uint64_t>(oldest); };
    const bool sorts = in_time && age(newest) < LeafOrder::values;
    LeafOrder order;
    for (size_t i = begin; i < end && sorts; ++i)
        order.add(age(time_of(i)), i - begin);
    if (sorts)
        order.sort();
    Node &node = own(directory().size() - 1);
    const size_t leaf = node.leaves - 1u;
    Target filled = target(node.leaf[leaf].memory);
    for (size_t n = 0; n < end - begin; ++n) {
        const size_t i = begin + (sorts ? order.number(n) : n);
        add(filled, batch.keys[i], batch.records + i * format_.size);
    }
    install(node, leaf, filled);
    edition().stored += filled.count;
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
