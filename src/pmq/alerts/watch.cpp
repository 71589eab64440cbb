// Thresholds, and one report for what lies together.
#include "pmq/alerts/watch.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace locus::pmq {
namespace {

constexpr size_t most_reported = 256;
constexpr size_t most_candidates = 4096; // of a batch; others have their turn with the next
constexpr double coarse = 6; // minima above what is expected for a jump of a region that is not of the finest
constexpr double calm = 0.5; // of the threshold

locus_box borders(const Quadrant &quadrant) noexcept {
    const double width = 360.0 / static_cast<double>(uint64_t{1} << quadrant.level);
    const double west = map_longitude(quadrant.x(), quadrant.level);
    return {map_latitude(quadrant.y() + 1, quadrant.level), west, map_latitude(quadrant.y(), quadrant.level),
            west + width};
}

// Does a region overlap another one or the eight of its size around it? Columns go on across the antimeridian.
bool touches(const Quadrant &one, const Quadrant &other) noexcept {
    struct Span {
        int64_t first, end;
    };
    const auto columns = [](const Quadrant &q) {
        const int64_t width = int64_t{1} << (key_levels - q.level), first = int64_t{q.x()} * width;
        return Span{first, first + width};
    };
    const auto rows = [](const Quadrant &q) {
        const int64_t width = int64_t{1} << (key_levels - q.level), first = int64_t{q.y()} * width;
        return Span{first, first + width};
    };
    const int64_t width = int64_t{1} << (key_levels - other.level);
    const auto overlap = [width](const Span &a, const Span &b, int64_t shift) {
        return a.first + shift < b.end + width && b.first - width < a.end + shift;
    };
    if (!overlap(rows(one), rows(other), 0))
        return false;
    const auto a = columns(one), b = columns(other);
    constexpr int64_t turn = int64_t{1} << key_levels;
    return overlap(a, b, 0) || overlap(a, b, turn) || overlap(a, b, -turn);
}

} // namespace

Watch::Watch(const locus_alerts_options &options) : options_(options) {
    reported_.reserve(most_reported);
    raised_.reserve(most_reported);
    candidates_.reserve(most_candidates);
}

// The present that a region needs.
double Watch::threshold(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept {
    switch (kind) {
    case LOCUS_ALERT_JUMP: {
        const Activity::Expected expected = activity.expected(node);
        const double least =
            activity.level(node) == options_.zoom_to ? options_.minimum : expected.mean + coarse * options_.minimum;
        return std::max(least, options_.factor * expected.most);
    }
    case LOCUS_ALERT_RATE:
        return std::max(options_.minimum, options_.rate * activity.seconds());
    default:
        return std::max(options_.minimum, options_.share * activity.present(Activity::root));
    }
}

bool Watch::stands_out(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept {
    const double present = activity.present(node);
    return present >= options_.minimum && present >= threshold(activity, node, kind);
}

bool Watch::deepest(const Activity &activity, Activity::Node node, uint32_t kind) const noexcept {
    const auto &children = activity.children(node);
    return std::none_of(children.begin(), children.end(), [&](Activity::Node child) {
        return child != Activity::none && stands_out(activity, child, kind);
    });
}

void Watch::look(const Activity &activity, int64_t now) {
    const std::lock_guard lock(mutex_);
    calm_down(activity, now);
    find_candidates(activity);
    raised_.clear();
    for (const Candidate &candidate : candidates_)
        if (reported_.size() < most_reported && !known(activity.quadrant(candidate.node), candidate.kind))
            raise(activity, candidate, now);
}

void Watch::calm_down(const Activity &activity, int64_t now) noexcept {
    for (Reported &one : reported_) {
        if (!one.active)
            continue;
        const Activity::Node node = activity.find(one.quadrant);
        if (node == Activity::none || activity.present(node) < calm * threshold(activity, node, one.alert.kind)) {
            one.active = false;
            one.cool_from = now;
        } else {
            describe(activity, node, one.alert);
        }
    }
    std::erase_if(reported_, [&](const Reported &one) {
        return !one.active && static_cast<uint64_t>(now) - static_cast<uint64_t>(one.cool_from) >=
                                  static_cast<uint64_t>(options_.cool_down);
    });
}

void Watch::find_candidates(const Activity &activity) noexcept {
    candidates_.clear();
    for (const Activity::Node node : activity.touched()) {
        const unsigned level = activity.level(node);
        if (level < options_.zoom_from || activity.present(node) < options_.minimum)
            continue;
        for (const uint32_t kind :
             std::initializer_list<uint32_t>{LOCUS_ALERT_JUMP, LOCUS_ALERT_RATE, LOCUS_ALERT_SHARE})
            if (candidates_.size() < most_candidates && stands_out(activity, node, kind) &&
                deepest(activity, node, kind))
                candidates_.push_back({node, kind, activity.present(node) - activity.expected(node).mean});
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate &a, const Candidate &b) {
        return a.excess != b.excess ? a.excess > b.excess : a.node < b.node;
    });
}

bool Watch::known(const Quadrant &quadrant, uint32_t kind) const noexcept {
    return std::any_of(reported_.begin(), reported_.end(),
                       [&](const Reported &one) { return one.alert.kind == kind && touches(quadrant, one.quadrant); });
}

void Watch::describe(const Activity &activity, Activity::Node node, locus_alert &alert) const noexcept {
    alert.records = activity.present(node);
    alert.rate = alert.records / activity.seconds();
    alert.expected = activity.expected(node).mean / activity.seconds();
    alert.share = alert.records / activity.present(Activity::root);
}

void Watch::raise(const Activity &activity, const Candidate &candidate, int64_t now) noexcept {
    const Quadrant quadrant = activity.quadrant(candidate.node);
    locus_alert alert{};
    alert.number = ++number_;
    alert.kind = candidate.kind;
    alert.zoom = quadrant.level;
    alert.x = quadrant.x();
    alert.y = quadrant.y();
    alert.box = borders(quadrant);
    alert.time = now;
    describe(activity, candidate.node, alert);
    reported_.push_back({alert, quadrant, true, 0});
    raised_.push_back(alert);
}

size_t Watch::active(locus_alert *alerts, size_t capacity) const {
    const std::lock_guard lock(mutex_);
    size_t count = 0;
    for (auto one = reported_.rbegin(); one != reported_.rend(); ++one) {
        if (!one->active)
            continue;
        if (count < capacity)
            alerts[count] = one->alert;
        ++count;
    }
    return count;
}

uint64_t Watch::raised_ever() const {
    const std::lock_guard lock(mutex_);
    return number_;
}

uint64_t Watch::bytes() const noexcept {
    return most_reported * (sizeof(Reported) + sizeof(locus_alert)) + most_candidates * sizeof(Candidate);
}

} // namespace locus::pmq
