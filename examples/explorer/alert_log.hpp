// The alerts found in the stream, described in words.
#pragma once

#include "common/world.hpp"
#include "explorer/answers.hpp"

#include <locus/alerts.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <vector>

namespace explorer {

class AlertLog {
public:
    explicit AlertLog(const demo::World &world) : world_(world) {} // its places name where an alert is
    ~AlertLog();
    AlertLog(const AlertLog &) = delete;
    AlertLog &operator=(const AlertLog &) = delete;

    // From now on. The store must not change meanwhile; this object must outlive its changes.
    void watch(locus_pmq *store);

    // Puts what has been raised into words and shows it. By one thread at a time, beside everything.
    void describe(const locus_pmq *store);

    uint64_t last() const { return last_.load(std::memory_order_acquire); } // the latest id shown, 0: none
    // Those shown with a greater id, oldest first; of more than `limit` the latest.
    std::vector<Json> since(uint64_t id, size_t limit) const;

private:
    struct Shown {
        uint64_t id;
        Json json;
    };

    static int32_t raised(const locus_alert *alert, void *user);
    std::string text_of(const locus_pmq *store, const locus_alert &alert) const;
    const demo::Place *place_of(const locus_box &box) const;

    const demo::World &world_;
    locus_alerts *alerts_ = nullptr;
    std::atomic<uint64_t> last_{0};
    mutable std::mutex mutex_; // of what follows
    std::vector<locus_alert> raised_;
    std::deque<Shown> shown_;
};

} // namespace explorer
