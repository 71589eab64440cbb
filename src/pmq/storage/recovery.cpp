// Loading, and recovery: the newest sound saved file, then the log. The log is read twice: what has left since is known
// only at its end, and is then not put in in the first place.
#include "pmq/storage/recovery.hpp"

#include "core/error.hpp"
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/restoring.hpp"
#include "pmq/storage/losses.hpp"
#include "pmq/storage/saved_file.hpp"
#include "pmq/storage/segment.hpp"

#include <algorithm>
#include <cstring>
#include <exception>

namespace locus::pmq {
namespace {

std::unique_ptr<Store> new_store(const locus_pmq_options *options, const SavedFile &file, const std::string &path) {
    locus_pmq_options whole = options ? *options : default_options();
    if (!options)
        whole.record = file.header().record;
    require(whole.record == file.header().record, "options.record is ", whole.record, ", the records of ", path,
            " have ", file.header().record, " bytes");
    return std::make_unique<Store>(whole);
}

// Let those records of a saved batch depart that `departs` takes, and keep the others.
template <typename Departs>
void restore(const Batch &saved, const RecordFormat &format, Restoring &restoring, Departs &&departs) {
    Batch staying{saved.records, saved.keys, 0, INT64_MAX};
    for (size_t i = 0; i < saved.count; ++i) {
        const Bytes record = saved.records + i * format.size;
        if (!departs(record)) {
            ++staying.count;
            staying.oldest = std::min(staying.oldest, format.time(record));
            continue;
        }
        if (staying.count > 0)
            restoring.add(staying);
        staying = {record + format.size, saved.keys + i + 1, 0, INT64_MAX};
    }
    if (staying.count > 0)
        restoring.add(staying);
}

// Puts a saved file's records into a store block by block, and lets those depart that are older than a cutoff.
class BlockTaker final : public SavedFile::Taker {
public:
    BlockTaker(Restoring &restoring, const RecordFormat &format, int64_t cutoff)
        : restoring_(restoring), format_(format), cutoff_(cutoff) {}

    void begin(std::span<const size_t> sizes) override {
        parts_ = restoring_.begin_parts(sizes);
        expired_.assign(sizes.size(), {});
    }
    void take(size_t block, const SavedFile::Block &content) override {
        Batch staying{content.records.data(), content.keys.data(), content.keys.size(), content.oldest};
        if (content.oldest < cutoff_)
            staying = without_expired(content, expired_[block]);
        parts_->fill(block, staying);
    }
    void end() override {
        for (const std::vector<std::byte> &records : expired_)
            for (size_t at = 0; at < records.size(); at += format_.size)
                restoring_.depart(&records[at]);
        restoring_.end_parts(*parts_);
    }

private:
    Batch without_expired(const SavedFile::Block &content, std::vector<std::byte> &expired) const {
        Batch staying{content.records.data(), content.keys.data(), 0, INT64_MAX};
        for (size_t i = 0; i < content.keys.size(); ++i) {
            std::byte *const record = &content.records[i * format_.size];
            if (format_.time(record) < cutoff_) {
                expired.insert(expired.end(), record, record + format_.size);
                continue;
            }
            std::memmove(&content.records[staying.count * format_.size], record, format_.size);
            content.keys[staying.count++] = content.keys[i];
            staying.oldest = std::min(staying.oldest, format_.time(record));
        }
        return staying;
    }

    Restoring &restoring_;
    const RecordFormat &format_;
    const int64_t cutoff_;
    std::unique_ptr<Layout::Parts> parts_;
    std::vector<std::vector<std::byte>> expired_; // of each block
};

// The segments from one on, and what they tell of the states behind the saved one.
class Log {
public:
    Log(const Folder &folder, uint64_t saved, const std::vector<uint64_t> &numbers, const RecordFormat &format,
        const locus_pmq_log_options &options)
        : saved_(saved), options_(options) {
        for (const uint64_t number : numbers) {
            if (number < saved)
                continue;
            if (number != saved + segments_.size())
                fail(LOCUS_E_FORMAT, folder.log(saved + segments_.size()), ": missing, ", folder.log(number),
                     " is there");
            segments_.emplace_back(folder.log(number), number, format);
        }
    }

    // A change, or the records that waited for the sink when a segment began.
    struct Step {
        size_t segment;
        uint64_t offset, sequence, state;
        EntryKind kind;
    };

    // Find the sound end, the steps, and the losses, which begin with the state of the saved file.
    void scan(int64_t now, Losses &losses, Progress &progress) {
        now_ = now;
        for (size_t i = 0; i < segments_.size() && !damaged_; ++i) {
            scan_segment(i, losses);
            progress.report(static_cast<double>(i + 1) / static_cast<double>(segments_.size()));
        }
    }

    int64_t now() const noexcept { return now_; }
    const std::vector<Step> &steps() const noexcept { return steps_; }
    uint64_t cut() const noexcept { return cut_; }
    bool damaged() const noexcept { return damaged_; } // and cut there, as the options allow
    uint64_t last() const noexcept { return saved_ + (segments_.empty() ? 0 : segments_.size() - 1); }
    Journal::Position end() const noexcept { return {last(), end_, next_}; }

    void read(const Step &step, Segment::Entry &entry) const {
        const Segment &segment = segments_[step.segment];
        if (!segment.read(step.offset, step.sequence, entry))
            fail(LOCUS_E_FORMAT, segment.path(), ": byte ", step.offset, ": the entry has changed");
    }

private:
    void scan_segment(size_t at, Losses &losses) {
        const Segment &segment = segments_[at];
        end_ = 0;
        if (!segment.begun()) {
            if (at + 1 < segments_.size())
                fail(LOCUS_E_FORMAT, segment.path(), ": ends at byte ", segment.size(), ", amid the header");
            cut_ += segment.size();
            return;
        }
        if (at == 0)
            next_ = segment.first();
        if (segment.first() != next_)
            fail(LOCUS_E_FORMAT, segment.path(), ": byte ", offsetof(SegmentHeader, first), ": begins with entry ",
                 segment.first(), ", not ", next_);
        end_ = sizeof(SegmentHeader);
        const bool last = at + 1 == segments_.size() || !segments_[at + 1].begun();
        const uint64_t behind = last ? UINT64_MAX : segments_[at + 1].first(); // what lies there was taken back
        Segment::Entry entry;
        for (uint64_t offset = end_, sequence = next_; sequence < behind && offset < segment.size();) {
            if (!segment.read(offset, sequence, entry))
                break;
            segment.check(entry, now_);
            take(at, entry, losses);
            offset = entry.end;
            ++sequence;
            if (!open_) {
                end_ = offset;
                next_ = sequence;
            }
        }
        open_ = false;
        if (!last && next_ < behind)
            fail_or_cut(at, "a damaged entry; another log follows");
        else if (last && end_ < segment.size() && segment.more_behind(end_, next_ + 1))
            fail_or_cut(at, "a damaged entry; sound ones follow");
        else if (last)
            cut_ += segment.size() - end_; // torn
    }

    // What the entry says counts once its change is complete.
    void take(size_t at, const Segment::Entry &entry, Losses &losses) {
        const EntryHeader &header = entry.header;
        const bool result = header.kind == EntryKind::result;
        if (result != open_)
            fail(LOCUS_E_FORMAT, segments_[at].path(), ": byte ", entry.offset,
                 result ? ": a result of no change" : ": a change where a result is due");
        if (header.open == 1) {
            opened_ = {at, entry.offset, header.sequence, 0, header.kind};
            open_ = true;
            return;
        }
        Step step = result ? opened_ : Step{at, entry.offset, header.sequence, 0, header.kind};
        open_ = false;
        now_ = header.now;
        if (header.kind != EntryKind::waiting)
            losses.add_state(header.cutoff);
        if (result || header.kind == EntryKind::erase)
            losses.add(entry.records);
        step.state = losses.state();
        steps_.push_back(step);
    }

    void fail_or_cut(size_t at, const char *what) {
        if (options_.repair == 0)
            fail(LOCUS_E_FORMAT, segments_[at].path(), ": byte ", end_, ": ", what);
        damaged_ = true;
        cut_ += segments_[at].size() - end_;
        for (size_t i = at + 1; i < segments_.size(); ++i)
            cut_ += segments_[i].size();
    }

    uint64_t saved_;
    const locus_pmq_log_options &options_;
    std::vector<Segment> segments_;
    std::vector<Step> steps_;
    int64_t now_ = INT64_MIN;
    uint64_t next_ = 1, end_ = 0, cut_ = 0;
    bool damaged_ = false, open_ = false;
    Step opened_{};
};

// A saved file with its log becomes a store.
class Recovery {
public:
    Recovery(const Folder &folder, const locus_pmq_log_options &options, locus_pmq_recovery &report)
        : folder_(folder), options_(options), report_(report) {}

    std::unique_ptr<Store> recover(uint64_t number, const std::vector<uint64_t> &logs, const locus_pmq_options *options,
                                   Progress &progress) {
        const std::string path = folder_.saved(number);
        const SavedFile file(path);
        std::unique_ptr<Store> store = new_store(options, file, path);
        log_ = std::make_unique<Log>(folder_, number, logs, file.format(), options_);
        Losses losses(file.format());
        losses.add_state(file.header().cutoff);
        progress.part(0, 0.2);
        log_->scan(file.header().now, losses, progress);
        Crew crew(file.threads());
        Restoring restoring(*store, log_->now(), crew);
        losses.add_state(restoring.moment().cutoff);
        losses.finish();

        progress.part(0.2, 0.7);
        const size_t record = file.format().size;
        file.for_each(crew, progress, [&](const Batch &batch) {
            restore(batch, file.format(), restoring, [&](Bytes at) {
                if (!losses.take(at, 0))
                    return false;
                depart(restoring, at, options_.redeliver || file.format().time(at) < file.header().cutoff);
                return true;
            });
        });
        progress.part(0.7, 1);
        replay(losses, restoring, record, progress);
        restoring.finish();
        report_.number = number;
        report_.saved = file.header().records;
        report_.cut = log_->cut();
        report_.now = log_->now();
        return store;
    }
    const Log &log() const noexcept { return *log_; }

private:
    void replay(Losses &losses, Restoring &restoring, size_t record, Progress &progress) {
        Segment::Entry entry;
        std::vector<std::byte> staying;
        size_t done = 0;
        for (const Log::Step &step : log_->steps()) {
            progress.report(static_cast<double>(done++) / static_cast<double>(log_->steps().size()));
            report_.changes += step.kind != EntryKind::waiting;
            if (step.kind != EntryKind::insert && step.kind != EntryKind::waiting)
                continue;
            log_->read(step, entry);
            staying.clear();
            for (size_t at = 0; at < entry.records.size(); at += record) {
                const Bytes bytes = entry.records.data() + at;
                if (step.kind == EntryKind::waiting)
                    depart(restoring, bytes, true);
                else if (losses.take(bytes, step.state))
                    depart(restoring, bytes, options_.redeliver);
                else
                    staying.insert(staying.end(), bytes, bytes + record);
            }
            if (step.kind == EntryKind::insert)
                report_.inserted += entry.records.size() / record;
            restoring.insert(staying);
        }
    }

    void depart(Restoring &restoring, Bytes record, bool deliver) {
        ++report_.departed;
        if (deliver)
            restoring.depart(record);
    }

    const Folder &folder_;
    const locus_pmq_log_options &options_;
    locus_pmq_recovery &report_;
    std::unique_ptr<Log> log_;
};

// Let a recovered store log on. Behind a log that was cut amid its changes it begins anew.
void resume(Store &store, Folder &&folder, const Log &log, const locus_pmq_log_options &options) {
    Journal::Position end = log.end();
    if (!log.damaged()) {
        store.attach(std::make_unique<Journal>(std::move(folder), store.view()->format(), options, end));
        return;
    }
    Progress silent;
    store.start_log(std::move(folder), options, {end.number + 1, 0, end.next}, silent);
}

locus_pmq_recovery empty_report() noexcept {
    locus_pmq_recovery report{};
    report.struct_size = sizeof report;
    return report;
}

} // namespace

std::unique_ptr<Store> load(const std::string &path, const locus_pmq_options *options, Progress &progress) {
    const SavedFile file(path);
    std::unique_ptr<Store> store = new_store(options, file, path);
    Crew crew(file.threads());
    Restoring restoring(*store, file.header().now, crew);
    const int64_t cutoff = std::max(file.header().cutoff, restoring.moment().cutoff);
    if (restoring.takes_parts()) {
        BlockTaker taker(restoring, file.format(), cutoff);
        file.for_each_apart(crew, progress, taker);
    } else {
        file.for_each(crew, progress, [&](const Batch &batch) {
            if (batch.oldest >= cutoff)
                return restoring.add(batch);
            restore(batch, file.format(), restoring, [&](Bytes record) {
                const bool expired = file.format().time(record) < cutoff;
                if (expired)
                    restoring.depart(record);
                return expired;
            });
        });
    }
    restoring.finish();
    return store;
}

std::unique_ptr<Store> open_folder(const std::string &path, const locus_pmq_options *options,
                                   const locus_pmq_log_options &log_options, Progress &progress,
                                   locus_pmq_recovery &recovery) {
    Folder folder(path);
    const Folder::Content content = folder.content();
    recovery = empty_report();
    if (content.empty()) {
        auto store = std::make_unique<Store>(options ? *options : default_options());
        store->attach(std::move(folder), log_options, progress);
        recovery.created = 1;
        recovery.number = 1;
        recovery.now = INT64_MIN;
        return store;
    }
    if (content.saved.empty())
        fail(LOCUS_E_FORMAT, path, ": holds a log and no saved store");
    std::exception_ptr newest; // what is wrong with it
    for (size_t i = content.saved.size(); i-- > 0;) {
        try {
            Recovery recover(folder, log_options, recovery);
            std::unique_ptr<Store> store = recover.recover(content.saved[i], content.logs, options, progress);
            recovery.records = count(*store->view(), {});
            folder.tidy(0);
            resume(*store, std::move(folder), recover.log(), log_options);
            return store;
        } catch (const Error &error) {
            if (error.status() != LOCUS_E_FORMAT)
                throw;
            if (!newest)
                newest = std::current_exception();
            const uint32_t skipped = recovery.skipped + 1;
            recovery = empty_report();
            recovery.skipped = skipped;
        }
    }
    std::rethrow_exception(newest);
}

} // namespace locus::pmq
