// Counts, records, top-k, nearest, aggregates.
#include "explorer/answers.hpp"

#include "explorer/groups.hpp"
#include "explorer/pages.hpp"
#include "explorer/words.hpp"

#include <cmath>
#include <cstring>
#include <numbers>

namespace explorer {
namespace {

constexpr int most_scans = 4;
constexpr size_t kept_pictures = 2000, kept_counts = 200, kept_peaks = 20, kept_references = 200, kept_groups = 100;
constexpr double second = 1e6;
constexpr size_t word_records = 20'000;

std::string_view text_of(const locus_text156 &record) {
    return {record.text, strnlen(record.text, sizeof record.text)};
}

Json record_json(const locus_text156 &record) {
    return {{"lat", float{record.latitude}},
            {"lon", float{record.longitude}},
            {"time", int64_t{record.time}},
            {"text", text_of(record)}};
}

// Haversine (Sinnott 1984), on the library's sphere.
double metres(double latitude, double longitude, const locus_text156 &record) {
    constexpr double degree = std::numbers::pi / 180;
    const double height = std::sin((record.latitude - latitude) * degree / 2);
    const double width = std::sin((record.longitude - longitude) * degree / 2);
    const double square =
        height * height + std::cos(latitude * degree) * std::cos(record.latitude * degree) * width * width;
    return 2 * LOCUS_EARTH_RADIUS * std::asin(std::min(1.0, std::sqrt(square)));
}

} // namespace

std::string json_text(const Json &json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Reply json_reply(const Json &json) { return text_reply("application/json", json_text(json)); }

Turns::Turn::Turn(Turns &turns) : left_(turns.left_) {
    if (left_.fetch_sub(1) > 0)
        return;
    left_.fetch_add(1);
    throw Failure(503, "too many long queries at once");
}

Answers::Answers(const Live &live, size_t max_results)
    : live_(live), max_results_(max_results), boot_(std::to_string(wall_clock())), turns_(most_scans),
      pictures_(kept_pictures, renewer_), counts_(kept_counts, renewer_), peaks_(kept_peaks, renewer_),
      references_(kept_references, renewer_), groups_(kept_groups, renewer_) {}

Json Answers::head(uint64_t version) const {
    const int64_t now = live_.now();
    return {{"version", version}, {"now", now == INT64_MIN ? Json() : Json(now)}};
}

Reply Answers::count(const Request &request) {
    Arguments arguments(request);
    Json json = head(live_.version());
    const Tiers tiers = tiers_of(arguments, live_);
    const Selection selection(arguments, live_.now(), true);
    arguments.done();
    std::optional<Turns::Turn> turn;
    if (tiers.older != nullptr)
        turn.emplace(turns_);
    json["count"] = count_records(tiers, selection.query());
    return json_reply(json);
}

Reply Answers::records(const Request &request) {
    Arguments arguments(request);
    Json json = head(live_.version());
    const Tiers tiers = tiers_of(arguments, live_);
    const Selection selection(arguments, live_.now(), true);
    const auto limit = arguments.integer("limit", 1, static_cast<int64_t>(max_results_)).value_or(100);
    const bool by_place = arguments.word("order", {"newest", "place"}) == 1;
    const std::string after = arguments.text("after", "");
    arguments.done();
    const Turns::Turn turn(turns_);
    const auto turned = by_place ? place_page : newest_page;
    const Page page = turned(tiers, selection.query(), std::min(static_cast<size_t>(limit), max_results_), after);
    json["records"] = Json::array();
    for (const locus_text156 &record : page.records)
        json["records"].push_back(record_json(record));
    json["next"] = page.next.empty() ? Json() : Json(page.next);
    return json_reply(json);
}

Reply Answers::topk(const Request &request) {
    Arguments arguments(request);
    Json json = head(live_.version());
    const Selection selection(arguments, live_.now(), false);
    locus_pmq_score score;
    check(locus_pmq_score_init(&score, sizeof score));
    score.latitude = arguments.needed_number("lat", -90, 90);
    score.longitude = arguments.needed_number("lon", -180, 180);
    const double half_globe = std::numbers::pi * LOCUS_EARTH_RADIUS;
    score.radius = arguments.number("radius", 1e-3, half_globe).value_or(score.radius);
    score.alpha = arguments.number("alpha", 0, 1).value_or(score.alpha);
    if (const auto period = arguments.number("period", 1e-6, 1e12))
        score.period = static_cast<int64_t>(*period * second);
    const auto k = static_cast<size_t>(arguments.integer("k", 1, static_cast<int64_t>(max_results_))
                                           .value_or(std::min<int64_t>(20, static_cast<int64_t>(max_results_))));
    arguments.done();
    std::vector<locus_text156> records(k);
    std::vector<double> scores(k);
    size_t found = 0;
    const int64_t now = live_.now();
    check(locus_pmq_topk(live_.store(), &score, &selection.query(), k, records.data(), scores.data(), &found));
    json["records"] = Json::array();
    for (size_t i = 0; i < found; ++i) {
        Json record = record_json(records[i]);
        record["score"] = scores[i];
        record["distance"] = metres(score.latitude, score.longitude, records[i]);
        record["age"] = static_cast<double>(now - records[i].time) / second;
        json["records"].push_back(std::move(record));
    }
    return json_reply(json);
}

Reply Answers::nearest(const Request &request) {
    Arguments arguments(request);
    Json json = head(live_.version());
    const Selection selection(arguments, live_.now(), false);
    const double latitude = arguments.needed_number("lat", -90, 90);
    const double longitude = arguments.needed_number("lon", -180, 180);
    const auto k = static_cast<size_t>(arguments.integer("k", 1, static_cast<int64_t>(max_results_))
                                           .value_or(std::min<int64_t>(20, static_cast<int64_t>(max_results_))));
    arguments.done();
    std::vector<locus_text156> records(k);
    std::vector<double> distances(k);
    size_t found = 0;
    check(locus_pmq_nearest(live_.store(), latitude, longitude, &selection.query(), k, records.data(), distances.data(),
                            &found));
    json["records"] = Json::array();
    for (size_t i = 0; i < found; ++i) {
        Json record = record_json(records[i]);
        record["distance"] = distances[i];
        json["records"].push_back(std::move(record));
    }
    return json_reply(json);
}

namespace {

Json by_time(const Tiers &tiers, const locus_pmq_query &query, double step) {
    uint64_t total = 0;
    Json groups = Json::array();
    for (const auto &[begin, count] : count_by_time(tiers, query, static_cast<int64_t>(step * second), total))
        groups.push_back({{"from", begin}, {"count", count}});
    return {{"by", "time"}, {"step", step}, {"total", total}, {"groups", std::move(groups)}};
}

Json by_cell(const Tiers &tiers, const locus_pmq_query &query, uint32_t zoom, size_t k) {
    uint64_t total = 0;
    Json groups = Json::array();
    for (const CellCount &cell : count_by_cell(tiers, query, zoom, k, total)) {
        const locus_box box = tile_box(zoom, cell.x, cell.y);
        groups.push_back({{"x", cell.x},
                          {"y", cell.y},
                          {"box", {{"south", box.south}, {"west", box.west}, {"north", box.north}, {"east", box.east}}},
                          {"count", cell.count}});
    }
    return {{"by", "cell"}, {"z", zoom}, {"total", total}, {"groups", std::move(groups)}};
}

Json by_word(const Tiers &tiers, const locus_pmq_query &query, size_t k) {
    const uint64_t total = count_records(tiers, query);
    Words words;
    for (const locus_text156 &record : newest_page(tiers, query, word_records, "").records)
        words.add(text_of(record));
    Json groups = Json::array();
    for (const auto &[word, count] : words.most(k))
        groups.push_back({{"word", word}, {"count", count}});
    return {{"by", "word"}, {"total", total}, {"groups", std::move(groups)}};
}

// The parameters as one text: the same answer has the same.
std::string key_of(const Request &request) {
    std::string key;
    for (const auto &[name, value] : request.params)
        key += std::to_string(name.size()) + name + std::to_string(value.size()) + "=" + value;
    return key;
}

} // namespace

Reply Answers::aggregate(const Request &request) {
    Arguments arguments(request);
    const uint64_t version = live_.version();
    const Tiers tiers = tiers_of(arguments, live_);
    const auto selection = std::make_shared<const Selection>(arguments, live_.now(), true);
    const size_t by = arguments.word("by", {"time", "cell", "word"});
    if (!arguments.has("by"))
        throw Failure(400, "by: missing (time, cell, word)");
    const double step = by == 0 ? arguments.needed_number("step", 1e-3, 1e9) : 0;
    const auto zoom = by == 1 ? static_cast<uint32_t>(arguments.needed_integer("z", 0, 25)) : 0;
    const auto k = by == 0 ? 0 : arguments.integer("k", 1, static_cast<int64_t>(max_results_)).value_or(20);
    arguments.done();
    const auto found = groups_.get(key_of(request), version, [=, this] {
        const Turns::Turn turn(turns_);
        Json json = by == 0   ? by_time(tiers, selection->query(), step)
                    : by == 1 ? by_cell(tiers, selection->query(), zoom, static_cast<size_t>(k))
                              : by_word(tiers, selection->query(), static_cast<size_t>(k));
        json.update(head(version));
        return Cache<std::string>::Made{json_text(json), version};
    });
    Reply reply = text_reply("application/json", "");
    reply.body = found.value;
    return reply;
}

} // namespace explorer
