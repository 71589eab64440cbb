// The store behind locus_pmq: checks what comes in, keeps the clock, lets a layout hold the records and hands over what
// leaves.
#pragma once

#include "pmq/departures.hpp"
#include "pmq/layout/layout.hpp"
#include "pmq/query/selection.hpp"

#include <vector>

namespace locus::pmq {

class Store {
public:
    explicit Store(const locus_pmq_options &options); // throws Error(LOCUS_E_ARGUMENT) for an option out of its range

    // True unless a callback stopped; what was asked for has happened then, too.
    bool insert(Bytes records, size_t count, int64_t now);
    bool sweep(int64_t now, uint64_t &evicted);
    bool erase(const Selection &selection, uint64_t &erased);

    // The queries (query/queries.hpp) ask this.
    std::shared_ptr<const View> view() const { return layout_->view(); }
    const RecordFormat &format() const noexcept { return format_; }
    locus_pmq_stats stats() const;
    void check() const;

private:
    Moment moment_at(int64_t now) const;
    Batch checked(Bytes records, size_t count, int64_t now);
    template <typename Work>
    bool change(int64_t now, Work &&work);

    locus_pmq_options options_;
    const RecordFormat &format_;
    std::unique_ptr<Layout> layout_;
    Departures departures_;
    int64_t now_ = INT64_MIN;
    std::vector<uint64_t> keys_;      // of the batch at work
    std::vector<std::byte> adjusted_; // its records, where times had to be changed
    uint64_t inserted_ = 0, erased_ = 0, batches_ = 0, longest_pause_ns_ = 0;
};

// An empty layout of the kind the options ask for.
std::unique_ptr<Layout> make_layout(const locus_pmq_options &options, const RecordFormat &format);

} // namespace locus::pmq
