// Filling a store that is being made with records in the order of their keys: leaf by leaf, without a split, by several
// threads.
#include "pmq/layout/ring_leaves.hpp"

#include "core/crew.hpp"
#include "pmq/eviction.hpp"
#include "pmq/layout/ring_order.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

// Room is left in leaves, so that the first batches that come do not split each of them, and in nodes likewise.
constexpr size_t most_filled = 25; // of 32 slots
constexpr size_t filled_quarters = 3;
constexpr size_t leaves_together = 21;
constexpr size_t leaves_at_once = 128; // by a thread: hardly two of them touch the same new page

} // namespace

// Leaves that are being filled; they come into the directory at the end.
class RingLeaves::Filling final : public Layout::Parts {
public:
    Filling(RingLeaves &store, std::span<const size_t> sizes) : store_(store) {
        begins_.reserve(sizes.size() + 1);
        begins_.push_back(0);
        for (const size_t size : sizes)
            begins_.push_back(begins_.back() + leaves_for(size));
        leaves_.reserve(begins_.back());
        while (leaves_.size() < begins_.back())
            leaves_.push_back({store_.target(store_.slabs_.take()), 0, INT64_MIN});
    }
    ~Filling() override {
        for (const Leaf &leaf : leaves_)
            if (leaf.target.memory)
                store_.slabs_.give_back(leaf.target.memory);
    }
    Filling(const Filling &) = delete;
    Filling &operator=(const Filling &) = delete;

    // All leaves of a part hold as many.
    void fill(size_t part, const Batch &batch) noexcept override {
        const size_t count = leaves_for(batch.count);
        for (size_t i = 0; i < count; ++i) {
            const size_t begin = batch.count * i / count, end = batch.count * (i + 1) / count;
            Leaf &leaf = leaves_[begins_[part] + i];
            leaf.key = batch.keys[begin];
            leaf.newest = store_.fill_leaf(
                {batch.records + begin * store_.format_.size, batch.keys + begin, end - begin, batch.oldest},
                leaf.target);
        }
    }

    uint64_t install() override {
        const Change change(store_, true);
        store_.own(0);
        uint64_t records = 0;
        for (Leaf &leaf : leaves_) {
            if (leaf.target.count == 0)
                continue;
            store_.append_leaf(leaf.key, leaf.target);
            leaf.target.memory = nullptr; // it is the store's
            store_.newest_ = std::max(store_.newest_, leaf.newest);
            store_.edition().stored += leaf.target.count;
            records += leaf.target.count;
        }
        return records;
    }

private:
    struct Leaf {
        Target target;
        uint64_t key;
        int64_t newest;
    };
    size_t leaves_for(size_t records) const noexcept {
        const size_t most = store_.shape_.slots * most_filled / 32;
        return (records + most - 1) / most;
    }

    RingLeaves &store_;
    std::vector<size_t> begins_; // the first leaf of each part
    std::vector<Leaf> leaves_;
};

size_t RingLeaves::fill_batch() const noexcept { return shape_.slots * most_filled / 32 * leaves_together; }

std::unique_ptr<Layout::Parts> RingLeaves::fill_parts(std::span<const size_t> sizes, Eviction &eviction) {
    {
        const Change change(*this, true);
        edition().moment = eviction.moment(); // the leaves' times are noted for it
    }
    return std::make_unique<Filling>(*this, sizes);
}

void RingLeaves::fill(const Batch &batch, Crew &crew, Eviction &eviction, Departures &) {
    if (ages_.wanted()) {
        ages_.reserve(batch.count);
        for (size_t i = 0; i < batch.count; ++i)
            ages_.add(format_.time(batch.records + i * format_.size));
    }
    const size_t most = shape_.slots * most_filled / 32 * leaves_at_once;
    std::vector<size_t> sizes;
    for (size_t begin = 0; begin < batch.count; begin += most)
        sizes.push_back(std::min(most, batch.count - begin));
    const std::unique_ptr<Parts> parts = fill_parts(sizes, eviction);
    crew.for_each(sizes.size(), 1, [&](uint64_t i, uint64_t) {
        const size_t begin = i * most;
        parts->fill(i, {batch.records + begin * format_.size, batch.keys + begin, sizes[i], batch.oldest});
    });
    parts->install();
}

// Records come in the order of their keys. A leaf takes them in that of time, so that what expires is a prefix again:
// arrival is known only among equal keys, and any order that keeps it will do. The newest time.
int64_t RingLeaves::fill_leaf(const Batch &batch, Target &target) const noexcept {
    int64_t times[LeafShape::most_slots], oldest = INT64_MAX, newest = INT64_MIN;
    for (size_t i = 0; i < batch.count; ++i) {
        times[i] = format_.time(batch.records + i * format_.size);
        oldest = std::min(oldest, times[i]);
        newest = std::max(newest, times[i]);
    }
    const auto age = [&](int64_t time) { return static_cast<uint64_t>(time) - static_cast<uint64_t>(oldest); };
    bool sorts = age(newest) < LeafOrder::values;
    for (size_t i = 1; i < batch.count; ++i) // in the order of arrival, where it is known
        sorts = sorts && (batch.keys[i] != batch.keys[i - 1] || times[i] >= times[i - 1]);
    LeafOrder order(0, sorts ? age(newest) : 0);
    for (size_t i = 0; i < batch.count; ++i)
        order.add(sorts ? age(times[i]) : 0, i);
    if (sorts)
        order.sort();
    uint64_t *keys = shape_.keys(target.memory);
    for (size_t n = 0; n < batch.count; ++n)
        keys[n] = batch.keys[order.number(n)];
    for (size_t n = 0; n < batch.count; ++n)
        copy_record(shape_.record(target.memory, n), batch.records + order.number(n) * format_.size, format_.size);
    if (target.unit != HeadTimes::no_unit)
        for (; target.known < std::min(batch.count, LeafShape::most_times); ++target.known)
            HeadTimes::write(shape_.times(target.memory), target.known, times[order.number(target.known)], target.unit);
    target.count = batch.count;
    target.oldest = oldest;
    target.ordered = sorts || std::is_sorted(times, times + batch.count);
    return newest;
}

// A leaf behind the last one, for keys from `key` on; or the one leaf of an empty store is it from now on.
void RingLeaves::append_leaf(uint64_t key, const Target &filled) {
    size_t last = directory().size() - 1;
    if (edition_->stored == 0) {
        const LeafMemory before = directory()[last]->leaf[0].memory;
        install(*directory()[last], 0, filled);
        slabs_.give_back(before);
        return;
    }
    if (Node &node = own(last); node.leaves < Node::fanout / 4 * filled_quarters) {
        node.insert(node.leaves, key, filled.memory);
    } else {
        directory().reserve_one();
        Node *next = take_node();
        next->clear();
        next->version = change_;
        next->insert(0, key, filled.memory);
        directory().insert(++last, next);
    }
    install(*directory()[last], directory()[last]->leaves - 1u, filled);
    ++leaf_count_;
    ++structure_;
}

} // namespace locus::pmq
