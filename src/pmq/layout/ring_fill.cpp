// Filling a store that is being made with records in the order of their keys: leaf by leaf, without a split, by several
// threads.
#include "pmq/layout/ring_leaves.hpp"

#include "core/crew.hpp"
#include "pmq/eviction.hpp"
#include "pmq/layout/ring_order.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

// Of four: room is left, so that the first batches that come do not split every leaf, and nodes likewise.
constexpr size_t filled_quarters = 3;
constexpr size_t leaves_together = 21;
constexpr size_t leaves_at_once = 128; // by a thread: hardly two of them touch the same new page

} // namespace

size_t RingLeaves::filled_slots() const noexcept { return shape_.slots / 4 * filled_quarters; }
size_t RingLeaves::fill_batch() const noexcept { return filled_slots() * leaves_together; }

void RingLeaves::fill(const Batch &batch, Crew &crew, Eviction &eviction, Departures &) {
    const Change change(*this, true);
    edition().moment = eviction.moment(); // the leaves' times are noted for it
    if (ages_.wanted()) {
        ages_.reserve(batch.count);
        for (size_t i = 0; i < batch.count; ++i)
            ages_.add(format_.time(batch.records + i * format_.size));
    }
    own(0);
    std::vector<Filled> filled;
    filled.reserve(batch.count / filled_slots() + 1);
    for (size_t begin = 0; begin < batch.count; begin += filled_slots()) {
        const bool first = edition_->stored + begin == 0; // the one leaf of an empty store is there
        const Spot spot = first ? Spot{0, 0} : append_leaf(batch.keys[begin]);
        const LeafMemory memory = directory()[spot.node]->leaf[spot.leaf].memory;
        filled.push_back({spot, begin, std::min(begin + filled_slots(), batch.count), target(memory), INT64_MIN});
    }
    crew.for_each(filled.size(), leaves_at_once, [&](uint64_t first, uint64_t end) {
        for (uint64_t i = first; i < end; ++i)
            fill_leaf(batch, filled[i]);
    });
    for (const Filled &leaf : filled) {
        install(*directory()[leaf.spot.node], leaf.spot.leaf, leaf.target);
        newest_ = std::max(newest_, leaf.newest);
    }
    edition().stored += batch.count;
}

// Records come in the order of their keys. A leaf takes them in that of time, so that what expires is a prefix again:
// arrival is known only among equal keys, and any order that keeps it will do.
void RingLeaves::fill_leaf(const Batch &batch, Filled &leaf) const noexcept {
    const size_t begin = leaf.begin, end = leaf.end;
    const auto time_of = [&](size_t i) { return format_.time(batch.records + i * format_.size); };
    int64_t oldest = INT64_MAX, newest = INT64_MIN;
    bool in_time = true; // the order of arrival, where it is known
    for (size_t i = begin; i < end; ++i) {
        oldest = std::min(oldest, time_of(i));
        newest = std::max(newest, time_of(i));
        in_time = in_time && (i == begin || batch.keys[i] != batch.keys[i - 1] || time_of(i) >= time_of(i - 1));
    }
    leaf.newest = newest;
    const auto age = [&](int64_t time) { return static_cast<uint64_t>(time) - static_cast<uint64_t>(oldest); };
    const bool sorts = in_time && age(newest) < LeafOrder::values;
    LeafOrder order(0, sorts ? age(newest) : 0);
    for (size_t i = begin; i < end && sorts; ++i)
        order.add(age(time_of(i)), i - begin);
    if (sorts)
        order.sort();
    for (size_t n = 0; n < end - begin; ++n) {
        const size_t i = begin + (sorts ? order.number(n) : n);
        add(leaf.target, batch.keys[i], batch.records + i * format_.size);
    }
}

// An empty leaf behind the last one, for keys from `key` on.
RingLeaves::Spot RingLeaves::append_leaf(uint64_t key) {
    size_t last = directory().size() - 1;
    const LeafMemory memory = slabs_.take();
    if (Node &node = own(last); node.leaves < Node::fanout / 4 * filled_quarters) {
        node.insert(node.leaves, key, memory);
    } else {
        directory().reserve_one();
        Node *next = take_node();
        next->clear();
        next->version = change_;
        next->insert(0, key, memory);
        directory().insert(++last, next);
    }
    ++leaf_count_;
    ++structure_;
    return {last, directory()[last]->leaves - 1u};
}

} // namespace locus::pmq
