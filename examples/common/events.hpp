// Planted bursts: at a place, for a while, far more posts than usual. They are what an alert must find: those, and no
// others.
#pragma once

#include "common/random.hpp"
#include "common/world.hpp"

#include <cstdint>

namespace demo {

struct Event {
    const Place *place = nullptr;
    int64_t start = 0;    // microseconds since the epoch
    int64_t duration = 0; // microseconds
    double posts = 0;     // expected, beyond the usual ones
    size_t kind = 0;      // see event_kind_name()
};

constexpr double event_spread_km = 1.5; // standard deviation of the posts' positions

struct EventPlan {
    size_t count;
    int64_t start;     // of the stream, microseconds
    int64_t span;      // of the stream, microseconds
    double posts;      // of the whole stream
    double population; // of all places together
};

// Events spread evenly over the stream, at large places that are far from each other, in order of their start.
std::vector<Event> plan_events(const World &world, const EventPlan &plan, Random &random);

// The share of an event's posts that lie in its first `fraction` (0..1): a steep rise, then a slow decline.
double event_share(double fraction);

} // namespace demo
