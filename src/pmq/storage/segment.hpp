// Reading one segment of the log.
#pragma once

#include "core/file.hpp"
#include "pmq/storage/log_format.hpp"

#include <vector>

namespace locus::pmq {

class Segment {
public:
    Segment(const std::string &path, uint64_t number, const RecordFormat &format);

    const std::string &path() const noexcept { return file_.path(); }
    uint64_t size() const noexcept { return file_.size(); }
    // Its header is whole, or so little of it is there that the end interrupted its making.
    bool begun() const noexcept { return begun_; }
    uint64_t first() const noexcept { return header_.first; }

    struct Entry {
        EntryHeader header;
        uint64_t offset = 0, end = 0;
        std::vector<std::byte> records;
    };
    // Read the entry at `offset`; false if there is no sound one with that sequence number.
    bool read(uint64_t offset, uint64_t sequence, Entry &entry) const;
    // A sound entry's header begins somewhere behind `offset`, of a number from `sequence` on.
    bool more_behind(uint64_t offset, uint64_t sequence) const;
    // The records and the clock of a sound entry are what a store may have logged; throws LOCUS_E_FORMAT.
    void check(const Entry &entry, int64_t before) const;

private:
    [[noreturn]] void fail_at(uint64_t offset, const std::string &text) const;

    InputFile file_;
    const RecordFormat &format_;
    SegmentHeader header_{};
    bool begun_ = false;
};

} // namespace locus::pmq
