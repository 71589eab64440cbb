// Tiles as pictures and as counts, and their legend.
#include "explorer/answers.hpp"
#include "explorer/selection.hpp"

#include <bit>
#include <cstdio>

namespace explorer {

const std::vector<std::string> map_names{"inferno", "magma", "viridis", "grey"};
const std::vector<std::string> scale_names{"log", "linear", "quantile"};

namespace {

constexpr demo::ColourMap maps[] = {demo::ColourMap::inferno, demo::ColourMap::magma, demo::ColourMap::viridis,
                                    demo::ColourMap::grey};
constexpr ScaleKind scales[] = {ScaleKind::log, ScaleKind::linear, ScaleKind::quantile};
constexpr uint32_t most_blur = 4;
constexpr int legend_stops = 9;
constexpr auto reference_life = std::chrono::seconds(2);

std::string hex(demo::Colour colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
    return text;
}

// One of the tags in If-None-Match, or any.
bool matches(const std::string &header, const std::string &tag) {
    return header == "*" || header.find(tag) != std::string::npos;
}

uint32_t log2_bins(Arguments &arguments) {
    const int64_t bins = arguments.integer("bins", 1, 256).value_or(256);
    if (!std::has_single_bit(static_cast<uint64_t>(bins)))
        throw Failure(400, "bins: " + std::to_string(bins) + " is no power of two");
    return static_cast<uint32_t>(std::countr_zero(static_cast<uint64_t>(bins)));
}

} // namespace

struct Answers::Look {
    explicit Look(Arguments &arguments)
        : map(arguments.word("map", map_names)),
          scale(arguments.word("scale", scale_names)), grain{log2_bins(arguments),
                                                             static_cast<uint32_t>(
                                                                 arguments.integer("blur", 0, most_blur).value_or(0))},
          high(arguments.number("high", 1e-3, 1e18)),
          window(arguments.text("from", "") + "_" + arguments.text("to", "") + "_" + arguments.text("last", "")) {}

    // What the heat depends on.
    std::string heat_key() const {
        return std::to_string(grain.log2_bins) + "_" + std::to_string(grain.blur) + "_" + window;
    }
    std::string key() const {
        char text[40] = "auto";
        if (high)
            std::snprintf(text, sizeof text, "%.17g", *high);
        return std::to_string(map) + "_" + std::to_string(scale) + "_" + text + "_" + heat_key();
    }

    size_t map, scale;
    Grain grain;
    std::optional<double> high;
    std::string window;
};

// Measured anew every few seconds, and then for all tiles of a version alike.
Reference Answers::reference(const Look &look, uint32_t zoom, const locus_pmq_query &query, uint64_t version) {
    const std::string key = std::to_string(zoom) + "/" + look.heat_key();
    const auto measured = references_.get(key, version, [&](const Measured *old) {
        const auto now = std::chrono::steady_clock::now();
        if (old != nullptr && now - old->when < reference_life)
            return *old;
        return Measured{reference_of(live_.store(), zoom, look.grain, query), now};
    });
    Reference reference = measured->reference;
    if (look.high)
        reference.high = *look.high;
    return reference;
}

Reply Answers::tile(const Request &request, const TilePlace &place, bool picture) {
    Arguments arguments(request);
    const uint64_t version = live_.version();
    const Selection selection(arguments, live_.now(), false);
    arguments.text("v", "");
    const std::string name = std::to_string(place.zoom) + "/" + std::to_string(place.x) + "/" + std::to_string(place.y);
    if (!picture) {
        const uint32_t bins = log2_bins(arguments);
        arguments.done();
        uint64_t total = 0;
        const auto counts = counts_of(live_.store(), place, bins, selection.query(), &total);
        Json json{{"z", place.zoom}, {"x", place.x}, {"y", place.y}, {"bins", 1u << bins}};
        json.update(head(version));
        json["total"] = total;
        json["counts"] = counts;
        return json_reply(json);
    }
    const Look look(arguments);
    arguments.done();
    const std::string key = name + "/" + look.key();
    const std::string tag =
        "\"" + boot_ + "-" + std::to_string(version) + "-" + std::to_string(std::hash<std::string>()(key)) + "\"";
    Reply reply;
    if (matches(request.header("if-none-match"), tag)) {
        reply.status = 304;
    } else {
        reply.type = "image/png";
        reply.body = pictures_.get(key, version, [&](const std::string *) {
            const Scale scale(scales[look.scale], look.grain, reference(look, place.zoom, selection.query(), version));
            const auto heat = heat_of(live_.store(), place, look.grain, selection.query());
            return tile_png(heat, look.grain, scale, maps[look.map]);
        });
    }
    reply.headers = {{"ETag", "W/" + tag}, {"Cache-Control", "no-cache"}, {"Locus-Version", std::to_string(version)}};
    return reply;
}

Reply Answers::scale(const Request &request) {
    Arguments arguments(request);
    const uint64_t version = live_.version();
    const Selection selection(arguments, live_.now(), false);
    const auto zoom = static_cast<uint32_t>(arguments.needed_integer("z", 0, 25));
    arguments.text("v", "");
    const Look look(arguments);
    arguments.done();
    const Scale scale(scales[look.scale], look.grain, reference(look, zoom, selection.query(), version));
    Json json{{"z", zoom},
              {"map", map_names[look.map]},
              {"scale", scale_names[look.scale]},
              {"bins", look.grain.bins()},
              {"blur", look.grain.blur}};
    json.update(head(version));
    json["low"] = scale.low();
    json["high"] = scale.high();
    json["stops"] = Json::array();
    for (int i = 0; i < legend_stops; ++i) {
        const double at = static_cast<double>(i) / (legend_stops - 1);
        json["stops"].push_back(
            {{"at", at}, {"value", scale.value(at)}, {"colour", hex(scale_colour(maps[look.map], at))}});
    }
    return json_reply(json);
}

} // namespace explorer
