// Records on their way out: out of the slots, not yet handed to the sink.
#pragma once

#include "pmq/record.hpp"

#include <cstdint>
#include <list>
#include <vector>

namespace locus::pmq {

class Departures {
public:
    // Without a sink nothing is kept, only counted.
    Departures(const RecordFormat &format, locus_sink_fn sink, void *user)
        : format_(format), sink_(sink), user_(user) {}

    // Records that leave together. Leaving takes two steps, so that a failure in between loses nothing: add (may
    // throw), then commit. A group that is not committed changes nothing.
    class Group {
    public:
        explicit Group(Departures &to) : to_(to), chunk_(1) {}
        void reserve(size_t records);
        void add(Bytes record);
        size_t count() const noexcept { return count_; }
        // Nobody wants the records themselves: to count them is enough.
        bool counts_only() const noexcept { return !to_.sink_ && !to_.noting_; }
        void count(size_t records) noexcept { count_ += records; }
        void commit() noexcept;

    private:
        Departures &to_;
        std::list<std::vector<std::byte>> chunk_; // a list of one, to be spliced
        std::list<std::vector<std::byte>> noted_; // of one or none
        size_t count_ = 0;
    };

    // From now on note what leaves with a time not before `from`, for the log.
    void note(int64_t from);
    // What has been noted so far was not live.
    void disregard() noexcept { noted_.clear(); }
    // The noted records that are not before `from`, one after the other. It ends the noting.
    std::vector<std::byte> noted(int64_t from);
    void note_no_more() noexcept;

    uint64_t left() const noexcept { return left_; } // records that ever left
    size_t pending() const noexcept;
    size_t bytes() const noexcept;
    // The records that wait, the first to leave first.
    std::vector<std::byte> waiting() const;
    // Hand everything over, the first to leave first. False if the sink stopped; the rest waits for the next call.
    bool hand_over();

private:
    const RecordFormat &format_;
    locus_sink_fn sink_;
    void *user_;
    std::list<std::vector<std::byte>> queue_;
    size_t head_ = 0; // bytes of the first chunk already handed over
    uint64_t left_ = 0;
    bool noting_ = false;
    int64_t note_from_ = 0;
    std::list<std::vector<std::byte>> noted_;
};

} // namespace locus::pmq
