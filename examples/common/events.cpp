// Where and when the bursts are.
#include "common/events.hpp"

#include "common/texts.hpp"

#include <algorithm>
#include <cmath>

namespace demo {
namespace {

constexpr double minute = 60e6;
constexpr double apart_km = 400;

bool alone(const std::vector<Event> &events, const Place &place) {
    return std::all_of(events.begin(), events.end(), [&](const Event &event) {
        return distance_km(event.place->position, place.position) > apart_km;
    });
}

// Places of 250,000 people and more; where no free one is found soon, any will do.
const Place &choose_place(const World &world, const std::vector<Event> &events, Random &random) {
    const auto small = std::partition_point(world.places.begin(), world.places.end(),
                                            [](const Place &place) { return place.population >= 250'000; });
    const auto count = static_cast<size_t>(std::max<std::ptrdiff_t>(small - world.places.begin(), 1));
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const Place &place = world.places[random.below(count)];
        if (alone(events, place))
            return place;
    }
    return world.places[random.below(count)];
}

} // namespace

std::vector<Event> plan_events(const World &world, const EventPlan &plan, Random &random) {
    std::vector<Event> events;
    const double slot = static_cast<double>(plan.span) / static_cast<double>(std::max<size_t>(plan.count, 1));
    for (size_t i = 0; i < plan.count; ++i) {
        Event event;
        event.place = &choose_place(world, events, random);
        const double duration = std::min((15 + 30 * random.uniform()) * minute, 0.8 * slot);
        const double offset = (static_cast<double>(i) + 0.1 + 0.1 * random.uniform()) * slot;
        event.start = plan.start + static_cast<int64_t>(offset);
        event.duration = static_cast<int64_t>(duration);
        // Ten to twenty times what the place has in that time, and enough to be seen in a small place.
        const double usual =
            plan.posts * event.place->population / plan.population * duration / static_cast<double>(plan.span);
        event.posts = (1 + random.uniform()) * std::max({10 * usual, plan.posts / 2000, 15.0});
        event.kind = random.below(event_kinds);
        events.push_back(event);
    }
    return events;
}

// Linear rise over the first tenth, then an exponential decline with three time constants, scaled to 1.
double event_share(double fraction) {
    constexpr double rise = 0.1;
    constexpr double decline = 3 / (1 - rise);
    const double tail = (1 - std::exp(-3)) / decline;
    const double whole = rise / 2 + tail;
    const double at = std::clamp(fraction, 0.0, 1.0);
    if (at < rise)
        return at * at / (2 * rise) / whole;
    return (rise / 2 + (1 - std::exp(-decline * (at - rise))) / decline) / whole;
}

} // namespace demo
