// Whose turn it is to change a store: one change at a time, a second one is refused; what needs the store to stand
// still for a moment waits for its turn, and changes wait for it.
#pragma once

#include "core/error.hpp"

#include <condition_variable>
#include <mutex>

namespace locus::pmq {

class Turn {
public:
    void begin_change() {
        std::unique_lock lock(mutex_);
        if (changing_)
            fail(LOCUS_E_BUSY, "another call that changes or checks the store is at work");
        ended_.wait(lock, [this] { return !standing_ && waiting_ == 0 && !changing_; });
        changing_ = true;
    }
    void end_change() noexcept { end(changing_); }

    void begin_stand() {
        std::unique_lock lock(mutex_);
        ++waiting_;
        ended_.wait(lock, [this] { return !standing_ && !changing_; });
        --waiting_;
        standing_ = true;
    }
    void end_stand() noexcept { end(standing_); }

private:
    void end(bool &mine) noexcept {
        {
            const std::lock_guard lock(mutex_);
            mine = false;
        }
        ended_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable ended_;
    bool changing_ = false, standing_ = false;
    size_t waiting_ = 0; // to stand
};

} // namespace locus::pmq
