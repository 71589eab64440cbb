// Which regions stand out, and which of them have been reported.
#pragma once

#include "pmq/alerts/activity.hpp"

#include <locus/alerts.h>

#include <mutex>
#include <span>
#include <vector>

namespace locus::pmq {

class Watch {
public:
    explicit Watch(const locus_alerts_options &options);

    // After a batch: end what is over, raise what is new.
    void look(const Activity &activity, int64_t now);
    // What the latest look raised, the largest excess first. For the thread that looks.
    std::span<const locus_alert> raised() const noexcept { return raised_; }

    // Any thread: copy the first `capacity` active alerts, the latest first; how many there are.
    size_t active(locus_alert *alerts, size_t capacity) const;
    uint64_t raised_ever() const;
    uint64_t bytes() const noexcept;

private:
    // A region that is active until it has calmed down, and then cools down.
    struct Reported {
        locus_alert alert;
        Quadrant quadrant;
        bool active;
        int64_t cool_from;
    };
    struct Candidate {
        Activity::Node node;
        uint32_t kind;
        double excess;
    };

    double threshold(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept;
    bool stands_out(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept;
    bool deepest(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept;
    void calm_down(const Activity &activity, int64_t now) noexcept;
    void find_candidates(const Activity &activity) noexcept;
    bool known(const Quadrant &quadrant, uint32_t kind) const noexcept;
    void describe(const Activity &activity, Activity::Node node, locus_alert &alert) const noexcept;
    void raise(const Activity &activity, const Candidate &candidate, int64_t now) noexcept;

    const locus_alerts_options options_;
    mutable std::mutex mutex_;       // of what follows
    std::vector<Reported> reported_; // the latest last
    uint64_t number_ = 0;
    std::vector<Candidate> candidates_;
    std::vector<locus_alert> raised_;
};

} // namespace locus::pmq
