// The clock and the limits. A limit raises one cutoff in time for the whole store, which acts like a horizon: what lies
// before it is gone for readers at once and leaves its slot in the ordinary rounds.
#include "pmq/eviction.hpp"
#include "pmq/layout/ring_leaves.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

constexpr uint64_t exact_below = 1 << 16; // limits up to which a partly expired bin is counted anew

} // namespace

// Before a batch is stored: late records, older than the limits' cutoff, are in the store only if there is room for
// them. Then nothing else that old may be left in the slots.
void RingLeaves::admit_late(const Batch &batch, Eviction &eviction, Departures &departures) {
    if (batch.oldest >= floor_)
        return;
    uint64_t late = 0;
    for (size_t i = 0; i < batch.count; ++i)
        late += format_.time(batch.records + i * format_.size) < floor_;
    const uint64_t all = ages_.total() + batch.count;
    if (all > most_records_ && late <= all - most_records_)
        return; // they are the oldest of what is too much
    Eviction expired(format_, edition_->moment, nullptr, nullptr);
    sweep_all(edition_->moment, expired, departures);
    departures.disregard();
    const Change change(*this, true);
    edition().moment.cutoff = std::min(edition().moment.cutoff, eviction.moment().cutoff);
}

// The moment after `batch` is stored; `ties` records at its cutoff are still too much. Throws without effect.
Moment RingLeaves::clock(const Batch &batch, const Moment &moment, uint64_t &ties) {
    Moment next{moment.now, std::max(moment.cutoff, floor_)};
    if (!ages_.wanted())
        return next;
    Ages before = ages_;
    try {
        ages_.reserve(batch.count);
        ages_.expire(next.cutoff);
        for (size_t i = 0; i < batch.count; ++i)
            if (const int64_t time = format_.time(batch.records + i * format_.size); time >= next.cutoff)
                ages_.add(time);
        next.cutoff = limit_cutoff(most_records_, next.cutoff, ties);
        ages_.expire(next.cutoff);
    } catch (...) {
        ages_ = std::move(before);
        throw;
    }
    if (next.cutoff > moment.cutoff)
        floor_ = next.cutoff;
    return next;
}

// The cutoff that leaves at most `most` records; `ties` of those at the cutoff itself have to go besides.
int64_t RingLeaves::limit_cutoff(uint64_t most, int64_t cutoff, uint64_t &ties) {
    uint64_t before = 0;
    if (ages_.total() > most && most < exact_below && ages_.straddles(cutoff))
        refine(ages_.reach(1, before), cutoff);
    if (ages_.total() <= most)
        return cutoff;
    const uint64_t excess = ages_.total() - most;
    const auto fits = [&](const Ages::Bin &bin) { return before + bin.count <= excess + most / 16; };
    if (const Ages::Bin &bin = ages_.reach(excess, before); !fits(bin))
        refine(bin, cutoff);
    if (ages_.total() <= most)
        return cutoff;
    const Ages::Bin &bin = ages_.reach(ages_.total() - most, before);
    if (before + bin.count <= ages_.total() - most + most / 16 && bin.last < INT64_MAX)
        return bin.last + 1;
    ties = ages_.total() - most - before;
    return bin.first;
}

void RingLeaves::refine(const Ages::Bin &bin, int64_t cutoff) {
    std::vector<int64_t> times;
    const int64_t from = std::max(bin.first, cutoff);
    for (size_t n = 0; n < directory().size(); ++n) {
        const Node &node = *directory()[n];
        for (size_t leaf = 0; leaf < node.leaves; ++leaf)
            for (size_t i = 0; i < node.leaf[leaf].count; ++i)
                if (const int64_t time = time_at(node, leaf, i); time >= from && time <= bin.last)
                    times.push_back(time);
    }
    std::sort(times.begin(), times.end());
    ages_.refine(bin, times);
}

// Of the records with this time, let `count` go.
void RingLeaves::drop_equal(int64_t time, uint64_t count, Departures &departures) {
    const Edition &now = *edition_;
    std::vector<Cut> cuts;
    for (size_t n = 0; n < now.directory.size() && count > 0; ++n) {
        const Node &node = *now.directory[n];
        for (size_t leaf = 0; leaf < node.leaves && count > 0; ++leaf) {
            Cut cut(n, leaf);
            for (size_t i = 0; i < node.leaf[leaf].count && count > 0; ++i) {
                if (time_at(node, leaf, i) == time) {
                    cut.marks.set(i);
                    ++cut.marked;
                    --count;
                }
            }
            if (cut.marked == node.leaf[leaf].count)
                cut.everything();
            if (cut.marked > 0 || cut.prefix > 0)
                cuts.push_back(cut);
        }
    }
    const Change change(*this, true);
    remove(cuts, departures);
}

// Hold the memory limit: first by a limit on records that follows the room they take; if slots take more all the same,
// by letting go until they do not.
void RingLeaves::hold_bytes(Departures &departures) {
    if (limits_.bytes == UINT64_MAX)
        return;
    const uint64_t used = bytes();
    const uint64_t soft = limits_.bytes - limits_.bytes / 16;
    if (used > soft) {
        const double share = static_cast<double>(soft) / static_cast<double>(used);
        const auto most = static_cast<uint64_t>(static_cast<double>(ages_.total()) * std::min(share, 0.98));
        most_records_ = std::min(limits_.records, std::max<uint64_t>(most, 1));
    } else if (used < soft - limits_.bytes / 16) {
        most_records_ = limits_.records;
    }
    while (bytes() > limits_.bytes && edition_->stored > 0) {
        most_records_ = std::min(most_records_, ages_.total() - ages_.total() / 8 - 1);
        Eviction expired(format_, edition_->moment, nullptr, nullptr);
        sweep(expired, departures);
        slabs_.press(true);
        for (slabs_.prepare(); slabs_.any_vacating(); slabs_.prepare()) {
            const Change change(*this, true);
            tidy_all();
        }
        slabs_.press(false);
    }
    most_records_ = std::max<uint64_t>(most_records_, 1);
}

} // namespace locus::pmq
