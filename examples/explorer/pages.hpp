// Records of a selection, page by page.
#pragma once

#include "explorer/tiers.hpp"

#include <string>
#include <vector>

namespace explorer {

struct Page {
    std::vector<locus_text156> records;
    std::string next; // where the next page begins; empty: there is none
};

// The newest first, of one time in the store's order. `after` is the `next` of the page before, or empty.
Page newest_page(const Tiers &tiers, const locus_pmq_query &query, size_t limit, const std::string &after);

// Along the Z-curve. Over both tiers a page is looked for from the beginning of the curve on.
Page place_page(const Tiers &tiers, const locus_pmq_query &query, size_t limit, const std::string &after);

} // namespace explorer
