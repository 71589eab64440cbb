// Saving from time to time.
#include "explorer/keeper.hpp"

#include "explorer/selection.hpp"

#include <chrono>

namespace explorer {
namespace {

// A save at work. The first report of progress comes when its moment has been taken: the store may change again, and
// the tier's mark is written before the file is there.
struct Saving {
    Older &older;
    std::unique_lock<std::mutex> still;
    uint64_t number = 0; // of the file
    std::string failure{};

    int32_t moment_taken() {
        if (!still)
            return 0;
        try {
            const uint64_t received = older.received();
            still.unlock();
            older.mark(number, received);
            return 0;
        } catch (const std::exception &error) {
            failure = error.what();
            return 1;
        }
    }
};

} // namespace

Keeper::Keeper(locus_pmq *store, Older *older, std::mutex &changing, double seconds)
    : store_(store), older_(older), changing_(changing), thread_([this, seconds] { run(seconds); }) {}

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
    std::string reason;
    try {
        reason = checkpoint();
    } catch (const std::exception &error) {
        reason = error.what();
    }
    const std::lock_guard lock(mutex_);
    failure_ = reason;
}

// Why it failed, or nothing.
std::string Keeper::checkpoint() {
    if (older_ == nullptr)
        return locus_pmq_checkpoint(store_, nullptr, nullptr) == LOCUS_OK ? "" : locus_last_error();
    Saving saving{*older_, std::unique_lock(changing_)};
    locus_pmq_log_stats log{};
    log.struct_size = sizeof log;
    check(locus_pmq_get_log_stats(store_, &log));
    saving.number = log.number + 1;
    const auto progress = [](double, void *user) { return static_cast<Saving *>(user)->moment_taken(); };
    if (locus_pmq_checkpoint(store_, progress, &saving) != LOCUS_OK)
        return saving.failure.empty() ? locus_last_error() : saving.failure;
    older_->saved(saving.number);
    return "";
}

} // namespace explorer
