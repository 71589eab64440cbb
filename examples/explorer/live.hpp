// The live window: a PMQ store, and the one thread that changes it.
#pragma once

#include "common/stream_clock.hpp"
#include "explorer/keeper.hpp"
#include "explorer/latency.hpp"
#include "explorer/thrift.hpp"

#include <locus/pmq.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace explorer {

using Batch = std::vector<locus_text156>;

int64_t wall_clock(); // microseconds since the epoch

struct LiveSettings {
    int64_t horizon = 0;                // microseconds, or LOCUS_NO_HORIZON
    uint64_t max_bytes = 0;             // or LOCUS_NO_LIMIT
    std::string folder;                 // the store is kept there, over restarts; empty: in memory alone
    double save_seconds = 0;            // how often it is saved anew
    std::optional<OlderSettings> older; // what has left the window is kept there, too
    // What time it is for the window; INT64_MIN: the latest time of the records. Called by the writer.
    std::function<int64_t()> clock;
    std::function<void(locus_pmq *)> watch; // called with the store before anything is inserted
};

class Live {
public:
    explicit Live(const LiveSettings &settings);
    ~Live();
    Live(const Live &) = delete;
    Live &operator=(const Live &) = delete;

    // Hand over a batch. `offer` waits while the queue is full (false: the writer has stopped), `ingest` until the
    // batch is stored; it throws a Failure where the queue is full or the store refuses. Any thread.
    bool offer(Batch batch);
    void ingest(Batch batch);
    void stop(); // stores what is queued, and saves; then the two above do nothing

    const locus_pmq *store() const { return store_.get(); }
    const Older *older() const { return older_.get(); } // null: what leaves is let go
    uint64_t version() const { return version_.load(std::memory_order_acquire); }
    int64_t now() const { return now_.load(std::memory_order_acquire); }     // INT64_MIN before the first record
    int64_t first() const { return first_.load(std::memory_order_relaxed); } // earliest time inserted; INT64_MAX
    double rate() const;                                                     // records/s over five seconds
    size_t queued() const;
    uint64_t refused() const { return refused_.load(std::memory_order_relaxed); } // batches the store did not take
    int64_t recovered() const { return recovered_; } // the clock found in the folder; INT64_MIN: there was none
    std::string keeping() const;                     // why the latest save failed; empty: it did not
    std::string failure() const;                     // why the writer has stopped
    const Latency &wall() const { return wall_; }
    const Latency &cpu() const { return cpu_; }

private:
    struct Destroy {
        void operator()(locus_pmq *store) const { locus_pmq_destroy(store); }
    };
    struct Job {
        Batch batch;
        std::shared_ptr<std::promise<std::string>> stored; // "" or why not; null: nobody waits
    };
    using Clock = std::chrono::steady_clock;

    locus_pmq *make(const LiveSettings &settings);
    bool enqueue(Job job, bool wait);
    void run();
    void store(Job &job);
    std::string insert(const Batch &batch);
    locus_status change(const Batch &batch, int64_t now);
    void count(size_t records);
    void publish();
    bool shrunk();

    LiveSettings settings_;
    std::unique_ptr<Older> older_; // outlives the store
    std::unique_ptr<locus_pmq, Destroy> store_;
    std::mutex changing_; // held while the store changes
    demo::StreamClock stream_clock_;
    Latency wall_, cpu_;
    std::atomic<uint64_t> version_{1};
    std::atomic<int64_t> now_{INT64_MIN};
    std::atomic<int64_t> first_{INT64_MAX};
    std::atomic<uint64_t> refused_{0};
    int64_t recovered_ = INT64_MIN;
    std::unique_ptr<Keeper> keeper_; // where there is a folder

    // The writer's own.
    bool changed_ = false;
    uint64_t gone_ = 0; // records that had left, when last counted
    Thrift counting_;
    Clock::time_point published_;

    mutable std::mutex mutex_; // of what follows
    std::condition_variable more_, room_;
    std::deque<Job> queue_;
    size_t waiting_ = 0; // records in it
    bool stopping_ = false;
    std::string failure_;
    struct Second {
        int64_t number = -1;
        uint64_t records = 0;
    };
    std::array<Second, 8> seconds_; // arrivals, by second
    std::thread writer_;
};

} // namespace explorer
