// The records a query asks for.
#pragma once

#include "pmq/query/region.hpp"
#include "pmq/record.hpp"

namespace locus::pmq {

struct Selection {
    const Region *region = nullptr; // everywhere
    TimeWindow times;
    locus_filter_fn filter = nullptr;
    void *filter_user = nullptr;
    bool expired = false; // what has expired and is still stored counts as live

    // The same, of the records that are live at a moment.
    Selection at(const Moment &moment) const noexcept {
        Selection live = *this;
        if (!expired && live.times.from < moment.cutoff)
            live.times.from = moment.cutoff;
        return live;
    }
};

} // namespace locus::pmq
