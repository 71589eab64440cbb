// How long things take: a histogram over the last minute and one over everything.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>

namespace explorer {

// Counts of nanoseconds in buckets whose width is a sixteenth of their value, or less.
class Histogram {
public:
    static constexpr size_t buckets = 60 * 16;

    void add(uint64_t ns);
    void add(const Histogram &other);
    uint64_t count() const { return count_; }
    double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
    double sum() const { return sum_; }
    uint64_t longest() const { return longest_; }
    uint64_t quantile(double part) const; // the upper end of the bucket in which it lies
    uint64_t below(uint64_t ns) const;    // how many are in buckets that end at `ns` or before

private:
    std::array<uint64_t, buckets> counts_{};
    uint64_t count_ = 0;
    uint64_t longest_ = 0;
    double sum_ = 0;
};

// Any thread.
class Latency {
public:
    using Clock = std::chrono::steady_clock;

    void add(uint64_t ns);
    Histogram minute() const; // the last 50 to 60 seconds
    Histogram all() const;

private:
    static constexpr int64_t slot_seconds = 10;
    struct Slot {
        int64_t number = -1;
        Histogram histogram;
    };

    static int64_t slot_now();

    mutable std::mutex mutex_;
    std::array<Slot, 6> slots_;
    Histogram all_;
};

} // namespace explorer
