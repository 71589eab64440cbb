// Records of a selection, page by page.
#pragma once

#include "explorer/selection.hpp"

#include <string>
#include <vector>

namespace explorer {

struct Page {
    std::vector<locus_text156> records;
    std::string next; // where the next page begins; empty: there is none
};

// The newest first, of one time in the store's order. `after` is the `next` of the page before, or empty.
Page newest_page(const locus_pmq *store, const locus_pmq_query &query, size_t limit, const std::string &after);

// Along the Z-curve.
Page place_page(const locus_pmq *store, const locus_pmq_query &query, size_t limit, const std::string &after);

// Calls visit(record) for the records of the query in the store's order until it returns false.
template <typename Visit>
void visit_records(const locus_pmq *store, const locus_pmq_query &query, Visit visit) {
    const auto call = [](const void *record, void *user) {
        return (*static_cast<Visit *>(user))(*static_cast<const locus_text156 *>(record)) ? 0 : 1;
    };
    const locus_status status = locus_pmq_visit(store, &query, call, &visit);
    if (status != LOCUS_E_STOPPED)
        check(status);
}

} // namespace explorer
