// Random sequences of operations on stores of every kind against the plain model, with a check after each.
#include "tests/unit/pmq/tracked_store.hpp"

#include <gtest/gtest.h>

namespace locus::test {
namespace {

struct Kind {
    const char *name;
    uint32_t record = LOCUS_RECORD_POINT32;
    uint32_t segment_slots = 8;
    double rho_leaf = 0.08, tau_leaf = 0.92, rho_root = 0.30, tau_root = 0.70;
    int64_t horizon = LOCUS_NO_HORIZON;
    uint64_t max_records = LOCUS_NO_LIMIT;
    uint64_t max_bytes = LOCUS_NO_LIMIT;
    bool predicate = false;
    double sink_stops = 0;
};

const Kind kinds[] = {
    {.name = "plain"},
    {.name = "text", .record = LOCUS_RECORD_TEXT156, .horizon = 4000},
    {.name = "small_segments", .segment_slots = 4, .rho_leaf = 0, .tau_leaf = 1},
    {.name = "large_segments", .segment_slots = 64, .horizon = 3000},
    {.name = "loose", .segment_slots = 4, .rho_leaf = 0, .tau_leaf = 0.06, .rho_root = 0.01, .tau_root = 0.05},
    {.name = "tight", .segment_slots = 16, .rho_leaf = 0.4, .tau_leaf = 0.96, .rho_root = 0.45, .tau_root = 0.92},
    {.name = "horizon", .horizon = 2000},
    {.name = "predicate", .predicate = true},
    {.name = "predicate_and_horizon", .horizon = 3000, .predicate = true, .sink_stops = 0.01},
    {.name = "max_records", .max_records = 300},
    {.name = "one_record", .max_records = 1},
    {.name = "max_records_and_horizon", .horizon = 2500, .max_records = 500, .sink_stops = 0.02},
    {.name = "max_bytes", .max_bytes = 65536},
    {.name = "max_bytes_text", .record = LOCUS_RECORD_TEXT156, .max_bytes = 65536, .predicate = true},
};

class Property : public testing::TestWithParam<std::tuple<size_t, LayoutChoice>> {
protected:
    Property() : kind(kinds[std::get<0>(GetParam())]), draw(1000 + std::get<0>(GetParam())) {}

    locus_pmq_options options() const {
        locus_pmq_options o = default_options();
        o.record = kind.record;
        std::get<1>(GetParam()).apply(o);
        o.segment_slots = kind.segment_slots;
        o.rho_leaf = kind.rho_leaf;
        o.tau_leaf = kind.tau_leaf;
        o.rho_root = kind.rho_root;
        o.tau_root = kind.tau_root;
        o.horizon = kind.horizon;
        o.max_records = kind.max_records;
        o.max_bytes = kind.max_bytes;
        return o;
    }

    TrackedStore::Callbacks callbacks() {
        TrackedStore::Callbacks c;
        if (kind.predicate)
            c.remove = [this](const Item &item) { return item.id % 5 < removable ? 1 : 0; };
        if (kind.sink_stops > 0)
            c.sink_stops = [this] { return draw.chance(stopping); };
        stopping = kind.sink_stops;
        return c;
    }

    std::vector<Item> batch() {
        std::vector<Item> items(draw.chance(0.1) ? draw.below(400) : draw.below(40));
        const bool one_place = draw.chance(0.1);
        const Item place = draw.place();
        for (Item &item : items) {
            item = one_place ? place : draw.place();
            item.time = now - static_cast<int64_t>(draw.chance(0.8) ? draw.below(20) : draw.below(6000));
        }
        return items;
    }

    locus_pmq_query query() {
        locus_pmq_query q = draw.chance(0.8) ? box_query(draw.box()) : default_query();
        if (draw.chance(0.3)) {
            q.time_from = now - static_cast<int64_t>(draw.below(3000));
            q.time_to = q.time_from + static_cast<int64_t>(draw.below(3000));
        }
        return q;
    }

    void step(TrackedStore &store) {
        now += static_cast<int64_t>(draw.below(100));
        const uint64_t choice = draw.below(20);
        if (choice < 14)
            store.insert(batch(), now);
        else if (choice < 16)
            store.sweep(now);
        else if (choice < 18)
            store.erase(query());
        else
            removable = draw.below(5);
    }

    const Kind &kind;
    Places draw;
    int64_t now = 100000;
    uint64_t removable = 1; // of 5, by the predicate
    double stopping = 0;
};

TEST_P(Property, EveryAnswerIsTheModels) {
    TrackedStore store(options(), callbacks());
    for (int i = 0; i < 250 && !HasFailure(); ++i) {
        SCOPED_TRACE("step " + std::to_string(i));
        step(store);
        store.compare();
        for (int q = 0; q < 4; ++q)
            store.compare_query(query());
        const auto zoom = static_cast<uint32_t>(draw.below(26)), log2_bins = static_cast<uint32_t>(draw.below(5));
        const Item at = draw.place();
        uint64_t key = 0;
        locus_pmq_key(at.latitude, at.longitude, &key);
        uint32_t x = 0, y = 0;
        for (unsigned level = 0; level < zoom; ++level) {
            x = x << 1 | (key >> (48 - 2 * level) & 1);
            y = y << 1 | (key >> (49 - 2 * level) & 1);
        }
        store.compare_tile(zoom, x, y, log2_bins);
    }
    stopping = 0;
    store.sweep(now);
    store.expect_conserved();
    store.erase(default_query());
    store.compare();
    store.expect_conserved();
    EXPECT_TRUE(store.live().empty());
    const bool ring = std::get<1>(GetParam()).layout == LOCUS_LAYOUT_RING_LEAVES;
    const uint64_t least = !ring ? kind.segment_slots : kind.record == LOCUS_RECORD_POINT32 ? 512u : 256u;
    EXPECT_EQ(stats_of(store.pmq()).slots, least) << "an empty store is as small as can be";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Property,
                         testing::Combine(testing::Range<size_t>(0, std::size(kinds)), testing::ValuesIn(layouts)),
                         [](const auto &instance) {
                             return std::string(kinds[std::get<0>(instance.param)].name) + "_" +
                                    std::get<1>(instance.param).name;
                         });

} // namespace
} // namespace locus::test
