// Removal from the packed array: the pass at overflow (thesis section 3.4.2.1), limits, sweeping and erasing.
#include "pmq/departures.hpp"
#include "pmq/eviction.hpp"
#include "pmq/layout/packed_array.hpp"
#include "pmq/query/scan.hpp"

#include <algorithm>

namespace locus::pmq {

// Which stored records may go, each asked once, and how old the others are.
void PackedArray::collect_removable(Eviction &eviction, Change &change) const {
    if (!eviction.asks() && eviction.moment().cutoff <= oldest_)
        return;
    int64_t oldest_kept = INT64_MAX, oldest_permitted = INT64_MAX;
    for (size_t segment = 0; segment < array_.count(); ++segment) {
        const size_t start = array_.slot(segment);
        for (size_t slot = start, end = start + array_.size(segment); slot < end; ++slot) {
            const Bytes record = array_.slots.record(slot);
            const int64_t time = format_.time(record);
            if (time < eviction.moment().cutoff) {
                change.gone.push_back(slot);
            } else if (eviction.permitted(record)) {
                change.gone.push_back(slot);
                oldest_permitted = std::min(oldest_permitted, time);
            } else {
                oldest_kept = std::min(oldest_kept, time);
            }
        }
    }
    if (eviction.stopped()) { // what was permitted stays; what has expired goes all the same
        std::erase_if(change.gone, [&](uint64_t slot) { return !eviction.expired(array_.slots.record(slot)); });
        oldest_kept = std::min(oldest_kept, oldest_permitted);
    }
    change.oldest = oldest_kept;
    for (const Incoming &incoming : change.incoming)
        change.oldest = std::min(change.oldest, format_.time(incoming.record));
}

// If more than `most` records would be left, let the oldest go (of one time, in the store's order), with some slack, so
// that one pass serves many batches.
void PackedArray::enforce_limits(uint64_t most, Change &change, Departures::Group &leaving) const {
    const auto merge = [&] { return Merge(array_, 0, array_.count(), change.gone, change.incoming); };
    const uint64_t left = array_.windows.total() - change.gone.size() + change.incoming.size();
    if (left <= most)
        return;
    const uint64_t excess = left - (most - most / 16);

    std::vector<int64_t> times;
    times.reserve(left);
    for (Merge m = merge(); !m.ended(); m.next())
        times.push_back(format_.time(m.record()));
    const auto last = times.begin() + static_cast<ptrdiff_t>(excess - 1);
    std::nth_element(times.begin(), last, times.end());
    const int64_t threshold = *last; // the youngest that goes
    auto equal = static_cast<uint64_t>(std::count(times.begin(), last + 1, threshold));

    std::vector<uint64_t> gone;
    std::vector<Incoming> incoming;
    change.oldest = INT64_MAX;
    for (Merge m = merge(); !m.ended(); m.next()) {
        const int64_t time = format_.time(m.record());
        const bool goes = time < threshold || (time == threshold && equal > 0 && equal-- > 0);
        if (!goes)
            change.oldest = std::min(change.oldest, time);
        if (goes && m.stored())
            gone.push_back(m.slot());
        if (goes && !m.stored())
            leaving.add(m.record());
        if (!goes && !m.stored())
            incoming.push_back({m.key(), m.record()});
    }
    const auto middle = static_cast<ptrdiff_t>(change.gone.size());
    change.gone.insert(change.gone.end(), gone.begin(), gone.end());
    std::inplace_merge(change.gone.begin(), change.gone.begin() + middle, change.gone.end());
    change.incoming = std::move(incoming);
}

// Make room by removal first; grow only if that is not enough. On overflow the array is written anew in any case, and
// doubled, too, if removal has freed so little that the next pass would come soon.
void PackedArray::removal_pass(Change &change, Eviction &eviction, Departures &departures, bool overflow) {
    Departures::Group leaving(departures);
    collect_removable(eviction, change);
    if (limits_.records != UINT64_MAX) { // what is expired on arrival is not live
        const auto stale = std::stable_partition(change.incoming.begin(), change.incoming.end(),
                                                 [&](const Incoming &in) { return !eviction.expired(in.record); });
        for (auto in = stale; in != change.incoming.end(); ++in)
            leaving.add(in->record);
        change.incoming.erase(stale, change.incoming.end());
    }
    enforce_limits(std::min(limits_.records, root_most(highest_)), change, leaving);
    for (const uint64_t slot : change.gone)
        leaving.add(array_.slots.record(slot));

    const uint64_t records = array_.windows.total() + change.incoming.size() - change.gone.size();
    if (overflow) {
        unsigned height = fitting_height(records);
        const uint64_t most = root_most(height);
        if (height < highest_ && records > most - most / 16 && records >= root_least(height + 1))
            ++height;
        rebuild(change, records, height);
        oldest_ = change.oldest;
    } else {
        apply(change);
    }
    left_ += leaving.count();
    leaving.commit();
}

void PackedArray::sweep(Eviction &eviction, Departures &departures) {
    Change change;
    change.oldest = oldest_;
    removal_pass(change, eviction, departures, false);
    moment_ = eviction.moment();
}

void PackedArray::erase(const Selection &selection, Departures &departures) {
    const Selection live = selection.at(moment_);
    Change change;
    change.oldest = oldest_;
    Departures::Group leaving(departures);
    for_each_range(*this, live.region, [&](const RangeAt &range) {
        return scan_accepted(*this, live, range, Order::key, [&](const Block &block, size_t entry) {
            const Bytes record = block.record(entry);
            change.gone.push_back(array_.slots.slot_of(record));
            leaving.add(record);
            return true;
        });
    });
    apply(change);
    left_ += leaving.count();
    leaving.commit();
}

} // namespace locus::pmq
