// Latencies.
#include "explorer/latency.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace explorer {
namespace {

// Below 16 a bucket a number; above, sixteen to each power of two.
size_t bucket_of(uint64_t ns) {
    if (ns < 16)
        return static_cast<size_t>(ns);
    const int shift = static_cast<int>(std::bit_width(ns)) - 5;
    const size_t bucket = static_cast<size_t>(shift) * 16 + static_cast<size_t>(ns >> shift);
    return std::min(bucket, Histogram::buckets - 1);
}

uint64_t end_of(size_t bucket) {
    if (bucket < 32)
        return bucket + 1;
    const size_t shift = bucket / 16 - 1;
    return (uint64_t{bucket % 16} + 17) << shift;
}

} // namespace

void Histogram::add(uint64_t ns) {
    ++counts_[bucket_of(ns)];
    ++count_;
    longest_ = std::max(longest_, ns);
    sum_ += static_cast<double>(ns);
}

void Histogram::add(const Histogram &other) {
    for (size_t i = 0; i < buckets; ++i)
        counts_[i] += other.counts_[i];
    count_ += other.count_;
    longest_ = std::max(longest_, other.longest_);
    sum_ += other.sum_;
}

uint64_t Histogram::quantile(double part) const {
    const auto wanted = static_cast<uint64_t>(std::ceil(part * static_cast<double>(count_)));
    uint64_t seen = 0;
    for (size_t i = 0; i < buckets && count_ > 0; ++i) {
        seen += counts_[i];
        if (seen >= wanted)
            return std::min(end_of(i), longest_);
    }
    return longest_;
}

uint64_t Histogram::below(uint64_t ns) const {
    uint64_t seen = 0;
    for (size_t i = 0; i < buckets && end_of(i) <= ns; ++i)
        seen += counts_[i];
    return seen;
}

int64_t Latency::slot_now() {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now().time_since_epoch());
    return seconds.count() / slot_seconds;
}

void Latency::add(uint64_t ns) {
    const int64_t number = slot_now();
    const std::lock_guard lock(mutex_);
    Slot &slot = slots_[static_cast<size_t>(number) % slots_.size()];
    if (slot.number != number)
        slot = {number, {}};
    slot.histogram.add(ns);
    all_.add(ns);
}

Histogram Latency::minute() const {
    const int64_t number = slot_now();
    Histogram result;
    const std::lock_guard lock(mutex_);
    for (const Slot &slot : slots_)
        if (slot.number > number - static_cast<int64_t>(slots_.size()))
            result.add(slot.histogram);
    return result;
}

Histogram Latency::all() const {
    const std::lock_guard lock(mutex_);
    return all_;
}

} // namespace explorer
