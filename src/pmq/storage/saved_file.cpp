// Writing and reading saved files.
#include "pmq/storage/saved_file.hpp"

#include "core/checksum.hpp"
#include "core/team.hpp"

#include <algorithm>
#include <exception>

namespace locus::pmq {
namespace {

constexpr uint64_t block_bytes = 256 << 10; // about
constexpr uint64_t most_block_records = 1 << 20;
constexpr size_t sum_bytes = sizeof(uint64_t);
constexpr uint64_t group_bytes = 24 * block_bytes; // that are read together
constexpr uint32_t most_threads = 4;               // that read

// Where a block begins; behind the last one, where the file ends.
uint64_t block_offset(const SavedHeader &header, uint64_t block) noexcept {
    const uint64_t before = std::min(block * header.block_records, header.records);
    return sizeof header + block * sum_bytes + before * header.record;
}

uint64_t blocks(const SavedHeader &header) noexcept {
    return header.records / header.block_records + (header.records % header.block_records != 0);
}

// Gathers records to blocks.
class BlockWriter {
public:
    BlockWriter(AtomicFile &file, const RecordFormat &format, uint64_t block_records)
        : file_(file), size_(format.size), block_(sum_bytes + block_records * format.size) {}

    void add(Bytes record) {
        copy_record(block_.data() + used_, record, size_);
        used_ += size_;
        ++records_;
        if (used_ == block_.size())
            end_block();
    }
    void end_block() {
        if (used_ == sum_bytes)
            return;
        const std::span<const std::byte> records(block_.data() + sum_bytes, used_ - sum_bytes);
        const uint64_t sum = checksum(records, blocks_++);
        std::memcpy(block_.data(), &sum, sum_bytes);
        file_.write({block_.data(), used_});
        used_ = sum_bytes;
    }
    uint64_t records() const noexcept { return records_; }

private:
    AtomicFile &file_;
    size_t size_;
    std::vector<std::byte> block_;
    size_t used_ = sum_bytes;
    uint64_t blocks_ = 0, records_ = 0;
};

} // namespace

void save(const View &view, const std::string &path, Progress &progress) {
    const RecordFormat &format = view.format();
    SavedHeader header{};
    std::memcpy(header.magic, SavedHeader::expected_magic, sizeof header.magic);
    header.version = SavedHeader::current_version;
    header.record = static_cast<uint32_t>(format.size);
    header.block_records = block_bytes / format.size;
    header.now = view.moment().now;
    header.cutoff = view.moment().cutoff;

    AtomicFile file(path);
    file.write(bytes_of(header)); // its place; filled in at the end
    BlockWriter writer(file, format, header.block_records);
    const auto total = static_cast<double>(view.stored() + 1);
    view.scan_stored([&](const Block &block) {
        for (size_t i = 0; i < block.count; ++i)
            writer.add(block.record(block.entry(i)));
        progress.report(static_cast<double>(writer.records()) / total);
        return true;
    });
    writer.end_block();
    header.records = writer.records();
    header.bytes = file.size();
    header.sum = sum_of(header);
    file.overwrite(0, bytes_of(header));
    progress.report(1); // the last chance to cancel
    file.commit();
}

SavedFile::SavedFile(const std::string &path) : file_(path) {
    const size_t got = file_.read_at(0, {reinterpret_cast<std::byte *>(&header_), sizeof header_});
    if (got < sizeof header_)
        fail(LOCUS_E_FORMAT, path, ": ends at byte ", got, ", amid the header of ", sizeof header_, " bytes");
    check_header();
    format_ = header_.record == LOCUS_RECORD_POINT32 ? point32 : text156;
}

void SavedFile::check_header() {
    const std::string &path = file_.path();
    const auto expect = [&](bool good, size_t offset, const auto &...parts) {
        if (!good)
            fail(LOCUS_E_FORMAT, path, ": byte ", offset, ": ", parts...);
    };
    expect(std::memcmp(header_.magic, SavedHeader::expected_magic, sizeof header_.magic) == 0, 0,
           "not a saved store: it does not begin with LOCUSPMQ");
    expect(header_.version == SavedHeader::current_version, offsetof(SavedHeader, version), "version ", header_.version,
           " of the format; this library reads version ", SavedHeader::current_version);
    expect(header_.sum == sum_of(header_), offsetof(SavedHeader, sum), "the header's checksum does not match");
    expect(header_.record == LOCUS_RECORD_POINT32 || header_.record == LOCUS_RECORD_TEXT156,
           offsetof(SavedHeader, record), "records of ", header_.record, " bytes");
    expect(header_.block_records >= 1 && header_.block_records <= most_block_records,
           offsetof(SavedHeader, block_records), "blocks of ", header_.block_records, " records");
    expect(header_.records <= file_.size() / header_.record, offsetof(SavedHeader, records), header_.records,
           " records in a file of ", file_.size(), " bytes");
    expect(header_.bytes == block_offset(header_, blocks(header_)), offsetof(SavedHeader, bytes), "a file of ",
           header_.bytes, " bytes for ", header_.records, " records");
    expect(header_.cutoff <= header_.now, offsetof(SavedHeader, cutoff), "the cutoff ", header_.cutoff,
           " lies after the clock, ", header_.now);
    if (file_.size() != header_.bytes)
        fail(LOCUS_E_FORMAT, path, ": ends at byte ", file_.size(), ", not at ", header_.bytes);
}

// A block's records, once they have proved sound, and their keys; the smallest of their times.
int64_t SavedFile::read_block(uint64_t block, std::span<std::byte> records, uint64_t *keys) const {
    const uint64_t offset = block_offset(header_, block);
    uint64_t sum;
    const std::span<std::byte> sum_word(reinterpret_cast<std::byte *>(&sum), sum_bytes);
    size_t got = file_.read_at(offset, sum_word);
    if (got == sum_bytes)
        got += file_.read_at(offset + sum_bytes, records);
    if (got < sum_bytes + records.size())
        fail(LOCUS_E_FORMAT, file_.path(), ": ends at byte ", offset + got, ", not at ", header_.bytes);
    if (sum != checksum(records, block))
        fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": the checksum of block ", block, " does not match");
    return find_keys(records, offset + sum_bytes, keys);
}

void SavedFile::check_record(Bytes record, uint64_t offset) const {
    const double latitude = format_.latitude(record), longitude = format_.longitude(record);
    if (!(latitude >= -90 && latitude <= 90))
        fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": latitude is ", latitude, ", not within -90..90");
    if (!(longitude >= -180 && longitude <= 180))
        fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": longitude is ", longitude, ", not within -180..180");
    if (format_.time(record) > header_.now)
        fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": time is ", format_.time(record), ", after the clock, ",
             header_.now);
}

int64_t SavedFile::find_keys(std::span<const std::byte> records, uint64_t offset, uint64_t *keys) const {
    constexpr size_t chunk = 128;
    double latitudes[chunk], longitudes[chunk];
    const size_t count = records.size() / format_.size;
    int64_t oldest = INT64_MAX;
    for (size_t begin = 0; begin < count; begin += chunk) {
        const size_t size = std::min(chunk, count - begin);
        for (size_t i = 0; i < size; ++i) {
            const uint64_t at = (begin + i) * format_.size;
            const Bytes record = records.data() + at;
            check_record(record, offset + at);
            latitudes[i] = format_.latitude(record);
            longitudes[i] = format_.longitude(record);
            oldest = std::min(oldest, format_.time(record));
        }
        find_keys_(latitudes, longitudes, keys + begin, size);
    }
    check_order({keys, count}, 0, offset);
    return oldest;
}

// `before` is the key of the record before the first one, which lies at `offset`.
void SavedFile::check_order(std::span<const uint64_t> keys, uint64_t before, uint64_t offset) const {
    for (size_t i = 0; i < keys.size(); ++i) {
        if (keys[i] < before)
            fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset + i * format_.size,
                 ": a record out of the order of keys");
        before = keys[i];
    }
}

// The last key. Of several damaged blocks the first one is reported.
uint64_t SavedFile::read_group(Crew &crew, const Group &group, uint64_t before, int64_t &oldest) const {
    struct Result {
        int64_t oldest;
        std::exception_ptr error;
    };
    const auto part = [&](auto records, size_t block, size_t size) {
        return records.subspan(block * size, std::min(size, records.size() - block * size));
    };
    const size_t per_block = header_.block_records, block_size = per_block * format_.size;
    std::vector<Result> results((group.keys.size() + per_block - 1) / per_block);
    crew.for_each(results.size(), 1, [&](uint64_t i, uint64_t) {
        try {
            results[i].oldest =
                read_block(group.first + i, part(group.records, i, block_size), &group.keys[i * per_block]);
        } catch (...) {
            results[i].error = std::current_exception();
        }
    });
    oldest = INT64_MAX;
    for (size_t i = 0; i < results.size(); ++i) {
        if (results[i].error)
            std::rethrow_exception(results[i].error);
        oldest = std::min(oldest, results[i].oldest);
        const auto keys = part(group.keys, i, per_block);
        check_order(keys.first(1), before, block_offset(header_, group.first + i) + sum_bytes);
        before = keys.back();
    }
    return before;
}

uint32_t SavedFile::threads() const noexcept {
    return static_cast<uint32_t>(std::min<uint64_t>(std::min(default_threads(), most_threads), blocks(header_)));
}

void SavedFile::for_each(Crew &crew, Progress &progress, FunctionRef<void(const Batch &)> visit) const {
    file_.expect_sequence();
    const uint64_t together = std::max<uint64_t>(group_bytes / (header_.block_records * format_.size), 1);
    const uint64_t most = std::min(together * header_.block_records, header_.records);
    std::vector<std::byte> records(most * format_.size);
    std::vector<uint64_t> keys(most);
    uint64_t before = 0;
    for (uint64_t block = 0; block < blocks(header_); block += together) {
        const uint64_t begin = block * header_.block_records, count = std::min(most, header_.records - begin);
        const auto report = [&](double part) {
            progress.report((static_cast<double>(begin) + part * static_cast<double>(count)) /
                            static_cast<double>(header_.records));
        };
        report(0);
        int64_t oldest;
        before =
            read_group(crew, {block, {records.data(), count * format_.size}, {keys.data(), count}}, before, oldest);
        file_.expect(block_offset(header_, block + together), group_bytes);
        report(0.5);
        visit({records.data(), keys.data(), count, oldest});
        report(1);
    }
}

} // namespace locus::pmq
