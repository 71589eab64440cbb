// Search in nodes and above them; adding and removing leaves and nodes.
#include "pmq/layout/ring_directory.hpp"

#include <algorithm>
#include <cstring>

namespace locus::pmq {
namespace {

// How many of `count` sorted keys are <= key (or < key). A whole comparison has no branch to mispredict.
template <bool inclusive>
size_t rank(const uint64_t *keys, size_t count, uint64_t key) noexcept {
    const uint64_t *at = keys;
    while (count > 1) {
        const size_t half = count / 2;
        const bool right = inclusive ? at[half - 1] <= key : at[half - 1] < key;
        at += half & -size_t{right};
        count -= half;
    }
    return static_cast<size_t>(at - keys) + (count == 1 && (inclusive ? *at <= key : *at < key));
}

size_t index_of(size_t rank) noexcept { return rank == 0 ? 0 : rank - 1; }

template <typename T>
void open_gap(T *values, size_t at, size_t count) noexcept {
    std::memmove(values + at + 1, values + at, (count - at) * sizeof(T));
}

template <typename T>
void close_gap(T *values, size_t at, size_t count) noexcept {
    std::memmove(values + at, values + at + 1, (count - at - 1) * sizeof(T));
}

uint64_t bits_below(size_t i) noexcept { return i >= 64 ? ~uint64_t{0} : (uint64_t{1} << i) - 1; }

} // namespace

size_t Node::find(uint64_t key) const noexcept { return index_of(rank<true>(separators, fanout, key)); }
size_t Node::find_below(uint64_t key) const noexcept { return index_of(rank<false>(separators, fanout, key)); }

int64_t Node::oldest_of_all() const noexcept {
    int64_t all = INT64_MAX;
    for (size_t i = 0; i < leaves; ++i)
        all = std::min(all, leaf[i].oldest);
    return all;
}

void Node::clear() noexcept {
    std::memset(static_cast<void *>(this), 0, sizeof *this);
    std::fill_n(separators, fanout, unused);
}

void Node::insert(size_t i, uint64_t separator, LeafMemory memory) noexcept {
    open_gap(separators, i, leaves);
    open_gap(leaf, i, leaves);
    ordered = (ordered & bits_below(i)) | (ordered & ~bits_below(i)) << 1 | uint64_t{1} << i;
    separators[i] = separator;
    leaf[i] = {memory, version, INT64_MAX, 0, 0, 0, 0, 0};
    ++leaves;
}

void Node::remove(size_t i) noexcept {
    total -= leaf[i].count;
    close_gap(separators, i, leaves);
    close_gap(leaf, i, leaves);
    ordered = (ordered & bits_below(i)) | (ordered >> 1 & ~bits_below(i));
    separators[--leaves] = unused;
}

void Node::append(const Node &other, size_t from, size_t to) noexcept {
    for (size_t i = from; i < to; ++i) {
        separators[leaves] = other.separators[i];
        leaf[leaves] = other.leaf[i];
        set_ordered(leaves, other.is_ordered(i));
        total += leaf[leaves].count;
        ++leaves;
    }
    ghost_version = std::max(ghost_version, other.ghost_version);
}

void Node::truncate(size_t new_leaves) noexcept {
    while (leaves > new_leaves) {
        total -= leaf[--leaves].count;
        separators[leaves] = unused;
    }
}

size_t Directory::find(uint64_t key) const noexcept {
    const size_t block = index_of(rank<true>(coarse_.data(), coarse_.size(), key)) * step;
    const size_t middle =
        block + index_of(rank<true>(samples_.data() + block, std::min(step, samples_.size() - block), key));
    const size_t start = middle * step;
    return start + index_of(rank<true>(smallest_.data() + start, std::min(step, smallest_.size() - start), key));
}

size_t Directory::find_below(uint64_t key) const noexcept {
    return index_of(rank<false>(smallest_.data(), smallest_.size(), key));
}

// What own and Node::find look at.
void Directory::prefetch(size_t i) const noexcept {
    const auto *lines = reinterpret_cast<const char *>(nodes_[i]);
    for (size_t at = 0; at < offsetof(Node, leaf); at += 64)
        __builtin_prefetch(lines + at);
}

void Directory::reserve_one() {
    const size_t more = size() + 1;
    const auto grow = [](auto &values, size_t wanted) {
        if (values.capacity() < wanted)
            values.reserve(wanted + wanted / 4 + 16);
    };
    grow(smallest_, more);
    grow(nodes_, more);
    grow(samples_, more / step + 1);
    grow(coarse_, more / step / step + 1);
}

void Directory::insert(size_t i, Node *node) noexcept {
    const auto at = static_cast<ptrdiff_t>(i);
    smallest_.insert(smallest_.begin() + at, i == 0 ? 0 : node->separators[0]);
    nodes_.insert(nodes_.begin() + at, node);
    sample();
}

void Directory::remove(size_t i) noexcept {
    const auto at = static_cast<ptrdiff_t>(i);
    smallest_.erase(smallest_.begin() + at);
    nodes_.erase(nodes_.begin() + at);
    if (i == 0 && !smallest_.empty())
        smallest_[0] = 0;
    sample();
}

// Resizing stays within what reserve_one has reserved.
void Directory::sample() noexcept {
    samples_.clear();
    for (size_t i = 0; i < smallest_.size(); i += step)
        samples_.push_back(smallest_[i]);
    coarse_.clear();
    for (size_t i = 0; i < samples_.size(); i += step)
        coarse_.push_back(samples_[i]);
}

size_t Directory::bytes() const noexcept {
    return sizeof *this + (smallest_.capacity() + samples_.capacity() + coarse_.capacity()) * sizeof(uint64_t) +
           nodes_.capacity() * sizeof(Node *);
}

} // namespace locus::pmq
