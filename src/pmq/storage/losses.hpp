// Which of the saved and logged records have left since: what the log says of it, to be asked about each record in its
// order of arrival.
#pragma once

#include "pmq/record.hpp"

#include <span>
#include <vector>

namespace locus::pmq {

// The states a store went through: 0 is the saved one, each change makes the next, the present is the last.
class Losses {
public:
    explicit Losses(const RecordFormat &format) : format_(format) {}

    // Of the next state: what is older than its cutoff has gone.
    void add_state(int64_t cutoff) { cutoffs_.push_back(cutoff); }
    // The change that made the latest state let these live records go.
    void add(std::span<const std::byte> records);
    uint64_t state() const noexcept { return cutoffs_.size() - 1; } // the latest
    void finish();                                                  // all is known

    // Has a record that came with this state left since? Of records equal in every byte the earliest left.
    bool take(Bytes record, uint64_t state);

private:
    struct Slot {
        size_t first = none, last = none; // of its events
    };
    static constexpr size_t none = SIZE_MAX;

    size_t events() const noexcept { return states_.size(); }
    Bytes record_of(size_t event) const noexcept { return records_.data() + event * format_.size; }
    Slot &slot_of(Bytes record) noexcept;
    void grow();
    int64_t highest(uint64_t from, uint64_t to) const noexcept;

    const RecordFormat &format_;
    std::vector<int64_t> cutoffs_;             // per state
    std::vector<int64_t> highest_from_;        // the highest of this state and those behind
    std::vector<std::vector<int64_t>> powers_; // [k][i]: the highest of the 2^k states from i on
    std::vector<std::byte> records_;           // per event
    std::vector<uint64_t> states_;
    std::vector<size_t> next_; // event of the same record
    std::vector<Slot> table_;  // open addressing by the record's checksum
    size_t used_ = 0;
};

} // namespace locus::pmq
