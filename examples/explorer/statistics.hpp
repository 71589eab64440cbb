// What the server tells of itself: /stats, /info, /metrics, /healthz.
#pragma once

#include "explorer/alert_log.hpp"
#include "explorer/answers.hpp"
#include "explorer/feed.hpp"

#include <atomic>
#include <functional>
#include <mutex>

namespace explorer {

struct Counters {
    std::atomic<uint64_t> requests{0};
    std::atomic<uint64_t> failures{0}; // answered with an error
    std::atomic<uint64_t> listeners{0};
    Latency tiles; // how long their answers took
};

struct StatisticsSettings {
    double horizon = 0;        // seconds; 0: none
    double keep = 0;           // seconds behind it; 0: nothing
    uint64_t memory_limit = 0; // bytes; 0: none
    size_t max_results = 0;
    std::string attribution;
};

class Statistics {
public:
    Statistics(const Live &live, const Feed &feed, const AlertLog &alerts, const Counters &counters,
               StatisticsSettings settings);

    Json stats() const;
    Json info() const;
    Reply metrics() const;
    Reply health() const;

private:
    locus_pmq_stats figures() const;

    const Live &live_;
    const Feed &feed_;
    const AlertLog &alerts_;
    const Counters &counters_;
    StatisticsSettings settings_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    mutable std::mutex mutex_; // of what follows
    mutable Thrift counting_;
    mutable locus_pmq_stats figures_{};
};

} // namespace explorer
