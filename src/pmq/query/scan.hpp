// The inner loop of every query that looks at records: which entries of a block a selection accepts.
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/query/ranges.hpp"

#include <algorithm>
#include <bit>

namespace locus::pmq {

// What a record has to be asked, given where it was found. Cheap questions first, the caller's filter last.
class Acceptance {
public:
    Acceptance(const View &view, const Selection &selection, const RangeAt &range)
        : format_(view.format()), selection_(selection), keys_(range.keys),
          region_(range.inside ? nullptr : selection.region), box_(region_ ? region_->as_box() : nullptr),
          late_(selection.times.to < view.moment().now) {}

    bool operator()(const Block &block, size_t entry) const noexcept {
        const uint64_t key = block.key(entry);
        if (!block.within && !keys_.contains(key))
            return false;
        const Bytes record = block.record(entry);
        if ((late_ || selection_.times.from > block.oldest) && !selection_.times.contains(format_.time(record)))
            return false;
        return place_accepted(key, record) &&
               (!selection_.filter || selection_.filter(record, selection_.filter_user) != 0);
    }
    // Every entry of the block is accepted.
    bool all_of(const Block &block) const noexcept { return block.within && !region_ && only_place_matters(block); }
    size_t count(const Block &block) const noexcept {
        if (all_of(block))
            return block.count;
        size_t total = 0;
        for_each(block, [&](size_t) {
            ++total;
            return true;
        });
        return total;
    }
    // Call `use(entry)` for every accepted entry of the block until it returns false; false if it did.
    template <typename Use>
    bool for_each(const Block &block, Use &&use) const {
        const bool many = block.count >= worthwhile && block.key_stride == sizeof(uint64_t) && !block.order;
        if (many && box_ && only_place_matters(block))
            return for_each_in_box(block, use);
        const bool all = all_of(block);
        for (size_t i = 0; i < block.count; ++i) {
            const size_t entry = block.entry(i);
            if ((all || (*this)(block, entry)) && !use(entry))
                return false;
        }
        return true;
    }

private:
    bool only_place_matters(const Block &block) const noexcept {
        return !late_ && !selection_.filter && selection_.times.from <= block.oldest;
    }
    // The keys lie side by side: many are asked at once.
    template <typename Use>
    bool for_each_in_box(const Block &block, Use &&use) const {
        const KeysOfBox question = box_->among(block.within ? KeyRange{} : keys_);
        const auto *keys = reinterpret_cast<const uint64_t *>(block.keys);
        KeyMarks marks;
        for (size_t begin = 0; begin < block.count; begin += most_keys) {
            many_keys().mark(question, keys + begin, std::min(block.count - begin, most_keys), marks);
            for (size_t word = 0; word < marks.inside.size(); ++word) {
                for (uint64_t left = marks.inside[word] | marks.edge[word]; left != 0; left &= left - 1) {
                    const size_t entry = begin + 64 * word + static_cast<size_t>(std::countr_zero(left));
                    const bool edge = (marks.edge[word] & left & -left) != 0;
                    if ((!edge || in_region(block.record(entry))) && !use(entry))
                        return false;
                }
            }
        }
        return true;
    }
    bool place_accepted(uint64_t key, Bytes record) const noexcept {
        if (!region_)
            return true;
        const Relation relation = box_ ? box_->relate_quickly(key) : region_->relate(key);
        return relation == Relation::inside || (relation == Relation::edge && in_region(record));
    }
    bool in_region(Bytes record) const noexcept {
        return region_->contains(format_.latitude(record), format_.longitude(record));
    }

    const RecordFormat &format_;
    const Selection &selection_;
    KeyRange keys_;
    const Region *region_; // to be asked
    const BoxRegion *box_; // the same, if it is a box
    bool late_;            // records may lie behind the end of the time window
};

// Call `use(block, entry)` for every accepted entry of a range until it returns false; false if it did.
template <typename Use>
bool scan_accepted(const View &view, const Selection &selection, const RangeAt &range, Order order, Use &&use) {
    const Acceptance accepted(view, selection, range);
    return view.scan(range.place, range.keys, selection.times.from, order, [&](const Block &block) {
        return accepted.for_each(block, [&](size_t entry) { return use(block, entry); });
    });
}

// How many records of a range are accepted; by the layout's own counts where no record needs to be asked.
inline uint64_t count_in(const View &view, const Selection &live, const RangeAt &range) {
    const bool plain = range.inside && !live.filter && live.times.to >= view.moment().now;
    if (plain)
        return view.count(range.place, range.keys, live.times.from);
    const Acceptance accepted(view, live, range);
    uint64_t total = 0;
    view.scan(range.place, range.keys, live.times.from, Order::any, [&](const Block &block) {
        total += accepted.count(block);
        return true;
    });
    return total;
}

} // namespace locus::pmq
