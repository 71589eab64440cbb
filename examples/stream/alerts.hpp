// The alerts found in a stream, and the planted bursts that they tell of.
#pragma once

#include "common/events.hpp"
#include "stream/window.hpp"

#include <locus/alerts.h>

#include <memory>
#include <vector>

namespace demo {

// Takes down the alerts with the default options, from its making on. It must outlive the window's changes.
class Watch {
public:
    explicit Watch(Window &window);
    Watch(const Watch &) = delete;
    Watch &operator=(const Watch &) = delete;

    const std::vector<locus_alert> &found() const { return found_; }

private:
    struct Destroy {
        void operator()(locus_alerts *alerts) const { locus_alerts_destroy(alerts); }
    };

    std::vector<locus_alert> found_;
    std::unique_ptr<locus_alerts, Destroy> alerts_;
};

// The alert tells of the burst: its region lies at the place, and it comes while the burst goes on.
bool tells_of(const locus_alert &alert, const Event &event);

// The planted bursts with the alerts that found them, and those that tell of nothing planted.
void print_bursts(const std::vector<Event> &events, const std::vector<locus_alert> &found, const World &world);

// The alerts of a stream of which no bursts are known.
void print_alerts(const std::vector<locus_alert> &found, const World &world);

} // namespace demo
