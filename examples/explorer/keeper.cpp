// Saving from time to time.
#include "explorer/keeper.hpp"

#include <locus/storage.h>

#include <chrono>

namespace explorer {

Keeper::Keeper(locus_pmq *store, double seconds) : store_(store), thread_([this, seconds] { run(seconds); }) {}

void Keeper::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    end_.notify_all();
    if (!thread_.joinable())
        return;
    thread_.join();
    save();
}

std::string Keeper::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void Keeper::run(double seconds) {
    std::unique_lock lock(mutex_);
    while (!end_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return stopping_; })) {
        lock.unlock();
        save();
        lock.lock();
    }
}

void Keeper::save() {
    const bool saved = locus_pmq_checkpoint(store_, nullptr, nullptr) == LOCUS_OK;
    const std::string reason = saved ? "" : locus_last_error();
    const std::lock_guard lock(mutex_);
    failure_ = reason;
}

} // namespace explorer
