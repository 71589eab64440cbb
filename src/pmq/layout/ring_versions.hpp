// One writer and any number of readers: who reads which version of the directory. The writer copies what it changes
// where a reader may see it, once for each version that is read, and changes the rest in place: readers that come
// during a short change wait for its end, and the next one does not let them wait again. What a version has lost is
// kept until nobody can see it.
#pragma once

#include "pmq/layout/ring_directory.hpp"

#include <condition_variable>
#include <list>
#include <map>
#include <mutex>
#include <vector>

namespace locus::pmq {

// The store at one moment.
struct Edition {
    uint64_t version = 0;
    Directory directory;
    Moment moment;
    uint64_t stored = 0;
    uint64_t left = 0; // records that ever left
};

class Versions {
public:
    // A reader's claim to a version for more than one call. The writer may withdraw it, between calls.
    struct Hold {
        const Edition *edition = nullptr;
        uint64_t version = 0;
        bool withdrawn = false;
    };

    // Readers: the current edition, or that of a hold, until unpin(its version). Throws Error(LOCUS_E_STALE) for a hold
    // that was withdrawn.
    const Edition &pin();
    const Edition &pin(const Hold &hold);
    void unpin(uint64_t version) noexcept;
    void hold(Hold &hold);
    void release(Hold &hold) noexcept;

    // What may be read until the end of a change: versions from `oldest` on, and below `until`.
    struct Read {
        uint64_t oldest, until;
    };
    // The writer: start a change. If it is short and nobody waits since the last one, those who come wait for its end.
    Read begin(bool is_short) noexcept;
    void publish(Edition &edition) noexcept;
    // The versions that are read, ascending. Later readers come to the current one.
    void readers(std::vector<uint64_t> &versions) const;
    bool withdraw_oldest() noexcept; // false: there are no holds
    // The current edition. For the writer only.
    Edition *current() const noexcept { return current_; }

private:
    void await_change(std::unique_lock<std::mutex> &lock);
    void drop_reader(uint64_t version) noexcept;

    mutable std::mutex mutex_;
    std::condition_variable change_ended_;
    std::map<uint64_t, size_t> readers_; // per version
    std::list<Hold *> holds_;            // the oldest first
    bool closed_ = false;                // to those who come
    size_t waiting_ = 0;
    Edition *current_ = nullptr;
};

} // namespace locus::pmq
