// Watching, and telling what was found.
#include "stream/alerts.hpp"

#include "common/progress.hpp"
#include "common/texts.hpp"
#include "stream/report.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace demo {
namespace {

constexpr double at_place_km = 15;
constexpr size_t most_printed = 20;

int32_t take_down(const locus_alert *alert, void *found) {
    static_cast<std::vector<locus_alert> *>(found)->push_back(*alert);
    return 0;
}

Position centre(const locus_alert &alert) {
    return {(alert.box.south + alert.box.north) / 2, (alert.box.west + alert.box.east) / 2};
}

void print_alert(const locus_alert &alert, const World &world) {
    std::printf("  %s  %6.1f records/min, expected %.1f  near %s\n", time_text(alert.time).c_str(), alert.rate * 60,
                alert.expected * 60, place_text(world, centre(alert)).c_str());
}

void print_event(const Event &event, const locus_alert *alert) {
    std::printf("  %s  %3.0f min  %6.0f posts  %-10s  ", time_text(event.start).c_str(),
                static_cast<double>(event.duration) / 60e6, event.posts,
                std::string(event_kind_name(event.kind)).c_str());
    if (alert != nullptr)
        std::printf("alert after %2.0f min  ", static_cast<double>(alert->time - event.start) / 60e6);
    else
        std::printf("no alert            ");
    std::printf("%s, %s\n", event.place->name.c_str(), event.place->country.c_str());
}

} // namespace

Watch::Watch(Window &window) {
    locus_alerts_options options;
    check(locus_alerts_options_init(&options, sizeof options));
    options.alert = take_down;
    options.alert_user = &found_;
    locus_alerts *alerts = nullptr;
    check(locus_alerts_create(window.store(), &options, &alerts));
    alerts_.reset(alerts);
}

bool tells_of(const locus_alert &alert, const Event &event) {
    return distance_km(centre(alert), event.place->position) < at_place_km && alert.time >= event.start &&
           alert.time < event.start + event.duration;
}

void print_bursts(const std::vector<Event> &events, const std::vector<locus_alert> &found, const World &world) {
    std::vector<locus_alert> others = found;
    size_t seen = 0;
    std::printf("\nPlanted bursts, and when an alert found them:\n");
    for (const Event &event : events) {
        const auto of_it = [&](const locus_alert &alert) { return tells_of(alert, event); };
        const auto first = std::find_if(found.begin(), found.end(), of_it);
        print_event(event, first != found.end() ? &*first : nullptr);
        seen += first != found.end();
        std::erase_if(others, of_it);
    }
    std::printf("Alerts     %zu of %zu planted bursts found, %zu alerts beside them\n", seen, events.size(),
                others.size());
    for (const locus_alert &alert : others)
        print_alert(alert, world);
}

void print_alerts(const std::vector<locus_alert> &found, const World &world) {
    if (found.empty())
        return;
    const size_t shown = std::min(found.size(), most_printed);
    std::printf("\nAlerts, %s, places where far more came than before%s:\n", with_commas(found.size()).c_str(),
                shown < found.size() ? "; the first" : "");
    for (size_t i = 0; i < shown; ++i)
        print_alert(found[i], world);
}

} // namespace demo
