// What a store holds, to be compared with what it held before it went through a file.
#pragma once

#include "tests/unit/pmq/tracked_store.hpp"

#include <locus/storage.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace locus::test {

struct Destroy {
    void operator()(locus_pmq *pmq) const { locus_pmq_destroy(pmq); }
};
using StoreHandle = std::unique_ptr<locus_pmq, Destroy>;

// The live records in their order, byte for byte, and the clock.
struct Content {
    std::vector<unsigned char> records;
    int64_t now = INT64_MIN;
    bool operator==(const Content &) const = default;
};

inline Content content_of(const locus_pmq *pmq, uint32_t record, const locus_pmq_snapshot *snapshot = nullptr) {
    locus_pmq_query query = default_query();
    query.snapshot = snapshot;
    Content content;
    size_t count = 0;
    locus_pmq_count(pmq, &query, &count);
    content.records.resize(count * record);
    EXPECT_EQ(locus_pmq_read(pmq, &query, content.records.data(), count, &count), LOCUS_OK) << locus_last_error();
    content.now = stats_of(pmq).now;
    return content;
}

inline void save_to(const StoreHandle &pmq, const std::string &path) {
    ASSERT_EQ(locus_pmq_save(pmq.get(), nullptr, path.c_str(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
}

inline StoreHandle load_store(const std::string &path, const locus_pmq_options *options) {
    locus_pmq *pmq = nullptr;
    EXPECT_EQ(locus_pmq_load(path.c_str(), options, nullptr, nullptr, &pmq), LOCUS_OK) << locus_last_error();
    EXPECT_EQ(pmq ? locus_pmq_check(pmq) : LOCUS_OK, LOCUS_OK) << locus_last_error();
    return StoreHandle(pmq);
}

inline locus_pmq_log_options log_options(uint32_t sync = LOCUS_SYNC_NONE) {
    locus_pmq_log_options options;
    locus_pmq_log_options_init(&options, sizeof options);
    options.sync = sync;
    return options;
}

inline StoreHandle open_store(const std::string &folder, const locus_pmq_options &options,
                              const locus_pmq_log_options &log, locus_pmq_recovery *recovery = nullptr) {
    locus_pmq *pmq = nullptr;
    EXPECT_EQ(locus_pmq_open(folder.c_str(), &options, &log, nullptr, nullptr, recovery, &pmq), LOCUS_OK)
        << locus_last_error();
    EXPECT_EQ(pmq ? locus_pmq_check(pmq) : LOCUS_OK, LOCUS_OK) << locus_last_error();
    return StoreHandle(pmq);
}

inline locus_pmq_recovery empty_recovery() {
    locus_pmq_recovery recovery{};
    recovery.struct_size = sizeof recovery;
    return recovery;
}

// Random changes, the same for the same seed, to be made on one store or several.
struct Changes {
    explicit Changes(uint64_t seed, uint32_t record = LOCUS_RECORD_POINT32) : draw(seed), record(record) {}

    std::vector<unsigned char> batch(size_t most) {
        std::vector<Item> items(draw.below(most));
        const bool one_place = draw.chance(0.2);
        const Item place = draw.place();
        for (Item &item : items) {
            item = one_place ? place : draw.place();
            item.time = now - static_cast<int64_t>(draw.chance(0.8) ? draw.below(30) : draw.below(4000));
            item.id = draw.chance(0.1) ? 7 : ++id; // some are the same in every byte
            if (item.id == 7) {
                item.latitude = item.longitude = 7;
                item.time = now / 1000 * 1000;
            }
        }
        return pack(items, record);
    }

    Places draw;
    uint32_t record;
    int64_t now = 100000;
    uint64_t id = 7;
};

} // namespace locus::test
