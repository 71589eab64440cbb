// Reading and validating the log.
#include "pmq/storage/segment.hpp"

#include <algorithm>

namespace locus::pmq {
namespace {

bool sound(const EntryHeader &header) noexcept {
    return header.magic == EntryHeader::expected_magic && header.sum == sum_of(header);
}

} // namespace

Segment::Segment(const std::string &path, uint64_t number, const RecordFormat &format) : file_(path), format_(format) {
    file_.expect_sequence();
    const size_t got = file_.read_at(0, {reinterpret_cast<std::byte *>(&header_), sizeof header_});
    begun_ = got == sizeof header_ && header_.sum == sum_of(header_) &&
             std::memcmp(header_.magic, SegmentHeader::expected_magic, sizeof header_.magic) == 0;
    if (!begun_ && file_.size() <= sizeof header_)
        return;
    if (!begun_)
        fail_at(0, "not the header of a log, or its checksum does not match");
    if (header_.version != SegmentHeader::current_version)
        fail_at(offsetof(SegmentHeader, version), "version " + std::to_string(header_.version) +
                                                      " of the format; this library reads version " +
                                                      std::to_string(SegmentHeader::current_version));
    if (header_.record != format_.size)
        fail_at(offsetof(SegmentHeader, record),
                "records of " + std::to_string(header_.record) + " bytes, not of " + std::to_string(format_.size));
    if (header_.number != number)
        fail_at(offsetof(SegmentHeader, number), "this is log " + std::to_string(header_.number));
}

void Segment::fail_at(uint64_t offset, const std::string &text) const {
    fail(LOCUS_E_FORMAT, file_.path(), ": byte ", offset, ": ", text);
}

bool Segment::read(uint64_t offset, uint64_t sequence, Entry &entry) const {
    EntryHeader &header = entry.header;
    const size_t got = file_.read_at(offset, {reinterpret_cast<std::byte *>(&header), sizeof header});
    if (got < sizeof header || !sound(header) || header.sequence != sequence)
        return false;
    const uint64_t left = file_.size() - offset - sizeof header;
    if (header.records > left / format_.size || padded(header.records * format_.size) > left)
        return false;
    const uint64_t bytes = header.records * format_.size;
    entry.records.resize(bytes);
    entry.offset = offset;
    entry.end = offset + sizeof header + padded(bytes);
    return file_.read_at(offset + sizeof header, entry.records) == bytes &&
           checksum(entry.records, sequence) == header.records_sum;
}

bool Segment::more_behind(uint64_t offset, uint64_t sequence) const {
    constexpr size_t step = 1 << 20;
    std::vector<std::byte> bytes(step + sizeof(EntryHeader));
    for (uint64_t at = offset + 8; at + sizeof(EntryHeader) <= file_.size(); at += step) {
        const size_t got = file_.read_at(at, bytes);
        for (size_t i = 0; i < step && i + sizeof(EntryHeader) <= got; i += 8) {
            EntryHeader header;
            std::memcpy(&header, bytes.data() + i, sizeof header);
            if (sound(header) && header.sequence >= sequence)
                return true;
        }
    }
    return false;
}

void Segment::check(const Entry &entry, int64_t before) const {
    const EntryHeader &header = entry.header;
    if (header.kind < EntryKind::insert || header.kind > EntryKind::waiting || header.open > 1 ||
        (header.open == 1 && header.kind > EntryKind::sweep))
        fail_at(entry.offset, "an entry of an unknown kind");
    if (header.now < before || header.cutoff > header.now)
        fail_at(entry.offset, "the clock runs back, or the cutoff lies after it");
    for (uint64_t at = 0; at < entry.records.size(); at += format_.size) {
        const Bytes record = entry.records.data() + at;
        const double latitude = format_.latitude(record), longitude = format_.longitude(record);
        if (!(latitude >= -90 && latitude <= 90 && longitude >= -180 && longitude <= 180) ||
            format_.time(record) > header.now)
            fail_at(entry.offset + sizeof header + at, "a record of no place, or of a time after the clock");
    }
}

} // namespace locus::pmq
