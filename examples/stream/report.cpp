// Summaries.
#include "stream/report.hpp"

#include "common/canvas.hpp"
#include "common/progress.hpp"
#include "common/texts.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>

namespace demo {
namespace {

constexpr double kept_radius = 30000; // metres
constexpr double nearby_km = 30;

std::string rate_text(double per_second) {
    char text[40];
    if (per_second >= 1e6)
        std::snprintf(text, sizeof text, "%.2f million", per_second / 1e6);
    else
        std::snprintf(text, sizeof text, "%s", with_commas(static_cast<uint64_t>(per_second)).c_str());
    return text;
}

// A record's text on one line of a terminal: no control characters.
std::string printable(const char (&text)[140]) {
    std::string line(text, strnlen(text, sizeof text));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }, ' ');
    return line;
}

struct Newest {
    size_t count;
    uint64_t seen = 0;
    std::vector<locus_text156> heap; // the oldest of them in front
};

bool newer(const locus_text156 &a, const locus_text156 &b) { return a.time > b.time; }

int32_t keep_newest(const void *record, void *user) {
    auto &newest = *static_cast<Newest *>(user);
    const auto &post = *static_cast<const locus_text156 *>(record);
    ++newest.seen;
    if (newest.heap.size() == newest.count && (newest.count == 0 || !newer(post, newest.heap.front())))
        return 0;
    if (newest.heap.size() == newest.count) {
        std::pop_heap(newest.heap.begin(), newest.heap.end(), newer);
        newest.heap.pop_back();
    }
    newest.heap.push_back(post);
    std::push_heap(newest.heap.begin(), newest.heap.end(), newer);
    return 0;
}

void print_waits(const Waits &waits, double records, double insert_seconds) {
    if (waits.times == 0) {
        std::printf("Database   never waited for\n");
        return;
    }
    std::printf("Database   waited for %s times, %s in all, longest %s; with that %s records/s\n",
                with_commas(waits.times).c_str(), duration_text(waits.seconds).c_str(),
                duration_text(waits.longest).c_str(), rate_text(records / (insert_seconds + waits.seconds)).c_str());
}

std::string quoted(const std::string &text) {
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

} // namespace

std::string time_text(int64_t microseconds) {
    using namespace std::chrono;
    const sys_time<std::chrono::microseconds> time{std::chrono::microseconds(microseconds)};
    const sys_days day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(floor<seconds>(time - day));
    char text[64];
    std::snprintf(text, sizeof text, "%04d-%02u-%02u %02d:%02d:%02d", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                  static_cast<int>(clock.seconds().count()));
    return text;
}

std::string place_text(const World &world, Position position) {
    for (const Place &place : world.places)
        if (distance_km(place.position, position) < nearby_km)
            return place.name + ", " + place.country;
    char text[40];
    std::snprintf(text, sizeof text, "%.3f, %.3f", position.latitude, position.longitude);
    return text;
}

void print_summary(const Window &window, const Source &source, size_t batch, double seconds) {
    const locus_pmq_stats stats = window.stats();
    const Latencies pause = window.latencies();
    std::printf("\nRecords    %s in %s, reading and drawing included\n", with_commas(stats.inserted).c_str(),
                duration_text(seconds).c_str());
    for (const std::string &remark : source.remarks())
        std::printf("           %s\n", remark.c_str());
    if (stats.inserted == 0) {
        std::printf("           The stream is empty.\n");
        return;
    }
    if (window.late() > 0)
        std::printf("           %s were older than the window when they came\n", with_commas(window.late()).c_str());
    if (window.ahead() > 0)
        std::printf("           %s had times far ahead of their neighbours', which were set to the clock\n",
                    with_commas(window.ahead()).c_str());
    std::printf("Insertion  %s records/s: %s for %s batches of %s\n",
                rate_text(static_cast<double>(stats.inserted) / window.insert_seconds()).c_str(),
                duration_text(window.insert_seconds()).c_str(), with_commas(stats.batches).c_str(),
                with_commas(batch).c_str());
    std::printf("Pauses     p50 %s, p99 %s, longest %s per batch\n", duration_text(pause.middle).c_str(),
                duration_text(pause.p99).c_str(), duration_text(pause.longest).c_str());
    if (window.keeps())
        print_waits(window.waits(), static_cast<double>(stats.inserted), window.insert_seconds());
    std::printf("Window     %s records live, %s evicted; the clock is %s UTC\n", with_commas(stats.records).c_str(),
                with_commas(stats.evicted).c_str(), time_text(window.clock()).c_str());
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("Memory     %s for the store (density %.2f), %s for the program at most\n",
                bytes_text(stats.bytes).c_str(), stats.density,
                bytes_text(static_cast<uint64_t>(usage.ru_maxrss) * 1024).c_str());
}

void print_newest(const Window &window, const locus_box &box, size_t count) {
    locus_pmq_query query;
    check(locus_pmq_query_init(&query, sizeof query));
    query.region = LOCUS_REGION_BOX;
    query.box = box;
    Newest newest{count, 0, {}};
    const auto begin = std::chrono::steady_clock::now();
    check(locus_pmq_visit(window.store(), &query, keep_newest, &newest));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    std::sort_heap(newest.heap.begin(), newest.heap.end(), newer);
    std::printf(
        "\nThe box of the zoom, %.3f..%.3f north, %.3f..%.3f east, holds %s records (read in %s). The newest:\n",
        box.south, box.north, box.west, box.east, with_commas(newest.seen).c_str(),
        duration_text(taken.count()).c_str());
    for (const locus_text156 &post : newest.heap)
        std::printf("  %s  %9.4f %9.4f  %s\n", time_text(post.time).c_str(), static_cast<double>(post.latitude),
                    static_cast<double>(post.longitude), printable(post.text).c_str());
}

void print_best(const Window &window, Position at, const std::string &place, size_t count) {
    locus_pmq_score score;
    check(locus_pmq_score_init(&score, sizeof score));
    score.latitude = at.latitude;
    score.longitude = at.longitude;
    std::vector<locus_text156> best(count);
    std::vector<double> scores(count);
    size_t found = 0;
    const auto begin = std::chrono::steady_clock::now();
    check(locus_pmq_topk(window.store(), &score, nullptr, count, best.data(), scores.data(), &found));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    std::printf("\nThe best around %s, near and young (found in %s):\n", place.c_str(),
                duration_text(taken.count()).c_str());
    if (found == 0)
        std::printf("  none within %.0f km and the last %.0f hours\n", score.radius / 1000,
                    static_cast<double>(score.period) / 3600e6);
    for (size_t i = 0; i < found; ++i) {
        const Position there{static_cast<double>(best[i].latitude), static_cast<double>(best[i].longitude)};
        std::printf("  score %.3f  %5.1f km  %s  %s\n", scores[i], distance_km(at, there),
                    time_text(best[i].time).c_str(), printable(best[i].text).c_str());
    }
}

void print_kept(Window &window, Position at, const std::string &place) {
    const uint64_t before = window.count_both(nullptr);
    const Restart restart = window.restart();
    const uint64_t after = window.count_both(nullptr);
    if (after != before)
        throw std::runtime_error("the restart: " + with_commas(before) + " records before, " + with_commas(after) +
                                 " after");
    const locus_cold_stats older = window.cold_stats();
    std::printf("\nRestart    %s records (%s) saved in %s and loaded in %s; %s older ones in SQLite (%s)\n",
                with_commas(restart.records).c_str(), bytes_text(restart.bytes).c_str(),
                duration_text(restart.saving).c_str(), duration_text(restart.loading).c_str(),
                with_commas(older.stored).c_str(), bytes_text(older.file_bytes).c_str());
    locus_pmq_query query;
    check(locus_pmq_query_init(&query, sizeof query));
    query.region = LOCUS_REGION_CIRCLE;
    query.circle = {at.latitude, at.longitude, kept_radius};
    uint64_t live = 0;
    check(locus_pmq_count(window.store(), &query, &live));
    const auto begin = std::chrono::steady_clock::now();
    const uint64_t both = window.count_both(&query);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    std::printf(
        "Both tiers %s records within %.0f km around %s since the stream began, %s of them live (counted in %s)\n",
        with_commas(both).c_str(), kept_radius / 1000, place.c_str(), with_commas(live).c_str(),
        duration_text(taken.count()).c_str());
}

void write_events(const std::string &path, const std::vector<Event> &events) {
    std::ostringstream table;
    table.precision(9);
    table << "start,end,lat,lon,spread_km,posts,kind,country,place\n";
    const auto iso = [](int64_t time) {
        std::string text = time_text(time) + "Z";
        text[10] = 'T';
        return text;
    };
    for (const Event &event : events)
        table << iso(event.start) << ',' << iso(event.start + event.duration) << ',' << event.place->position.latitude
              << ',' << event.place->position.longitude << ',' << event_spread_km << ',' << std::lround(event.posts)
              << ',' << event_kind_name(event.kind) << ',' << event.place->country << ',' << quoted(event.place->name)
              << '\n';
    const std::string text = table.str();
    write_file(path, text.data(), text.size());
}

} // namespace demo
