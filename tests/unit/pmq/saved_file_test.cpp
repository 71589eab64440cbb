// Saving and loading.
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include "core/checksum.hpp"
#include "pmq/storage/saved_file.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

namespace locus::test {
namespace {

StoreHandle filled(const locus_pmq_options &options, Changes &changes, int batches, size_t most) {
    locus_pmq *pmq = nullptr;
    EXPECT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK) << locus_last_error();
    for (int i = 0; i < batches; ++i) {
        const auto batch = changes.batch(most);
        EXPECT_EQ(locus_pmq_insert(pmq, batch.data(), batch.size() / options.record, changes.now), LOCUS_OK);
        changes.now += 50;
    }
    return StoreHandle(pmq);
}

int32_t count_record(const void *, void *user) {
    ++*static_cast<uint64_t *>(user);
    return 0;
}

class SavedFiles : public testing::TestWithParam<std::tuple<LayoutChoice, uint32_t>> {
protected:
    const LayoutChoice from = std::get<0>(GetParam());
    const uint32_t record = std::get<1>(GetParam());
    Scratch folder;
};

// Whatever comes behind, a store that was loaded, in whichever layout, answers like the one that was saved.
TEST_P(SavedFiles, LoadIntoEveryLayout) {
    const locus_pmq_options options = options_of(from, record, 4000);
    Changes changes(11, record);
    const StoreHandle saved = filled(options, changes, 60, 400);
    const std::string path = folder / "saved";
    save_to(saved, path);
    const Content content = content_of(saved.get(), record);
    ASSERT_GT(content.records.size() / record, 3000u);
    for (const LayoutChoice &to : layouts) {
        SCOPED_TRACE(to.name);
        const locus_pmq_options other = options_of(to, record, 4000);
        const StoreHandle loaded = load_store(path, &other);
        ASSERT_EQ(content_of(loaded.get(), record), content);
        Changes later = changes;
        for (int i = 0; i < 10; ++i) {
            const auto batch = later.batch(300);
            later.now += 20;
            ASSERT_EQ(locus_pmq_insert(loaded.get(), batch.data(), batch.size() / record, later.now), LOCUS_OK);
        }
        EXPECT_EQ(locus_pmq_check(loaded.get()), LOCUS_OK) << locus_last_error();
        save_to(loaded, folder / "again");
        EXPECT_EQ(content_of(load_store(folder / "again", nullptr).get(), record), content_of(loaded.get(), record));
    }
    locus_pmq_file_info info{};
    info.struct_size = sizeof info;
    ASSERT_EQ(locus_pmq_get_file_info(path.c_str(), &info), LOCUS_OK);
    EXPECT_EQ(info.record, record);
    EXPECT_EQ(info.records, stats_of(saved.get()).stored);
    EXPECT_EQ(info.now, content.now);
    EXPECT_EQ(info.bytes, std::filesystem::file_size(path));
}

TEST_P(SavedFiles, EmptyStores) {
    const locus_pmq_options options = options_of(from, record);
    Changes changes(1, record);
    const StoreHandle saved = filled(options, changes, 0, 1);
    save_to(saved, folder / "empty");
    const StoreHandle loaded = load_store(folder / "empty", nullptr);
    EXPECT_EQ(content_of(loaded.get(), record), Content{});
    EXPECT_EQ(std::filesystem::file_size(folder / "empty"), sizeof(pmq::SavedHeader));
}

// The loader's horizon and limits hold, and what had expired or is too much reaches its sink.
TEST_P(SavedFiles, HorizonLimitsAndSink) {
    Changes changes(5, record);
    const StoreHandle saved = filled(options_of(from, record, 4000), changes, 40, 200);
    save_to(saved, folder / "saved");
    const locus_pmq_stats before = stats_of(saved.get());
    for (const LayoutChoice &to : layouts) {
        SCOPED_TRACE(to.name);
        uint64_t handed = 0, live = 0;
        locus_pmq_options options = options_of(to, record, 1000);
        options.sink = count_record;
        options.sink_user = &handed;
        StoreHandle loaded = load_store(folder / "saved", &options);
        locus_pmq_query young = default_query();
        young.time_from = before.now - 1000;
        locus_pmq_count(saved.get(), &young, &live);
        EXPECT_EQ(stats_of(loaded.get()).records, live);
        EXPECT_EQ(locus_pmq_sweep(loaded.get(), before.now, nullptr), LOCUS_OK);
        EXPECT_EQ(handed, before.stored - live);

        handed = 0;
        options.horizon = LOCUS_NO_HORIZON; // what had expired does not come back
        options.max_records = 200;
        loaded = load_store(folder / "saved", &options);
        const uint64_t kept = stats_of(loaded.get()).records;
        EXPECT_LE(kept, 200u);
        EXPECT_GE(kept, 200u - 200 / 16);
        EXPECT_EQ(locus_pmq_sweep(loaded.get(), before.now, nullptr), LOCUS_OK);
        EXPECT_EQ(handed, before.stored - kept);
    }
}

INSTANTIATE_TEST_SUITE_P(From, SavedFiles,
                         testing::Combine(testing::ValuesIn(layouts),
                                          testing::Values<uint32_t>(LOCUS_RECORD_POINT32, LOCUS_RECORD_TEXT156)),
                         [](const auto &instance) {
                             return std::string(std::get<0>(instance.param).name) + "_" +
                                    std::to_string(std::get<1>(instance.param));
                         });

// Leaves of one place, airports, hold thousands of equal keys: their order is that of arrival.
TEST(SavedFile, KeepsTheOrderOfArrivalAmongEqualKeys) {
    Scratch folder;
    const locus_pmq_options options = options_of(layouts[0], LOCUS_RECORD_POINT32);
    std::vector<Item> items(20000);
    Places draw(3);
    for (size_t i = 0; i < items.size(); ++i) {
        items[i].latitude = static_cast<double>(draw.below(3));
        items[i].time = static_cast<int64_t>(draw.below(1000)); // not in the order of arrival
        items[i].id = i;
    }
    const auto batch = pack(items, options.record);
    locus_pmq *made = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &made), LOCUS_OK);
    const StoreHandle pmq(made);
    ASSERT_EQ(locus_pmq_insert(pmq.get(), batch.data(), items.size(), 1000), LOCUS_OK);
    save_to(pmq, folder / "saved");
    for (const LayoutChoice &to : layouts) {
        const locus_pmq_options other = options_of(to, options.record);
        EXPECT_EQ(content_of(load_store(folder / "saved", &other).get(), options.record),
                  content_of(pmq.get(), options.record));
    }
}

// A leaf that was in the order of time is not any more.
TEST(SavedFile, LateRecordsComeAfterLoading) {
    const Scratch folder;
    const locus_pmq_options options = options_of(layouts[0], LOCUS_RECORD_POINT32);
    std::vector<Item> items(100);
    for (size_t i = 0; i < items.size(); ++i)
        items[i] = {static_cast<double>(i) / 4, static_cast<double>(i), static_cast<int64_t>(1000 + i), i, 0};
    const auto batch = pack(items, options.record), late = pack({{7, 28, 500, 100, 0}}, options.record);
    locus_pmq *made = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &made), LOCUS_OK);
    const StoreHandle pmq(made);
    ASSERT_EQ(locus_pmq_insert(made, batch.data(), items.size(), 2000), LOCUS_OK);
    save_to(pmq, folder / "saved");
    const StoreHandle loaded = load_store(folder / "saved", &options);
    ASSERT_EQ(locus_pmq_insert(loaded.get(), late.data(), 1, 2000), LOCUS_OK);
    EXPECT_EQ(locus_pmq_check(loaded.get()), LOCUS_OK) << locus_last_error();
}

// A file of a few records: each byte changed, each length, each of them an error that names the file, or no change.
TEST(SavedFile, NoDamageGoesUnseen) {
    Scratch folder;
    const locus_pmq_options options = options_of(layouts[0], LOCUS_RECORD_POINT32);
    Changes changes(2);
    const StoreHandle pmq = filled(options, changes, 3, 12);
    const std::string path = folder / "saved";
    save_to(pmq, path);
    const Content content = content_of(pmq.get(), options.record);
    const FileBytes whole = file_bytes(path);
    ASSERT_GT(whole.size(), 200u);
    const auto expect_refused = [&](const FileBytes &bytes, const std::string &what) {
        write_file(path, bytes);
        locus_pmq *loaded = nullptr;
        ASSERT_EQ(locus_pmq_load(path.c_str(), &options, nullptr, nullptr, &loaded), LOCUS_E_FORMAT) << what;
        ASSERT_EQ(loaded, nullptr);
        ASSERT_NE(std::string(locus_last_error()).find(path), std::string::npos) << locus_last_error();
        ASSERT_NE(std::string(locus_last_error()).find("byte "), std::string::npos) << locus_last_error();
    };
    for (size_t at = 0; at < whole.size(); ++at) {
        for (const int flip : {0x01, 0x80, 0xFF}) {
            FileBytes bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ flip);
            expect_refused(bytes, "byte " + std::to_string(at) + " ^ " + std::to_string(flip));
        }
        expect_refused({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(at)}, "length " + std::to_string(at));
    }
    FileBytes longer = whole;
    longer.push_back(0);
    expect_refused(longer, "one byte more");
    write_file(path, whole);
    EXPECT_EQ(content_of(load_store(path, &options).get(), options.record), content);
}

// Files with matching checksums that no store has saved.
TEST(SavedFile, ForgedContentIsRefused) {
    Scratch folder;
    const std::string path = folder / "forged";
    const auto expect_refused = [&](auto &&change, const char *words) {
        std::vector<locus_point32> records(3);
        for (size_t i = 0; i < records.size(); ++i)
            records[i] = {10.0 - static_cast<double>(i), 20.0 + static_cast<double>(i), 100, 0, 0, 0, 0};
        pmq::SavedHeader header{};
        std::memcpy(header.magic, pmq::SavedHeader::expected_magic, sizeof header.magic);
        header.version = 1;
        header.record = 32;
        header.records = records.size();
        header.block_records = 8;
        header.now = 100;
        header.cutoff = 0;
        header.bytes = sizeof header + 8 + records.size() * 32;
        change(header, records);
        header.sum = sum_of(header);
        const uint64_t sum = checksum(std::as_bytes(std::span(records)), 0);
        FileBytes bytes(sizeof header + 8 + records.size() * 32);
        std::memcpy(bytes.data(), &header, sizeof header);
        std::memcpy(bytes.data() + sizeof header, &sum, 8);
        std::memcpy(bytes.data() + sizeof header + 8, records.data(), records.size() * 32);
        write_file(path, bytes);
        locus_pmq *loaded = nullptr;
        const locus_status status = locus_pmq_load(path.c_str(), nullptr, nullptr, nullptr, &loaded);
        EXPECT_EQ(status, *words ? LOCUS_E_FORMAT : LOCUS_OK) << words << ": " << locus_last_error();
        EXPECT_EQ(loaded == nullptr, *words != 0);
        if (*words) {
            EXPECT_NE(std::string(locus_last_error()).find(words), std::string::npos) << locus_last_error();
        }
        locus_pmq_destroy(loaded);
    };
    using Header = pmq::SavedHeader;
    using Records = std::vector<locus_point32>;
    expect_refused([](Header &, Records &) {}, "");
    expect_refused([](Header &, Records &r) { r[1].latitude = NAN; }, "latitude is nan");
    expect_refused([](Header &, Records &r) { r[1].longitude = 180.5; }, "longitude is 180.5");
    expect_refused([](Header &, Records &r) { r[2].time = 101; }, "time is 101");
    expect_refused([](Header &, Records &r) { std::swap(r[0], r[2]); }, "order of keys");
    expect_refused([](Header &h, Records &) { h.version = 2; }, "version 2");
    expect_refused([](Header &h, Records &) { h.record = 33; }, "records of 33 bytes");
    expect_refused([](Header &h, Records &) { h.block_records = 0; }, "blocks of 0");
    expect_refused([](Header &h, Records &) { h.block_records = UINT64_MAX; }, "blocks of");
    expect_refused([](Header &h, Records &) { h.records = UINT64_MAX / 32; }, "records in a file");
    expect_refused([](Header &h, Records &) { h.block_records = 2; }, "a file of");
    expect_refused([](Header &h, Records &) { h.cutoff = 101; }, "cutoff 101");
    expect_refused([](Header &h, Records &) { h.bytes += 8; }, "a file of");
}

int32_t cancel_third(double, void *user) { return ++*static_cast<int *>(user) >= 3; }

TEST(SavedFile, CancelledAndFailedSavesLeaveTheFormerFile) {
    Scratch folder;
    const locus_pmq_options options = options_of(layouts[0], LOCUS_RECORD_POINT32);
    Changes changes(3);
    const StoreHandle pmq = filled(options, changes, 100, 500);
    const std::string path = folder / "saved";
    write_file(path, {'o', 'l', 'd'});
    int calls = 0;
    EXPECT_EQ(locus_pmq_save(pmq.get(), nullptr, path.c_str(), cancel_third, &calls), LOCUS_E_STOPPED);
    {
        const FullDisk full(100000);
        EXPECT_EQ(locus_pmq_save(pmq.get(), nullptr, path.c_str(), nullptr, nullptr), LOCUS_E_IO);
        EXPECT_NE(std::string(locus_last_error()).find(path), std::string::npos) << locus_last_error();
        EXPECT_NE(std::string(locus_last_error()).find("at byte 100000"), std::string::npos) << locus_last_error();
    }
    EXPECT_EQ(file_bytes(path), (FileBytes{'o', 'l', 'd'}));
    EXPECT_EQ(folder.entries(), 1u) << "a temporary file was left";
    save_to(pmq, path);
    calls = 0;
    locus_pmq *loaded = nullptr;
    EXPECT_EQ(locus_pmq_load(path.c_str(), nullptr, cancel_third, &calls, &loaded), LOCUS_E_STOPPED);
    EXPECT_EQ(loaded, nullptr);
}

// One moment, whatever the writer does meanwhile: the one of the call, or that of a snapshot.
TEST(SavedFile, SavesOneMomentBesideTheWriter) {
    Scratch folder;
    const locus_pmq_options options = options_of(layouts[0], LOCUS_RECORD_POINT32);
    Changes changes(4);
    const StoreHandle pmq = filled(options, changes, 20, 500);
    const Content before = content_of(pmq.get(), options.record);
    locus_pmq_snapshot *snapshot = nullptr;
    ASSERT_EQ(locus_pmq_snapshot_create(pmq.get(), &snapshot), LOCUS_OK);
    std::atomic<bool> stop = false;
    std::thread writer([&] {
        Places draw(5);
        while (!stop) {
            std::vector<Item> items(64); // batches that can be told from parts of batches
            for (Item &item : items) {
                item = draw.place();
                item.time = changes.now;
            }
            const auto batch = pack(items, options.record);
            EXPECT_EQ(locus_pmq_insert(pmq.get(), batch.data(), items.size(), changes.now), LOCUS_OK);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    for (int i = 0; i < 5; ++i) {
        save_to(pmq, folder / "present");
        const uint64_t records = stats_of(load_store(folder / "present", &options).get()).records;
        EXPECT_EQ((records - before.records.size() / options.record) % 64, 0u);
    }
    EXPECT_EQ(locus_pmq_save(pmq.get(), snapshot, (folder / "past").c_str(), nullptr, nullptr), LOCUS_OK);
    stop = true;
    writer.join();
    locus_pmq_snapshot_destroy(snapshot);
    EXPECT_EQ(content_of(load_store(folder / "past", &options).get(), options.record), before);
}

} // namespace
} // namespace locus::test
