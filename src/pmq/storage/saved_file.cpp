// Writing and reading saved files.
#include "pmq/storage/saved_file.hpp"

#include "core/checksum.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

constexpr uint64_t block_bytes = 256 << 10; // about
constexpr uint64_t most_block_records = 1 << 20;
constexpr size_t sum_bytes = sizeof(uint64_t);

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

void SavedFile::read_block(uint64_t block, std::vector<std::byte> &bytes) const {
    const uint64_t offset = block_offset(header_, block);
    const size_t size = block_offset(header_, block + 1) - offset;
    if (const size_t got = file_.read_at(offset, {bytes.data(), size}); got < size)
        fail(LOCUS_E_FORMAT, file_.path(), ": ends at byte ", offset + got, ", not at ", header_.bytes);
    uint64_t sum;
    std::memcpy(&sum, bytes.data(), sum_bytes);
    if (sum != checksum({bytes.data() + sum_bytes, size - sum_bytes}, block))
        fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": the checksum of block ", block, " does not match");
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

// Check a block's records and find their keys.
void SavedFile::find_keys(const std::vector<std::byte> &bytes, uint64_t offset, Block &block) const {
    block.latitudes.resize(block.count);
    block.longitudes.resize(block.count);
    block.keys.resize(block.count);
    for (size_t i = 0; i < block.count; ++i) {
        const uint64_t at = sum_bytes + i * format_.size;
        const Bytes record = bytes.data() + at;
        check_record(record, offset + at);
        block.latitudes[i] = format_.latitude(record);
        block.longitudes[i] = format_.longitude(record);
    }
    find_keys_(block.latitudes.data(), block.longitudes.data(), block.keys.data(), block.count);
}

void SavedFile::for_each(Progress &progress, FunctionRef<void(uint64_t key, Bytes record)> visit) const {
    file_.expect_sequence();
    std::vector<std::byte> bytes(sum_bytes + std::min(header_.block_records, header_.records) * header_.record);
    Block found;
    uint64_t before = 0, done = 0;
    for (uint64_t block = 0; block < blocks(header_); ++block) {
        const uint64_t offset = block_offset(header_, block);
        read_block(block, bytes);
        found.count = std::min(header_.records - done, header_.block_records);
        find_keys(bytes, offset, found);
        for (size_t i = 0; i < found.count; ++i) {
            const uint64_t at = sum_bytes + i * format_.size;
            if (found.keys[i] < before)
                fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset + at, ": a record out of the order of keys");
            before = found.keys[i];
            visit(before, bytes.data() + at);
        }
        done += found.count;
        progress.report(static_cast<double>(done) / static_cast<double>(header_.records));
    }
}

} // namespace locus::pmq
