// The live window: a PMQ store with a horizon, and what inserting into it takes.
#pragma once

#include "common/stream_clock.hpp"

#include <locus/pmq.h>

#include <memory>
#include <vector>

namespace demo {

enum class StoreLayout { usual, ring_leaves, packed_array, packed_array_explicit };

struct Latencies {
    double mean = 0, middle = 0, p99 = 0, longest = 0; // seconds per batch
};

class Window {
public:
    explicit Window(int64_t horizon, StoreLayout layout = StoreLayout::usual); // microseconds

    // Insert a batch at the clock that its times tell. Throws std::runtime_error.
    void insert(const std::vector<locus_text156> &batch);

    // Evict what is expired but still stored.
    void sweep();

    const locus_pmq *store() const { return store_.get(); }
    locus_pmq_stats stats() const;
    int64_t clock() const { return clock_; } // INT64_MIN before the first record
    Latencies latencies() const;
    double insert_seconds() const { return insert_seconds_; }
    uint64_t late() const { return late_; }   // records older than the window when they came
    uint64_t ahead() const { return ahead_; } // records whose time was set back to the clock

private:
    struct Destroy {
        void operator()(locus_pmq *store) const { locus_pmq_destroy(store); }
    };

    int64_t horizon_;
    StreamClock stream_clock_;
    std::unique_ptr<locus_pmq, Destroy> store_;
    int64_t clock_ = INT64_MIN;
    std::vector<double> seconds_; // per batch
    double insert_seconds_ = 0;
    uint64_t late_ = 0;
    uint64_t ahead_ = 0;
};

// A status of liblocus as an exception.
void check(locus_status status);

} // namespace demo
