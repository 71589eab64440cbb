// Insertion: records are appended to their leaves in order of arrival, in groups, so that the memory one record waits
// for is fetched while others are found. A full leaf is split, or joined by an empty one.
#include "pmq/layout/ring_leaves.hpp"

#include "pmq/eviction.hpp"

#include <algorithm>
#include <span>

namespace locus::pmq {
namespace {

constexpr size_t most_group = 32;
// Readers may have to wait for a change of so many records; larger batches are written into copies.
constexpr size_t most_short = 8192;

} // namespace

void RingLeaves::insert(const Batch &batch, Eviction &eviction, Departures &departures) {
    uint64_t ties = 0;
    admit_late(batch, eviction, departures);
    {
        const Change change(*this, batch.count <= most_short);
        append(batch);
        try {
            edition().moment = clock(batch, eviction.moment(), ties);
        } catch (...) {
            take_back(batch, batch.count);
            throw;
        }
        edition().stored += batch.count;
    }
    try { // what may go can also go later
        if (ties > 0)
            drop_equal(edition_->moment.cutoff, ties, departures);
        tend(batch.count, eviction, departures);
        hold_bytes(departures);
    } catch (const std::bad_alloc &) {
    }
}

void RingLeaves::append(const Batch &batch) {
    size_t done = 0;
    try {
        const size_t groups = (batch.count + most_group - 1) / most_group;
        for (size_t group = 0; group < groups; ++group)
            append_group(batch, batch.count * group / groups, batch.count * (group + 1) / groups, done);
    } catch (...) {
        take_back(batch, done);
        throw;
    }
}

void RingLeaves::append_group(const Batch &batch, size_t begin, size_t end, size_t &done) {
    Spot spots[most_group];
    for (size_t i = begin; i < end; ++i) {
        spots[i - begin].node = directory().find(batch.keys[i]);
        directory().prefetch(spots[i - begin].node);
    }
    for (size_t i = begin; i < end; ++i) {
        Spot &spot = spots[i - begin];
        const Node &node = own(spot.node);
        spot.leaf = node.find(batch.keys[i]);
        __builtin_prefetch(&node.leaf[spot.leaf], 1);
    }
    for (const Spot &spot : std::span(spots, end - begin)) {
        const LeafEntry &leaf = directory()[spot.node]->leaf[spot.leaf];
        const size_t slot = shape_.slot(leaf.head, leaf.count);
        __builtin_prefetch(shape_.keys(leaf.memory) + slot, 1);
        const std::byte *record = shape_.record(leaf.memory, slot);
        for (size_t at = 0; at < format_.size; at += 64)
            __builtin_prefetch(record + at, 1);
    }
    const uint64_t structure = structure_;
    for (size_t i = begin; i < end; ++i, ++done) {
        const uint64_t key = batch.keys[i];
        Spot spot = structure == structure_ ? spots[i - begin] : find(key);
        for (;;) {
            const Node &node = own(spot.node);
            if (node.leaf[spot.leaf].count + node.leaf[spot.leaf].ghosts < shape_.slots)
                break;
            make_room(spot, key);
            spot = find(key);
        }
        put(*directory()[spot.node], spot.leaf, key, batch.records + i * format_.size);
    }
}

void RingLeaves::put(Node &node, size_t leaf, uint64_t key, Bytes record) noexcept {
    LeafEntry &to = node.leaf[leaf];
    const size_t slot = shape_.slot(to.head, to.count);
    const int64_t time = format_.time(record);
    if (time >= newest_)
        newest_ = time;
    else if (to.count > 0 && time < time_at(node, leaf, to.count - 1u))
        node.set_ordered(leaf, false);
    shape_.keys(to.memory)[slot] = key;
    copy_record(shape_.record(to.memory, slot), record, format_.size);
    to.oldest = std::min(to.oldest, time);
    ++to.count;
    ++node.total;
}

RingLeaves::Spot RingLeaves::find(uint64_t key) const noexcept {
    const size_t node = edition_->directory.find(key);
    return {node, edition_->directory[node]->find(key)};
}

// Undo the first `done` insertions of a batch, the last one first: each is the youngest entry of its leaf, whatever was
// split in between. It lies in the last leaf that may hold the key and is not behind a newer, empty one.
void RingLeaves::take_back(const Batch &batch, size_t done) noexcept {
    while (done-- > 0) {
        const uint64_t key = batch.keys[done];
        Spot spot = find(key);
        Node *node = directory()[spot.node];
        while (node->leaf[spot.leaf].count == 0 || key_at(*node, spot.leaf, node->leaf[spot.leaf].count - 1u) != key) {
            if (spot.leaf == 0) {
                node = directory()[--spot.node];
                spot.leaf = node->leaves;
            }
            --spot.leaf;
        }
        LeafEntry &leaf = node->leaf[spot.leaf];
        --leaf.count;
        leaf.known = static_cast<uint8_t>(std::min<size_t>(leaf.known, leaf.count));
        --node->total;
    }
}

// Change the directory so that the leaf, or the one that then takes the key, has room.
void RingLeaves::make_room(const Spot &spot, uint64_t key) {
    if (directory()[spot.node]->leaves == Node::fanout) {
        split_node(spot.node);
        return;
    }
    const Node &node = own(spot.node);
    if (node.leaf[spot.leaf].count <= shape_.slots / 2) { // full of ghosts
        relocate(spot.node, spot.leaf);
        return;
    }
    const uint64_t at = pivot(node, spot.leaf);
    if (at != Node::unused) {
        partition(spot.node, spot.leaf, at);
        return;
    }
    // All keys are equal: an empty leaf takes what comes behind them, or, for a smaller key, before.
    const uint64_t all = key_at(node, spot.leaf, 0);
    const LeafMemory empty = slabs_.take();
    Node &owned = *directory()[spot.node];
    if (key < all) {
        owned.insert(spot.leaf, owned.separators[spot.leaf], empty);
        owned.separators[spot.leaf + 1] = all;
    } else {
        owned.insert(spot.leaf + 1, all, empty);
    }
    ++leaf_count_;
    ++structure_;
}

void RingLeaves::split_node(size_t position) {
    own(position);
    directory().reserve_one();
    Node *upper = take_node();
    Node &lower = *directory()[position];
    upper->clear();
    upper->version = change_;
    upper->append(lower, Node::fanout / 2, Node::fanout);
    lower.truncate(Node::fanout / 2);
    directory().insert(position + 1, upper);
    ++structure_;
}

// A key that parts the leaf in two halves, about: the median of a sample; every key on its left is smaller. `unused` if
// all keys are equal.
uint64_t RingLeaves::pivot(const Node &node, size_t leaf) const noexcept {
    constexpr size_t samples = 33;
    uint64_t sample[samples];
    const size_t count = node.leaf[leaf].count;
    for (size_t i = 0; i < samples; ++i)
        sample[i] = key_at(node, leaf, i * (count - 1) / (samples - 1));
    std::nth_element(sample, sample + samples / 2, sample + samples);
    const uint64_t median = sample[samples / 2];
    uint64_t smallest_above = Node::unused;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t key = key_at(node, leaf, i);
        if (key < median)
            return median;
        if (key > median)
            smallest_above = std::min(smallest_above, key);
    }
    return smallest_above;
}

// Move a leaf's entries, in their order, to one or two leaves: the keys below the pivot to the left one. The left one
// may be the leaf itself when nobody reads it.
void RingLeaves::partition(size_t position, size_t leaf, uint64_t pivot) {
    expect_garbage(1);
    const LeafMemory right = slabs_.take();
    const bool in_place = unread(directory()[position]->leaf[leaf].born);
    LeafMemory left = directory()[position]->leaf[leaf].memory;
    if (!in_place) {
        try {
            left = slabs_.take();
        } catch (...) {
            slabs_.give_back(right);
            throw;
        }
    }
    Node &node = *directory()[position];
    const LeafMemory old = node.leaf[leaf].memory;
    const uint64_t born = node.leaf[leaf].born;
    // Which entry goes where is as good as random: no branch is to depend on it.
    uint16_t below[LeafShape::most_slots], above[LeafShape::most_slots];
    size_t lows = 0, highs = 0;
    for (size_t i = 0, count = node.leaf[leaf].count; i < count; ++i) {
        below[lows] = above[highs] = static_cast<uint16_t>(i);
        const bool is_low = key_at(node, leaf, i) < pivot;
        lows += is_low;
        highs += !is_low;
    }
    Target low = target(left, in_place ? node.leaf[leaf].head : size_t{0}), high = target(right);
    for (const size_t i : std::span(above, highs))
        add(high, key_at(node, leaf, i), record_at(node, leaf, i));
    for (const size_t i : std::span(below, lows))
        add(low, key_at(node, leaf, i), record_at(node, leaf, i));
    counters_.moved += low.count + high.count;
    ++counters_.rebalances;
    node.insert(leaf + 1, pivot, right);
    install(node, leaf, low);
    install(node, leaf + 1, high);
    if (left != old)
        retire(old, born);
    ++leaf_count_;
    ++structure_;
}

// A copy of a leaf without its ghosts.
void RingLeaves::relocate(size_t position, size_t leaf) {
    expect_garbage(1);
    Target copy = target(slabs_.take());
    Node &node = *directory()[position];
    for (size_t i = 0, count = node.leaf[leaf].count; i < count; ++i)
        add(copy, key_at(node, leaf, i), record_at(node, leaf, i));
    counters_.moved += copy.count;
    retire(node.leaf[leaf].memory, node.leaf[leaf].born);
    install(node, leaf, copy);
}

void RingLeaves::add(Target &target, uint64_t key, Bytes record) const noexcept {
    const size_t slot = shape_.slot(target.head, target.count);
    const int64_t time = format_.time(record);
    shape_.keys(target.memory)[slot] = key;
    std::byte *to = shape_.record(target.memory, slot);
    if (to != record)
        copy_record(to, record, format_.size);
    if (target.known == target.count && target.known < LeafShape::most_times && target.unit != HeadTimes::no_unit) {
        HeadTimes::write(shape_.times(target.memory), slot, time, target.unit);
        ++target.known;
    }
    target.ordered = target.ordered && time >= target.newest;
    target.newest = time;
    target.oldest = std::min(target.oldest, time);
    ++target.count;
}

// The target holds what the leaf has held, or a part of it.
void RingLeaves::install(Node &node, size_t leaf, const Target &target) noexcept {
    node.total -= node.leaf[leaf].count;
    if (node.leaf[leaf].memory != target.memory)
        node.leaf[leaf].born = change_;
    node.leaf[leaf].memory = target.memory;
    node.leaf[leaf].head = static_cast<uint16_t>(target.head);
    node.leaf[leaf].count = static_cast<uint16_t>(target.count);
    node.leaf[leaf].ghosts = 0;
    node.leaf[leaf].known = target.known;
    node.leaf[leaf].unit = target.unit;
    node.leaf[leaf].oldest = target.oldest;
    node.set_ordered(leaf, target.ordered);
    node.total += node.leaf[leaf].count;
}

} // namespace locus::pmq
