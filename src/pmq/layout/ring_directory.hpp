// Finding leaves: nodes of up to 64 leaves that hold all there is to know about them, and above the nodes one sorted
// array of their smallest keys with two levels of samples.
#pragma once

#include "pmq/layout/ring_leaf.hpp"

#include <cstdint>
#include <vector>

namespace locus::pmq {

// What there is to know of a leaf without looking into it. Half a cache line, so that an insertion waits for one line.
struct LeafEntry {
    LeafMemory memory;
    uint64_t born;   // the change that made the leaf
    int64_t oldest;  // no entry's time is smaller; INT64_MAX at first
    uint16_t head;   // the slot of the oldest entry
    uint16_t count;  // entries
    uint16_t ghosts; // slots before the head that must not be written yet: a reader may still see their entries
    uint8_t known;   // the times of so many first entries are at hand (ring_times.hpp),
    uint8_t unit;    // in this unit
};
static_assert(sizeof(LeafEntry) == 32);

// Neighbouring leaves. Leaf i holds keys from separators[i] to separators[i + 1], both included: an equal key is found
// in the earlier leaf if it arrived before the later leaf was made.
struct alignas(64) Node {
    static constexpr size_t fanout = 64;
    static constexpr uint64_t unused = UINT64_MAX; // the separators beyond the last leaf

    uint64_t version;       // the change that made this copy
    uint64_t ghost_version; // the change that left the latest ghosts; 0: there are none
    uint64_t ordered;       // bit i: the times in leaf i never decrease
    uint32_t leaves;
    uint32_t total; // entries of all leaves
    Node *next;     // in a list of spare nodes
    alignas(64) uint64_t separators[fanout];
    alignas(64) LeafEntry leaf[fanout];

    size_t find(uint64_t key) const noexcept;       // the last leaf with separator <= key
    size_t find_below(uint64_t key) const noexcept; // the last leaf with separator < key; the first where there is none
    bool is_ordered(size_t i) const noexcept { return ordered >> i & 1; }
    void set_ordered(size_t i, bool yes) noexcept { ordered = (ordered & ~(uint64_t{1} << i)) | uint64_t{yes} << i; }
    int64_t oldest_of_all() const noexcept;

    void clear() noexcept;
    // Make room for a leaf at i, and fill it.
    void insert(size_t i, uint64_t separator, LeafMemory memory) noexcept;
    void remove(size_t i) noexcept; // its entries no longer count
    // Append the leaves from..to of another node, with their entries.
    void append(const Node &other, size_t from, size_t to) noexcept;
    void truncate(size_t new_leaves) noexcept;
};

// One version of the directory.
class Directory {
public:
    size_t size() const noexcept { return nodes_.size(); }
    Node *operator[](size_t i) const noexcept { return nodes_[i]; }
    uint64_t smallest(size_t i) const noexcept { return smallest_[i]; }

    size_t find(uint64_t key) const noexcept; // the last node with smallest key <= key
    size_t
    find_below(uint64_t key) const noexcept; // the last node with smallest key < key; the first where there is none
    void prefetch(size_t i) const noexcept;

    void reserve_one(); // room for one more node: then insert cannot fail
    void replace(size_t i, Node *node) noexcept { nodes_[i] = node; }
    void insert(size_t i, Node *node) noexcept;
    void remove(size_t i) noexcept;
    size_t bytes() const noexcept;

private:
    void sample() noexcept;

    static constexpr size_t step = 16; // keys per sample
    std::vector<uint64_t> smallest_;   // per node: its first separator, 0 for the first node
    std::vector<Node *> nodes_;
    std::vector<uint64_t> samples_, coarse_; // every 16th of smallest_, and of samples_
};

} // namespace locus::pmq
