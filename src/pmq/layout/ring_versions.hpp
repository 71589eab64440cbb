// One writer and any number of readers: who reads which version of the directory. The writer changes the current
// version in place while nobody reads (readers that come then wait for the end of that short change); otherwise it
// copies what it changes, and readers never wait. What a version has lost is kept until nobody can see it.
#pragma once

#include "pmq/layout/ring_directory.hpp"

#include <condition_variable>
#include <map>
#include <mutex>

namespace locus::pmq {

// The store at one moment.
struct Edition {
    uint64_t version = 0;
    Directory directory;
    Moment moment;
    uint64_t stored = 0;
};

class Versions {
public:
    // Readers: hold the current edition until unpin(its version).
    const Edition &pin();
    void unpin(uint64_t version) noexcept;

    // The writer: start a change, alone if nobody reads and that is wanted. The oldest version that may be read until
    // the next start is stored in `oldest_read`.
    bool begin(bool alone, uint64_t &oldest_read) noexcept;
    uint64_t publish(Edition &edition) noexcept; // the oldest version that may be read from now on
    // The current edition. For the writer only.
    Edition *current() const noexcept { return current_; }

private:
    std::mutex mutex_;
    std::condition_variable change_ended_;
    std::map<uint64_t, size_t> readers_; // per version
    bool alone_ = false;
    Edition *current_ = nullptr;
};

} // namespace locus::pmq
