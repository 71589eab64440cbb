// The object behind locus_alerts: what a store's batches bring, to the caller's callbacks.
#pragma once

#include "pmq/alerts/fences.hpp"
#include "pmq/alerts/watch.hpp"
#include "pmq/observer.hpp"

namespace locus::pmq {

locus_alerts_options default_alerts_options() noexcept;
// Throws Error(LOCUS_E_ARGUMENT), which names the option and its value.
void check_alerts_options(const locus_alerts_options &options);

class Alerts final : public Observer {
public:
    // Throws Error(LOCUS_E_ARGUMENT) for an option out of its range.
    explicit Alerts(const locus_alerts_options &options);

    bool ended() const noexcept override { return ended_; }
    bool arrived(const Batch &batch, const RecordFormat &format, const Moment &moment) override;

    // Any thread.
    void end() noexcept { ended_ = true; }
    size_t active(locus_alert *alerts, size_t capacity) const { return watch_.active(alerts, capacity); }
    void add_fence(uint64_t id, std::unique_ptr<const Region> region, const Selection &selection);
    void remove_fence(uint64_t id);
    locus_alerts_stats stats() const;

private:
    static constexpr size_t chunk_records = 256, chunk_found = 1024;

    void count(const Batch &batch, const RecordFormat &format, const Moment &moment) noexcept;
    bool any_fences() const;
    bool show(const Batch &batch, const RecordFormat &format, const Moment &moment);
    size_t gather(const Batch &batch, size_t begin, const RecordFormat &format, const Moment &moment);
    bool show_to_fence(const Fence &fence, Bytes record);
    bool tell();

    const locus_alerts_options options_;
    std::atomic<bool> ended_ = false;
    Activity activity_; // of the thread that inserts
    Watch watch_;
    std::atomic<uint64_t> regions_ = 1, activity_bytes_ = 0, shown_ = 0;

    mutable std::mutex fences_mutex_;
    Fences fences_;
    Fences::Found
        room_; // for as many as a chunk may find, made when a fence is added; the thread that inserts takes it
    Fences::Found found_;                      // for the records of a chunk, one record after the other,
    std::array<size_t, chunk_records> ends_{}; // and where those of each end
};

} // namespace locus::pmq
