// Saved files that several threads read, in groups of 24 blocks.
#include "tests/unit/pmq/failing_files.hpp"
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include "core/checksum.hpp"
#include "pmq/storage/saved_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace locus::test {
namespace {

// Two groups and a part of a third, which ends amid a block.
class LargeFile : public testing::TestWithParam<uint32_t> {
protected:
    const uint32_t record = GetParam();
    const size_t records = record == LOCUS_RECORD_POINT32 ? 420'000 : 90'000;
    const size_t block_bytes = 8 + (256 << 10) / record * record;

    LargeFile() {
        options.horizon = static_cast<int64_t>(records) / 4;
        Places draw(5);
        std::vector<Item> items(records);
        for (size_t i = 0; i < records; ++i) {
            items[i].latitude = static_cast<double>(draw.below(120'000)) / 1000 - 60;
            items[i].longitude = static_cast<double>(draw.below(340'000)) / 1000 - 170;
            items[i].time = 200'000 + static_cast<int64_t>(i);
            items[i].id = i;
        }
        const auto batch = pack(items, record);
        locus_pmq_options all = options;
        all.horizon = LOCUS_NO_HORIZON;
        locus_pmq *made = nullptr;
        EXPECT_EQ(locus_pmq_create(&all, &made), LOCUS_OK);
        EXPECT_EQ(locus_pmq_insert(made, batch.data(), records, 200'000 + static_cast<int64_t>(records)), LOCUS_OK)
            << locus_last_error();
        pmq = StoreHandle(made);
        save_to(pmq, path);
        last = (std::filesystem::file_size(path) - sizeof(pmq::SavedHeader)) / block_bytes;
        EXPECT_GE(last, 50u);
    }
    size_t offset(size_t block) const { return sizeof(pmq::SavedHeader) + block * block_bytes; }
    // A block's checksum is made to match what the block holds now.
    void seal(FileBytes &bytes, size_t block) const {
        const size_t begin = offset(block), end = std::min(offset(block + 1), bytes.size());
        const uint64_t sum = checksum(std::as_bytes(std::span(bytes)).subspan(begin + 8, end - begin - 8), block);
        std::memcpy(&bytes[begin], &sum, sizeof sum);
    }
    void expect_failure(locus_status status, const std::string &words, locus_progress_fn progress = nullptr,
                        void *user = nullptr) const {
        locus_pmq *loaded = nullptr;
        EXPECT_EQ(locus_pmq_load(path.c_str(), nullptr, progress, user, &loaded), status);
        EXPECT_EQ(loaded, nullptr);
        EXPECT_NE(std::string(locus_last_error()).find(words), std::string::npos) << locus_last_error();
    }
    // Loading what was changed says so.
    void expect_refused(const FileBytes &bytes, const std::string &words) const {
        write_file(path, bytes);
        expect_failure(LOCUS_E_FORMAT, words);
    }

    Scratch folder;
    const std::string path = folder / "saved";
    locus_pmq_options options = options_of(layouts[0], record);
    StoreHandle pmq;
    size_t last = 0; // block
};

TEST_P(LargeFile, ComesBackWholeOrWithinTheHorizon) {
    const Content content = content_of(pmq.get(), record);
    for (const bool limited : {false, true}) { // block by block, or with an eye on the limit
        locus_pmq_options all = options_of(layouts[0], record);
        all.max_records = limited ? records : LOCUS_NO_LIMIT;
        const StoreHandle whole = load_store(path, &all);
        EXPECT_TRUE(content_of(whole.get(), record) == content) << limited;
        save_to(whole, folder / "again"); // the same file, byte for byte
        EXPECT_TRUE(file_bytes(folder / "again") == file_bytes(path)) << limited;
    }
    const locus_pmq_options heads = options_of(layouts[3], record);
    EXPECT_TRUE(content_of(load_store(path, &heads).get(), record) == content);
    uint64_t departed = 0;
    options.sink = [](const void *, void *user) -> int32_t {
        ++*static_cast<uint64_t *>(user);
        return 0;
    };
    options.sink_user = &departed;
    const StoreHandle recent = load_store(path, &options);
    locus_pmq_query query = default_query();
    query.time_from = 200'000 + static_cast<int64_t>(records) - options.horizon;
    std::vector<unsigned char> wanted(records * record);
    size_t count = 0;
    ASSERT_EQ(locus_pmq_read(pmq.get(), &query, wanted.data(), records, &count), LOCUS_OK);
    wanted.resize(count * record);
    EXPECT_GE(count, records / 4);
    EXPECT_TRUE(content_of(recent.get(), record).records == wanted);
    EXPECT_EQ(locus_pmq_sweep(recent.get(), content.now, nullptr), LOCUS_OK);
    EXPECT_EQ(departed, records - count);
}

TEST_P(LargeFile, NamesTheFirstOfSeveralDamages) {
    const FileBytes whole = file_bytes(path);
    for (const auto &[first, second] : {std::pair<size_t, size_t>(3, 20), {23, 24}, {30, last}, {last - 1, last}}) {
        FileBytes bytes = whole;
        for (const size_t block : {first, second})
            bytes[offset(block) + 1000] ^= 1;
        expect_refused(bytes, "block " + std::to_string(first) + " ");
    }
    for (const size_t block : {size_t{0}, size_t{1}, size_t{47}, last}) {
        FileBytes bytes = whole;
        bytes[std::min(offset(block + 1), bytes.size()) - 1] ^= 1; // its last byte
        expect_refused(bytes, "byte " + std::to_string(offset(block)) + ": the checksum of block ");
    }
}

// Within a group of blocks and where two groups meet.
TEST_P(LargeFile, KeysOutOfOrderBetweenBlocksAreRefused) {
    const FileBytes whole = file_bytes(path);
    for (const size_t block : {4u, 23u, 24u, 47u}) {
        FileBytes bytes = whole;
        const auto at = [&](size_t i) { return bytes.begin() + static_cast<ptrdiff_t>(offset(i)); };
        std::swap_ranges(at(block), at(block + 1), at(block + 1));
        seal(bytes, block);
        seal(bytes, block + 1);
        expect_refused(bytes, "byte " + std::to_string(offset(block + 1) + 8) + ": a record out of the order of keys");
    }
}

// The very last record of all, and of a block amid the others.
TEST_P(LargeFile, RecordsOfNoPlaceOrTimeAreRefused) {
    const FileBytes whole = file_bytes(path);
    for (const size_t block : {size_t{25}, last}) {
        const size_t at = std::min(offset(block + 1), whole.size()) - record, time_at = record == 32 ? 16 : 8;
        FileBytes bytes = whole;
        std::fill_n(bytes.begin() + static_cast<ptrdiff_t>(at), 8, static_cast<char>(0xFF)); // no number
        seal(bytes, block);
        expect_refused(bytes, "byte " + std::to_string(at) + ": latitude is");
        bytes = whole;
        const int64_t later = 200'001 + static_cast<int64_t>(records);
        std::memcpy(&bytes[at + time_at], &later, sizeof later);
        seal(bytes, block);
        expect_refused(bytes, "byte " + std::to_string(at) + ": time is " + std::to_string(later));
    }
}

TEST_P(LargeFile, ReadErrorsAndCancellingEndItAnywhere) {
    for (const size_t after : {1u, 2u, 20u, 60u, 100u}) { // the header, the first group, ..., the last
        SCOPED_TRACE(after);
        const FailingFiles failing(after, FailingFiles::Way::refused, EIO);
        expect_failure(LOCUS_E_IO, "cannot read at byte");
        EXPECT_TRUE(failing.failed());
    }
    for (double part : {0.0, 0.5, 0.99}) {
        const auto cancel = [](double progress, void *user) -> int32_t {
            return progress > *static_cast<const double *>(user);
        };
        expect_failure(LOCUS_E_STOPPED, "progress", cancel, &part);
    }
    const auto cut = [](double, void *user) -> int32_t { // the end goes before it is read
        std::filesystem::resize_file(*static_cast<const std::string *>(user), 13'000'000);
        return 0;
    };
    std::string name = path;
    expect_failure(LOCUS_E_FORMAT, "ends at byte 13000000", cut, &name);
}

INSTANTIATE_TEST_SUITE_P(Records, LargeFile, testing::Values(LOCUS_RECORD_POINT32, LOCUS_RECORD_TEXT156),
                         [](const auto &instance) { return std::to_string(instance.param); });

} // namespace
} // namespace locus::test
