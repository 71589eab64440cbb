// A store with a cold tier beside its model: everything that was ever inserted.
#pragma once

#include "tests/unit/pmq/tracked_store.hpp"

#include <locus/cold.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace locus::test {

class Folder {
public:
    Folder() {
        std::string name = std::filesystem::temp_directory_path() / "locus-cold-XXXXXX";
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error("no folder for the test");
        path_ = name;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;
    std::string file() const { return path_ + "/tier.db"; }
    const std::string &path() const { return path_; }

private:
    std::string path_;
};

inline locus_cold_options cold_options(uint32_t record = LOCUS_RECORD_POINT32) {
    locus_cold_options options;
    locus_cold_options_init(&options, sizeof options);
    options.record = record;
    options.cache_bytes = 1 << 20;
    options.queue_bytes = 1 << 20;
    options.sync = LOCUS_COLD_SYNC_OFF; // what a loss of power would do is not tested
    return options;
}

inline locus_cold_stats stats_of(const locus_cold *cold) {
    locus_cold_stats stats{};
    stats.struct_size = sizeof stats;
    locus_cold_get_stats(cold, &stats);
    return stats;
}

// What a query selects. Circles and polygons: by the store's own geometry, which has tests of its own.
class Selection {
public:
    explicit Selection(const locus_pmq_query &query) : query_(query) {
        EXPECT_EQ(locus_pmq_selection_create(&query, LOCUS_RECORD_POINT32, &geometry_), LOCUS_OK) << locus_last_error();
    }
    ~Selection() { locus_pmq_selection_destroy(geometry_); }
    Selection(const Selection &) = delete;
    Selection &operator=(const Selection &) = delete;

    bool selects(const Item &item) const {
        if (item.time < query_.time_from || item.time > query_.time_to)
            return false;
        if (query_.region == LOCUS_REGION_BOX)
            return in_box(query_.box, item);
        if (query_.region == LOCUS_REGION_ALL)
            return true;
        const locus_point32 record{item.latitude, item.longitude, item.time, 0, 0, 0, 0};
        int32_t matches = 0;
        EXPECT_EQ(locus_pmq_selection_matches(geometry_, &record, 0, &matches), LOCUS_OK) << locus_last_error();
        return matches != 0;
    }

private:
    const locus_pmq_query query_;
    locus_pmq_selection *geometry_ = nullptr;
};

// Store, tier and model. Ids count from 1 in the order of insertion.
class Tiers {
public:
    Tiers(const std::string &file, locus_pmq_options window, const locus_cold_options &options)
        : file_(file), window_(window), options_(options) {
        open();
    }
    ~Tiers() { close(); }
    Tiers(const Tiers &) = delete;
    Tiers &operator=(const Tiers &) = delete;

    void open() {
        ASSERT_EQ(locus_cold_open(file_.c_str(), &options_, &cold), LOCUS_OK) << locus_cold_last_error();
        locus_pmq_options window = window_;
        ASSERT_EQ(locus_cold_attach(cold, &window), LOCUS_OK) << locus_cold_last_error();
        ASSERT_EQ(locus_pmq_create(&window, &pmq), LOCUS_OK) << locus_last_error();
    }
    void close() {
        locus_pmq_destroy(pmq);
        locus_cold_close(cold);
        pmq = nullptr;
        cold = nullptr;
    }

    locus_status insert(std::vector<Item> items, int64_t now) {
        for (Item &item : items) {
            item.id = ++last_id;
            locus_pmq_key(item.latitude, item.longitude, &item.key);
            model[item.id] = item;
        }
        const auto batch = pack(items, options_.record);
        return locus_pmq_insert(pmq, batch.data(), items.size(), now);
    }

    // What the answer to a query should be, by ids.
    std::vector<uint64_t> wanted(const locus_pmq_query &query) const {
        const Selection selection(query);
        std::vector<uint64_t> ids;
        for (const auto &[id, item] : model)
            if (selection.selects(item))
                ids.push_back(id);
        return ids;
    }

    std::vector<Item> read(const locus_pmq_query &query, bool both = true) const {
        size_t count = 0;
        std::vector<unsigned char> bytes((model.size() + 1) * options_.record);
        EXPECT_EQ(locus_cold_read(cold, both ? pmq : nullptr, &query, bytes.data(), model.size() + 1, &count), LOCUS_OK)
            << locus_cold_last_error();
        std::vector<Item> items;
        for (size_t i = 0; i < count; ++i) {
            items.push_back(unpack(bytes.data() + i * options_.record, options_.record));
            locus_pmq_key(items.back().latitude, items.back().longitude, &items.back().key);
        }
        return items;
    }

    // The tiers hold what the model does, in order, byte for byte as far as items tell.
    void expect(const locus_pmq_query &query) const {
        const std::vector<uint64_t> want = wanted(query);
        uint64_t count = 0;
        ASSERT_EQ(locus_cold_count(cold, pmq, &query, &count), LOCUS_OK) << locus_cold_last_error();
        EXPECT_EQ(count, want.size());
        const std::vector<Item> found = read(query);
        std::vector<uint64_t> ids;
        for (size_t i = 0; i < found.size(); ++i) {
            ids.push_back(found[i].id);
            if (i > 0) {
                ASSERT_LE(found[i - 1].key, found[i].key);
            }
        }
        std::sort(ids.begin(), ids.end());
        ASSERT_EQ(ids, want);
    }

    std::map<uint64_t, Item> model;
    uint64_t last_id = 0;
    locus_cold *cold = nullptr;
    locus_pmq *pmq = nullptr;

private:
    const std::string file_;
    const locus_pmq_options window_;
    const locus_cold_options options_;
};

// A query of any region; its polygon lies in the drawer.
class Queries {
public:
    explicit Queries(uint64_t seed) : draw(seed) {}
    locus_pmq_query next(int64_t now) {
        locus_pmq_query query = default_query();
        query.region = static_cast<uint32_t>(draw.below(4));
        query.box = draw.box();
        const Item centre = draw.place();
        query.circle = {centre.latitude, centre.longitude, std::pow(10.0, draw.uniform(2, 7))};
        for (int i = 0; i < 5; ++i)
            vertices_[i] = {std::clamp(centre.latitude + 3 * std::cos(i * 1.25), -90.0, 90.0),
                            centre.longitude + 3 * std::sin(i * 1.25)};
        query.polygon = {vertices_, &vertex_count_, 1};
        if (draw.chance(0.4)) {
            query.time_from = static_cast<int64_t>(draw.below(static_cast<uint64_t>(now)));
            query.time_to = query.time_from + static_cast<int64_t>(draw.below(3000));
        }
        return query;
    }
    Places draw;

private:
    locus_position vertices_[5];
    uint64_t vertex_count_ = 5;
};

} // namespace locus::test
