// Counting and scanning leaves.
#include "pmq/layout/ring_view.hpp"

#include <algorithm>

namespace locus::pmq {

size_t first_not_before(const RecordFormat &format, const LeafShape &shape, const Node &node, size_t leaf,
                        int64_t time) noexcept {
    const auto older = [&](size_t entry) {
        return format.time(shape.record(node.leaf[leaf], shape.slot(node.head[leaf], entry))) < time;
    };
    const size_t count = node.count[leaf];
    size_t begin = 0, step = 1; // all before `begin` are older
    while (begin + step <= count && older(begin + step - 1)) {
        begin += step;
        step *= 2;
    }
    size_t end = std::min(begin + step - 1, count); // `end` is not older, or the end
    while (begin < end) {
        const size_t middle = (begin + end) / 2;
        if (older(middle))
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

int64_t RingView::oldest() const noexcept {
    int64_t oldest = INT64_MAX;
    for (size_t i = 0; i < edition_.directory.size(); ++i)
        oldest = std::min(oldest, edition_.directory[i]->oldest_of_all());
    return oldest;
}

Place RingView::everywhere() const noexcept {
    const size_t last = edition_.directory.size() - 1;
    return {0, number(last, edition_.directory[last]->leaves - 1)};
}

// The last leaf whose separator is below the key: the first one that may hold it.
uint64_t RingView::last_below(uint64_t key, const Place &outer) const noexcept {
    const Directory &directory = edition_.directory;
    const size_t first = position(outer.first), last = position(outer.last);
    const size_t at = first == last ? first : std::clamp(directory.find_below(key), first, last);
    return std::clamp(number(at, directory[at]->find_below(key)), outer.first, outer.last);
}

Place RingView::narrow(const Place &outer, const Quadrant &quadrant) const noexcept {
    const KeyRange keys = quadrant.keys();
    const uint64_t first = last_below(keys.lo, outer);
    return {first, last_below(keys.hi, {first, outer.last})};
}

// Does the whole leaf lie in the range?
bool RingView::within(size_t position, size_t leaf, const KeyRange &keys) const noexcept {
    const Node &node = *edition_.directory[position];
    if (node.separators[leaf] < keys.lo)
        return false;
    if (leaf + 1 < node.leaves)
        return node.separators[leaf + 1] < keys.hi;
    return position + 1 < edition_.directory.size() ? edition_.directory.smallest(position + 1) < keys.hi
                                                    : keys.hi >= key_end;
}

uint64_t RingView::count(const Place &place, const KeyRange &keys, int64_t from) const {
    uint64_t total = 0;
    if (place.empty())
        return 0;
    const auto count_leaves = [&](uint64_t first, uint64_t last) {
        for (uint64_t at = first; at <= last; ++at)
            total += count_leaf(position(at), leaf(at), keys, from);
    };
    for (size_t at = position(place.first); at <= position(place.last); ++at) {
        const Node &node = *edition_.directory[at];
        const size_t begin = at == position(place.first) ? leaf(place.first) : 0;
        const size_t end = at == position(place.last) ? leaf(place.last) : node.leaves - 1;
        if (begin == 0 && end + 1 == node.leaves && within(at, 0, keys) && within(at, end, keys) &&
            node.oldest_of_all() >= from)
            total += node.total;
        else
            count_leaves(number(at, begin), number(at, end));
    }
    return total;
}

uint64_t RingView::count_leaf(size_t position, size_t leaf, const KeyRange &keys, int64_t from) const noexcept {
    const Node &node = *edition_.directory[position];
    const size_t count = node.count[leaf];
    const bool all_young = node.oldest[leaf] >= from;
    const uint64_t *leaf_keys = shape_.keys(node.leaf[leaf]);
    if (within(position, leaf, keys)) {
        if (all_young)
            return count;
        if (node.is_ordered(leaf))
            return count - first_not_before(format_, shape_, node, leaf, from);
    }
    const size_t begin = !all_young && node.is_ordered(leaf) ? first_not_before(format_, shape_, node, leaf, from) : 0;
    const bool ask_time = !all_young && !node.is_ordered(leaf);
    uint64_t total = 0;
    for (size_t i = begin; i < count; ++i) {
        const size_t slot = shape_.slot(node.head[leaf], i);
        total +=
            keys.contains(leaf_keys[slot]) && (!ask_time || format_.time(shape_.record(node.leaf[leaf], slot)) >= from);
    }
    return total;
}

Block RingView::slots_of(const Node &node, size_t leaf) const noexcept {
    Block block;
    block.keys = node.leaf[leaf];
    block.records = shape_.record(node.leaf[leaf], 0);
    block.key_stride = sizeof(uint64_t);
    block.record_stride = shape_.record_size;
    block.count = shape_.slots;
    block.oldest = node.oldest[leaf];
    block.times_ascend = node.is_ordered(leaf);
    return block;
}

bool RingView::scan(const Place &place, const KeyRange &keys, Order order,
                    FunctionRef<bool(const Block &)> visit) const {
    return for_each_leaf(place, [&](size_t position, size_t leaf) {
        const Node &node = *edition_.directory[position];
        if (node.count[leaf] == 0)
            return true;
        return order == Order::any ? scan_ring(node, leaf, within(position, leaf, keys), visit)
                                   : scan_sorted(node, leaf, keys, visit);
    });
}

// A ring is one block, or two.
bool RingView::scan_ring(const Node &node, size_t leaf, bool within, FunctionRef<bool(const Block &)> visit) const {
    Block block = slots_of(node, leaf);
    const Block all = block;
    const size_t head = node.head[leaf], count = node.count[leaf];
    const size_t first = std::min(count, shape_.slots - head);
    block.within = within;
    block.keys = all.keys + head * all.key_stride;
    block.records = all.record(head);
    block.count = first;
    if (!visit(block))
        return false;
    block.keys = all.keys;
    block.records = all.records;
    block.count = count - first;
    return block.count == 0 || visit(block);
}

// Sort the entries asked for by (key, arrival).
bool RingView::scan_sorted(const Node &node, size_t leaf, const KeyRange &keys,
                           FunctionRef<bool(const Block &)> visit) const {
    uint64_t order[LeafShape::most_slots];
    uint32_t slots[LeafShape::most_slots];
    size_t count = 0;
    const uint64_t *leaf_keys = shape_.keys(node.leaf[leaf]);
    for (size_t i = 0; i < node.count[leaf]; ++i)
        if (const uint64_t key = leaf_keys[shape_.slot(node.head[leaf], i)]; keys.contains(key))
            order[count++] = key * LeafShape::most_slots + i;
    if (count == 0)
        return true;
    std::sort(order, order + count);
    for (size_t i = 0; i < count; ++i)
        slots[i] = static_cast<uint32_t>(shape_.slot(node.head[leaf], order[i] % LeafShape::most_slots));
    Block block = slots_of(node, leaf);
    block.order = slots;
    block.count = count;
    block.within = true;
    block.times_ascend = false;
    return visit(block);
}

} // namespace locus::pmq
