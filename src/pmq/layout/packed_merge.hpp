// The merged sequence of what a window keeps and what comes in, in the order (key, arrival).
#pragma once

#include "pmq/layout/packed_segments.hpp"

#include <span>

namespace locus::pmq {

// A record of the batch at work. A batch is sorted by key, of one key in order of arrival.
struct Incoming {
    uint64_t key;
    Bytes record;
};

class Merge {
public:
    // The records of `segments` segments from `first` on but those in the slots `gone` (ascending), and `incoming`.
    Merge(const Segments &from, size_t first, size_t segments, std::span<const uint64_t> gone,
          std::span<const Incoming> incoming) noexcept
        : from_(from), segment_(first), segments_end_(first + segments), gone_(gone), incoming_(incoming) {
        enter_segment();
        choose();
    }

    bool ended() const noexcept { return !stored_ && incoming_.empty(); }
    bool stored() const noexcept { return stored_; } // the current record is one of the array's, in slot()
    size_t slot() const noexcept { return slot_; }
    uint64_t key() const noexcept { return key_; }
    Bytes record() const noexcept { return stored_ ? from_.slots.record(slot_) : incoming_.front().record; }
    void next() noexcept {
        if (stored_)
            ++slot_;
        else
            incoming_ = incoming_.subspan(1);
        choose();
    }

private:
    void enter_segment() noexcept {
        if (segment_ == segments_end_)
            return;
        slot_ = from_.slot(segment_);
        slots_end_ = slot_ + from_.size(segment_);
    }
    // Move to the next record that is kept, if there is one.
    bool skip_to_kept() noexcept {
        while (segment_ != segments_end_) {
            for (; slot_ != slots_end_; ++slot_, gone_ = gone_.subspan(1))
                if (gone_.empty() || gone_.front() != slot_)
                    return true;
            ++segment_;
            enter_segment();
        }
        return false;
    }
    // Of two equal keys the stored one arrived first.
    void choose() noexcept {
        stored_ = skip_to_kept();
        if (stored_)
            key_ = from_.slots.key(slot_);
        if (incoming_.empty() || (stored_ && key_ <= incoming_.front().key))
            return;
        stored_ = false;
        key_ = incoming_.front().key;
    }

    const Segments &from_;
    size_t segment_, segments_end_;
    size_t slot_ = 0, slots_end_ = 0;
    std::span<const uint64_t> gone_;
    std::span<const Incoming> incoming_;
    bool stored_ = false;
    uint64_t key_ = 0;
};

} // namespace locus::pmq
