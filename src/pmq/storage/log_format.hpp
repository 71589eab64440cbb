// The append log: segments of entries. A change of the store is one entry, or, where what leaves is known only
// afterwards, an open one and its result.
#pragma once

#include "core/checksum.hpp"
#include "pmq/record.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace locus::pmq {

// All words are little-endian.
struct SegmentHeader {
    static constexpr char expected_magic[8] = {'L', 'O', 'C', 'U', 'S', 'L', 'O', 'G'};
    static constexpr uint32_t current_version = 1;

    char magic[8];
    uint32_t version;
    uint32_t record; // bytes
    uint64_t number;
    uint64_t first; // the sequence number of its first entry; entries before it in earlier segments only
    uint64_t sum;   // of what stands before
};
static_assert(sizeof(SegmentHeader) == 40, "the format's");

enum class EntryKind : uint16_t {
    insert = 1, // records: the batch
    sweep = 2,
    erase = 3,   // records: those that leave
    result = 4,  // records: those live ones that the open entry before made leave; its cutoff counts
    waiting = 5, // records that had left before the segment began and wait for the sink
};

// Its records follow, padded with zeros to whole words.
struct EntryHeader {
    static constexpr uint32_t expected_magic = 0x59525445; // ETRY

    uint32_t magic;
    EntryKind kind;
    uint16_t open;       // 1: a result follows
    uint64_t sequence;   // one more than that of the entry before
    int64_t now, cutoff; // the store's clock afterwards; records older than the cutoff are gone
    uint64_t records;
    uint64_t records_sum; // of the records, with the sequence number as seed
    uint64_t sum;         // of what stands before
};
static_assert(sizeof(EntryHeader) == 56, "the format's");

constexpr uint64_t padded(uint64_t bytes) noexcept { return (bytes + 7) / 8 * 8; }

} // namespace locus::pmq
