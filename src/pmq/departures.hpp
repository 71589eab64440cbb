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
        void commit() noexcept;

    private:
        Departures &to_;
        std::list<std::vector<std::byte>> chunk_; // a list of one, to be spliced
        size_t count_ = 0;
    };

    uint64_t left() const noexcept { return left_; } // records that ever left
    size_t pending() const noexcept;
    size_t bytes() const noexcept;
    // Hand everything over, the first to leave first. False if the sink stopped; the rest waits for the next call.
    bool hand_over();

private:
    const RecordFormat &format_;
    locus_sink_fn sink_;
    void *user_;
    std::list<std::vector<std::byte>> queue_;
    size_t head_ = 0; // bytes of the first chunk already handed over
    uint64_t left_ = 0;
};

} // namespace locus::pmq
