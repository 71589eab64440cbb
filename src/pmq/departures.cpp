// The queue of records that wait for the sink.
#include "pmq/departures.hpp"

namespace locus::pmq {

void Departures::Group::reserve(size_t records) {
    if (to_.sink_)
        chunk_.front().reserve(records * to_.format_.size);
}

void Departures::Group::add(Bytes record) {
    if (to_.sink_)
        chunk_.front().insert(chunk_.front().end(), record, record + to_.format_.size);
    ++count_;
}

void Departures::Group::commit() noexcept {
    to_.left_ += count_;
    count_ = 0;
    if (!chunk_.empty() && !chunk_.front().empty())
        to_.queue_.splice(to_.queue_.end(), chunk_);
}

size_t Departures::bytes() const noexcept {
    size_t total = 0;
    for (const auto &chunk : queue_)
        total += chunk.capacity();
    return total;
}

size_t Departures::pending() const noexcept {
    size_t total = 0;
    for (const auto &chunk : queue_)
        total += chunk.size();
    return (total - head_) / format_.size;
}

bool Departures::hand_over() {
    while (!queue_.empty()) {
        while (head_ < queue_.front().size()) {
            const std::byte *record = queue_.front().data() + head_;
            head_ += format_.size;
            if (sink_(record, user_) != 0)
                return false;
        }
        queue_.pop_front();
        head_ = 0;
    }
    return true;
}

} // namespace locus::pmq
