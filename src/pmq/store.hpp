// The store behind locus_pmq: checks what comes in, keeps the clock, lets a layout hold the records and hands over what
// leaves.
#pragma once

#include "core/mercator.hpp"
#include "pmq/departures.hpp"
#include "pmq/eviction.hpp"
#include "pmq/layout/layout.hpp"
#include "pmq/observer.hpp"
#include "pmq/query/selection.hpp"
#include "pmq/storage/journal.hpp"
#include "pmq/turn.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

namespace locus::pmq {

class Store {
public:
    // Throws Error(LOCUS_E_ARGUMENT) for an option out of its range.
    explicit Store(const locus_pmq_options &options);
    ~Store();

    // Each is true unless a callback stopped; what was asked for has happened all the same. One thread at a time:
    // another one gets Error(LOCUS_E_BUSY).
    bool insert(Bytes records, size_t count, int64_t now);
    bool sweep(int64_t now, uint64_t &evicted);
    bool erase(const Selection &selection, uint64_t &erased);

    // Tell of every batch from now on. Error(LOCUS_E_BUSY) beside a change.
    void observe(std::shared_ptr<Observer> observer);

    // What the queries (query/queries.hpp) ask.
    std::shared_ptr<const View> view() const;
    // How many records had left by a view's moment.
    uint64_t left(const View &view) const noexcept { return left_apart_ + view.left(); }
    std::shared_ptr<const Snapshot> snapshot() const { return layout_->snapshot(); }
    locus_pmq_stats stats() const;
    void check() const;

    // store_log.cpp: save into a folder without a store, and log what comes.
    void attach(Folder &&folder, const locus_pmq_log_options &options, Progress &progress);
    // The same for a store that nobody else knows yet, in a folder that may hold earlier saves; or with the log at
    // hand.
    void start_log(Folder &&folder, const locus_pmq_log_options &options, const Journal::Position &position,
                   Progress &progress);
    void attach(std::unique_ptr<Journal> journal) noexcept { journal_ = std::move(journal); }
    void checkpoint(Progress &progress);
    void sync();
    locus_pmq_log_stats log_stats() const;

private:
    friend class Restoring;
    // While one lives, its thread alone may change the store.
    class Writing {
    public:
        explicit Writing(const Store &store) : turn_(store.turn_) { turn_.begin_change(); }
        ~Writing() { turn_.end_change(); }
        Writing(const Writing &) = delete;
        Writing &operator=(const Writing &) = delete;

    private:
        Turn &turn_;
    };
    // While one lives, nothing changes the store. The constructor waits for that.
    class Standing {
    public:
        explicit Standing(const Store &store) : turn_(store.turn_) { turn_.begin_stand(); }
        ~Standing() { turn_.end_stand(); }
        Standing(const Standing &) = delete;
        Standing &operator=(const Standing &) = delete;

    private:
        Turn &turn_;
    };

    Eviction eviction_at(int64_t now) const;
    Batch checked(Bytes records, size_t count, int64_t now);
    void check_record(Bytes record, size_t index, int64_t now) const;
    template <typename Change>
    uint64_t change(Change &&change);
    template <typename Change>
    uint64_t logged(EntryKind kind, const Moment &moment, std::span<const std::byte> records, Change &&change);
    uint64_t erase_logged(const Selection &selection);
    void log_result();
    bool hand_over();
    bool tell(const Batch &batch, const Moment &moment);
    void publish_figures();
    void log_growth(const LayoutStats &before) const;

    const locus_pmq_options options_;
    const RecordFormat &format_;
    const std::unique_ptr<Layout> layout_;
    const KeysOf find_keys_ = keys_of(simd_best());
    Departures departures_;
    std::vector<std::shared_ptr<Observer>> observers_;
    int64_t now_ = INT64_MIN;
    std::vector<uint64_t> keys_;     // of the batch at work
    std::vector<std::byte> clamped_; // its records, if a time had to be changed
    uint64_t inserted_ = 0, evicted_ = 0, erased_ = 0, batches_ = 0, longest_pause_ns_ = 0;
    uint64_t left_apart_ = 0; // records that left while the store was restored, without having been in the layout

    mutable Turn turn_;
    std::unique_ptr<Journal> journal_; // set while the store stands still
    bool result_due_ = false;          // the change at work is an open entry of the log
    std::atomic<bool> saving_ = false; // a checkpoint is at work
    // Where views do not last: readers share the gate, a change excludes them. Who waits for it holds the turnstile, so
    // that readers cannot starve the writer.
    mutable std::mutex turnstile_;
    mutable std::shared_mutex gate_;
    mutable std::mutex figures_mutex_;
    locus_pmq_stats figures_{}; // after the latest change
};

} // namespace locus::pmq
