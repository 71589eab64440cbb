// The one interface between the store and its memory layouts: a View answers every query at one moment between batches,
// a Layout takes batches in and lets records out. Every query is written once, above a View.
#pragma once

#include "core/function_ref.hpp"
#include "core/zcurve.hpp"
#include "pmq/record.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace locus {
class Crew;
}

namespace locus::pmq {

class Departures;
class Eviction;
struct Selection;

// Where the records of a key range lie: positions in the order of the layout's blocks (segments, leaves), and what the
// layout remembers of the quadtree there. A query that descends the quadtree narrows the place of the parent down to
// the child.
struct Place {
    uint64_t first = 0; // the block that may hold the range's first record,
    uint64_t last = 0;  // and its last one
    uint64_t node = 0;  // the layout's own,
    unsigned level = 0; // and the level of the quadrant it stands for

    bool empty() const noexcept { return first > last; }
    bool narrow() const noexcept { return last <= first + 1; } // so few blocks that scanning beats refining
    Place to(const Place &later) const noexcept {
        return {first, later.last, node, level};
    } // from here to the end of a later one
};

// Neighbouring records in the layout's memory. Keys and records may be interleaved or apart, hence the strides.
struct Block {
    const std::byte *keys = nullptr;
    const std::byte *records = nullptr;
    size_t key_stride = 0;
    size_t record_stride = 0;
    size_t count = 0;
    const uint32_t *order =
        nullptr; // visit the entries order[0..count) instead of 0..count: for Order::key in unsorted leaves
    int64_t oldest = INT64_MIN;                // no entry's time is smaller
    uint64_t lowest = 0, highest = UINT64_MAX; // no entry's key lies outside
    bool within = false;                       // every key lies in the range asked for; else test
    bool times_ascend = false;                 // the entries' times never decrease

    size_t entry(size_t i) const noexcept { return order ? order[i] : i; }
    uint64_t key(size_t entry) const noexcept {
        uint64_t key;
        std::memcpy(&key, keys + entry * key_stride, sizeof key);
        return key;
    }
    Bytes record(size_t entry) const noexcept { return records + entry * record_stride; }
};

enum class Order {
    any, // as fast as the layout can
    key  // (key, arrival)
};

// The store at one moment between two batches. Any number of threads may ask one view; it stays valid while it is held.
class View {
public:
    virtual ~View() = default;
    virtual const RecordFormat &format() const noexcept = 0;
    virtual Moment moment() const noexcept = 0;
    // How many records had left the layout by then.
    virtual uint64_t left() const noexcept = 0;
    // No stored record is older.
    virtual int64_t oldest() const noexcept = 0;

    // The place of all keys, and of a quadrant (or a quadrant of a quadrant of ...) of the one `outer` was made for. A
    // place joined by Place::to serves count and scan, not narrowing.
    virtual Place everywhere() const noexcept = 0;
    virtual Place narrow(const Place &outer, const Quadrant &quadrant) const noexcept = 0;

    // The number of stored records with a key in `keys` and a time not before `from`, without looking at each where the
    // layout can.
    virtual uint64_t count(const Place &place, const KeyRange &keys, int64_t from) const = 0;
    // Show blocks that together hold every stored record with a key in `keys` and a time not before `from` once, and
    // perhaps older ones, until `visit` says false; false if it did.
    virtual bool scan(const Place &place, const KeyRange &keys, int64_t from, Order order,
                      FunctionRef<bool(const Block &)> visit) const = 0;

    // The number of stored records, the expired ones included; and show blocks that hold them all, in the order (key,
    // arrival), until `visit` says false; false if it did.
    virtual uint64_t stored() const noexcept = 0;
    bool scan_stored(FunctionRef<bool(const Block &)> visit) const {
        return scan(everywhere(), KeyRange{}, INT64_MIN, Order::key, visit);
    }
};

// A moment kept for several queries.
class Snapshot {
public:
    virtual ~Snapshot() = default;
    virtual std::shared_ptr<const View> view() const = 0; // throws Error(LOCUS_E_STALE) once its memory was needed
};

// A batch in order of arrival, checked, with its keys.
struct Batch {
    Bytes records;
    const uint64_t *keys;
    size_t count;
    int64_t oldest; // the smallest time of its records; INT64_MAX when empty
};

// What a layout reports; see locus_pmq_stats.
struct LayoutStats {
    uint64_t stored = 0, slots = 0, bytes = 0;
    uint64_t moved = 0, rebalances = 0, grows = 0, shrinks = 0;
};

// The most a layout may hold between calls. Beyond, the oldest records go, by time, and at least records - records / 16
// of a limit's worth stay.
struct Limits {
    uint64_t records = UINT64_MAX; // that are live
    uint64_t bytes = UINT64_MAX;
    uint64_t snapshot_bytes = UINT64_MAX; // that are kept for snapshots alone; beyond, the oldest one turns stale
};

// One thread at a time calls these. Each is all or nothing: when it throws (std::bad_alloc), store and departures are
// as before.
class Layout {
public:
    virtual ~Layout() = default;
    // Store a batch and move the clock to eviction.moment(). Records that go, now or then, go to `departures` in the
    // same commit.
    virtual void insert(const Batch &batch, Eviction &eviction, Departures &departures) = 0;
    // Let go of everything that may go.
    virtual void sweep(Eviction &eviction, Departures &departures) = 0;
    // Let go of the records that the selection accepts.
    virtual void erase(const Selection &selection, Departures &departures) = 0;
    // For a store that is being made: take in records in the order (key, arrival), behind all that came before, in
    // batches of `fill_batch` as a rule. Keeps no limit on records. Not all or nothing: after a failure the layout is
    // only good for destruction. A sweep ends it.
    virtual void fill(const Batch &batch, Crew &crew, Eviction &eviction, Departures &departures) = 0;
    virtual size_t fill_batch() const noexcept = 0;

    // The same in parts, of which several threads take in one each: first their sizes are told, then they are filled in
    // any order, then all of them are put in place. Without that, nothing has come in.
    class Parts {
    public:
        virtual ~Parts() = default;
        virtual void fill(size_t part, const Batch &batch) noexcept = 0; // once each, and no more than was told
        virtual uint64_t install() = 0; // the number of records; between the layout's other calls
    };
    virtual bool fills_in_parts() const noexcept { return false; }
    virtual std::unique_ptr<Parts> fill_parts(std::span<const size_t> sizes, Eviction &eviction);

    // The current moment. Any thread; to be asked while the view is held, or, where `views_last` is false, until the
    // next change.
    virtual std::shared_ptr<const View> view() const = 0;
    virtual bool views_last() const noexcept { return false; }
    // Throws Error(LOCUS_E_UNSUPPORTED) where views do not last.
    virtual std::shared_ptr<const Snapshot> snapshot() const = 0;
    virtual LayoutStats stats() const = 0;
    // Verify every invariant; throws Error(LOCUS_E_INTERNAL) with what is broken.
    virtual void check() const = 0;
};

inline std::unique_ptr<Layout::Parts> Layout::fill_parts(std::span<const size_t>, Eviction &) { return nullptr; }

} // namespace locus::pmq
