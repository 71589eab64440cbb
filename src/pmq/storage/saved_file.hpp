// A saved store: a header, then blocks of records in the order (key, arrival), each with its checksum.
#pragma once

#include "core/file.hpp"
#include "core/mercator.hpp"
#include "core/progress.hpp"
#include "pmq/layout/layout.hpp"

#include <vector>

namespace locus::pmq {

// All words are little-endian. Block i is the checksum of its records with the seed i, then the records: block_records
// of them, in the last block what is left.
struct SavedHeader {
    static constexpr char expected_magic[8] = {'L', 'O', 'C', 'U', 'S', 'P', 'M', 'Q'};
    static constexpr uint32_t current_version = 1;

    char magic[8];
    uint32_t version;
    uint32_t record; // bytes
    uint64_t records;
    uint64_t block_records;
    int64_t now, cutoff; // the moment; records older than the cutoff are saved for the sink only
    uint64_t bytes;      // of the file
    uint64_t sum;        // of what stands before
};
static_assert(sizeof(SavedHeader) == 64, "the format's");

// Write every stored record of a view to `path`, atomically.
void save(const View &view, const std::string &path, Progress &progress);

// A saved file whose header is sound.
class SavedFile {
public:
    explicit SavedFile(const std::string &path); // throws LOCUS_E_IO, LOCUS_E_FORMAT

    const SavedHeader &header() const noexcept { return header_; }
    const RecordFormat &format() const noexcept { return format_; }
    // Show every record with its key, in order, once its block has proved sound.
    void for_each(Progress &progress, FunctionRef<void(uint64_t key, Bytes record)> visit) const;

private:
    // The places of a block's records.
    struct Block {
        size_t count = 0;
        std::vector<double> latitudes, longitudes;
        std::vector<uint64_t> keys;
    };
    void check_header();
    void read_block(uint64_t block, std::vector<std::byte> &bytes) const;
    void check_record(Bytes record, uint64_t offset) const;
    void find_keys(const std::vector<std::byte> &bytes, uint64_t offset, Block &block) const;

    const KeysOf find_keys_ = keys_of(simd_best());
    InputFile file_;
    SavedHeader header_{};
    RecordFormat format_{};
};

} // namespace locus::pmq
