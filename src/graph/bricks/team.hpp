// A joined team: the calling thread and `threads` - 1 more run the same body; the first exception is thrown again by
// the caller.
#pragma once

#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace locus::bricks {

// `body(thread)` with thread = 0 .. threads - 1. `on_failure()` is called once if a body throws, so that the others
// come to an end. A thread that cannot be started is done without.
template <typename Body, typename OnFailure>
void run_team(unsigned threads, Body &&body, OnFailure &&on_failure) {
    std::mutex mutex;
    std::exception_ptr failure;
    const auto guarded = [&](unsigned thread) {
        try {
            body(thread);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure)
                failure = std::current_exception();
            on_failure();
        }
    };
    {
        std::vector<std::jthread> helpers;
        helpers.reserve(threads);
        try {
            for (unsigned t = 1; t < threads; ++t)
                helpers.emplace_back(guarded, t);
        } catch (const std::system_error &) {
            // fewer threads do the same work
        }
        guarded(0);
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace locus::bricks
