// The thread that writes: transactions of queued records, retention, and room given back.
#pragma once

#include "cold/queue.hpp"
#include "cold/schema.hpp"

#include <locus/cold.h>

#include <thread>

namespace locus::cold {

class Writer {
public:
    // Takes over a file that `prepare` has seen to; the queue then starts behind what it holds.
    Writer(Database &database, const locus_cold_options &options, const RecordFormat &format, Queue &queue);
    ~Writer(); // writes what is queued, as far as the file takes it
    Writer(const Writer &) = delete;
    Writer &operator=(const Writer &) = delete;

    // Wait until what is queued is written and synced, and retention done. Throws Error with what failed.
    void flush();
    void set_clock(int64_t now);
    // Records with an earlier time are in no answer.
    int64_t cutoff() const noexcept { return cutoff_.load(); }
    // Forget the records from `number` on. The queue must be empty.
    void rewind(uint64_t number);
    void report(locus_cold_stats &stats) const;

private:
    struct Failure {
        locus_status status = LOCUS_OK;
        std::string text;
    };

    void work();
    bool attempt(bool sync);
    void write(const Queue::Content &content);
    std::shared_ptr<const std::vector<Entry>> sort(const Queue::Content &content, uint64_t end) const;
    Run current_run() const;
    void insert(Run &run, const std::vector<Entry> &entries, const Queue::Content &content);
    void hold_age();
    void clear(Run &run, int64_t cutoff);
    void drop(std::vector<Run>::iterator run);
    void hold_bytes();
    void give_back();
    uint64_t pages_in_use() const;
    void synchronous(uint32_t sync);
    void publish();

    Database &database_;
    const locus_cold_options options_;
    const RecordFormat format_;
    Queue &queue_;
    const uint64_t run_records_;

    mutable std::mutex database_mutex_; // for the following, and while a transaction is at work
    State state_;
    std::vector<Run> runs_;
    Statement insert_;
    uint64_t insert_run_ = UINT64_MAX;
    int64_t held_cutoff_ = INT64_MIN;
    uint64_t transactions_ = 0;

    std::atomic<int64_t> now_ = INT64_MIN, cutoff_ = INT64_MIN;
    std::atomic<bool> stopping_ = false;

    mutable std::mutex mutex_; // for the following
    std::condition_variable flushed_;
    uint64_t flushes_wanted_ = 0, flushes_answered_ = 0, flushes_done_ = 0; // numbers of requests
    Failure failure_, flush_failure_; // of the latest attempt, and of the latest flush that failed
    locus_cold_stats figures_{};

    std::thread thread_; // starts when all else is there
};

} // namespace locus::cold
