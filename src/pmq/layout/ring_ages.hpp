// How many live records are how old: what a limit needs to know to raise the one cutoff that makes the oldest go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace locus::pmq {

// A histogram over time, exact at the borders of its bins, which grow until they hold about a hundredth of all.
class Ages {
public:
    struct Bin {
        int64_t first, last; // the times of its records; the next bin's are later
        uint64_t count;
    };

    explicit Ages(bool wanted) : wanted_(wanted) {}
    bool wanted() const noexcept { return wanted_; }
    uint64_t total() const noexcept { return total_; }

    void reserve(size_t times);            // room to add so many
    void add(int64_t time) noexcept;       // a record that is live
    void take_back(int64_t time) noexcept; // the record has left
    void expire(int64_t cutoff) noexcept;  // forget the bins that lie before

    // The bin that holds the `rank`-th oldest record, 1 <= rank <= total(), and how many records the bins before hold.
    const Bin &reach(uint64_t rank, uint64_t &before) const noexcept;
    bool straddles(int64_t cutoff) const noexcept { return !bins_.empty() && bins_.front().first < cutoff; }
    // Put finer bins in the place of one, given the times of all its records, sorted.
    void refine(const Bin &bin, std::span<const int64_t> times);
    size_t bytes() const noexcept { return bins_.capacity() * sizeof(Bin); }

private:
    uint64_t grain() const noexcept { return total_ / 128; }
    void join_small() noexcept;

    bool wanted_;
    std::vector<Bin> bins_;
    uint64_t total_ = 0;
};

} // namespace locus::pmq
