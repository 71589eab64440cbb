// The log of a store: every change is written to the folder's newest segment before it is acknowledged.
#pragma once

#include "core/progress.hpp"
#include "pmq/storage/folder.hpp"
#include "pmq/storage/log_format.hpp"

#include <locus/storage.h>

#include <vector>

namespace locus::pmq {

class Journal {
public:
    // Where the log is to go on.
    struct Position {
        uint64_t number; // of the segment
        uint64_t bytes;  // its length; 0: it is to be made
        uint64_t next;   // the next entry's sequence number
    };

    Journal(Folder &&folder, const RecordFormat &format, const locus_pmq_log_options &options,
            const Position &position);
    const Folder &folder() const noexcept { return folder_; }

    // One change, in the store's thread. begin() writes it; when it throws, nothing has been written. A change that is
    // not `open` is then safe, an open one after result(). undo() takes back what begin() wrote.
    void begin(EntryKind kind, bool open, const Moment &moment, std::span<const std::byte> records);
    void result(const Moment &moment, std::span<const std::byte> gone);
    void undo() noexcept;
    // What the change made leave cannot be logged: take back what begin() wrote, and stop.
    void fall_behind(const char *why) noexcept;
    void sync();
    // Flush, if anything is left to be flushed, as the last act.
    void close() noexcept;

    // A checkpoint: start a segment, while the store stands still, with the records that wait for the sink; after the
    // save, while it stands still again, let go of what is no longer needed. If the save fails, the new segment goes on
    // behind the one before.
    uint64_t rotate(const Moment &moment, std::span<const std::byte> waiting);
    void saved() noexcept;

    // Log records that had left before, for the recovery to hand over.
    void carry(const Moment &moment, std::span<const std::byte> waiting);

    locus_pmq_log_stats stats() const noexcept;

private:
    void append(EntryKind kind, bool open, const Moment &moment, std::span<const std::byte> records);
    void start_segment(const Position &position);
    void sync_by_policy();
    void flush();
    void stop(const char *why) noexcept;

    Folder folder_;
    const RecordFormat &format_;
    locus_pmq_log_options options_;
    Descriptor file_;
    std::string path_; // of the segment
    Position position_{};
    Position change_{};   // where the change at work began
    uint64_t synced_ = 0; // bytes of the segment
    int64_t synced_at_ = 0;
    bool stopped_ = false;
    std::string why_;
    bool resumes_ = false; // the log had stopped before the segment began: a save makes up for it
    uint64_t changes_before_ = 0;
    std::vector<std::byte> buffer_;
    locus_pmq_log_stats counters_{};
};

} // namespace locus::pmq
