// From the queue into the file.
#include "cold/writer.hpp"

#include <algorithm>

namespace locus::cold {
namespace {

// An eighth of the limit on bytes holds a run.
uint64_t run_limit(const locus_cold_options &options, const RecordFormat &format) noexcept {
    constexpr uint64_t row_overhead = 40; // bytes, more than there are
    if (options.max_bytes == LOCUS_NO_LIMIT)
        return options.run_records;
    return std::min(options.run_records, options.max_bytes / 8 / (format.size + row_overhead));
}

} // namespace

Writer::Writer(Database &database, const locus_cold_options &options, const RecordFormat &format, Queue &queue)
    : database_(database), options_(options), format_(format), queue_(queue), run_records_(run_limit(options, format)),
      state_(read_state(database)), runs_(read_runs(database)), now_(state_.now),
      cutoff_(cutoff_at(state_.now, options.max_age)) {
    synchronous(options.sync);
    queue_.start_at(state_.written);
    publish();
    thread_ = std::thread([this] { work(); });
}

Writer::~Writer() {
    stopping_ = true;
    queue_.wake();
    thread_.join();
}

void Writer::synchronous(uint32_t sync) {
    static constexpr const char *modes[] = {"OFF", "NORMAL", "FULL"};
    database_.execute(std::string("PRAGMA synchronous = ") + modes[sync]);
}

void Writer::flush() {
    std::unique_lock lock(mutex_);
    const uint64_t request = ++flushes_wanted_;
    queue_.wake();
    flushed_.wait(lock, [&] { return flushes_answered_ >= request; });
    if (flushes_done_ < request)
        fail(flush_failure_.status, flush_failure_.text);
}

void Writer::set_clock(int64_t now) {
    {
        const std::lock_guard lock(mutex_);
        require(now >= now_, "now is ", now, ", before the clock's ", now_.load());
        now_ = now;
        cutoff_ = cutoff_at(now, options_.max_age);
    }
    queue_.wake();
}

void Writer::work() {
    for (bool last = false; !last;) {
        queue_.wait();
        last = stopping_;
        uint64_t request;
        bool sync;
        {
            const std::lock_guard lock(mutex_);
            request = flushes_wanted_;
            sync = last || request > flushes_answered_;
        }
        const uint64_t goal = queue_.received();
        bool good = attempt(sync);
        while (good && sync && queue_.content().written < goal)
            good = attempt(sync);
        if (!sync)
            continue;
        {
            const std::lock_guard lock(mutex_);
            flushes_answered_ = request;
            if (good)
                flushes_done_ = request;
            else
                flush_failure_ = failure_;
        }
        flushed_.notify_all();
    }
}

// Write a batch, then see to retention. False: something failed, and what is not written stays in the queue.
bool Writer::attempt(bool sync) {
    Failure failure;
    try {
        const std::lock_guard lock(database_mutex_);
        const Queue::Content content = queue_.content();
        if (content.written < content.received || sync) {
            const bool more = sync && options_.sync == LOCUS_COLD_SYNC_NORMAL;
            if (more)
                synchronous(LOCUS_COLD_SYNC_FULL);
            write(content);
            if (more)
                synchronous(options_.sync);
        }
        hold_age();
        hold_bytes();
        give_back();
        publish();
    } catch (const Error &error) {
        failure = {error.status(), error.what()};
    } catch (const std::bad_alloc &) {
        failure = {LOCUS_E_MEMORY, "out of memory"};
    } catch (const std::exception &error) {
        failure = {LOCUS_E_INTERNAL, error.what()};
    }
    const bool good = failure.status == LOCUS_OK;
    queue_.sorted(nullptr);
    queue_.failing(!good);
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    return good;
}

void Writer::write(const Queue::Content &content) {
    const uint64_t end =
        std::min({content.received, content.written + options_.batch_records, content.written + run_records_});
    const auto entries = sort(content, end);
    queue_.sorted(entries);
    Transaction transaction(database_, Transaction::Kind::write);
    Run run = current_run();
    State state = state_;
    const uint64_t before = run.records;
    insert(run, *entries, content);
    run.end = end;
    state.written = end;
    state.removed += entries->size() - (run.records - before);
    state.now = now_;
    write_state(database_, state);
    if (run.records > 0) {
        write_run(database_, run);
        if (runs_.empty() || runs_.back().first != run.first)
            runs_.reserve(runs_.size() + 1);
    }
    transaction.commit();
    state_ = state;
    ++transactions_;
    if (run.records > 0) {
        if (runs_.empty() || runs_.back().first != run.first)
            runs_.push_back(run);
        else
            runs_.back() = run;
    }
    queue_.written(end);
}

std::shared_ptr<const std::vector<Entry>> Writer::sort(const Queue::Content &content, uint64_t end) const {
    auto entries = std::make_shared<std::vector<Entry>>();
    entries->reserve(static_cast<size_t>(end - content.written));
    for (uint64_t number = content.written; number < end; ++number)
        entries->push_back({format_.key(content.record(number)), number});
    std::sort(entries->begin(), entries->end());
    return entries;
}

// The last run as long as it has room; then one to come.
Run Writer::current_run() const {
    if (!runs_.empty() && runs_.back().records < run_records_)
        return runs_.back();
    Run run;
    run.first = run.end = state_.written;
    return run;
}

void Writer::insert(Run &run, const std::vector<Entry> &entries, const Queue::Content &content) {
    const int64_t cutoff = cutoff_;
    for (const Entry &entry : entries) {
        const std::byte *record = content.record(entry.number);
        const int64_t time = format_.time(record);
        if (time < cutoff)
            continue;
        if (run.records == 0)
            create_run(database_, run);
        if (insert_run_ != run.first) {
            insert_ = database_.prepare("INSERT INTO " + run.table() + " VALUES(?1, ?2, ?3)");
            insert_run_ = run.first;
        }
        insert_.bind(1, static_cast<int64_t>(entry.key)).bind(2, static_cast<int64_t>(entry.number - run.first));
        insert_.bind(3, record, format_.size).run();
        ++run.records;
        run.oldest = std::min(run.oldest, time);
        run.youngest = std::max(run.youngest, time);
        run.lowest = std::min(run.lowest, entry.key);
        run.highest = std::max(run.highest, entry.key);
    }
}

// Runs in which nothing is young enough go whole. One of mixed age is cleared of what is too old once that may be a
// quarter of the age old, so that each is read a few times in its life.
void Writer::hold_age() {
    const int64_t cutoff = cutoff_;
    if (cutoff == held_cutoff_)
        return;
    for (size_t i = runs_.size(); i-- > 0;) {
        Run &run = runs_[i];
        const int64_t from = std::max(run.oldest, run.cleared);
        if (run.youngest < cutoff)
            drop(runs_.begin() + static_cast<ptrdiff_t>(i));
        else if (from < cutoff && static_cast<uint64_t>(cutoff) - static_cast<uint64_t>(from) >=
                                      static_cast<uint64_t>(options_.max_age) / 4)
            clear(run, cutoff);
    }
    held_cutoff_ = cutoff;
}

void Writer::clear(Run &run, int64_t cutoff) {
    Run kept = run;
    kept.oldest = INT64_MAX;
    kept.cleared = cutoff;
    std::vector<Entry> old;
    Transaction transaction(database_, Transaction::Kind::write);
    Statement read = database_.prepare("SELECT key, arrival, record FROM " + run.table());
    while (read.step()) {
        const std::byte *record = read.bytes(2, format_.size);
        if (record == nullptr)
            fail(LOCUS_E_FORMAT, run.table(), ": a record of another size");
        const int64_t time = format_.time(record);
        if (time < cutoff)
            old.push_back({static_cast<uint64_t>(read.number(0)), static_cast<uint64_t>(read.number(1))});
        else
            kept.oldest = std::min(kept.oldest, time);
    }
    read.reset();
    Statement remove = database_.prepare("DELETE FROM " + run.table() + " WHERE key = ?1 AND arrival = ?2");
    for (const Entry &entry : old) {
        remove.bind(1, static_cast<int64_t>(entry.key)).bind(2, static_cast<int64_t>(entry.number));
        remove.run();
    }
    kept.records -= old.size();
    State state = state_;
    state.removed += old.size();
    state.now = now_;
    write_run(database_, kept);
    write_state(database_, state);
    transaction.commit();
    run = kept;
    state_ = state;
}

void Writer::drop(std::vector<Run>::iterator run) {
    State state = state_;
    state.removed += run->records;
    state.now = now_;
    Transaction transaction(database_, Transaction::Kind::write);
    drop_run(database_, *run);
    write_state(database_, state);
    transaction.commit();
    state_ = state;
    runs_.erase(run);
}

uint64_t Writer::pages_in_use() const {
    return static_cast<uint64_t>(database_.number("PRAGMA page_count") - database_.number("PRAGMA freelist_count"));
}

void Writer::hold_bytes() {
    if (options_.max_bytes == LOCUS_NO_LIMIT)
        return;
    const uint64_t most = options_.max_bytes / static_cast<uint64_t>(database_.number("PRAGMA page_size"));
    while (!runs_.empty() && pages_in_use() > most)
        drop(runs_.begin());
}

// A step at a time, and only what is far more than the records to come will need.
void Writer::give_back() {
    constexpr int64_t step = 512; // pages
    const int64_t free = database_.number("PRAGMA freelist_count"), all = database_.number("PRAGMA page_count");
    if (free > step && free > all / 4)
        database_.execute("PRAGMA incremental_vacuum(" + std::to_string(step) + ")");
}

void Writer::rewind(uint64_t number) {
    const std::lock_guard lock(database_mutex_);
    require(number <= state_.written, "received is ", number, ", above the tier's ", state_.written);
    std::vector<Run> runs = runs_;
    State state = state_;
    state.written = number;
    Transaction transaction(database_, Transaction::Kind::write);
    while (!runs.empty() && runs.back().end > number) {
        Run &last = runs.back();
        if (last.first >= number) {
            drop_run(database_, last);
            runs.pop_back();
            continue;
        }
        const std::string later = " FROM " + last.table() + " WHERE arrival >= " + std::to_string(number - last.first);
        last.records -= static_cast<uint64_t>(database_.number("SELECT count(*)" + later));
        database_.execute("DELETE" + later);
        last.end = number;
        write_run(database_, last);
    }
    write_state(database_, state);
    transaction.commit();
    runs_.swap(runs);
    state_ = state;
    queue_.start_at(number);
    publish();
}

void Writer::publish() {
    locus_cold_stats figures{};
    figures.removed = state_.removed;
    for (const Run &run : runs_)
        figures.stored += run.records;
    figures.runs = runs_.size();
    const auto page = static_cast<uint64_t>(database_.number("PRAGMA page_size"));
    figures.file_bytes = page * static_cast<uint64_t>(database_.number("PRAGMA page_count"));
    figures.free_bytes = page * static_cast<uint64_t>(database_.number("PRAGMA freelist_count"));
    figures.transactions = transactions_;
    const std::lock_guard lock(mutex_);
    figures_ = figures;
}

void Writer::report(locus_cold_stats &stats) const {
    const std::lock_guard lock(mutex_);
    stats = figures_;
    stats.now = now_;
    stats.failure = failure_.status;
}

} // namespace locus::cold
