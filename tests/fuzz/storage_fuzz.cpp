// libFuzzer: any bytes as a saved file or as a store's log. The first byte chooses; half of the inputs get their
// checksums mended first, so that what lies behind them is reached.
#include "pmq/storage/log_format.hpp"
#include "pmq/storage/saved_file.hpp"

#include <locus/storage.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace locus;
using namespace locus::pmq;

void require(bool good) {
    if (!good)
        std::abort();
}

using Buffer = std::vector<std::byte>;

template <typename Header>
void mend(Buffer &bytes, size_t at, void (*change)(Header &, std::span<const std::byte> behind)) {
    if (bytes.size() < at + sizeof(Header))
        return;
    Header header;
    std::memcpy(&header, bytes.data() + at, sizeof header);
    change(header, std::span<const std::byte>(bytes).subspan(at + sizeof header));
    header.sum = sum_of(header);
    std::memcpy(bytes.data() + at, &header, sizeof header);
}

// One block, as small files have.
void mend_saved(Buffer &bytes) {
    mend<SavedHeader>(bytes, 0, [](SavedHeader &header, std::span<const std::byte>) {
        std::memcpy(header.magic, SavedHeader::expected_magic, sizeof header.magic);
        header.version = SavedHeader::current_version;
    });
    if (bytes.size() < sizeof(SavedHeader) + 8)
        return;
    const std::span<const std::byte> records = std::span<const std::byte>(bytes).subspan(sizeof(SavedHeader) + 8);
    const uint64_t sum = checksum(records, 0);
    std::memcpy(bytes.data() + sizeof(SavedHeader), &sum, sizeof sum);
}

void mend_log(Buffer &bytes) {
    mend<SegmentHeader>(bytes, 0, [](SegmentHeader &header, std::span<const std::byte>) {
        std::memcpy(header.magic, SegmentHeader::expected_magic, sizeof header.magic);
        header.version = SegmentHeader::current_version;
        header.record = LOCUS_RECORD_POINT32;
        header.number = header.first = 1;
    });
    static uint64_t sequence, records;
    sequence = 1;
    for (size_t at = sizeof(SegmentHeader); at + sizeof(EntryHeader) <= bytes.size();
         at += sizeof(EntryHeader) + records * LOCUS_RECORD_POINT32, ++sequence)
        mend<EntryHeader>(bytes, at, [](EntryHeader &header, std::span<const std::byte> behind) {
            header.magic = EntryHeader::expected_magic;
            header.sequence = sequence;
            header.records = records = std::min<uint64_t>(header.records, behind.size() / LOCUS_RECORD_POINT32);
            header.records_sum = checksum(behind.first(records * LOCUS_RECORD_POINT32), sequence);
        });
}

// In memory where there is such a place: every open flushes.
std::string scratch_folder() {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    std::string name = (parent / "locus-storage-fuzz-XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr);
    static std::string path;
    path = name;
    std::atexit([] {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    });
    return name;
}

void write_file(const std::string &path, const Buffer &bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    require(file.good());
}

constexpr const char *saved_name = "/store-00000000000000000001", *log_name = "/log-00000000000000000001";

// What a new folder holds beside its log.
Buffer empty_save(const std::string &store) {
    locus_pmq *pmq = nullptr;
    require(locus_pmq_open(store.c_str(), nullptr, nullptr, nullptr, nullptr, nullptr, &pmq) == LOCUS_OK);
    locus_pmq_destroy(pmq);
    std::ifstream file(store + saved_name, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    require(!text.empty());
    const auto *begin = reinterpret_cast<const std::byte *>(text.data());
    return {begin, begin + text.size()};
}

// A store is whole, and can be used.
void use(locus_status status, locus_pmq *pmq) {
    require((status == LOCUS_OK) == (pmq != nullptr));
    require(status == LOCUS_OK || status == LOCUS_E_FORMAT);
    if (pmq == nullptr) {
        require(std::strstr(locus_last_error(), "byte") != nullptr);
        return;
    }
    uint64_t count = 0;
    require(locus_pmq_check(pmq) == LOCUS_OK);
    require(locus_pmq_count(pmq, nullptr, &count) == LOCUS_OK);
    locus_pmq_stats stats{};
    stats.struct_size = sizeof stats;
    require(locus_pmq_get_stats(pmq, &stats) == LOCUS_OK);
    require(locus_pmq_sweep(pmq, stats.now, nullptr) == LOCUS_OK);
    require(locus_pmq_check(pmq) == LOCUS_OK);
    locus_pmq_destroy(pmq);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *input, size_t size) {
    if (size < 1)
        return 0;
    static const std::string folder = scratch_folder();
    const auto *begin = reinterpret_cast<const std::byte *>(input);
    Buffer bytes(begin + 1, begin + size);
    const bool mended = input[0] & 1, log = input[0] & 2;
    locus_pmq_options options;
    locus_pmq_options_init(&options, sizeof options);
    options.layout = input[0] >> 2 & 1;
    options.horizon = input[0] & 8 ? 1000 : LOCUS_NO_HORIZON;
    options.max_records = input[0] & 16 ? 2 : LOCUS_NO_LIMIT;
    locus_pmq *pmq = nullptr;
    if (!log) {
        if (mended)
            mend_saved(bytes);
        const std::string path = folder + "/saved";
        write_file(path, bytes);
        locus_pmq_file_info info{};
        info.struct_size = sizeof info;
        if (locus_pmq_get_file_info(path.c_str(), &info) == LOCUS_OK)
            options.record = info.record;
        use(locus_pmq_load(path.c_str(), &options, nullptr, nullptr, &pmq), pmq);
        return 0;
    }
    if (mended)
        mend_log(bytes);
    locus_pmq_log_options log_options;
    locus_pmq_log_options_init(&log_options, sizeof log_options);
    log_options.sync = LOCUS_SYNC_NONE;
    log_options.repair = input[0] >> 5 & 1;
    const std::string store = folder + "/store";
    static const Buffer saved = empty_save(store);
    std::filesystem::remove_all(store);
    std::filesystem::create_directory(store);
    write_file(store + saved_name, saved);
    write_file(store + log_name, bytes);
    use(locus_pmq_open(store.c_str(), &options, &log_options, nullptr, nullptr, nullptr, &pmq), pmq);
    return 0;
}
