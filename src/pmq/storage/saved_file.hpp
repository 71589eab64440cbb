// A saved store: a header, then blocks of records in the order (key, arrival), each with its checksum.
#pragma once

#include "core/crew.hpp"
#include "core/file.hpp"
#include "core/mercator.hpp"
#include "core/progress.hpp"
#include "pmq/layout/layout.hpp"

#include <exception>
#include <span>
#include <string>

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
    // How many threads reading it deserves.
    uint32_t threads() const noexcept;
    // Show all records with their keys, in order, many at a time, once their blocks have proved sound. The crew reads
    // blocks; `visit` is called by this thread.
    void for_each(Crew &crew, Progress &progress, FunctionRef<void(const Batch &)> visit) const;

    // A sound block. What takes it may change it in place.
    struct Block {
        std::span<std::byte> records;
        std::span<uint64_t> keys;
        int64_t oldest;
    };
    // Takes in blocks while they are at hand: of some blocks first the numbers of their records, by this thread, then
    // the blocks, by the crew's threads, in any order; then `end`, by this thread. Without that, they count for
    // nothing: one of them was not sound.
    class Taker {
    public:
        virtual void begin(std::span<const size_t> sizes) = 0;
        virtual void take(size_t block, const Block &content) = 0; // its number among these blocks
        virtual void end() = 0;

    protected:
        ~Taker() = default;
    };
    void for_each_apart(Crew &crew, Progress &progress, Taker &taker) const;

private:
    // What reading a block came to.
    struct Result {
        int64_t oldest = INT64_MAX;
        uint64_t first = 0, last = 0; // keys
        std::exception_ptr error;
    };
    using ReadBlock = FunctionRef<Result(uint64_t block)>;
    class Rooms;
    uint64_t records_before(uint64_t block) const noexcept;
    template <typename Work>
    void in_groups(uint64_t bytes, Progress &progress, Work &&work) const;
    void check_header();
    int64_t read_group(Crew &crew, uint64_t begin, uint64_t end, uint64_t grain, uint64_t &before,
                       ReadBlock read) const;
    Result read_block(uint64_t block, std::span<std::byte> records, uint64_t *keys) const;
    int64_t find_keys(std::span<const std::byte> records, uint64_t offset, uint64_t *keys) const;
    void check_record(Bytes record, uint64_t offset) const;
    void check_order(std::span<const uint64_t> keys, uint64_t before, uint64_t offset) const;

    const KeysOf find_keys_ = keys_of(simd_best());
    InputFile file_;
    SavedHeader header_{};
    RecordFormat format_{};
};

} // namespace locus::pmq
