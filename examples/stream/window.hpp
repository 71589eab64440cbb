// The live window: a PMQ store with a horizon, what inserting into it takes, and a cold tier for what leaves it.
#pragma once

#include "common/stream_clock.hpp"

#include <locus/cold.h>
#include <locus/pmq.h>

#include <memory>
#include <string>
#include <vector>

namespace demo {

enum class StoreLayout { usual, ring_leaves, packed_array, packed_array_explicit, packed_array_heads };

struct Latencies {
    double mean = 0, middle = 0, p99 = 0, longest = 0; // seconds per batch
};

// Waiting for the cold tier, which is slower than a replay can be.
struct Waits {
    uint64_t times = 0;
    double seconds = 0, longest = 0;
};

// A store that was saved, ended and loaded.
struct Restart {
    uint64_t records = 0, bytes = 0; // of the saved window
    double saving = 0, loading = 0;  // seconds
};

class Window {
public:
    // What leaves the window is kept in FOLDER/older.db, made anew; with no folder it is let go. Microseconds. Throws
    // std::runtime_error.
    explicit Window(int64_t horizon, StoreLayout layout = StoreLayout::usual, const std::string &folder = "");

    // Insert a batch at the clock that its times tell. Throws std::runtime_error.
    void insert(const std::vector<locus_text156> &batch);

    // Evict what is expired but still stored.
    void sweep();

    // Save the window to FOLDER/window.pmq, end store and tier, and open both again. Throws std::runtime_error, and
    // then there may be no store any more.
    Restart restart();

    locus_pmq *store() { return store_.get(); }
    const locus_pmq *store() const { return store_.get(); }
    locus_pmq_stats stats() const;
    locus_cold_stats cold_stats() const;
    uint64_t count_both(const locus_pmq_query *query) const; // in the window and in what has left it
    int64_t clock() const { return clock_; }                 // INT64_MIN before the first record
    Latencies latencies() const;
    double insert_seconds() const { return insert_seconds_; }
    const Waits &waits() const { return waits_; } // beside the inserts
    bool keeps() const { return !folder_.empty(); }
    uint64_t late() const { return late_; }   // records older than the window when they came
    uint64_t ahead() const { return ahead_; } // records whose time was set back to the clock

private:
    struct Destroy {
        void operator()(locus_pmq *store) const { locus_pmq_destroy(store); }
    };

    struct Close {
        void operator()(locus_cold *cold) const { locus_cold_close(cold); }
    };

    locus_pmq_options with_tier();
    void wait_for_tier();
    std::string path(const char *name) const { return folder_ + "/" + name; }

    int64_t horizon_;
    std::string folder_;
    uint64_t queue_bytes_ = 0; // of the tier
    locus_pmq_options options_;
    StreamClock stream_clock_;
    std::unique_ptr<locus_cold, Close> cold_; // outlives the store
    std::unique_ptr<locus_pmq, Destroy> store_;
    int64_t clock_ = INT64_MIN;
    std::vector<double> seconds_; // per batch
    double insert_seconds_ = 0;
    Waits waits_;
    uint64_t late_ = 0;
    uint64_t ahead_ = 0;
};

// A status of liblocus, or of liblocus_cold, as an exception.
void check(locus_status status);
void check_cold(locus_status status);

} // namespace demo
