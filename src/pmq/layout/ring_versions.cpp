// The meeting point of the writer and its readers: one mutex, held for a few instructions.
#include "pmq/layout/ring_versions.hpp"

namespace locus::pmq {

const Edition &Versions::pin() {
    std::unique_lock lock(mutex_);
    change_ended_.wait(lock, [this] { return !alone_; });
    ++readers_[current_->version];
    return *current_;
}

void Versions::unpin(uint64_t version) noexcept {
    const std::lock_guard lock(mutex_);
    const auto at = readers_.find(version);
    if (--at->second == 0)
        readers_.erase(at);
}

bool Versions::begin(bool alone, uint64_t &oldest_read) noexcept {
    const std::lock_guard lock(mutex_);
    alone_ = alone && readers_.empty();
    oldest_read = readers_.empty() ? current_->version : readers_.begin()->first;
    return alone_;
}

uint64_t Versions::publish(Edition &edition) noexcept {
    uint64_t oldest_read;
    {
        const std::lock_guard lock(mutex_);
        current_ = &edition;
        alone_ = false;
        oldest_read = readers_.empty() ? edition.version : readers_.begin()->first;
    }
    change_ended_.notify_all();
    return oldest_read;
}

} // namespace locus::pmq
