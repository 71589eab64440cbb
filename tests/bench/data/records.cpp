// The clustered generator and boxes in kilometres.
#include "tests/bench/data/records.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

namespace bench {
namespace {

struct City {
    double latitude, longitude, spread; // degrees
};

constexpr std::size_t city_count = 2000;

std::vector<City> cities(std::mt19937_64 &random) {
    std::vector<City> out(city_count);
    std::uniform_real_distribution<double> latitude(-50, 65), longitude(-175, 175), spread(0.03, 0.3);
    for (City &city : out) {
        city = {latitude(random), longitude(random), spread(random)};
    }
    return out;
}

/// Cumulated Zipf weights: the city of rank r has the weight 1/r.
std::vector<double> zipf() {
    std::vector<double> sums(city_count);
    double sum = 0;
    for (std::size_t rank = 0; rank < city_count; ++rank) {
        sums[rank] = sum += 1.0 / static_cast<double>(rank + 1);
    }
    return sums;
}

void fill(locus_point32 &record, double latitude, double longitude, uint64_t bits) {
    record = {latitude,
              longitude,
              record.time,
              static_cast<uint16_t>(bits & 15),
              static_cast<uint16_t>(bits >> 4 & 63),
              static_cast<uint16_t>(bits >> 10 & 31),
              0};
}

void fill(locus_text156 &record, double latitude, double longitude, uint64_t bits) {
    record.latitude = static_cast<float>(latitude);
    record.longitude = static_cast<float>(longitude);
    std::memset(record.text, 'a' + static_cast<int>(bits % 26), sizeof record.text);
    std::memcpy(record.text, &bits, sizeof bits);
}

} // namespace

template <class Record>
std::vector<Record> clustered(std::size_t count, std::size_t batch, uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::vector<City> places = cities(random);
    const std::vector<double> sums = zipf();
    std::uniform_real_distribution<double> pick(0, sums.back());
    std::normal_distribution<double> offset;
    std::vector<Record> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto rank = std::upper_bound(sums.begin(), sums.end(), pick(random)) - sums.begin();
        const City &city = places[std::min(static_cast<std::size_t>(rank), city_count - 1)];
        out[i].time = static_cast<int64_t>(i / batch) * second;
        fill(out[i], city.latitude + city.spread * offset(random),
             std::clamp(city.longitude + city.spread * offset(random), -180.0, 180.0), random());
    }
    return out;
}
template std::vector<locus_point32> clustered(std::size_t, std::size_t, uint64_t);
template std::vector<locus_text156> clustered(std::size_t, std::size_t, uint64_t);

void heaviest_city(double &latitude, double &longitude, uint64_t seed) {
    std::mt19937_64 random(seed);
    const City first = cities(random).front();
    latitude = first.latitude;
    longitude = first.longitude;
}

locus_box box_around(double latitude, double longitude, double radius_km) {
    constexpr double km_per_degree = 6371.0088 * std::numbers::pi / 180;
    const double dy = radius_km / km_per_degree;
    const double dx = dy / std::cos(latitude * std::numbers::pi / 180);
    return {std::max(latitude - dy, -90.0), std::max(longitude - dx, -180.0), std::min(latitude + dy, 90.0),
            std::min(longitude + dx, 180.0)};
}

} // namespace bench
