// Insertion into the packed array: Algorithm 3.1, in two steps. plan() goes top-down and only reads; what it needs is
// allocated; then the windows are rewritten, which cannot fail.
#include "pmq/layout/packed_array.hpp"

#include "core/error.hpp"
#include "pmq/departures.hpp"
#include "pmq/eviction.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace locus::pmq {
namespace {

Keys keys_for(PackedIndex index) noexcept { return index == PackedIndex::heads ? Keys::apart : Keys::beside; }

} // namespace

PackedArray::PackedArray(const RecordFormat &format, const Densities &densities, const Limits &limits,
                         PackedIndex index)
    : format_(format), densities_(densities), limits_(limits), keys_(keys_for(index)), highest_(0),
      array_(format, densities, keys_, 0), index_(index == PackedIndex::quadtree) {
    const auto largest = static_cast<unsigned>(62 - std::countr_zero(densities.segment_slots));
    const size_t most_segments =
        std::numeric_limits<size_t>::max() / (2 * Slots::bytes(format, keys_) * densities.segment_slots);
    while (highest_ < largest && size_t{2} << highest_ <= most_segments && bytes(highest_ + 1) <= limits.bytes)
        ++highest_;
    if (index_.wanted())
        index_.build(array_);
}

uint64_t PackedArray::smallest_bytes(const RecordFormat &format, const Densities &densities,
                                     PackedIndex index) noexcept {
    unsigned height = 0;
    while (std::ldexp(densities.segment_slots * densities.tau_root, static_cast<int>(height)) < 1 && height < 40)
        ++height;
    return Segments::bytes(format, densities, keys_for(index), height);
}

std::vector<Incoming> PackedArray::sorted(const Batch &batch) const {
    std::vector<Incoming> incoming(batch.count);
    for (size_t i = 0; i < batch.count; ++i)
        incoming[i] = {batch.keys[i], batch.records + i * format_.size};
    // Arrival order is address order.
    std::sort(incoming.begin(), incoming.end(), [](const Incoming &a, const Incoming &b) {
        return a.key != b.key ? a.key < b.key : a.record < b.record;
    });
    return incoming;
}

void PackedArray::insert(const Batch &batch, Eviction &eviction, Departures &departures) {
    Change change;
    change.incoming = sorted(batch);
    change.oldest = std::min(oldest_, batch.oldest);
    const uint64_t records = array_.windows.total() + batch.count;
    const bool overflow = records > root_most(array_.windows.height());
    if (overflow || records > limits_.records)
        removal_pass(change, eviction, departures, overflow);
    else
        apply(change);
    moment_ = eviction.moment();
}

// Few large batches, as all of them go to the end of the array: each lets it be written anew about once.
size_t PackedArray::fill_batch() const noexcept { return std::max<size_t>(8192, array_.windows.total() / 4); }

// Carry a change out that fits the limits: window by window, or, if the root's bounds or its extent make that
// pointless, anew.
void PackedArray::apply(const Change &change) {
    const uint64_t records = array_.windows.total() + change.incoming.size() - change.gone.size();
    const unsigned height = array_.windows.height();
    const bool extensive = change.gone.size() > records / 8;
    if (extensive || records > root_most(height) || records < root_least(height))
        rebuild(change, records, fitting_height(records));
    else if (!change.empty())
        update(change);
    oldest_ = change.oldest;
}

void PackedArray::update(const Change &change) {
    tasks_.clear();
    plan({array_.windows.height(), 0, change.incoming, change.gone});
    size_t largest = 0;
    for (const Task &task : tasks_)
        if (task.level > 0)
            largest = std::max(largest, array_.windows.count(task.level, task.window) + task.incoming.size());
    reserve_scratch(largest);
    for (const Task &task : tasks_) {
        task.level == 0 ? rewrite_segment(task) : rebalance(task);
        array_.windows.recount(task.level, task.window);
        array_.index_heads(task.window << task.level, size_t{1} << task.level);
    }
    repair_index();
}

// The window itself can take its share of the change. Descend as long as both halves can; else rebalance it.
void PackedArray::plan(const Task &task) {
    if (task.incoming.empty() && task.gone.empty())
        return;
    if (task.level == 0) {
        tasks_.push_back(task);
        return;
    }
    const Windows &windows = array_.windows;
    const unsigned below = task.level - 1;
    const size_t middle = (2 * task.window + 1) << below;
    const uint64_t pivot = array_.head(middle);
    const auto incoming_left = static_cast<size_t>(
        std::lower_bound(task.incoming.begin(), task.incoming.end(), pivot,
                         [](const Incoming &incoming, uint64_t key) { return incoming.key < key; }) -
        task.incoming.begin());
    const auto gone_left = static_cast<size_t>(
        std::lower_bound(task.gone.begin(), task.gone.end(), array_.slot(middle)) - task.gone.begin());
    const Task left{below, 2 * task.window, task.incoming.first(incoming_left), task.gone.first(gone_left)};
    const Task right{below, 2 * task.window + 1, task.incoming.subspan(incoming_left), task.gone.subspan(gone_left)};
    const auto fits = [&](const Task &half) {
        const uint64_t count = windows.count(below, half.window) + half.incoming.size() - half.gone.size();
        return (half.incoming.empty() || count <= windows.most(below)) &&
               (half.gone.empty() || count >= windows.least(below));
    };
    if (!fits(left) || !fits(right)) {
        tasks_.push_back(task);
        return;
    }
    plan(left);
    plan(right);
}

// Merge in place, from the back.
void PackedArray::rewrite_segment(const Task &task) noexcept {
    Slots &slots = array_.slots;
    const size_t start = array_.slot(task.window);
    size_t kept = array_.size(task.window);
    if (!task.gone.empty()) {
        const size_t end = start + kept;
        size_t to = task.gone.front();
        for (size_t g = 0; g < task.gone.size(); ++g) {
            const size_t from = task.gone[g] + 1;
            const size_t run = (g + 1 < task.gone.size() ? task.gone[g + 1] : end) - from;
            slots.move(to, slots, from, run);
            to += run;
            counters_.moved += run;
        }
        kept -= task.gone.size();
    }
    array_.windows.set_segment(task.window, kept + task.incoming.size());
    for (size_t n = task.incoming.size(); n > 0; --n) {
        const Incoming &last = task.incoming[n - 1];
        size_t behind = kept; // the first record that comes after it
        while (behind > 0 && slots.key(start + behind - 1) > last.key)
            --behind;
        slots.move(start + behind + n, slots, start + behind, kept - behind);
        counters_.moved += kept - behind;
        slots.put(start + behind + n - 1, last.key, last.record);
        kept = behind;
    }
}

namespace {

// Reads slots one after the other.
struct Sequence {
    const Slots &slots;
    size_t slot;
    uint64_t key() const noexcept { return slots.key(slot); }
    Bytes record() const noexcept { return slots.record(slot); }
    void next() noexcept { ++slot; }
};

} // namespace

void PackedArray::rebalance(const Task &task) noexcept {
    const size_t first = task.window << task.level;
    const size_t segments = size_t{1} << task.level;
    size_t total = 0;
    for (Merge merge(array_, first, segments, task.gone, task.incoming); !merge.ended(); merge.next())
        scratch_.put(total++, merge.key(), merge.record());
    array_.fill(first, segments, total, Sequence{scratch_, 0});
    counters_.moved += total - task.incoming.size();
    ++counters_.rebalances;
}

// Double or halve until the records fit.
unsigned PackedArray::fitting_height(uint64_t records) const noexcept {
    unsigned height = array_.windows.height();
    while (height < highest_ && records > root_most(height))
        ++height;
    while (height > 0 && records < root_least(height))
        --height;
    return height;
}

uint64_t PackedArray::root_most(unsigned height) const noexcept {
    return static_cast<uint64_t>(static_cast<double>(uint64_t{densities_.segment_slots} << height) *
                                 densities_.tau_root);
}

uint64_t PackedArray::root_least(unsigned height) const noexcept {
    if (height == 0)
        return 0;
    const double least = static_cast<double>(uint64_t{densities_.segment_slots} << height) * densities_.rho_root;
    return static_cast<uint64_t>(std::ceil(least));
}

void PackedArray::rebuild(const Change &change, uint64_t records, unsigned height) {
    Segments fresh(format_, densities_, keys_, height);
    fresh.fill(0, fresh.count(), records, Merge(array_, 0, array_.count(), change.gone, change.incoming));
    fresh.windows.recount(height, 0);
    fresh.index_heads(0, fresh.count());
    QuadtreeIndex index(index_.wanted());
    if (index.wanted())
        index.build(fresh);

    const unsigned before = array_.windows.height();
    array_ = std::move(fresh);
    index_ = std::move(index);
    counters_.moved += records - change.incoming.size();
    counters_.grows += height > before ? height - before : 0;
    counters_.shrinks += height < before ? before - height : 0;
    ++counters_.rebalances;
    bound_index();
}

void PackedArray::reserve_scratch(size_t records) {
    constexpr size_t kept = 4096; // beyond, memory is given back after use
    if (records > scratch_size_ || (scratch_size_ > kept && records <= kept)) {
        const size_t size = std::max(records, std::min(kept, std::bit_ceil(records)));
        scratch_ = Slots(format_, size, keys_);
        scratch_size_ = size;
    }
}

// Without memory for it, or room in the budget, the index is dropped: searches are binary until the array is next
// written anew.
void PackedArray::repair_index() noexcept {
    if (!index_.present())
        return;
    try {
        std::vector<Dirty> dirty;
        dirty.reserve(tasks_.size());
        for (const Task &task : tasks_)
            dirty.push_back({task.window << task.level, ((task.window + 1) << task.level) - 1});
        index_.repair(array_, dirty);
        bound_index();
    } catch (const std::bad_alloc &) {
        index_.drop();
    }
}

void PackedArray::bound_index() noexcept {
    if (bytes(array_.windows.height()) + index_.bytes() > limits_.bytes)
        index_.drop();
}

std::shared_ptr<const View> PackedArray::view() const {
    return std::shared_ptr<const View>(std::shared_ptr<const void>(), this); // lives as long as the array
}

std::shared_ptr<const Snapshot> PackedArray::snapshot() const {
    fail(LOCUS_E_UNSUPPORTED, "options.layout is the packed array, which has no snapshots");
}

} // namespace locus::pmq
