// Reading the clock off a batch.
#include "common/stream_clock.hpp"

#include <algorithm>

namespace demo {

int64_t StreamClock::advance(const std::vector<locus_text156> &batch) {
    if (batch.empty())
        return now_;
    times_.clear();
    for (const locus_text156 &record : batch)
        times_.push_back(int64_t{record.time}); // by value: it may lie at a multiple of 4 only
    std::sort(times_.begin(), times_.end());
    const auto median = static_cast<double>(times_[times_.size() / 2]);
    const auto quarter = static_cast<double>(times_[times_.size() / 4]);
    const double limit = median + std::max(static_cast<double>(horizon_), 10 * (median - quarter));
    size_t last = times_.size() - 1;
    while (static_cast<double>(times_[last]) > limit)
        --last;
    return now_ = std::max(now_, times_[last]);
}

} // namespace demo
