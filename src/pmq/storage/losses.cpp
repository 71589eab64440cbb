// A multiset of records with their times of leaving, and maxima over ranges of states.
#include "pmq/storage/losses.hpp"

#include "core/checksum.hpp"

#include <algorithm>
#include <bit>

namespace locus::pmq {

Losses::Slot &Losses::slot_of(Bytes record) noexcept {
    const size_t mask = table_.size() - 1;
    for (size_t at = checksum({record, format_.size}) & mask;; at = (at + 1) & mask)
        if (table_[at].first == none || std::memcmp(record_of(table_[at].first), record, format_.size) == 0)
            return table_[at];
}

void Losses::grow() {
    std::vector<Slot> before(std::max<size_t>(64, table_.size() * 2));
    std::swap(before, table_);
    for (const Slot &slot : before)
        if (slot.first != none)
            slot_of(record_of(slot.first)) = slot;
}

void Losses::add(std::span<const std::byte> records) {
    for (size_t at = 0; at < records.size(); at += format_.size) {
        if (2 * (used_ + 1) > table_.size())
            grow();
        const size_t event = events();
        records_.insert(records_.end(), records.data() + at, records.data() + at + format_.size);
        states_.push_back(cutoffs_.size() - 1);
        next_.push_back(none);
        Slot &slot = slot_of(records.data() + at);
        if (slot.first == none) {
            slot.first = event;
            ++used_;
        } else {
            next_[slot.last] = event;
        }
        slot.last = event;
    }
}

void Losses::finish() {
    highest_from_ = cutoffs_;
    for (size_t i = highest_from_.size(); i-- > 1;)
        highest_from_[i - 1] = std::max(highest_from_[i - 1], highest_from_[i]);
    if (events() == 0)
        return;
    powers_.push_back(cutoffs_);
    for (size_t step = 1; 2 * step <= cutoffs_.size(); step *= 2) {
        const std::vector<int64_t> &half = powers_.back();
        std::vector<int64_t> whole(cutoffs_.size() - 2 * step + 1);
        for (size_t i = 0; i < whole.size(); ++i)
            whole[i] = std::max(half[i], half[i + step]);
        powers_.push_back(std::move(whole));
    }
}

// Of the states from..to - 1, at least one.
int64_t Losses::highest(uint64_t from, uint64_t to) const noexcept {
    const auto power = static_cast<size_t>(std::bit_width(to - from) - 1);
    return std::max(powers_[power][from], powers_[power][to - (uint64_t{1} << power)]);
}

// What a cutoff made go before the change that let an equal record go is not the one meant there.
bool Losses::take(Bytes record, uint64_t state) {
    const int64_t time = format_.time(record);
    if (events() > 0) {
        Slot &slot = slot_of(record);
        const size_t event = slot.first;
        if (event != none && slot.last != none && states_[event] >= state) {
            if (states_[event] > state && highest(state, states_[event]) > time)
                return true;
            if (next_[event] != none)
                slot.first = next_[event];
            else
                slot.last = none; // all have been met; the record still marks the slot
            return true;
        }
    }
    return time < highest_from_[state];
}

} // namespace locus::pmq
