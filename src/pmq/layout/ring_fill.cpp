// Filling a store that is being made with records in the order of their keys: leaf by leaf, without a split.
#include "pmq/layout/ring_leaves.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

// Of four: room is left, so that the first batches that come do not split every leaf, and nodes likewise.
constexpr size_t filled_quarters = 3;

} // namespace

void RingLeaves::fill(const Batch &batch, Eviction &, Departures &) {
    const size_t most = shape_.slots / 4 * filled_quarters;
    const Change change(*this, true);
    slabs_.prepare();
    if (ages_.wanted())
        ages_.reserve(batch.count);
    std::vector<std::byte> scratch;
    for (size_t i = 0; i < batch.count;) {
        Node &node = own(directory().size() - 1);
        const size_t leaf = node.leaves - 1u;
        if (node.leaf[leaf].count == most) {
            order_by_time(node, leaf, scratch);
            append_leaf(batch.keys[i]);
            continue;
        }
        for (const size_t end = std::min(batch.count, i + most - node.leaf[leaf].count); i < end; ++i) {
            const Bytes record = batch.records + i * format_.size;
            put(node, leaf, batch.keys[i], record);
            ++edition().stored;
            if (ages_.wanted())
                ages_.add(format_.time(record));
        }
    }
}

// A leaf's entries came in the order of their keys. In that of time, what expires is a prefix again: arrival is known
// only among equal keys, and any order that keeps it will do.
void RingLeaves::order_by_time(Node &node, size_t leaf, std::vector<std::byte> &scratch) const {
    if (node.is_ordered(leaf))
        return;
    struct Entry {
        int64_t time;
        size_t number;
    };
    const size_t count = node.leaf[leaf].count;
    Entry entries[LeafShape::most_slots];
    for (size_t i = 0; i < count; ++i) {
        entries[i] = {time_at(node, leaf, i), i};
        if (i > 0 && key_at(node, leaf, i) == key_at(node, leaf, i - 1) && entries[i].time < entries[i - 1].time)
            return;
    }
    std::sort(entries, entries + count,
              [](const Entry &a, const Entry &b) { return a.time != b.time ? a.time < b.time : a.number < b.number; });
    const LeafMemory to = node.leaf[leaf].memory;
    scratch.assign(to, to + shape_.bytes());
    const LeafMemory from = scratch.data();
    for (size_t i = 0; i < count; ++i) {
        shape_.keys(to)[i] = shape_.keys(from)[entries[i].number];
        copy_record(shape_.record(to, i), shape_.record(from, entries[i].number), format_.size);
    }
    node.set_ordered(leaf, true);
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
