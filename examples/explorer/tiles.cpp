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

std::string hex(demo::Colour colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
    return text;
}

// One of the tags in If-None-Match, or any.
bool matches(const std::string &header, const std::string &tag) {
    return header == "*" || header.find(tag) != std::string::npos;
}

std::string place_key(const TilePlace &place) {
    return std::to_string(place.zoom) + "/" + std::to_string(place.x) + "/" + std::to_string(place.y);
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

// Counts take the longest by far, and all looks of a tile share them.
Cache<std::vector<uint32_t>>::Found Answers::counts(const TilePlace &place, uint32_t log2_bins, const Ask &ask) {
    const std::string key = place_key(place) + "/" + std::to_string(log2_bins) + "/" + ask.window;
    return counts_.get(key, ask.version, [=, this] {
        return Cache<std::vector<uint32_t>>::Made{counts_of(live_.store(), place, log2_bins, ask.query), ask.version};
    });
}

std::vector<float> Answers::heat(const std::vector<uint32_t> &counts, const TilePlace &place, const Grain &grain,
                                 const Ask &ask) const {
    return heat_of(counts, place, grain, [&](const TilePlace &square, uint32_t log2_bins) {
        return counts_of(live_.store(), square, log2_bins, ask.query);
    });
}

Reference Answers::reference(const Look &look, uint32_t zoom, const Ask &ask) {
    Reference reference;
    if (scales[look.scale] == ScaleKind::quantile || !look.high) {
        const auto found = references_.get(std::to_string(zoom) + "/" + look.heat_key(), ask.version, [=, this] {
            const auto peaks = peaks_.get(look.window, ask.version, [=, this] {
                const Count count = [&](const TilePlace &place, uint32_t log2_bins) {
                    return *counts(place, log2_bins, ask).value;
                };
                return Cache<Peaks>::Made{peaks_of(count), ask.version};
            });
            const TilePlace peak = (*peaks.value)[zoom];
            const auto counted = counts(peak, look.grain.log2_bins, ask);
            return Cache<Reference>::Made{reference_of(heat(*counted.value, peak, look.grain, ask), look.grain),
                                          ask.version};
        });
        reference = *found.value;
    }
    if (look.high)
        reference.high = *look.high;
    return reference;
}

Cache<std::string>::Made Answers::picture(const Look &look, const TilePlace &place, const Ask &ask) {
    const Scale scale(scales[look.scale], look.grain, reference(look, place.zoom, ask));
    const auto counted = counts(place, look.grain.log2_bins, ask);
    const auto values = heat(*counted.value, place, look.grain, ask);
    return {tile_png(values, look.grain, scale, maps[look.map]), counted.version};
}

Reply Answers::tile(const Request &request, const TilePlace &place, bool drawn) {
    Arguments arguments(request);
    const uint64_t version = live_.version();
    const Selection selection(arguments, live_.now(), false);
    arguments.text("v", "");
    if (!drawn) {
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
    const std::string key = place_key(place) + "/" + look.key();
    const Ask ask{selection.query(), look.window, version};
    const auto found = pictures_.get(key, version, [=, this] { return picture(look, place, ask); });
    const std::string shown = std::to_string(found.version);
    const std::string tag = "\"" + boot_ + "-" + shown + "-" + std::to_string(std::hash<std::string>()(key)) + "\"";
    Reply reply;
    if (matches(request.header("if-none-match"), tag)) {
        reply.status = 304;
    } else {
        reply.type = "image/png";
        reply.body = found.value;
    }
    reply.headers = {{"ETag", "W/" + tag}, {"Cache-Control", "no-cache"}, {"Locus-Version", shown}};
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
    const Scale scale(scales[look.scale], look.grain, reference(look, zoom, {selection.query(), look.window, version}));
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
