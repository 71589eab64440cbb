// Counting and scanning leaves.
#include "pmq/layout/ring_view.hpp"

#include "pmq/layout/ring_order.hpp"
#include "pmq/layout/ring_times.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

constexpr uint64_t ahead = 8;     // leaves whose times are fetched before they are looked at
constexpr size_t first_keys = 64; // so many of the next leaf are fetched; where it reads on the processor fetches more
constexpr size_t cache_line = 64;

} // namespace

size_t first_not_before(const RecordFormat &format, const LeafShape &shape, const Node &node, size_t leaf, int64_t time,
                        int64_t now) noexcept {
    const size_t count = node.leaf[leaf].count;
    size_t begin = 0, end = count; // all before `begin` are older; `end` is not, or is the end
    if (const HeadTimes times(shape, node.leaf[leaf]); times.tell(time, now)) {
        times.narrow(time, begin, end);
        if (end == node.leaf[leaf].known)
            end = count;
    }
    const auto older = [&](size_t entry) {
        return format.time(shape.record(node.leaf[leaf].memory, shape.slot(node.leaf[leaf].head, entry))) < time;
    };
    size_t step = 1;
    while (begin + step <= end && older(begin + step - 1)) {
        begin += step;
        step *= 2;
    }
    end = std::min(begin + step - 1, end);
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

// No key of the leaf is larger.
uint64_t RingView::highest(size_t position, size_t leaf) const noexcept {
    const Node &node = *edition_.directory[position];
    if (leaf + 1 < node.leaves)
        return node.separators[leaf + 1];
    return position + 1 < edition_.directory.size() ? edition_.directory.smallest(position + 1) : key_end - 1;
}

// Does the whole leaf lie in the range?
bool RingView::within(size_t position, size_t leaf, const KeyRange &keys) const noexcept {
    return edition_.directory[position]->separators[leaf] >= keys.lo && highest(position, leaf) < keys.hi;
}

// Fetch what first_not_before will look at.
void RingView::prefetch_times(uint64_t at, int64_t from) const noexcept {
    if (entry(at).oldest < from)
        HeadTimes(shape_, entry(at)).prefetch();
}

void RingView::prefetch_keys(uint64_t at) const noexcept {
    const uint64_t *keys = shape_.keys(entry(at).memory);
    for (size_t i = 0; i < first_keys; i += cache_line / sizeof *keys)
        __builtin_prefetch(keys + shape_.slot(entry(at).head, i));
}

// Call visit(leaf's number) for the leaves of a place until it returns false; false if it did.
template <typename Visit>
bool RingView::visit_ahead(const Place &place, int64_t from, Visit &&visit) const {
    uint64_t fetched = place.first;
    const auto fetch = [&](uint64_t leaves) {
        for (; leaves > 0 && fetched <= place.last; --leaves, fetched = after(fetched))
            prefetch_times(fetched, from);
    };
    fetch(ahead);
    for (uint64_t at = place.first; at <= place.last; at = after(at)) {
        fetch(1);
        if (!visit(at))
            return false;
    }
    return true;
}

uint64_t RingView::count(const Place &place, const KeyRange &keys, int64_t from) const {
    uint64_t total = 0;
    if (place.empty())
        return 0;
    for (size_t at = position(place.first); at <= position(place.last); ++at) {
        const Node &node = *edition_.directory[at];
        const size_t begin = at == position(place.first) ? leaf(place.first) : 0;
        const size_t end = at == position(place.last) ? leaf(place.last) : node.leaves - 1;
        if (begin == 0 && end + 1 == node.leaves && within(at, 0, keys) && within(at, end, keys) &&
            node.oldest_of_all() >= from)
            total += node.total;
        else
            visit_ahead({number(at, begin), number(at, end)}, from, [&](uint64_t i) {
                total += count_leaf(position(i), leaf(i), keys, from);
                return true;
            });
    }
    return total;
}

uint64_t RingView::count_leaf(size_t position, size_t leaf, const KeyRange &keys, int64_t from) const noexcept {
    const Node &node = *edition_.directory[position];
    const size_t count = node.leaf[leaf].count;
    const bool all_young = node.leaf[leaf].oldest >= from;
    const uint64_t *leaf_keys = shape_.keys(node.leaf[leaf].memory);
    if (within(position, leaf, keys)) {
        if (all_young)
            return count;
        if (node.is_ordered(leaf))
            return count - first_not_before(format_, shape_, node, leaf, from, edition_.moment.now);
    }
    const size_t begin = !all_young && node.is_ordered(leaf)
                             ? first_not_before(format_, shape_, node, leaf, from, edition_.moment.now)
                             : 0;
    const bool ask_time = !all_young && !node.is_ordered(leaf);
    uint64_t total = 0;
    for (size_t i = begin; i < count; ++i) {
        const size_t slot = shape_.slot(node.leaf[leaf].head, i);
        total += keys.contains(leaf_keys[slot]) &&
                 (!ask_time || format_.time(shape_.record(node.leaf[leaf].memory, slot)) >= from);
    }
    return total;
}

Block RingView::slots_of(const Node &node, size_t leaf) const noexcept {
    Block block;
    block.keys = node.leaf[leaf].memory;
    block.records = shape_.record(node.leaf[leaf].memory, 0);
    block.key_stride = sizeof(uint64_t);
    block.record_stride = shape_.record_size;
    block.count = shape_.slots;
    block.oldest = node.leaf[leaf].oldest;
    block.times_ascend = node.is_ordered(leaf);
    return block;
}

bool RingView::scan(const Place &place, const KeyRange &keys, int64_t from, Order order,
                    FunctionRef<bool(const Block &)> visit) const {
    return visit_ahead(place, from, [&](uint64_t at) {
        if (const uint64_t next = after(at); order == Order::key && next <= place.last)
            prefetch_keys(next);
        if (entry(at).count == 0)
            return true;
        return order == Order::any ? scan_ring(position(at), leaf(at), keys, from, visit)
                                   : scan_sorted(position(at), leaf(at), keys, from, visit);
    });
}

// Where times are in order, what is older than wanted is left out.
size_t RingView::skip_older(const Node &node, size_t leaf, int64_t from, Block &block) const noexcept {
    if (node.leaf[leaf].oldest >= from || !node.is_ordered(leaf))
        return 0;
    block.oldest = from;
    return first_not_before(format_, shape_, node, leaf, from, edition_.moment.now);
}

// A ring is one block, or two.
bool RingView::scan_ring(size_t position, size_t leaf, const KeyRange &keys, int64_t from,
                         FunctionRef<bool(const Block &)> visit) const {
    const Node &node = *edition_.directory[position];
    const Block all = slots_of(node, leaf);
    Block block = all;
    block.within = within(position, leaf, keys);
    block.lowest = node.separators[leaf];
    block.highest = highest(position, leaf);
    size_t entry = skip_older(node, leaf, from, block);
    while (entry < node.leaf[leaf].count) {
        const size_t slot = shape_.slot(node.leaf[leaf].head, entry);
        block.keys = all.keys + slot * all.key_stride;
        block.records = all.record(slot);
        block.count = std::min(node.leaf[leaf].count - entry, shape_.slots - slot);
        if (!visit(block))
            return false;
        entry += block.count;
    }
    return true;
}

bool RingView::scan_sorted(size_t position, size_t leaf, const KeyRange &keys, int64_t from,
                           FunctionRef<bool(const Block &)> visit) const {
    const Node &node = *edition_.directory[position];
    const size_t head = node.leaf[leaf].head, count = node.leaf[leaf].count;
    Block block = slots_of(node, leaf);
    LeafOrder order(node.separators[leaf], highest(position, leaf));
    const bool all = within(position, leaf, keys);
    const uint64_t *leaf_keys = shape_.keys(node.leaf[leaf].memory);
    for (size_t i = skip_older(node, leaf, from, block); i < count; ++i) {
        const uint64_t key = leaf_keys[shape_.slot(head, i)];
        order.add(key, i, all || keys.contains(key));
    }
    for (size_t i = 0; i < order.count(); ++i)
        __builtin_prefetch(block.record(shape_.slot(head, order.number(i))));
    if (order.count() == 0)
        return true;
    order.sort();
    uint32_t slots[LeafShape::most_slots];
    for (size_t i = 0; i < order.count(); ++i)
        slots[i] = static_cast<uint32_t>(shape_.slot(head, order.number(i)));
    block.order = slots;
    block.count = order.count();
    block.within = true;
    block.times_ascend = false;
    return visit(block);
}

} // namespace locus::pmq
