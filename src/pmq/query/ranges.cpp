// Descending the quadtree from the world to the quadrants of a region.
#include "pmq/query/ranges.hpp"

#include "pmq/query/scan.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

class Descent {
public:
    Descent(const View &view, const Region &region, FunctionRef<bool(const RangeAt &)> visit)
        : view_(view), region_(region), visit_(visit) {}

    bool run() { return descend({}, view_.everywhere()) && flush(); }

private:
    bool descend(const Quadrant &quadrant, const Place &outer) {
        const Relation relation = region_.relate(quadrant);
        if (relation == Relation::outside)
            return true;
        const Place place = view_.narrow(outer, quadrant);
        if (place.empty())
            return true;
        if (relation == Relation::inside || place.narrow() || quadrant.level == key_levels)
            return emit({place, quadrant.keys(), relation == Relation::inside});
        for (unsigned child = 0; child < 4; ++child)
            if (!descend(quadrant.child(child), place))
                return false;
        return true;
    }

    // Hold a range back until its successor shows that it does not continue it. Edges, whose records are tested one by
    // one, also take in what follows in the same blocks.
    bool emit(const RangeAt &range) {
        const bool joins = held_ && (held_range_.inside ? range.inside && held_range_.keys.hi == range.keys.lo
                                                        : range.place.first <= held_range_.place.last &&
                                                              (!range.inside || range.place.narrow()));
        if (!joins) {
            if (!flush())
                return false;
            held_range_ = range;
            held_ = true;
        } else {
            held_range_.keys.hi = range.keys.hi;
            held_range_.place = held_range_.place.to(range.place);
        }
        return true;
    }

    bool flush() {
        const bool go_on = !held_ || visit_(held_range_);
        held_ = false;
        return go_on;
    }

    const View &view_;
    const Region &region_;
    FunctionRef<bool(const RangeAt &)> visit_;
    RangeAt held_range_{};
    bool held_ = false;
};

} // namespace

bool for_each_range(const View &view, const Region *region, FunctionRef<bool(const RangeAt &)> visit) {
    if (!region)
        return visit({view.everywhere(), KeyRange{}, true});
    return Descent(view, *region, visit).run();
}

bool for_each_record(const View &view, const Selection &selection, Order order,
                     FunctionRef<bool(uint64_t key, Bytes record)> visit) {
    const Selection live = selection.at(view.moment());
    return for_each_range(view, live.region, [&](const RangeAt &range) {
        return scan_accepted(view, live, range, order, [&](const Block &block, size_t entry) {
            return visit(block.key(entry), block.record(entry));
        });
    });
}

} // namespace locus::pmq
