// Statistics.
#include "explorer/statistics.hpp"

#include "explorer/selection.hpp"

#include <fstream>
#include <unistd.h>

namespace explorer {
namespace {

constexpr double microsecond = 1e3; // nanoseconds

uint64_t resident_bytes() {
    std::ifstream file("/proc/self/statm");
    uint64_t whole = 0, resident = 0;
    file >> whole >> resident;
    return resident * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

Json latency_json(const Histogram &histogram) {
    const auto us = [](uint64_t ns) { return static_cast<double>(ns) / microsecond; };
    if (histogram.count() == 0)
        return {{"p50", nullptr}, {"p99", nullptr}, {"max", nullptr}, {"mean", nullptr}, {"batches", 0}};
    return {{"p50", us(histogram.quantile(0.5))},
            {"p99", us(histogram.quantile(0.99))},
            {"max", us(histogram.longest())},
            {"mean", histogram.mean() / microsecond},
            {"batches", histogram.count()}};
}

// What has left the window; null where it is not kept.
Json older_json(const Older *older) {
    if (older == nullptr)
        return {};
    const locus_cold_stats stats = older->stats();
    return {{"records", stats.stored},
            {"bytes", stats.file_bytes},
            {"queued", stats.received - stats.written},
            {"taken", stats.received},
            {"removed", stats.removed},
            {"waits", stats.waits},
            {"error", stats.failure == LOCUS_OK ? Json() : Json(locus_status_name(stats.failure))}};
}

Json time_json(int64_t time) { return time == INT64_MIN || time == INT64_MAX ? Json() : Json(time); }

// Prometheus' text, version 0.0.4.
class Exposition {
public:
    void value(const char *name, const char *type, const char *help, double number) {
        head(name, type, help);
        line(name, "", number);
    }
    void histogram(const char *name, const char *help, const Histogram &histogram) {
        head(name, "histogram", help);
        const std::string bucket = std::string(name) + "_bucket";
        for (int power = 14; power <= 30; power += 2) { // 16 us to 1 s, where buckets of the histogram end
            char label[40];
            std::snprintf(label, sizeof label, "{le=\"%.9g\"}", static_cast<double>(uint64_t{1} << power) / 1e9);
            line(bucket, label, static_cast<double>(histogram.below(uint64_t{1} << power)));
        }
        line(bucket, "{le=\"+Inf\"}", static_cast<double>(histogram.count()));
        line(std::string(name) + "_sum", "", histogram.sum() / 1e9);
        line(std::string(name) + "_count", "", static_cast<double>(histogram.count()));
    }
    std::string text() const { return text_; }

private:
    void head(const std::string &name, const char *type, const char *help) {
        text_ += "# HELP " + name + " " + help + "\n# TYPE " + name + " " + type + "\n";
    }
    void line(const std::string &name, const std::string &labels, double number) {
        char text[40];
        std::snprintf(text, sizeof text, " %.17g\n", number);
        text_ += name + labels + text;
    }
    std::string text_;
};

} // namespace

Statistics::Statistics(const Live &live, const Feed &feed, const AlertLog &alerts, const Counters &counters,
                       StatisticsSettings settings)
    : live_(live), feed_(feed), alerts_(alerts), counters_(counters), settings_(std::move(settings)) {}

// To count the live records takes long where there are many.
locus_pmq_stats Statistics::figures() const {
    const std::lock_guard lock(mutex_);
    if (counting_.due())
        figures_ = counting_.spend([this] {
            locus_pmq_stats stats{};
            stats.struct_size = sizeof stats;
            check(locus_pmq_get_stats(live_.store(), &stats));
            return stats;
        });
    return figures_;
}

Json Statistics::stats() const {
    const uint64_t version = live_.version();
    const locus_pmq_stats store = figures();
    const FeedState feed = feed_.state();
    const std::chrono::duration<double> uptime = std::chrono::steady_clock::now() - begun_;
    int64_t oldest = live_.first();
    if (settings_.horizon > 0 && live_.now() != INT64_MIN)
        oldest = std::max(oldest, live_.now() - static_cast<int64_t>(settings_.horizon * 1e6));
    return {{"version", version},
            {"now", time_json(live_.now())},
            {"wall", wall_clock()},
            {"uptime", uptime.count()},
            {"records", store.records},
            {"oldest", store.records == 0 ? Json() : time_json(oldest)},
            {"bytes", store.bytes},
            {"resident", resident_bytes()},
            {"memory_limit", settings_.memory_limit == 0 ? Json() : Json(settings_.memory_limit)},
            {"inserted", store.inserted},
            {"evicted", store.evicted},
            {"batches", store.batches},
            {"refused", live_.refused()},
            {"queue", live_.queued()},
            {"rate", live_.rate()},
            {"insert", latency_json(live_.wall().minute())},
            {"insert_cpu", latency_json(live_.cpu().minute())},
            {"listeners", counters_.listeners.load()},
            {"requests", counters_.requests.load()},
            {"alerts", alerts_.last()},
            {"cold", older_json(live_.older())},
            {"save_error", live_.keeping().empty() ? Json() : Json(live_.keeping())},
            {"source",
             {{"name", feed.name},
              {"state", feed.state},
              {"fraction", feed.fraction < 0 ? Json() : Json(feed.fraction)},
              {"remarks", feed.remarks}}}};
}

Json Statistics::info() const {
    return {{"name", "Locus explorer"},
            {"library", locus_version_text()},
            {"horizon", settings_.horizon > 0 ? Json(settings_.horizon) : Json()},
            {"max_results", settings_.max_results},
            {"maps", map_names},
            {"scales", scale_names},
            {"max_zoom", 25},
            {"alerts", true},
            {"cold", live_.older() != nullptr},
            {"keep", settings_.keep > 0 ? Json(settings_.keep) : Json()},
            {"source", feed_.state().name},
            {"attribution", settings_.attribution}};
}

Reply Statistics::metrics() const {
    const locus_pmq_stats store = figures();
    const auto number = [](auto value) { return static_cast<double>(value); };
    Exposition out;
    out.value("locus_records", "gauge", "Live records.", number(store.records));
    out.value("locus_store_bytes", "gauge", "Memory of the store.", number(store.bytes));
    out.value("locus_resident_bytes", "gauge", "Memory of the process.", number(resident_bytes()));
    out.value("locus_inserted_total", "counter", "Records inserted.", number(store.inserted));
    out.value("locus_evicted_total", "counter", "Records that left the window.", number(store.evicted));
    out.value("locus_batches_total", "counter", "Batches inserted.", number(store.batches));
    out.value("locus_refused_total", "counter", "Batches the store did not take.", number(live_.refused()));
    out.value("locus_queued_batches", "gauge", "Batches that wait for the writer.", number(live_.queued()));
    if (const Older *older = live_.older()) {
        const locus_cold_stats cold = older->stats();
        out.value("locus_cold_records", "gauge", "Records in the database.", number(cold.stored));
        out.value("locus_cold_bytes", "gauge", "Size of the database.", number(cold.file_bytes));
        out.value("locus_cold_queued", "gauge", "Records that wait for it.", number(cold.received - cold.written));
        out.value("locus_cold_taken_total", "counter", "Records it has taken over.", number(cold.received));
        out.value("locus_cold_removed_total", "counter", "Records it has let go.", number(cold.removed));
        out.value("locus_cold_waits_total", "counter", "Times the writer waited for it.", number(cold.waits));
        out.value("locus_cold_failing", "gauge", "1: it cannot be written.", cold.failure == LOCUS_OK ? 0 : 1);
    }
    out.value("locus_version", "counter", "Version of the store.", number(live_.version()));
    out.value("locus_listeners", "gauge", "Event listeners.", number(counters_.listeners.load()));
    out.value("locus_requests_total", "counter", "Requests answered.", number(counters_.requests.load()));
    out.value("locus_failures_total", "counter", "Requests answered with an error.", number(counters_.failures.load()));
    out.histogram("locus_insert_seconds", "Time a batch takes.", live_.wall().all());
    out.histogram("locus_insert_cpu_seconds", "The writer's own time for a batch.", live_.cpu().all());
    out.histogram("locus_tile_seconds", "Time the answer to a tile takes.", counters_.tiles.all());
    return text_reply("text/plain; version=0.0.4; charset=utf-8", out.text());
}

Reply Statistics::health() const {
    const std::string failure = live_.failure();
    Json json{{"status", failure.empty() ? "ok" : "failed"}};
    if (!failure.empty())
        json["error"] = failure;
    if (const Older *older = live_.older()) {
        const int32_t reason = older->stats().failure;
        json["cold"] = reason == LOCUS_OK ? "ok" : locus_status_name(reason);
    }
    Reply reply = json_reply(json);
    reply.status = failure.empty() ? 200 : 503;
    return reply;
}

} // namespace explorer
