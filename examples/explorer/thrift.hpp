// What takes long is done seldom: it rests for twenty times as long as it took of its thread's processor time, a second
// at most.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace explorer {

// The calling thread's processor time.
inline std::chrono::nanoseconds thread_time() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

class Thrift {
public:
    using Clock = std::chrono::steady_clock;

    // May it be done again? What is cheap, and what was never done, always may.
    bool due() const { return !costly() || age() >= std::min<Clock::duration>(20 * cost_, std::chrono::seconds(1)); }
    bool costly() const { return cost_ >= std::chrono::milliseconds(5); }
    Clock::duration age() const { return Clock::now() - done_; }

    template <typename Work>
    auto spend(Work work) {
        const auto begin = thread_time();
        auto result = work();
        cost_ = thread_time() - begin;
        done_ = Clock::now();
        return result;
    }

private:
    Clock::time_point done_;
    Clock::duration cost_{};
};

} // namespace explorer
