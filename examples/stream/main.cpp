// stream: a stream of geo-located records through a six-hour window, measured, queried and drawn. See --help.
#include "common/file_source.hpp"
#include "common/generator.hpp"
#include "common/progress.hpp"
#include "stream/alerts.hpp"
#include "stream/options.hpp"
#include "stream/pictures.hpp"
#include "stream/report.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <thread>

namespace demo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double hour = 3600e6; // microseconds

int64_t parse_day(const std::string &text) {
    int year = 0;
    unsigned month = 0, day = 0;
    char end = 0;
    const bool read = std::sscanf(text.c_str(), "%d-%u-%u%c", &year, &month, &day, &end) == 3;
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    if (!read || !date.ok() || year < 1970 || year > 9999)
        throw std::runtime_error("--start " + text + ": a day such as 2026-03-21");
    return std::chrono::microseconds(std::chrono::sys_days(date).time_since_epoch()).count();
}

GeneratorSettings generator_settings(const Options &options) {
    return {options.seed, options.posts, parse_day(options.start), static_cast<int64_t>(options.hours * hour),
            options.events};
}

// Holds a replay back to `speed` times real time.
class Pace {
public:
    explicit Pace(double speed) : speed_(speed) {}
    void wait(int64_t clock) {
        if (speed_ == 0)
            return;
        if (first_ == INT64_MIN)
            first_ = clock;
        const std::chrono::duration<double> due(static_cast<double>(clock - first_) / 1e6 / speed_);
        std::this_thread::sleep_until(begin_ + std::chrono::duration_cast<Clock::duration>(due));
    }

private:
    double speed_;
    int64_t first_ = INT64_MIN;
    Clock::time_point begin_ = Clock::now();
};

// Tells when the next frame of the animation is due: evenly over the stream, or over its times where its end is not
// known.
class FrameTimes {
public:
    FrameTimes(size_t frames, double horizon) : frames_(static_cast<double>(frames)), step_(horizon / 12) {}
    bool due(double fraction, int64_t clock) {
        if (frames_ == 0)
            return false;
        double place = fraction * frames_;
        if (fraction < 0) {
            if (first_ == INT64_MIN)
                first_ = clock;
            place = std::min(frames_, static_cast<double>(clock - first_) / step_);
        }
        if (place < next_)
            return false;
        next_ = std::floor(place) + 1;
        return true;
    }

private:
    double frames_;
    double step_;
    double next_ = 1;
    int64_t first_ = INT64_MIN;
};

void replay(const Options &options, Source &source, Window &window, Pictures &pictures) {
    Progress progress("stream");
    Pace pace(options.speed);
    FrameTimes frames(options.frames, options.window_hours * hour);
    std::vector<locus_text156> batch;
    const auto begin = Clock::now();
    uint64_t total = 0;
    const auto note = [&] {
        const std::chrono::duration<double> taken = Clock::now() - begin;
        return with_commas(total) + " records, " +
               with_commas(static_cast<uint64_t>(static_cast<double>(total) / std::max(1e-9, taken.count()))) + "/s";
    };
    for (source.next(batch, options.batch); !batch.empty(); source.next(batch, options.batch)) {
        window.insert(batch);
        total += batch.size();
        pace.wait(window.clock());
        progress.at(source.fraction(), note());
        if (frames.due(source.fraction(), window.clock()))
            pictures.frame(window);
    }
    window.sweep();
    progress.done(note());
}

void print_files(const std::vector<std::string> &files) {
    if (files.empty())
        return;
    std::printf("\nWritten:\n");
    for (const std::string &file : files)
        std::printf("  %s\n", file.c_str());
}

// 0, or 1 where the stream was absorbed but a picture could not be written.
int run(const Options &options) {
    const auto begin = Clock::now();
    const World world = load_world(options.data);
    std::unique_ptr<Source> source;
    std::vector<Event> events; // none are known of a file
    if (options.file.input.empty()) {
        auto generator = std::make_unique<Generator>(world, generator_settings(options));
        events = generator->events();
        source = std::move(generator);
    } else {
        source = std::make_unique<FileSource>(options.file.input, reader_options(options.file));
    }
    const auto horizon = static_cast<int64_t>(options.window_hours * hour);
    Window window(horizon, options.layout, options.keep ? options.out : "");
    const Watch watch(window);
    Pictures pictures(world, {options.out, options.zoom, options.zoom_km, horizon, events, options.pictures});

    std::string stopped; // why the stream ended early; what came before is shown all the same
    try {
        replay(options, *source, window, pictures);
    } catch (const std::exception &error) {
        stopped = error.what();
    }
    pictures.finish(window);
    std::vector<std::string> files = pictures.files();
    std::string failed = pictures.error();
    if (!events.empty() && options.pictures && failed.empty()) {
        try {
            write_events(options.out + "/events.csv", events);
            files.push_back(options.out + "/events.csv  the planted bursts");
        } catch (const std::exception &error) {
            failed = error.what();
        }
    }
    const std::chrono::duration<double> taken = Clock::now() - begin;
    print_summary(window, *source, options.batch, taken.count());
    if (options.newest > 0)
        print_newest(window, box_of(pictures.zoom()), options.newest);
    const Position at = pictures.middle();
    const std::string place = place_text(world, at);
    if (options.best > 0 && window.stats().inserted > 0)
        print_best(window, at, place, options.best);
    if (!events.empty())
        print_bursts(events, watch.found(), world);
    else
        print_alerts(watch.found(), world);
    if (options.keep) {
        try {
            print_kept(window, at, place);
            files.push_back(options.out + "/window.pmq  the window, saved");
            files.push_back(options.out + "/older.db  what had left it, an SQLite database");
        } catch (const std::exception &error) {
            failed = error.what();
        }
    }
    print_files(files);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw std::runtime_error("cannot write the summary");
    if (!stopped.empty())
        std::fprintf(stderr, "stream: the stream stopped early: %s\n", stopped.c_str());
    if (!failed.empty())
        std::fprintf(stderr, "stream: not all could be written: %s\n", failed.c_str());
    return stopped.empty() && failed.empty() ? 0 : 1;
}

} // namespace
} // namespace demo

int main(int argc, char **argv) {
    try {
        int status = 0;
        const auto options = demo::parse_options(argc, argv, status);
        return options ? demo::run(*options) : status;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "stream: %s\n", error.what());
        return 1;
    }
}
