// A store beside its model: a plain vector in the order (key, arrival). Every operation is done on both and compared.
#pragma once

#include "tests/unit/pmq/items.hpp"

#include <locus/pmq.h>

#include <functional>
#include <set>
#include <vector>

namespace locus::test {

class TrackedStore {
public:
    // The callbacks of the options are replaced by the tracker's own where `options` asks for them with `want_*`.
    struct Callbacks {
        std::function<int32_t(const Item &)> remove; // empty: none
        std::function<bool()> sink_stops;            // empty: never
        bool sink = true;
    };

    TrackedStore(locus_pmq_options options, Callbacks callbacks);
    ~TrackedStore() { locus_pmq_destroy(pmq_); }
    TrackedStore(const TrackedStore &) = delete;
    TrackedStore &operator=(const TrackedStore &) = delete;

    locus_pmq *pmq() const { return pmq_; }
    int64_t now() const { return now_; }
    const std::vector<Item> &stored() const { return stored_; }
    size_t handed_over() const { return departed_.size(); }
    std::vector<Item> live() const;

    locus_status insert(std::vector<Item> items, int64_t now);
    locus_status sweep(int64_t now);
    locus_status erase(const locus_pmq_query &query);

    // Everything a store answers, against the model.
    void compare();
    void compare_query(const locus_pmq_query &query);
    void compare_tile(uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins);
    // Every record ever inserted has been handed over exactly once, or is still there.
    void expect_conserved();

    static bool selects(const locus_pmq_query &query, const Item &item);

private:
    std::vector<Item> read(const locus_pmq_query *query);
    void after_change(const std::set<uint64_t> &may_be_missing);
    bool is_live(const Item &item) const;
    static int32_t on_remove(const void *record, void *user);
    static int32_t on_sink(const void *record, void *user);

    locus_pmq_options options_;
    Callbacks callbacks_;
    locus_pmq *pmq_ = nullptr;
    std::vector<Item> stored_;       // that the store has not let go as far as can be seen
    std::vector<uint64_t> departed_; // ids, as handed over
    std::set<uint64_t> asked_;       // ids the predicate saw in this pass
    std::set<uint64_t> inserted_;
    uint64_t next_id_ = 1;
    int64_t now_ = INT64_MIN;
};

// The ways to hold the same records.
struct LayoutChoice {
    const char *name;
    uint32_t layout, index;
    void apply(locus_pmq_options &options) const {
        options.layout = layout;
        options.index = index;
    }
};
inline constexpr LayoutChoice layouts[] = {
    {"ring", LOCUS_LAYOUT_RING_LEAVES, LOCUS_INDEX_IMPLICIT},
    {"implicit", LOCUS_LAYOUT_PACKED_ARRAY, LOCUS_INDEX_IMPLICIT},
    {"explicit", LOCUS_LAYOUT_PACKED_ARRAY, LOCUS_INDEX_EXPLICIT},
    {"heads", LOCUS_LAYOUT_PACKED_ARRAY, LOCUS_INDEX_HEADS},
};

inline locus_pmq_options default_options() {
    locus_pmq_options options;
    locus_pmq_options_init(&options, sizeof options);
    return options;
}

inline locus_pmq_options options_of(const LayoutChoice &layout, uint32_t record, int64_t horizon = LOCUS_NO_HORIZON) {
    locus_pmq_options options = default_options();
    options.record = record;
    options.horizon = horizon;
    layout.apply(options);
    return options;
}

inline locus_pmq_query default_query() {
    locus_pmq_query query;
    locus_pmq_query_init(&query, sizeof query);
    return query;
}

inline locus_pmq_query box_query(const locus_box &box) {
    locus_pmq_query query = default_query();
    query.region = LOCUS_REGION_BOX;
    query.box = box;
    return query;
}

inline locus_pmq_stats stats_of(const locus_pmq *pmq) {
    locus_pmq_stats stats{};
    stats.struct_size = sizeof stats;
    locus_pmq_get_stats(pmq, &stats);
    return stats;
}

} // namespace locus::test
