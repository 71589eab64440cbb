// The model's side of every operation.
#include "tests/unit/pmq/tracked_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace locus::test {

TrackedStore::TrackedStore(locus_pmq_options options, Callbacks callbacks)
    : options_(options), callbacks_(std::move(callbacks)) {
    if (callbacks_.remove) {
        options_.remove = on_remove;
        options_.remove_user = this;
    }
    if (callbacks_.sink) {
        options_.sink = on_sink;
        options_.sink_user = this;
    }
    EXPECT_EQ(locus_pmq_create(&options_, &pmq_), LOCUS_OK) << locus_last_error();
}

int32_t TrackedStore::on_remove(const void *record, void *user) {
    auto &self = *static_cast<TrackedStore *>(user);
    const Item item = unpack(record, self.options_.record);
    EXPECT_TRUE(self.asked_.insert(item.id).second) << "asked twice about " << item.id;
    return self.callbacks_.remove(item);
}

int32_t TrackedStore::on_sink(const void *record, void *user) {
    auto &self = *static_cast<TrackedStore *>(user);
    self.departed_.push_back(unpack(record, self.options_.record).id);
    return self.callbacks_.sink_stops && self.callbacks_.sink_stops() ? 1 : 0;
}

bool TrackedStore::is_live(const Item &item) const {
    if (options_.horizon == LOCUS_NO_HORIZON)
        return true;
    // Unsigned: the difference of extreme times. No time is after the clock.
    const uint64_t age = static_cast<uint64_t>(now_) - static_cast<uint64_t>(item.time);
    return age <= static_cast<uint64_t>(options_.horizon);
}

std::vector<Item> TrackedStore::live() const {
    std::vector<Item> items;
    std::copy_if(stored_.begin(), stored_.end(), std::back_inserter(items),
                 [this](const Item &i) { return is_live(i); });
    return items;
}

bool TrackedStore::selects(const locus_pmq_query &query, const Item &item) {
    if (query.region == LOCUS_REGION_BOX && !in_box(query.box, item))
        return false;
    return item.time >= query.time_from && item.time <= query.time_to;
}

std::vector<Item> TrackedStore::read(const locus_pmq_query *query) {
    size_t count = 0;
    const locus_status status = locus_pmq_read(pmq_, query, nullptr, 0, &count);
    EXPECT_EQ(status, count == 0 ? LOCUS_OK : LOCUS_E_CAPACITY);
    std::vector<unsigned char> bytes(count * options_.record);
    EXPECT_EQ(locus_pmq_read(pmq_, query, bytes.data(), count, &count), LOCUS_OK);
    std::vector<Item> items;
    for (size_t i = 0; i < count; ++i)
        items.push_back(unpack(bytes.data() + i * options_.record, options_.record));
    return items;
}

locus_status TrackedStore::insert(std::vector<Item> items, int64_t now) {
    for (Item &item : items) {
        EXPECT_EQ(locus_pmq_key(item.latitude, item.longitude, &item.key), LOCUS_OK);
        item.id = next_id_++;
    }
    const std::vector<unsigned char> bytes = pack(items, options_.record);
    asked_.clear();
    const locus_status status = locus_pmq_insert(pmq_, bytes.data(), items.size(), now);
    if (status != LOCUS_OK && status != LOCUS_E_STOPPED)
        return status;
    now_ = now;
    for (const Item &item : items)
        inserted_.insert(item.id);
    stored_.insert(stored_.end(), items.begin(), items.end());
    std::stable_sort(stored_.begin(), stored_.end(), [](const Item &a, const Item &b) { return a.key < b.key; });
    after_change(asked_);
    return status;
}

locus_status TrackedStore::sweep(int64_t now) {
    asked_.clear();
    uint64_t evicted = 0;
    const uint64_t before = stats_of(pmq_).stored;
    const locus_status status = locus_pmq_sweep(pmq_, now, &evicted);
    if (status != LOCUS_OK && status != LOCUS_E_STOPPED)
        return status;
    now_ = now;
    EXPECT_EQ(stats_of(pmq_).stored + evicted, before);
    after_change(asked_);
    if (status == LOCUS_OK) {
        for (const Item &item : stored_) {
            EXPECT_TRUE(is_live(item)) << "expired record " << item.id << " outlived a sweep";
            if (callbacks_.remove && !callbacks_.sink_stops) {
                EXPECT_EQ(callbacks_.remove(item), 0);
            }
        }
    }
    return status;
}

locus_status TrackedStore::erase(const locus_pmq_query &query) {
    std::set<uint64_t> chosen;
    for (const Item &item : live())
        if (selects(query, item))
            chosen.insert(item.id);
    uint64_t erased = 0;
    const locus_status status = locus_pmq_erase(pmq_, &query, &erased);
    if (status != LOCUS_OK && status != LOCUS_E_STOPPED)
        return status;
    EXPECT_EQ(erased, chosen.size());
    after_change(chosen);
    for (const Item &item : stored_)
        EXPECT_FALSE(chosen.contains(item.id)) << "erased record " << item.id << " is still there";
    return status;
}

// Find out what is gone: of the live records only those that were asked about or exceed the limits, and nothing else.
void TrackedStore::after_change(const std::set<uint64_t> &may_be_missing) {
    const std::vector<Item> seen = read(nullptr);
    std::set<uint64_t> seen_ids;
    for (const Item &item : seen)
        EXPECT_TRUE(seen_ids.insert(item.id).second) << "record " << item.id << " is there twice";
    std::set<uint64_t> handed(departed_.begin(), departed_.end());
    EXPECT_EQ(handed.size(), departed_.size()) << "a record was handed over twice";

    std::vector<Item> kept, limited;
    for (const Item &item : stored_) {
        const bool live = is_live(item), visible = seen_ids.contains(item.id);
        EXPECT_TRUE(live || !visible) << "expired record " << item.id << " is visible";
        if (visible || (!live && !handed.contains(item.id)))
            kept.push_back(item);
        else if (live && !may_be_missing.contains(item.id))
            limited.push_back(item);
        if (visible) {
            EXPECT_FALSE(handed.contains(item.id)) << "record " << item.id << " was handed over and is there";
        }
    }
    stored_ = std::move(kept);

    // What went by limit is older than all that stayed, and no more than the slack went.
    if (!limited.empty()) {
        EXPECT_TRUE(options_.max_records != LOCUS_NO_LIMIT || options_.max_bytes != LOCUS_NO_LIMIT)
            << limited.size() << " records are lost";
        const auto older = [](const Item &a, const Item &b) {
            return std::tuple(a.time, a.key, a.id) < std::tuple(b.time, b.key, b.id);
        };
        const Item youngest = *std::max_element(limited.begin(), limited.end(), older);
        for (const Item &item : seen)
            EXPECT_LE(youngest.time, item.time);
        if (options_.max_bytes == LOCUS_NO_LIMIT) {
            EXPECT_GE(seen.size(), options_.max_records - options_.max_records / 16);
        }
    }
    EXPECT_LE(seen.size(), options_.max_records);
}

void TrackedStore::compare() {
    EXPECT_EQ(locus_pmq_check(pmq_), LOCUS_OK) << locus_last_error();
    const std::vector<Item> expected = live(), seen = read(nullptr);
    ASSERT_EQ(seen.size(), expected.size());
    for (size_t i = 0; i < seen.size(); ++i) {
        ASSERT_EQ(seen[i].id, expected[i].id) << "at " << i;
        ASSERT_EQ(seen[i].latitude, expected[i].latitude);
        ASSERT_EQ(seen[i].longitude, expected[i].longitude);
        ASSERT_EQ(seen[i].time, expected[i].time);
    }
    const locus_pmq_stats stats = stats_of(pmq_);
    EXPECT_EQ(stats.records, expected.size());
    EXPECT_EQ(stats.inserted, inserted_.size());
    EXPECT_EQ(stats.inserted, stats.stored + stats.evicted + stats.erased);
    EXPECT_EQ(stats.now, now_);
    EXPECT_LE(stats.stored, stats.slots);
    if (callbacks_.sink) {
        EXPECT_EQ(stats.evicted + stats.erased, departed_.size() + stats.pending);
    }
}

void TrackedStore::compare_query(const locus_pmq_query &query) {
    std::vector<Item> expected;
    for (const Item &item : live())
        if (selects(query, item))
            expected.push_back(item);
    uint64_t count = 0;
    ASSERT_EQ(locus_pmq_count(pmq_, &query, &count), LOCUS_OK) << locus_last_error();
    ASSERT_EQ(count, expected.size()) << "box " << query.box.south << ".." << query.box.north << " x " << query.box.west
                                      << ".." << query.box.east;
    const std::vector<Item> seen = read(&query);
    ASSERT_EQ(seen.size(), expected.size());
    for (size_t i = 0; i < seen.size(); ++i)
        ASSERT_EQ(seen[i].id, expected[i].id);
    locus_pmq_query unordered = query;
    unordered.order = LOCUS_ORDER_ANY;
    std::multiset<uint64_t> seen_ids, expected_ids;
    for (const Item &item : read(&unordered))
        seen_ids.insert(item.id);
    for (const Item &item : expected)
        expected_ids.insert(item.id);
    ASSERT_EQ(seen_ids, expected_ids);
}

namespace {

// The bin of a coordinate, by the formula of the map tiles (asinh of the tangent, unlike the library's own).
uint64_t cell_x(const Item &item, unsigned level) {
    const double longitude = item.longitude == 180 ? -180 : item.longitude;
    return static_cast<uint64_t>(std::floor((longitude + 180) / 360 * std::ldexp(1.0, static_cast<int>(level))));
}
uint64_t cell_y(const Item &item, unsigned level) {
    const double cells = std::ldexp(1.0, static_cast<int>(level));
    const double y = (1 - std::asinh(std::tan(item.latitude * std::numbers::pi / 180)) / std::numbers::pi) / 2 * cells;
    return static_cast<uint64_t>(std::clamp(std::floor(y), 0.0, cells - 1));
}

} // namespace

void TrackedStore::compare_tile(uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins) {
    const unsigned level = zoom + log2_bins;
    const size_t side = size_t{1} << log2_bins;
    std::vector<uint32_t> expected(side * side), bins(side * side, 77);
    for (const Item &item : live()) {
        const uint64_t column = cell_x(item, level), row = cell_y(item, level);
        if (column >> log2_bins == x && row >> log2_bins == y)
            ++expected[(row % side) * side + column % side];
    }
    uint64_t total = 0;
    ASSERT_EQ(locus_pmq_tile(pmq_, zoom, x, y, log2_bins, nullptr, bins.data(), bins.size(), &total), LOCUS_OK);
    ASSERT_EQ(bins, expected) << "tile " << zoom << "/" << x << "/" << y << " with 2^" << log2_bins << " bins";
    ASSERT_EQ(total, std::accumulate(expected.begin(), expected.end(), uint64_t{0}));
}

void TrackedStore::expect_conserved() {
    std::set<uint64_t> all(departed_.begin(), departed_.end());
    EXPECT_EQ(all.size(), departed_.size());
    for (const Item &item : stored_)
        EXPECT_TRUE(all.insert(item.id).second);
    EXPECT_EQ(stats_of(pmq_).pending, 0u);
    EXPECT_EQ(all, inserted_);
}

} // namespace locus::test
