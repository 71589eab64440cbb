// Reading the data files.
#include "common/world.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace demo {
namespace {

std::ifstream open_text(const std::string &path) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot read " + path + " (--data names the folder of places.tsv and land.txt)");
    return file;
}

Place parse_place(const std::string &line, const std::string &path) {
    Place place;
    std::istringstream fields(line);
    fields >> place.position.latitude >> place.position.longitude >> place.population >> place.country;
    fields.ignore(1);
    std::getline(fields, place.name);
    if (!fields)
        throw std::runtime_error(path + " holds a line that is no place: " + line);
    return place;
}

Ring parse_ring(const std::string &line) {
    Ring ring;
    std::istringstream numbers(line);
    int x = 0;
    int y = 0;
    for (int dx = 0, dy = 0; numbers >> dx >> dy;) {
        x += ring.empty() ? dx : dx - 36000 * static_cast<int>(std::lround(dx / 36000.0)); // the shorter way round
        y += dy;
        ring.push_back({y / 100.0, x / 100.0});
    }
    // A ring that begins beyond the antimeridian comes back to its lakes.
    double sum = 0;
    for (const Position &position : ring)
        sum += position.longitude;
    const double turn = 360 * std::round(sum / static_cast<double>(ring.size()) / 360);
    for (Position &position : ring)
        position.longitude -= turn;
    return ring;
}

bool same_letters(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char c, char d) { return lower(c) == lower(d); });
}

} // namespace

World load_world(const std::string &folder) {
    World world;
    std::string line;
    const std::string places = folder + "/places.tsv";
    for (std::ifstream file = open_text(places); std::getline(file, line);)
        if (!line.starts_with('#'))
            world.places.push_back(parse_place(line, places));
    for (std::ifstream file = open_text(folder + "/land.txt"); std::getline(file, line);)
        if (!line.starts_with('#'))
            world.land.push_back(parse_ring(line));
    if (world.places.empty() || world.land.empty())
        throw std::runtime_error(folder + ": no places or no land in it");
    return world;
}

const Place *find_place(const World &world, std::string_view name) {
    const auto found = std::find_if(world.places.begin(), world.places.end(),
                                    [&](const Place &place) { return same_letters(place.name, name); });
    return found == world.places.end() ? nullptr : &*found;
}

double distance_km(Position a, Position b) {
    constexpr double degree = std::numbers::pi / 180;
    const double height = std::sin((b.latitude - a.latitude) * degree / 2);
    const double width = std::sin((b.longitude - a.longitude) * degree / 2);
    const double square =
        height * height + std::cos(a.latitude * degree) * std::cos(b.latitude * degree) * width * width;
    return 2 * 6371.0 * std::asin(std::min(1.0, std::sqrt(square)));
}

} // namespace demo
