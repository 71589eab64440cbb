// Writing the log.
#include "pmq/storage/journal.hpp"

#include <algorithm>
#include <chrono>

namespace locus::pmq {
namespace {

int64_t microseconds() noexcept {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

} // namespace

Journal::Journal(Folder &&folder, const RecordFormat &format, const locus_pmq_log_options &options,
                 const Position &position)
    : folder_(std::move(folder)), format_(format), options_(options) {
    start_segment(position);
}

// Open a segment, or make it.
void Journal::start_segment(const Position &position) {
    const std::string path = folder_.log(position.number);
    const bool fresh = position.bytes == 0;
    Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC | (fresh ? O_CREAT | O_TRUNC : 0), 0666));
    if (!file.open())
        fail_io(path, fresh ? "cannot create" : "cannot open", errno);
    uint64_t bytes = position.bytes;
    try {
        if (fresh) {
            SegmentHeader header{};
            std::memcpy(header.magic, SegmentHeader::expected_magic, sizeof header.magic);
            header.version = SegmentHeader::current_version;
            header.record = static_cast<uint32_t>(format_.size);
            header.number = position.number;
            header.first = position.next;
            header.sum = sum_of(header);
            write_at(file, path, 0, bytes_of(header));
            bytes = sizeof header;
            if (::fsync(file.number()) != 0)
                fail_io(path, "cannot flush to the disk", errno);
            flush_folder(folder_.path());
        } else if (::ftruncate(file.number(), static_cast<off_t>(bytes)) != 0) {
            fail_io(path, "cannot cut at byte " + std::to_string(bytes), errno);
        }
    } catch (...) {
        if (fresh)
            ::unlink(path.c_str());
        throw;
    }
    file_ = std::move(file);
    path_ = path;
    position_ = {position.number, bytes, position.next};
    synced_ = bytes;
    synced_at_ = microseconds();
}

void Journal::append(EntryKind kind, bool open, const Moment &moment, std::span<const std::byte> records) {
    EntryHeader header{};
    header.magic = EntryHeader::expected_magic;
    header.kind = kind;
    header.open = open;
    header.sequence = position_.next;
    header.now = moment.now;
    header.cutoff = moment.cutoff;
    header.records = records.size() / format_.size;
    header.records_sum = checksum(records, header.sequence);
    header.sum = sum_of(header);
    const auto start = bytes_of(header);
    constexpr size_t large = 1 << 20; // worth a second call rather than a copy
    const size_t copied = records.size() < large ? records.size() : 0;
    buffer_.assign(start.begin(), start.end());
    buffer_.insert(buffer_.end(), records.begin(), records.begin() + static_cast<ptrdiff_t>(copied));
    if (copied == records.size())
        buffer_.resize(start.size() + padded(copied));
    write_at(file_, path_, position_.bytes, buffer_);
    uint64_t bytes = buffer_.size();
    if (copied < records.size()) {
        write_at(file_, path_, position_.bytes + bytes, records);
        bytes += records.size();
        const std::byte zeros[8] = {};
        write_at(file_, path_, position_.bytes + bytes, std::span(zeros).first(padded(bytes) - bytes));
        bytes = padded(bytes);
    }
    position_.bytes += bytes;
    ++position_.next;
}

void Journal::begin(EntryKind kind, bool open, const Moment &moment, std::span<const std::byte> records) {
    if (stopped_)
        fail(LOCUS_E_STATE, folder_.path(), ": the log has stopped (", why_, "): a checkpoint makes it go on");
    change_ = position_;
    changes_before_ = counters_.changes;
    try {
        append(kind, open, moment, records);
        if (!open)
            sync_by_policy();
    } catch (...) {
        undo();
        throw;
    }
    ++counters_.changes;
}

// The store has changed: what cannot be logged now stops the log.
void Journal::result(const Moment &moment, std::span<const std::byte> gone) {
    try {
        append(EntryKind::result, false, moment, gone);
        sync_by_policy();
    } catch (const std::exception &error) {
        fall_behind(error.what());
        throw;
    }
}

void Journal::fall_behind(const char *why) noexcept {
    undo();
    stop(why);
}

// Also after a write that ended halfway.
void Journal::undo() noexcept {
    const bool flushed = synced_ > change_.bytes;
    position_ = change_;
    counters_.changes = changes_before_;
    synced_ = std::min(synced_, position_.bytes);
    if (::ftruncate(file_.number(), static_cast<off_t>(position_.bytes)) != 0)
        stop("what failed cannot be cut off");
    else if (flushed && ::fdatasync(file_.number()) != 0)
        stop("cannot flush to the disk");
}

void Journal::sync_by_policy() {
    if (options_.sync == LOCUS_SYNC_NONE)
        return;
    if (options_.sync == LOCUS_SYNC_INTERVAL && position_.bytes - synced_ < options_.sync_bytes &&
        microseconds() - synced_at_ < options_.sync_interval)
        return;
    flush();
}

// After a flush that failed nobody knows what is on the disk.
void Journal::flush() {
    if (synced_ == position_.bytes)
        return;
    if (::fdatasync(file_.number()) != 0) {
        const int code = errno;
        stop("cannot flush to the disk");
        fail_io(path_, "cannot flush to the disk", code);
    }
    synced_ = position_.bytes;
    synced_at_ = microseconds();
    ++counters_.syncs;
}

void Journal::sync() {
    if (stopped_)
        fail(LOCUS_E_IO, folder_.path(), ": the log has stopped: ", why_);
    flush();
}

void Journal::close() noexcept {
    if (!stopped_ && options_.sync != LOCUS_SYNC_NONE && synced_ < position_.bytes)
        ::fdatasync(file_.number());
}

void Journal::stop(const char *why) noexcept {
    if (!stopped_) {
        try {
            why_ = why;
        } catch (const std::bad_alloc &) {
            why_.clear();
        }
    }
    stopped_ = true;
}

void Journal::carry(const Moment &moment, std::span<const std::byte> waiting) {
    if (waiting.empty())
        return;
    append(EntryKind::waiting, false, moment, waiting);
    flush();
}

uint64_t Journal::rotate(const Moment &moment, std::span<const std::byte> waiting) {
    if (!stopped_)
        flush();
    const Position before = position_;
    std::string path = path_;
    Descriptor file = std::move(file_);
    const auto go_back = [&] {
        file_ = std::move(file);
        path_ = std::move(path);
        position_ = before;
        synced_ = before.bytes;
    };
    try {
        start_segment({before.number + 1, 0, before.next});
        carry(moment, waiting);
    } catch (...) {
        ::unlink(folder_.log(before.number + 1).c_str());
        go_back();
        throw;
    }
    resumes_ = stopped_;
    return position_.number;
}

void Journal::saved() noexcept {
    if (resumes_) {
        stopped_ = resumes_ = false;
        why_.clear();
    }
    try {
        const std::vector<uint64_t> saved = folder_.content().saved;
        const size_t kept = size_t{options_.keep} + 1;
        folder_.tidy(saved.size() > kept ? saved[saved.size() - kept] : 0);
    } catch (const std::exception &) { // the next checkpoint tries again
    }
}

locus_pmq_log_stats Journal::stats() const noexcept {
    locus_pmq_log_stats stats = counters_;
    stats.struct_size = sizeof stats;
    stats.number = position_.number;
    stats.bytes = position_.bytes;
    stats.unsynced = position_.bytes - synced_;
    stats.attached = 1;
    stats.stopped = stopped_;
    return stats;
}

} // namespace locus::pmq
