// Where a request looks for records: in the window, or also in what has left it, as of one moment.
#pragma once

#include "explorer/live.hpp"
#include "explorer/selection.hpp"

namespace explorer {

struct Tiers {
    const locus_pmq *store;
    locus_cold *older = nullptr; // null: the window alone
    int64_t now = INT64_MIN;     // the store's clock
};

// By the parameter tiers=window|both.
Tiers tiers_of(Arguments &arguments, const Live &live);

uint64_t count_records(const Tiers &tiers, const locus_pmq_query &query);

// Calls visit(record) for the records of the query in the store's order until it returns false.
template <typename Visit>
void visit_records(const Tiers &tiers, const locus_pmq_query &query, Visit visit) {
    const auto call = [](const void *record, void *user) {
        return (*static_cast<Visit *>(user))(*static_cast<const locus_text156 *>(record)) ? 0 : 1;
    };
    const bool both = tiers.older != nullptr;
    const locus_status status = both ? locus_cold_visit(tiers.older, tiers.store, &query, call, &visit)
                                     : locus_pmq_visit(tiers.store, &query, call, &visit);
    if (status != LOCUS_E_STOPPED)
        both ? check_cold(status) : check(status);
}

} // namespace explorer
