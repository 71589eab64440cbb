// The clock of a stream that is not live: what time its records tell.
#pragma once

#include <locus/pmq.h>

#include <cstdint>
#include <vector>

namespace demo {

class StreamClock {
public:
    explicit StreamClock(int64_t horizon) : horizon_(horizon) {} // of the window, microseconds

    // The latest time of the batch, but it never runs back, and a few times far ahead of the others (a slip, a broken
    // clock) do not move it, for they would empty the window: more than the horizon, and than ten times the usual
    // spread, after the median.
    int64_t advance(const std::vector<locus_text156> &batch);
    int64_t now() const { return now_; } // INT64_MIN before the first record

private:
    int64_t horizon_;
    int64_t now_ = INT64_MIN;
    std::vector<int64_t> times_; // room for advance
};

} // namespace demo
