// Tasks for a team of threads that share a budget of scratch memory: handed out one by one, given back where one
// thread's share does not suffice, and then done by fewer threads. They come in groups; those of one group have work in
// common, so that a thread stays in a group, and begins one of its own, before it helps others with theirs.
#pragma once

#include "core/progress.hpp"
#include "core/team.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace locus::graph {

class Tasks {
public:
    // `sizes`: how many tasks each group has. `steps`: how often done() will be called in all.
    Tasks(std::span<const size_t> sizes, uint64_t steps, Progress &progress) : progress_(progress), steps_(steps) {
        for (const size_t size : sizes) {
            Group &group = groups_.emplace_back();
            for (size_t i = size; i > 0; --i)
                group.open.push_back(i - 1);
            tasks_ += size;
        }
    }

    struct Task {
        size_t group, number; // in the group
    };
    // The next task for a thread whose last one was of group `last`; nothing once all are taken or a thread has failed.
    std::optional<Task> take(std::optional<size_t> last) {
        const std::lock_guard lock(mutex_);
        if (failed_ || groups_.empty())
            return std::nullopt;
        size_t group = last.value_or(0);
        if (!last || groups_[group].open.empty())
            group = static_cast<size_t>(std::ranges::max_element(groups_, std::less<>{}, promise) - groups_.begin());
        if (groups_[group].open.empty())
            return std::nullopt;
        const Task task{group, groups_[group].open.back()};
        groups_[group].open.pop_back();
        groups_[group].begun = true;
        return task;
    }
    // A task that needs so many bytes, more than the thread may take.
    void give_back(const Task &task, uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        groups_[task.group].large.push_back(task.number);
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
        threads = static_cast<uint32_t>(std::clamp<uint64_t>(tasks_, 1, threads));
        for (bool left = tasks_ != 0; left;) {
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
            left = false;
            for (Group &group : groups_) {
                left = left || !group.large.empty();
                group = {std::move(group.large), {}, false};
            }
        }
    }

private:
    struct Group {
        std::vector<size_t> open, large; // tasks to take from the back; given back
        bool begun = false;
    };
    // What a thread had best begin with: a group that no other has begun, and the one with the most to do.
    static std::pair<bool, size_t> promise(const Group &group) {
        return {!group.begun && !group.open.empty(), group.open.size()};
    }

    Progress &progress_;
    uint64_t steps_;
    uint64_t tasks_ = 0;
    std::mutex mutex_;
    std::vector<Group> groups_;
    uint64_t needed_ = 0;
    std::atomic<uint64_t> done_{0};
    std::atomic<bool> failed_{false};
};

} // namespace locus::graph
