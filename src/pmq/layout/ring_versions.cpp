// The meeting point of the writer and its readers: one mutex, held for a few instructions.
#include "pmq/layout/ring_versions.hpp"

#include "core/error.hpp"

namespace locus::pmq {

void Versions::await_change(std::unique_lock<std::mutex> &lock) {
    ++waiting_;
    change_ended_.wait(lock, [this] { return !closed_; });
    --waiting_;
}

const Edition &Versions::pin() {
    std::unique_lock lock(mutex_);
    await_change(lock);
    ++readers_[current_->version];
    return *current_;
}

const Edition &Versions::pin(const Hold &hold) {
    const std::lock_guard lock(mutex_);
    if (hold.withdrawn)
        fail(LOCUS_E_STALE, "the snapshot's memory went beyond options.snapshot_bytes");
    ++readers_[hold.version];
    return *hold.edition;
}

void Versions::unpin(uint64_t version) noexcept {
    const std::lock_guard lock(mutex_);
    drop_reader(version);
}

void Versions::drop_reader(uint64_t version) noexcept {
    const auto at = readers_.find(version);
    if (--at->second == 0)
        readers_.erase(at);
}

void Versions::hold(Hold &hold) {
    std::unique_lock lock(mutex_);
    await_change(lock);
    holds_.push_back(&hold);
    try {
        ++readers_[current_->version];
    } catch (...) {
        holds_.pop_back();
        throw;
    }
    hold.edition = current_;
    hold.version = current_->version;
}

void Versions::release(Hold &hold) noexcept {
    const std::lock_guard lock(mutex_);
    if (hold.withdrawn)
        return;
    holds_.remove(&hold);
    drop_reader(hold.version);
}

Versions::Read Versions::begin(bool is_short) noexcept {
    const std::lock_guard lock(mutex_);
    closed_ = is_short && waiting_ == 0;
    const uint64_t oldest = readers_.empty() ? current_->version : readers_.begin()->first;
    const uint64_t until = !closed_ ? current_->version + 1 : readers_.empty() ? 0 : readers_.rbegin()->first + 1;
    return {oldest, until};
}

void Versions::publish(Edition &edition) noexcept {
    {
        const std::lock_guard lock(mutex_);
        current_ = &edition;
        closed_ = false;
    }
    change_ended_.notify_all();
}

void Versions::readers(std::vector<uint64_t> &versions) const {
    const std::lock_guard lock(mutex_);
    versions.clear();
    for (const auto &[version, count] : readers_)
        versions.push_back(version);
}

bool Versions::withdraw_oldest() noexcept {
    const std::lock_guard lock(mutex_);
    if (holds_.empty())
        return false;
    Hold *oldest = holds_.front();
    holds_.pop_front();
    oldest->withdrawn = true;
    drop_reader(oldest->version);
    return true;
}

} // namespace locus::pmq
