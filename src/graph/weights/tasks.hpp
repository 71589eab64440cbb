// Tasks for a team of threads that share a budget of scratch memory: handed out one by one, given back where one
// thread's share does not suffice, and then done by fewer threads.
#pragma once

#include "core/progress.hpp"
#include "core/team.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace locus::graph {

class Tasks {
public:
    // `steps`: how often done() will be called in all.
    Tasks(size_t count, uint64_t steps, Progress &progress) : progress_(progress), steps_(steps), open_(count) {
        for (size_t i = 0; i < count; ++i)
            open_[i] = count - 1 - i;
    }

    // The next task; nothing once all are taken or a thread has failed.
    std::optional<size_t> take() {
        const std::lock_guard lock(mutex_);
        if (open_.empty() || failed_)
            return std::nullopt;
        const size_t task = open_.back();
        open_.pop_back();
        return task;
    }
    // A task that needs so many bytes, more than the thread may take.
    void give_back(size_t task, uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        large_.push_back(task);
        needed_ = std::max(needed_, bytes);
    }
    // One of the steps is done. Throws LOCUS_E_STOPPED on the caller's thread.
    void done(bool on_callers_thread) {
        const uint64_t done = ++done_;
        if (on_callers_thread)
            progress_.report(static_cast<double>(done) / static_cast<double>(steps_));
    }
    bool failed() const { return failed_; }

    // Run work(rank, bytes) on up to `threads` threads, each with its share of `bytes`, until no task is left.
    // Throws LOCUS_E_MEMORY where a task needs more than all of them.
    template <typename Work>
    void run(uint32_t threads, uint64_t bytes, Work &&work) {
        threads = static_cast<uint32_t>(std::clamp<uint64_t>(open_.size(), 1, threads));
        while (!open_.empty()) {
            if (needed_ > bytes)
                fail(LOCUS_E_MEMORY, "a batch needs ", needed_, " bytes, batch_bytes allow ", bytes);
            if (needed_ != 0)
                threads = static_cast<uint32_t>(std::min<uint64_t>(threads, bytes / needed_));
            run_team(threads, [&](uint32_t rank) {
                try {
                    work(rank, bytes / threads);
                } catch (...) {
                    failed_ = true;
                    throw;
                }
            });
            open_.swap(large_);
            large_.clear();
        }
    }

private:
    Progress &progress_;
    uint64_t steps_;
    std::mutex mutex_;
    std::vector<size_t> open_;
    std::vector<size_t> large_;
    uint64_t needed_ = 0;
    std::atomic<uint64_t> done_{0};
    std::atomic<bool> failed_{false};
};

} // namespace locus::graph
