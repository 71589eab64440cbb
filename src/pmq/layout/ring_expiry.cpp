// Removal: what has expired or may go is found a few leaves per batch, in the proportion of the records that come in,
// so that a round over all leaves ends before the store has taken in a sixteenth of its size. A record thus outlives
// its time in its slot by one round at most, and slots grow by no more than that; readers do not see it.
#include "pmq/eviction.hpp"
#include "pmq/layout/ring_leaves.hpp"
#include "pmq/layout/ring_view.hpp"
#include "pmq/query/scan.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

constexpr unsigned rounds_per_refill = 16;
constexpr double most_for_time = 32;   // leaves per call that are looked at beyond what the records inserted pay for
constexpr size_t most_short = 1 << 16; // records of a store for whose removals readers may wait

} // namespace

// Look at one node's leaves: which entries have expired, and which of the others does the predicate permit to go?
// Unless `thoroughly`, a few expired ones amid younger ones stay until there are more of them.
void RingLeaves::collect(size_t position, int64_t cutoff, Eviction *eviction, bool thoroughly,
                         std::vector<Cut> &cuts) const {
    const Node &node = *directory()[position];
    for (size_t i = 0; i < node.leaves; ++i)
        if (node.leaf[i].oldest < cutoff)
            HeadTimes(shape_, node.leaf[i]).prefetch();
    for (size_t i = 0; i < node.leaves; ++i) {
        if (node.leaf[i].count == 0)
            continue;
        Cut cut(position, i);
        if (node.leaf[i].oldest < cutoff) {
            if (node.is_ordered(i))
                cut.prefix = first_not_before(format_, shape_, node, i, cutoff, edition_->moment.now);
            else
                mark_expired(node, i, cutoff, thoroughly, cut);
        }
        if (eviction && eviction->asks())
            ask(node, i, cutoff, *eviction, cut);
        if (cut.prefix > 0 || cut.marked > 0)
            cuts.push_back(cut);
    }
}

void RingLeaves::mark_expired(const Node &node, size_t leaf, int64_t cutoff, bool thoroughly, Cut &cut) const {
    const size_t count = node.leaf[leaf].count;
    while (cut.prefix < count && time_at(node, leaf, cut.prefix) < cutoff)
        ++cut.prefix;
    for (size_t i = cut.prefix; i < count; ++i) {
        if (time_at(node, leaf, i) < cutoff) {
            cut.marks.set(i);
            ++cut.marked;
        }
    }
    if (!thoroughly && cut.marked * 8 < count) {
        cut.marks.reset();
        cut.marked = 0;
    }
}

// Ask in the order (key, arrival).
void RingLeaves::ask(const Node &node, size_t leaf, int64_t cutoff, Eviction &eviction, Cut &cut) const {
    uint64_t order[LeafShape::most_slots];
    size_t asked = 0;
    for (size_t i = cut.prefix; i < node.leaf[leaf].count; ++i)
        if (!cut.marks[i] && time_at(node, leaf, i) >= cutoff)
            order[asked++] = key_at(node, leaf, i) * LeafShape::most_slots + i;
    std::sort(order, order + asked);
    for (size_t i = 0; i < asked; ++i) {
        const size_t entry = order[i] % LeafShape::most_slots;
        if (eviction.permitted(record_at(node, leaf, entry))) {
            cut.marks.set(entry);
            ++cut.marked;
        }
    }
}

// What leaves from the nodes first..first + nodes. After a stopped pass only what has expired does.
std::vector<RingLeaves::Cut> RingLeaves::decide(size_t first, size_t nodes, int64_t cutoff, Eviction &eviction,
                                                bool thoroughly) const {
    std::vector<Cut> cuts;
    for (size_t i = first; i < first + nodes; ++i)
        collect(i, cutoff, &eviction, thoroughly, cuts);
    if (eviction.stopped()) {
        cuts.clear();
        for (size_t i = first; i < first + nodes; ++i)
            collect(i, cutoff, nullptr, thoroughly, cuts);
    }
    return cuts;
}

// Within a change: let the entries go that the cuts name. All or nothing.
void RingLeaves::remove(std::vector<Cut> &cuts, Departures &departures) {
    Departures::Group leaving(departures);
    size_t total = 0;
    for (const Cut &cut : cuts)
        total += cut.prefix + cut.marked;
    leaving.reserve(total);
    for (const Cut &cut : cuts) {
        const Node &node = own(cut.node);
        const size_t end = cut.marked > 0 ? node.leaf[cut.leaf].count : cut.prefix;
        if (leaving.counts_only())
            leaving.count(cut.prefix + cut.marked);
        else
            for (size_t i = 0; i < end; ++i)
                if (cut.takes(i))
                    leaving.add(record_at(node, cut.leaf, i));
    }
    expect_garbage(cuts.size());
    try {
        for (Cut &cut : cuts)
            if (cut.marked > 0 && !unread(directory()[cut.node]->leaf[cut.leaf].born))
                cut.fresh = slabs_.take();
    } catch (...) {
        for (const Cut &cut : cuts)
            if (cut.fresh)
                slabs_.give_back(cut.fresh);
        throw;
    }
    for (const Cut &cut : cuts)
        apply(cut);
    edition().stored -= total;
    edition().left += total;
    leaving.commit();
}

void RingLeaves::apply(const Cut &cut) noexcept {
    Node &node = *directory()[cut.node];
    const size_t leaf = cut.leaf, count = node.leaf[leaf].count;
    if (ages_.wanted()) {
        for (size_t i = 0; i < count; ++i)
            if (cut.takes(i) && time_at(node, leaf, i) >= edition().moment.cutoff)
                ages_.take_back(time_at(node, leaf, i));
    }
    if (cut.marked == 0) {
        pop(node, leaf, cut.prefix);
        return;
    }
    const LeafMemory old = node.leaf[leaf].memory;
    const uint64_t born = node.leaf[leaf].born;
    Target rest = cut.fresh ? target(cut.fresh) : target(old, node.leaf[leaf].head);
    for (size_t i = cut.prefix; i < count; ++i)
        if (!cut.marks[i])
            add(rest, key_at(node, leaf, i), record_at(node, leaf, i));
    counters_.moved += rest.count;
    if (cut.fresh)
        retire(old, born);
    install(node, leaf, rest);
}

void RingLeaves::pop(Node &node, size_t leaf, size_t entries) noexcept {
    node.leaf[leaf].head = static_cast<uint16_t>(shape_.slot(node.leaf[leaf].head, entries) % shape_.slots);
    node.leaf[leaf].count = static_cast<uint16_t>(node.leaf[leaf].count - entries);
    node.leaf[leaf].known =
        static_cast<uint8_t>(node.leaf[leaf].known - std::min<size_t>(node.leaf[leaf].known, entries));
    node.total -= static_cast<uint32_t>(entries);
    if (!unread(node.leaf[leaf].born)) {
        node.leaf[leaf].ghosts = static_cast<uint16_t>(node.leaf[leaf].ghosts + entries);
        node.ghost_version = change_;
    }
    if (node.leaf[leaf].count == 0) {
        node.leaf[leaf].oldest = INT64_MAX;
        node.set_ordered(leaf, true);
    } else if (node.is_ordered(leaf)) {
        node.leaf[leaf].oldest = time_at(node, leaf, 0);
    }
}

// The part of a round that the clock's progress since the last call asks for: after a burst, little comes in and much
// goes.
double RingLeaves::elapsed() noexcept {
    const Moment &moment = edition_->moment;
    const double horizon = static_cast<double>(moment.now) - static_cast<double>(moment.cutoff);
    const double since = tended_ == INT64_MIN ? 0 : static_cast<double>(moment.now) - static_cast<double>(tended_);
    tended_ = moment.now;
    return horizon > 0 ? rounds_per_refill * since / horizon : 0;
}

// The share of upkeep that inserting `records` pays for. Without memory for it, it is put off.
void RingLeaves::tend(size_t records, Eviction &eviction, Departures &departures) {
    slabs_.prepare();
    if (edition_->moment.cutoff == INT64_MIN && !eviction.asks() && !slabs_.any_vacating())
        return;
    const auto all = static_cast<double>(leaf_count_);
    const double share = rounds_per_refill * static_cast<double>(records) / static_cast<double>(edition_->stored + 1);
    credit_ = std::min(credit_ + std::max(all * share, std::min(all * elapsed(), most_for_time)), all);
    while (credit_ > 0 && !eviction.stopped()) {
        constexpr size_t most_nodes = 16; // per change
        const size_t size = directory().size();
        if (cursor_ >= size)
            cursor_ = 0;
        size_t nodes = 0;
        while (credit_ > 0 && cursor_ + nodes < size && nodes < most_nodes)
            credit_ -= directory()[cursor_ + nodes++]->leaves;
        try {
            tend_nodes(cursor_, nodes, eviction, departures);
        } catch (const std::bad_alloc &) {
            return;
        }
        cursor_ += nodes + directory().size() - size; // those that were merged are done, too
    }
}

void RingLeaves::tend_nodes(size_t first, size_t nodes, Eviction &eviction, Departures &departures) {
    std::vector<Cut> cuts = decide(first, nodes, edition_->moment.cutoff, eviction, false);
    const Change change(*this, true);
    remove(cuts, departures);
    for (size_t i = 0; i < nodes; ++i)
        note_times(first + i);
    for (size_t i = nodes; i-- > 0;)
        tidy(first + i);
}

// Write down the times of the entries that expire until the next round comes, and a few more.
void RingLeaves::note_times(size_t position) {
    const Moment &moment = edition().moment;
    if (moment.cutoff == INT64_MIN || !slabs_.keep_times())
        return;
    const uint64_t window = static_cast<uint64_t>(moment.now) - static_cast<uint64_t>(moment.cutoff);
    const auto until = static_cast<int64_t>(static_cast<uint64_t>(moment.cutoff) + window / rounds_per_refill +
                                            window / (4 * rounds_per_refill));
    Node &node = own(position);
    const auto noted = [&](size_t leaf) { return node.leaf[leaf].oldest < until && node.is_ordered(leaf); };
    for (size_t i = 0; i < node.leaves; ++i) {
        if (i + 1 < node.leaves && noted(i + 1))
            for (size_t entry = node.leaf[i + 1].known; entry < LeafShape::most_times; entry += 2)
                __builtin_prefetch(record_at(node, i + 1, entry) + format_.time_at);
        if (noted(i))
            note_times(node, i, until);
    }
}

void RingLeaves::note_times(Node &node, size_t leaf, int64_t until) const noexcept {
    LeafEntry &at = node.leaf[leaf];
    const uint8_t unit = HeadTimes::unit_for(edition_->moment);
    if (at.known == 0 || (unread(at.born) && at.unit != unit)) {
        at.known = 0;
        at.unit = unit;
    }
    int64_t last = at.known > 0 ? time_at(node, leaf, at.known - 1u) : INT64_MIN;
    for (; last < until && at.known < at.count && at.known + at.ghosts < LeafShape::most_times; ++at.known) {
        last = time_at(node, leaf, at.known);
        HeadTimes::write(shape_.times(at.memory), shape_.slot(at.head, at.known), last, at.unit);
    }
}

void RingLeaves::sweep(Eviction &eviction, Departures &departures) {
    Ages ages = ages_;
    const int64_t floor = floor_;
    uint64_t ties = 0;
    try {
        const Moment moment = clock({}, eviction.moment(), ties);
        sweep_all(moment, eviction, departures);
    } catch (...) {
        ages_ = std::move(ages);
        floor_ = floor;
        throw;
    }
    if (ties > 0)
        drop_equal(edition_->moment.cutoff, ties, departures);
}

// Remove everything that may go by a moment, which becomes the current one.
void RingLeaves::sweep_all(const Moment &moment, Eviction &eviction, Departures &departures) {
    std::vector<Cut> cuts = decide(0, directory().size(), moment.cutoff, eviction, true);
    {
        const Change change(*this, edition_->stored <= most_short);
        remove(cuts, departures);
        edition().moment = moment;
        floor_ = INT64_MIN;
        tidy_all();
    }
    slabs_.prepare();
}

void RingLeaves::erase(const Selection &selection, Departures &departures) {
    const Edition &now = *edition_;
    const RingView view(now, format_, shape_);
    const Selection live = selection.at(now.moment);
    std::vector<Cut> cuts;
    for_each_range(view, live.region, [&](const RangeAt &range) {
        const Acceptance accepted(view, live, range);
        return view.for_each_leaf(range.place, [&](size_t position, size_t leaf) {
            const Node &node = *now.directory[position];
            if (cuts.empty() || cuts.back().node != position || cuts.back().leaf != leaf)
                cuts.emplace_back(position, leaf);
            Cut &cut = cuts.back();
            const Block block = view.slots_of(node, leaf);
            for (size_t i = 0; i < node.leaf[leaf].count; ++i) {
                if (!cut.marks[i] && accepted(block, shape_.slot(node.leaf[leaf].head, i))) {
                    cut.marks.set(i);
                    ++cut.marked;
                }
            }
            return true;
        });
    });
    std::erase_if(cuts, [](const Cut &cut) { return cut.marked == 0; });
    for (Cut &cut : cuts)
        if (cut.marked == now.directory[cut.node]->leaf[cut.leaf].count)
            cut.everything();
    {
        const Change change(*this, now.stored <= most_short);
        remove(cuts, departures);
        tidy_all();
    }
    slabs_.prepare();
}

} // namespace locus::pmq
