// A simulated stream of posts: places by their people, day and night by the sun, planted bursts.
#pragma once

#include "common/events.hpp"
#include "common/source.hpp"

namespace demo {

struct GeneratorSettings {
    uint64_t seed = 1;
    double posts = 0;  // about so many; the bursts come on top
    int64_t start = 0; // microseconds since the epoch
    int64_t span = 0;  // microseconds
    size_t events = 0;
};

class Generator : public Source {
public:
    // `world` must outlive the generator.
    Generator(const World &world, const GeneratorSettings &settings);

    void next(std::vector<locus_text156> &batch, size_t count) override;
    double fraction() const override;
    std::vector<std::string> remarks() const override { return {}; }

    const std::vector<Event> &events() const { return events_; }

private:
    // Places of one strip of longitudes, which have the same local time.
    struct Strip {
        std::vector<const Place *> places;
        std::vector<double> up_to; // running sum of their populations
    };
    // A post to be written: its time, and its event (or none).
    struct Arrival {
        int64_t time;
        const Event *event;
    };

    void begin_step();
    const Place &choose_place();
    locus_text156 write(const Arrival &arrival);
    double rate_of_strips(int64_t time);

    GeneratorSettings settings_;
    Random random_;
    std::vector<Strip> strips_;
    std::vector<double> strips_up_to_; // running sum of the strips' rates in the present step
    std::vector<double> day_;          // activity per minute of the local day
    std::vector<Event> events_;
    double posts_per_rate_ = 0;
    int64_t time_; // where the next step begins
    std::vector<Arrival> arrivals_;
    size_t next_arrival_ = 0;
};

// How much is posted at a local solar time (hours), on a day whose mean is about one half.
double activity(double hour);

} // namespace demo
