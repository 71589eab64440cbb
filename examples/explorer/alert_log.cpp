// Watching the stream.
#include "explorer/alert_log.hpp"

#include "explorer/pages.hpp"
#include "explorer/words.hpp"

#include <algorithm>
#include <cstring>

namespace explorer {
namespace {

constexpr size_t most_shown = 1000;
constexpr size_t read_records = 500; // for the words of an alert
constexpr size_t told_words = 3;
constexpr int64_t word_age = int64_t{300} * 1'000'000;
constexpr double nearby_km = 50;

const char *kind_name(uint32_t kind) {
    return kind == LOCUS_ALERT_JUMP ? "jump" : kind == LOCUS_ALERT_RATE ? "rate" : "share";
}

Json alert_json(const locus_alert &alert, const std::string &text) {
    const locus_box &box = alert.box;
    return {{"id", alert.number},
            {"kind", kind_name(alert.kind)},
            {"z", alert.zoom},
            {"x", alert.x},
            {"y", alert.y},
            {"box", {{"south", box.south}, {"west", box.west}, {"north", box.north}, {"east", box.east}}},
            {"rate", alert.rate},
            {"expected", alert.expected},
            {"time", alert.time},
            {"text", text}};
}

} // namespace

AlertLog::~AlertLog() { locus_alerts_destroy(alerts_); }

void AlertLog::watch(locus_pmq *store) {
    locus_alerts_options options;
    check(locus_alerts_options_init(&options, sizeof options));
    options.alert = raised;
    options.alert_user = this;
    check(locus_alerts_create(store, &options, &alerts_));
}

// By the writer: it only takes down what there is to tell.
int32_t AlertLog::raised(const locus_alert *alert, void *user) {
    auto &self = *static_cast<AlertLog *>(user);
    const std::lock_guard lock(self.mutex_);
    if (self.raised_.size() < most_shown)
        self.raised_.push_back(*alert);
    return 0;
}

void AlertLog::describe(const locus_pmq *store) {
    std::vector<locus_alert> raised;
    {
        const std::lock_guard lock(mutex_);
        raised.swap(raised_);
    }
    for (const locus_alert &alert : raised) {
        Json json = alert_json(alert, text_of(store, alert));
        const std::lock_guard lock(mutex_);
        shown_.push_back({alert.number, std::move(json)});
        if (shown_.size() > most_shown)
            shown_.pop_front();
        last_.store(alert.number, std::memory_order_release);
    }
}

std::vector<Json> AlertLog::since(uint64_t id, size_t limit) const {
    std::vector<Json> result;
    const std::lock_guard lock(mutex_);
    for (auto shown = shown_.rbegin(); shown != shown_.rend() && shown->id > id && result.size() < limit; ++shown)
        result.push_back(shown->json);
    std::reverse(result.begin(), result.end());
    return result;
}

// The words most used there lately, and the place.
std::string AlertLog::text_of(const locus_pmq *store, const locus_alert &alert) const {
    locus_pmq_query query;
    check(locus_pmq_query_init(&query, sizeof query));
    query.region = LOCUS_REGION_BOX;
    query.box = alert.box;
    query.time_from = alert.time - word_age;
    query.time_to = alert.time;
    Words words;
    for (const locus_text156 &record : newest_page(Tiers{store}, query, read_records, "").records)
        words.add({record.text, strnlen(record.text, sizeof record.text)});
    std::string text;
    for (const auto &[word, count] : words.most(told_words))
        text += (text.empty() ? "" : ", ") + word;
    if (const demo::Place *place = place_of(alert.box))
        text += (text.empty() ? "near " : " near ") + place->name;
    return text;
}

// The largest place in the box, or the nearest one around it; null: none nearby.
const demo::Place *AlertLog::place_of(const locus_box &box) const {
    const demo::Position middle{(box.south + box.north) / 2, (box.west + box.east) / 2};
    const demo::Place *nearest = nullptr;
    double least = nearby_km;
    for (const demo::Place &place : world_.places) {
        const demo::Position at = place.position;
        if (at.latitude >= box.south && at.latitude <= box.north && at.longitude >= box.west &&
            at.longitude <= box.east)
            return &place;
        const double km = demo::distance_km(at, middle);
        if (km < least) {
            least = km;
            nearest = &place;
        }
    }
    return nearest;
}

} // namespace explorer
