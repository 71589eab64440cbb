// Arrivals step by step: a Poisson number of posts per minute, each at a place drawn for its share of the moment.
#include "common/generator.hpp"

#include "common/texts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace demo {
namespace {

constexpr int64_t minute = 60'000'000;
constexpr size_t strip_count = 144; // 2.5 degrees, ten minutes of solar time
constexpr size_t day_minutes = 1440;

size_t strip_of(double longitude) {
    const double place = (longitude + 180) / 360 * static_cast<double>(strip_count);
    return std::min(strip_count - 1, static_cast<size_t>(std::max(0.0, place)));
}

// The local solar time of a strip, in minutes of the day.
size_t local_minute(int64_t time, size_t strip) {
    const auto utc = static_cast<size_t>(time / minute % static_cast<int64_t>(day_minutes));
    return (utc + strip * (day_minutes / strip_count) + day_minutes / 2) % day_minutes;
}

// Draw an index by a running sum of weights.
size_t draw(const std::vector<double> &up_to, Random &random) {
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), random.uniform() * up_to.back());
    return static_cast<size_t>(std::min(found, up_to.end() - 1) - up_to.begin());
}

// A larger place is wider: about 1 km for 10,000 people, 8 km for 10 million.
double spread_km(const Place &place) { return 0.9 * std::pow(place.population / 1e4, 0.32); }

Position scatter(Position centre, double km, Random &random) {
    constexpr double degree_km = 111.2;
    const double latitude = std::clamp(centre.latitude + km / degree_km * random.normal(), -89.9, 89.9);
    const double shrink = std::max(0.01, std::cos(latitude * std::numbers::pi / 180));
    const double longitude = centre.longitude + km / degree_km / shrink * random.normal();
    return {latitude, std::remainder(longitude, 360.0)};
}

double share_between(const Event &event, int64_t from, int64_t to) {
    const auto part = [&](int64_t time) {
        return static_cast<double>(time - event.start) / static_cast<double>(event.duration);
    };
    return event_share(part(to)) - event_share(part(from));
}

} // namespace

// A low at four in the morning, a rise at breakfast, noon, and the peak of the evening.
double activity(double hour) {
    const auto bump = [hour](double centre, double width) {
        const double away = std::remainder(hour - centre, 24.0) / width;
        return std::exp(-away * away / 2);
    };
    return 0.06 + 0.45 * bump(8.5, 1.6) + 0.75 * bump(13, 2.6) + bump(20.5, 2.3);
}

Generator::Generator(const World &world, const GeneratorSettings &settings)
    : settings_(settings), random_(settings.seed), strips_(strip_count), strips_up_to_(strip_count), day_(day_minutes),
      time_(settings.start) {
    for (size_t i = 0; i < day_minutes; ++i)
        day_[i] = activity(static_cast<double>(i) / 60);
    double population = 0;
    for (const Place &place : world.places) {
        Strip &strip = strips_[strip_of(place.position.longitude)];
        strip.places.push_back(&place);
        strip.up_to.push_back((strip.up_to.empty() ? 0 : strip.up_to.back()) + place.population);
        population += place.population;
    }
    double whole = 0;
    for (int64_t time = settings.start; time < settings.start + settings.span; time += minute)
        whole += rate_of_strips(time);
    posts_per_rate_ = settings.posts / whole;
    events_ = plan_events(world, {settings.events, settings.start, settings.span, settings.posts, population}, random_);
}

// Sets strips_up_to_ for the minute at `time`; the sum.
double Generator::rate_of_strips(int64_t time) {
    double sum = 0;
    for (size_t i = 0; i < strip_count; ++i) {
        if (!strips_[i].places.empty())
            sum += strips_[i].up_to.back() * day_[local_minute(time, i)];
        strips_up_to_[i] = sum;
    }
    return sum;
}

void Generator::begin_step() {
    arrivals_.clear();
    next_arrival_ = 0;
    const int64_t end = std::min(time_ + minute, settings_.start + settings_.span);
    const auto add = [&](double mean, const Event *event) {
        for (uint64_t i = random_.poisson(mean); i > 0; --i) {
            const double part = random_.uniform() * static_cast<double>(end - time_);
            arrivals_.push_back({time_ + static_cast<int64_t>(part), event});
        }
    };
    add(posts_per_rate_ * rate_of_strips(time_), nullptr);
    for (const Event &event : events_) {
        const double posts = event.posts * share_between(event, time_, end);
        if (posts > 0)
            add(posts, &event);
    }
    std::stable_sort(arrivals_.begin(), arrivals_.end(),
                     [](const Arrival &a, const Arrival &b) { return a.time < b.time; });
    time_ = end;
}

const Place &Generator::choose_place() {
    const Strip &strip = strips_[draw(strips_up_to_, random_)];
    return *strip.places[draw(strip.up_to, random_)];
}

locus_text156 Generator::write(const Arrival &arrival) {
    const Place &place = arrival.event != nullptr ? *arrival.event->place : choose_place();
    const double tail = std::exp(0.5 * random_.normal()); // some live far out
    const double km = arrival.event != nullptr ? event_spread_km : spread_km(place) * tail;
    const Position position = scatter(place.position, km, random_);
    locus_text156 post{static_cast<float>(position.latitude), static_cast<float>(position.longitude), arrival.time, {}};
    if (arrival.event != nullptr)
        write_event_post(post.text, sizeof post.text, place.country, place.name, arrival.event->kind, random_);
    else {
        const size_t minute_of_day = local_minute(arrival.time, strip_of(place.position.longitude));
        write_post(post.text, sizeof post.text, place.country, place.name, static_cast<int>(minute_of_day / 60),
                   random_);
    }
    return post;
}

void Generator::next(std::vector<locus_text156> &batch, size_t count) {
    batch.clear();
    while (batch.size() < count) {
        if (next_arrival_ < arrivals_.size())
            batch.push_back(write(arrivals_[next_arrival_++]));
        else if (time_ < settings_.start + settings_.span)
            begin_step();
        else
            return;
    }
}

double Generator::fraction() const {
    return static_cast<double>(time_ - settings_.start) / static_cast<double>(settings_.span);
}

} // namespace demo
