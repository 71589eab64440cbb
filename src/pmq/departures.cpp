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
    if (to_.noting_ && to_.format_.time(record) >= to_.note_from_) {
        if (noted_.empty())
            noted_.emplace_back();
        noted_.front().insert(noted_.front().end(), record, record + to_.format_.size);
    }
    ++count_;
}

void Departures::Group::commit() noexcept {
    to_.left_ += count_;
    count_ = 0;
    if (!chunk_.empty() && !chunk_.front().empty())
        to_.queue_.splice(to_.queue_.end(), chunk_);
    to_.noted_.splice(to_.noted_.end(), noted_);
}

void Departures::note(int64_t from) {
    noted_.clear();
    noting_ = true;
    note_from_ = from;
}

void Departures::note_no_more() noexcept {
    noting_ = false;
    noted_.clear();
}

std::vector<std::byte> Departures::noted(int64_t from) {
    std::vector<std::byte> records;
    for (const auto &chunk : noted_)
        for (size_t at = 0; at < chunk.size(); at += format_.size)
            if (const Bytes record = chunk.data() + at; format_.time(record) >= from)
                records.insert(records.end(), record, record + format_.size);
    note_no_more();
    return records;
}

std::vector<std::byte> Departures::waiting() const {
    std::vector<std::byte> records;
    for (const auto &chunk : queue_)
        records.insert(records.end(), chunk.begin() + static_cast<ptrdiff_t>(records.empty() ? head_ : 0), chunk.end());
    return records;
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
