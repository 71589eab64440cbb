// One tier or both.
#include "explorer/tiers.hpp"

namespace explorer {

Tiers tiers_of(Arguments &arguments, const Live &live) {
    Tiers tiers{live.store(), nullptr, live.now()};
    if (arguments.word("tiers", {"window", "both"}) == 0)
        return tiers;
    if (live.older() == nullptr)
        throw Failure(400, "tiers: both, but nothing is kept of what leaves the window (--keep)");
    tiers.older = live.older()->tier();
    return tiers;
}

uint64_t count_records(const Tiers &tiers, const locus_pmq_query &query) {
    uint64_t count = 0;
    if (tiers.older != nullptr)
        check_cold(locus_cold_count(tiers.older, tiers.store, &query, &count));
    else
        check(locus_pmq_count(tiers.store, &query, &count));
    return count;
}

} // namespace explorer
