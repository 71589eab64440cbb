// The layout of the thesis: a packed-memory array with the implicit or the explicit quadtree index (sections 3.2
// and 3.4), or with keys apart from the records and a search index over the segments' heads.
#pragma once

#include "pmq/departures.hpp"
#include "pmq/layout/layout.hpp"
#include "pmq/layout/packed_merge.hpp"
#include "pmq/layout/quadtree_index.hpp"

#include <span>
#include <vector>

namespace locus::pmq {

enum class PackedIndex { implicit, quadtree, heads };

class PackedArray final : public Layout, private View {
public:
    PackedArray(const RecordFormat &format, const Densities &densities, const Limits &limits, PackedIndex index);

    // The least memory of an array that can take a record.
    static uint64_t smallest_bytes(const RecordFormat &format, const Densities &densities, PackedIndex index) noexcept;

    void insert(const Batch &batch, Eviction &eviction, Departures &departures) override;
    void sweep(Eviction &eviction, Departures &departures) override;
    void erase(const Selection &selection, Departures &departures) override;
    void fill(const Batch &batch, Crew &, Eviction &eviction, Departures &departures) override {
        insert(batch, eviction, departures);
    }
    size_t fill_batch() const noexcept override;
    std::shared_ptr<const View> view() const override;
    std::shared_ptr<const Snapshot> snapshot() const override;
    LayoutStats stats() const override;
    void check() const override;

private:
    const RecordFormat &format() const noexcept override { return format_; }
    Moment moment() const noexcept override { return moment_; }
    uint64_t left() const noexcept override { return left_; }
    int64_t oldest() const noexcept override { return oldest_; }
    Place everywhere() const noexcept override;
    Place narrow(const Place &outer, const Quadrant &quadrant) const noexcept override;
    uint64_t count(const Place &place, const KeyRange &keys, int64_t from) const override;
    bool scan(const Place &place, const KeyRange &keys, int64_t from, Order order,
              FunctionRef<bool(const Block &)> visit) const override;
    uint64_t stored() const noexcept override { return array_.windows.total(); }

    // What one operation changes, sorted by (key, arrival).
    struct Change {
        std::vector<uint64_t> gone;     // slots whose records leave
        std::vector<Incoming> incoming; // records that are stored
        int64_t oldest = INT64_MAX;     // of what stays and comes, once known
        bool empty() const noexcept { return gone.empty() && incoming.empty(); }
    };
    // A window to be rewritten, with its share of the change.
    struct Task {
        unsigned level;
        size_t window;
        std::span<const Incoming> incoming;
        std::span<const uint64_t> gone;
    };

    std::vector<Incoming> sorted(const Batch &batch) const;
    void collect_removable(Eviction &eviction, Change &change) const;
    void enforce_limits(uint64_t most, Change &change, Departures::Group &leaving) const;
    uint64_t root_most(unsigned height) const noexcept;
    uint64_t root_least(unsigned height) const noexcept;
    unsigned fitting_height(uint64_t records) const noexcept;

    void removal_pass(Change &change, Eviction &eviction, Departures &departures, bool overflow);
    void apply(const Change &change);
    void rebuild(const Change &change, uint64_t records, unsigned height);
    size_t bytes(unsigned height) const noexcept { return Segments::bytes(format_, densities_, keys_, height); }
    void update(const Change &change);
    void plan(const Task &task);
    void rewrite_segment(const Task &task) noexcept;
    void rebalance(const Task &task) noexcept;
    void repair_index() noexcept;
    void bound_index() noexcept;
    void reserve_scratch(size_t records);

    const RecordFormat &format_;
    const Densities densities_;
    const Limits limits_;
    const Keys keys_;
    unsigned highest_; // the height of the largest array that the limits allow
    Segments array_;
    QuadtreeIndex index_;
    Moment moment_;
    uint64_t left_ = 0; // records that ever left
    int64_t oldest_ = INT64_MAX;
    std::vector<Task> tasks_; // of the update at work
    Slots scratch_;           // a window's records while it is rebalanced
    size_t scratch_size_ = 0;
    LayoutStats counters_;
};

} // namespace locus::pmq
