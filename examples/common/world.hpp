// What the world looks like: places with their people, and land.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace demo {

struct Position {
    double latitude = 0;
    double longitude = 0;
};

struct Place {
    Position position;
    double population = 0;
    std::string country; // ISO 3166, two letters
    std::string name;
};

// A closed line around land, or around a lake in it. Across the antimeridian its longitudes go on beyond 180 or -180.
using Ring = std::vector<Position>;

struct World {
    std::vector<Place> places; // the largest first
    std::vector<Ring> land;
};

// Read places.tsv and land.txt in `folder`. Throws std::runtime_error.
World load_world(const std::string &folder);

// The largest place of that name (ASCII letters in either case); null: there is none.
const Place *find_place(const World &world, std::string_view name);

// Kilometres along the great circle.
double distance_km(Position a, Position b);

} // namespace demo
