// Which views, and what is written on them.
#include "stream/pictures.hpp"

#include "common/progress.hpp"
#include "common/texts.hpp"
#include "stream/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace demo {
namespace {

constexpr int zoom_width = 1000;
constexpr int zoom_height = 720;
constexpr uint32_t frame_level = 10; // the world is 1024 pixels wide
constexpr uint32_t world_level = 11;
constexpr double local_km = 300;   // records within this extent lie close together
constexpr size_t candidates = 200; // places that a zoom may have in its middle
constexpr double wide_km = 900;    // the zoom's width where they do not

// Where the records lie: the middle, and the extent of nine tenths of them.
struct Extent {
    Position middle;
    double km = 0;
};

std::optional<Extent> extent_of(const locus_pmq *store) {
    struct Lists {
        std::vector<float> latitudes, longitudes;
    } lists;
    const auto keep = [](const void *record, void *user) -> int32_t {
        const auto *post = static_cast<const locus_text156 *>(record);
        static_cast<Lists *>(user)->latitudes.push_back(post->latitude);
        static_cast<Lists *>(user)->longitudes.push_back(post->longitude);
        return 0;
    };
    check(locus_pmq_visit(store, nullptr, keep, &lists));
    if (lists.latitudes.empty())
        return std::nullopt;
    const auto part = [](std::vector<float> &list, double share) {
        const auto place = list.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(list.size() - 1));
        std::nth_element(list.begin(), place, list.end());
        return static_cast<double>(*place);
    };
    const Position south_west{part(lists.latitudes, 0.05), part(lists.longitudes, 0.05)};
    const Position north_east{part(lists.latitudes, 0.95), part(lists.longitudes, 0.95)};
    return Extent{{part(lists.latitudes, 0.5), part(lists.longitudes, 0.5)}, distance_km(south_west, north_east)};
}

uint64_t count_in(const View &view, const locus_pmq *store) {
    locus_pmq_query query;
    check(locus_pmq_query_init(&query, sizeof query));
    query.region = LOCUS_REGION_BOX;
    query.box = box_of(view);
    uint64_t count = 0;
    check(locus_pmq_count(store, &query, &count));
    return count;
}

Position parse_position(const World &world, const std::string &zoom) {
    Position position;
    char end = 0;
    if (std::sscanf(zoom.c_str(), "%lf,%lf%c", &position.latitude, &position.longitude, &end) == 2) {
        if (!(std::abs(position.latitude) <= 90 && std::abs(position.longitude) <= 180))
            throw std::runtime_error("--zoom " + zoom + ": latitudes are -90..90, longitudes -180..180");
        return position;
    }
    const Place *place = find_place(world, zoom);
    if (place == nullptr)
        throw std::runtime_error("--zoom " + zoom + ": no such place; its name, or LAT,LON, or auto");
    return place->position;
}

} // namespace

Pictures::Pictures(const World &world, PictureSettings settings) : world_(world), settings_(std::move(settings)) {
    if (settings_.zoom != "auto")
        parse_position(world_, settings_.zoom); // an error now rather than at the end
    if (!settings_.draw)
        return;
    std::error_code failed;
    std::filesystem::create_directories(settings_.folder + "/frames", failed);
    if (failed)
        throw std::runtime_error("cannot make " + settings_.folder + ": " + failed.message());
    for (const auto &file : std::filesystem::directory_iterator(settings_.folder + "/frames"))
        if (file.path().filename().string().starts_with("frame-"))
            std::filesystem::remove(file.path(), failed);
}

template <typename Work>
void Pictures::guarded(Work work) {
    if (!settings_.draw || !error_.empty())
        return;
    try {
        work();
    } catch (const std::exception &failure) {
        error_ = failure.what();
    }
}

// The planted bursts that show in the window.
std::vector<Event> Pictures::events_in(const Window &window) const {
    std::vector<Event> found;
    for (const Event &event : settings_.events)
        if (event.start < window.clock() && event.start + event.duration > window.clock() - settings_.horizon)
            found.push_back(event);
    return found;
}

void Pictures::choose_zoom(const Window &window) {
    const std::optional<Extent> extent = extent_of(window.store());
    local_ = extent && extent->km < local_km;
    double km = settings_.zoom_km > 0 ? settings_.zoom_km : wide_km;
    const auto view_of = [&](Position middle) { return zoom_view(middle, km, zoom_width, zoom_height); };
    Position centre;
    if (settings_.zoom != "auto") {
        centre = parse_position(world_, settings_.zoom);
    } else if (local_) {
        centre = extent->middle;
        if (settings_.zoom_km == 0)
            km = std::max(2.0, 1.2 * extent->km);
    } else {
        if (extent)
            centre = extent->middle;
        uint64_t most = 0; // around a large place: the one with the most records around
        for (size_t i = 0; i < std::min(candidates, world_.places.size()); ++i) {
            const Position place = world_.places[i].position;
            const uint64_t count = count_in(view_of(place), window.store());
            if (count > most)
                centre = place;
            most = std::max(most, count);
        }
    }
    zoom_ = view_of(centre);
    middle_ = centre;
}

MapText Pictures::text_of(const Window &window, const std::string &what) const {
    MapText text;
    const double hours = static_cast<double>(settings_.horizon) / 3.6e9;
    char span[40];
    std::snprintf(span, sizeof span, "%g", hours);
    text.title = what + " of the last " + span + " hours";
    text.clock = window.clock();
    if (window.clock() != INT64_MIN)
        text.subtitle = time_text(window.clock() - settings_.horizon) + " .. " + time_text(window.clock()) + " UTC";
    for (const Event &event : events_in(window)) {
        const std::string kind(event_kind_name(event.kind));
        text.labels.push_back({event.place->position, event.place->name + ": " + kind, true});
    }
    return text;
}

// The largest places in the view.
void Pictures::add_places(const View &view, MapText &text) const {
    size_t left = 30;
    for (const Place &place : world_.places) {
        const double x = view.x(place.position.longitude), y = view.y(place.position.latitude);
        if (x < 0 || y < 0 || x >= view.width || y >= view.height)
            continue;
        text.labels.push_back({place.position, place.name, false});
        if (--left == 0)
            break;
    }
}

Canvas Pictures::draw(const View &view, const Window &window, bool places) const {
    const std::vector<uint32_t> counts = counts_of(view, window.store());
    uint64_t shown = 0;
    for (const uint32_t count : counts)
        shown += count;
    MapText text = text_of(window, with_commas(shown) + " records");
    text.solar_hours = !places && window.clock() != INT64_MIN;
    if (text.solar_hours)
        text.subtitle += ", and the local solar time";
    if (places)
        add_places(view, text);
    return draw_map(view, world_, counts, text);
}

void Pictures::frame(const Window &window) {
    guarded([&] {
        if (!frame_view_) {
            choose_zoom(window);
            frame_view_ = local_ ? *zoom_ : world_view(frame_level);
        }
        const std::vector<uint8_t> png = encode_png(draw(*frame_view_, window, local_), map_colours());
        char name[32];
        std::snprintf(name, sizeof name, "/frames/frame-%04zu.png", animation_.frames() + 1);
        write_file(settings_.folder + name, png.data(), png.size());
        animation_.add(png);
    });
}

void Pictures::finish(const Window &window) {
    choose_zoom(window);
    const auto keep = [&](const char *name, const Canvas &picture, const std::string &about) {
        write_png(settings_.folder + name, picture);
        files_.push_back(settings_.folder + name + "  " + about);
    };
    guarded([&] { keep("/world.png", draw(world_view(world_level), window, false), "the world"); });
    guarded([&] { keep("/zoom.png", draw(*zoom_, window, true), "closer"); });
    guarded([&] {
        if (animation_.frames() == 0)
            return;
        animation_.write(settings_.folder + "/window.png", 150);
        files_.push_back(settings_.folder + "/window.png  the moving window, animated (a browser plays it); its " +
                         std::to_string(animation_.frames()) + " frames are in frames/");
    });
}

} // namespace demo
