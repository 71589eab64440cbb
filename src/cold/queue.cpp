// Chunks of records between the sink and the writer.
#include "cold/queue.hpp"

#include <algorithm>
#include <new>
#include <thread>

namespace locus::cold {
namespace {

constexpr size_t chunk_bytes = 256 << 10;

} // namespace

const std::byte *Queue::Content::record(uint64_t number) const noexcept {
    const uint64_t at = number - chunks_.front()->first;
    return chunks_[at / chunk_records_]->memory.get() + at % chunk_records_ * record_size_;
}

Queue::Queue(size_t record_size, uint64_t most_bytes, bool waits, uint64_t enough, std::chrono::microseconds delay)
    : record_size_(record_size), chunk_records_(chunk_bytes / record_size),
      most_chunks_(static_cast<size_t>(most_bytes / chunk_bytes)), waits_(waits),
      enough_(std::min<uint64_t>(enough, chunk_records_ * most_chunks_ / 2)), delay_(delay) {}

void Queue::start_at(uint64_t number) {
    const std::lock_guard lock(mutex_);
    chunks_.clear();
    next_ = nullptr;
    chunk_end_ = number;
    written_ = number;
    received_.store(number, std::memory_order_release);
}

bool Queue::put(const std::byte *record) {
    const uint64_t number = received_.load(std::memory_order_relaxed);
    if (number == chunk_end_)
        begin_chunk(number);
    std::memcpy(next_, record, record_size_);
    next_ += record_size_;
    received_.store(number + 1, std::memory_order_release);
    bool refuse = false;
    if (starving_) {
        const std::lock_guard lock(mutex_);
        starving_ = refuse = crowded();
    }
    refused_.store(refuse);
    return !refuse;
}

// The record that is to go into the chunk has left the store: it is taken over in any case. Without memory that waits
// for what the writer gives back.
void Queue::begin_chunk(uint64_t number) {
    std::unique_lock lock(mutex_);
    if (waits_ && chunks_.size() >= most_chunks_ && !failing_) {
        ++waited_;
        waiting_ = true;
        work_.notify_all();
        room_.wait(lock, [&] { return chunks_.size() < most_chunks_ || failing_; });
        waiting_ = false;
    }
    for (;;) {
        try {
            auto chunk = std::make_shared<Chunk>(number, chunk_records_ * record_size_);
            next_ = chunk->memory.get();
            chunks_.push_back(std::move(chunk));
            break;
        } catch (const std::bad_alloc &) {
            work_.notify_all();
            room_.wait_for(lock, std::chrono::milliseconds(10));
        }
    }
    chunk_end_ = number + chunk_records_;
    starving_ = crowded();
    work_.notify_all();
}

Queue::Content Queue::content() const {
    Content content;
    content.record_size_ = record_size_;
    content.chunk_records_ = chunk_records_;
    const std::lock_guard lock(mutex_);
    content.chunks_ = chunks_;
    content.sorted = sorted_;
    content.written = written_;
    content.received = received();
    return content;
}

uint64_t Queue::bytes() const {
    const std::lock_guard lock(mutex_);
    return chunks_.size() * chunk_records_ * record_size_ + (sorted_ ? sorted_->capacity() * sizeof(Entry) : 0);
}

uint64_t Queue::waits() const {
    const std::lock_guard lock(mutex_);
    return waited_;
}

Queue::Content Queue::wait() {
    {
        std::unique_lock lock(mutex_);
        const auto enough = [&] {
            return woken_ || received() - written_ >= enough_ || chunks_.size() >= most_chunks_;
        };
        work_.wait_for(lock, failing_ ? std::max(delay_, std::chrono::microseconds(1000000)) : delay_,
                       [&] { return failing_ ? woken_ : enough(); });
        woken_ = false;
    }
    return content();
}

void Queue::wake() {
    {
        const std::lock_guard lock(mutex_);
        woken_ = true;
    }
    work_.notify_all();
}

void Queue::sorted(std::shared_ptr<const std::vector<Entry>> entries) {
    const std::lock_guard lock(mutex_);
    sorted_ = std::move(entries);
}

void Queue::written(uint64_t end) {
    std::deque<std::shared_ptr<const Chunk>> gone; // released without the lock
    {
        const std::lock_guard lock(mutex_);
        written_ = end;
        sorted_.reset();
        while (!chunks_.empty() && chunks_.front()->first + chunk_records_ <= end) {
            gone.push_back(std::move(chunks_.front()));
            chunks_.pop_front();
        }
    }
    room_.notify_all();
}

void Queue::failing(bool is) {
    {
        const std::lock_guard lock(mutex_);
        failing_ = is;
    }
    room_.notify_all();
}

} // namespace locus::cold
