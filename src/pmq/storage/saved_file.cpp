// Writing and reading saved files.
#include "pmq/storage/saved_file.hpp"

#include "core/checksum.hpp"
#include "core/team.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace locus::pmq {
namespace {

constexpr uint64_t block_bytes = 256 << 10; // about
constexpr uint64_t most_block_records = 1 << 20;
constexpr size_t sum_bytes = sizeof(uint64_t);
constexpr uint64_t group_bytes = 24 * block_bytes; // that are read together
constexpr uint64_t apart_bytes = 96 * block_bytes; // that are taken in together, block by block
constexpr uint64_t apart_grain = 5;                // blocks a thread takes one after the other
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

// A block's records, once they have proved sound, and their keys.
SavedFile::Result SavedFile::read_block(uint64_t block, std::span<std::byte> records, uint64_t *keys) const {
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
    const int64_t oldest = find_keys(records, offset + sum_bytes, keys);
    return {oldest, keys[0], keys[records.size() / format_.size - 1], nullptr};
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

// Read the blocks begin..end - 1, `before` being the last key so far; the smallest of their times. Of several damaged
// blocks the first one is reported.
int64_t SavedFile::read_group(Crew &crew, uint64_t begin, uint64_t end, uint64_t grain, uint64_t &before,
                              ReadBlock read) const {
    std::vector<Result> results(end - begin);
    crew.for_each(results.size(), grain, [&](uint64_t first, uint64_t last) {
        for (uint64_t i = first; i < last; ++i) {
            try {
                results[i] = read(begin + i);
            } catch (...) {
                results[i].error = std::current_exception();
            }
        }
    });
    int64_t oldest = INT64_MAX;
    for (const Result &result : results) {
        if (result.error)
            std::rethrow_exception(result.error);
        check_order({&result.first, 1}, before, block_offset(header_, begin++) + sum_bytes);
        before = result.last;
        oldest = std::min(oldest, result.oldest);
    }
    return oldest;
}

uint32_t SavedFile::threads() const noexcept {
    return static_cast<uint32_t>(std::min<uint64_t>(std::min(default_threads(), most_threads), blocks(header_)));
}

uint64_t SavedFile::records_before(uint64_t block) const noexcept {
    return std::min(block * header_.block_records, header_.records);
}

// So many neighbouring blocks after the other: work(begin, end), which calls its argument `report` with its share done.
template <typename Work>
void SavedFile::in_groups(uint64_t bytes, Progress &progress, Work &&work) const {
    file_.expect_sequence();
    const uint64_t together = std::max<uint64_t>(bytes / (header_.block_records * format_.size), 1);
    for (uint64_t begin = 0, all = blocks(header_); begin < all; begin += together) {
        const uint64_t end = std::min(begin + together, all);
        const auto report = [&](double share) {
            const auto done = static_cast<double>(begin) + share * static_cast<double>(end - begin);
            progress.report(done / static_cast<double>(all));
        };
        report(0);
        work(begin, end, report);
        report(1);
    }
}

void SavedFile::for_each(Crew &crew, Progress &progress, FunctionRef<void(const Batch &)> visit) const {
    const size_t size = format_.size;
    std::vector<std::byte> records;
    std::vector<uint64_t> keys;
    uint64_t last = 0;
    in_groups(group_bytes, progress, [&](uint64_t begin, uint64_t end, auto &&report) {
        const uint64_t before = records_before(begin), count = records_before(end) - before;
        records.resize(count * size);
        keys.resize(count);
        const int64_t oldest = read_group(crew, begin, end, 1, last, [&](uint64_t block) {
            const uint64_t at = records_before(block) - before, part = records_before(block + 1) - before - at;
            return read_block(block, std::span(records).subspan(at * size, part * size), &keys[at]);
        });
        file_.expect(block_offset(header_, end), group_bytes);
        report(0.5);
        visit({records.data(), keys.data(), count, oldest});
    });
}

// Memory for a block for each thread that reads one: what it has read stays in the thread's cache until it is taken.
class SavedFile::Rooms {
public:
    struct Room {
        std::vector<std::byte> records;
        std::vector<uint64_t> keys;
    };
    Rooms(size_t rooms, uint64_t records, size_t size) : rooms_(rooms) {
        for (Room &room : rooms_) {
            room.records.resize(records * size);
            room.keys.resize(records);
            free_.push_back(&room);
        }
    }
    class Use {
    public:
        explicit Use(Rooms &rooms) : room(rooms.take()), rooms_(rooms) {}
        ~Use() { rooms_.give_back(room); }
        Use(const Use &) = delete;
        Use &operator=(const Use &) = delete;
        Room &room;

    private:
        Rooms &rooms_;
    };

private:
    Room &take() noexcept {
        const std::lock_guard lock(mutex_);
        Room &room = *free_.back();
        free_.pop_back();
        return room;
    }
    void give_back(Room &room) noexcept {
        const std::lock_guard lock(mutex_);
        free_.push_back(&room);
    }

    std::vector<Room> rooms_;
    std::vector<Room *> free_;
    std::mutex mutex_;
};

void SavedFile::for_each_apart(Crew &crew, Progress &progress, Taker &taker) const {
    Rooms rooms(threads(), std::min(header_.block_records, header_.records), format_.size);
    std::vector<size_t> sizes;
    uint64_t last = 0;
    in_groups(apart_bytes, progress, [&](uint64_t begin, uint64_t end, auto &&report) {
        sizes.clear();
        for (uint64_t block = begin; block < end; ++block)
            sizes.push_back(records_before(block + 1) - records_before(block));
        taker.begin(sizes);
        read_group(crew, begin, end, apart_grain, last, [&](uint64_t block) {
            const Rooms::Use use(rooms);
            const size_t count = sizes[block - begin];
            const std::span records = std::span(use.room.records).first(count * format_.size);
            const Result result = read_block(block, records, use.room.keys.data());
            taker.take(block - begin, {records, std::span(use.room.keys).first(count), result.oldest});
            return result;
        });
        report(0.9); // they have yet to be put in place
        taker.end();
    });
}

} // namespace locus::pmq
