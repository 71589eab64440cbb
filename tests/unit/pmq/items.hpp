// Records for the tests: items with an identity, in either layout, at ordinary and at extreme places.
#pragma once

#include <locus/pmq.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

namespace locus::test {

struct Item {
    double latitude = 0, longitude = 0;
    int64_t time = 0;
    uint64_t id = 0;
    uint64_t key = 0;
};

// Items to a store's records and back; the id travels in the fields that are the caller's.
inline std::vector<unsigned char> pack(const std::vector<Item> &items, uint32_t format) {
    std::vector<unsigned char> bytes(items.size() * format);
    for (size_t i = 0; i < items.size(); ++i) {
        const Item &item = items[i];
        unsigned char *to = bytes.data() + i * format;
        if (format == LOCUS_RECORD_POINT32) {
            locus_point32 record{item.latitude, item.longitude, item.time, 0, 0, 0, 0};
            std::memcpy(&record.device, &item.id, sizeof item.id);
            std::memcpy(to, &record, sizeof record);
        } else {
            locus_text156 record{static_cast<float>(item.latitude), static_cast<float>(item.longitude), item.time, {}};
            std::memcpy(record.text, &item.id, sizeof item.id);
            std::memset(record.text + 100, static_cast<int>(item.id % 251), 40);
            std::memcpy(to, &record, sizeof record);
        }
    }
    return bytes;
}

inline Item unpack(const void *bytes, uint32_t format) {
    Item item;
    if (format == LOCUS_RECORD_POINT32) {
        locus_point32 record;
        std::memcpy(&record, bytes, sizeof record);
        item = {record.latitude, record.longitude, record.time, 0, 0};
        std::memcpy(&item.id, &record.device, sizeof item.id);
    } else {
        locus_text156 record;
        std::memcpy(&record, bytes, sizeof record);
        item = {record.latitude, record.longitude, record.time, 0, 0};
        std::memcpy(&item.id, record.text, sizeof item.id);
        if (static_cast<unsigned char>(record.text[139]) != item.id % 251)
            item.id = UINT64_MAX; // torn
    }
    return item;
}

// Draws places: clustered, uniform, a few places over and over, and the edges of the map.
class Places {
public:
    explicit Places(uint64_t seed) : random(seed) {}

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
    uint64_t below(uint64_t end) { return std::uniform_int_distribution<uint64_t>(0, end - 1)(random); }
    bool chance(double probability) { return uniform(0, 1) < probability; }

    // Coordinates a float can hold, so that both layouts keep them.
    Item place() {
        float latitude, longitude; // no double is rounded in place: g++ 12 leaves that out where it vectorizes
        switch (below(8)) {
        case 0:
            latitude = static_cast<float>(uniform(-90, 90));
            longitude = static_cast<float>(uniform(-180, 180));
            break;
        case 1: { // airports
            const auto airport = static_cast<float>(below(5));
            latitude = 10 + airport * 7;
            longitude = -100 + airport * 31;
            break;
        }
        case 2: {
            static constexpr float latitudes[] = {-90,      90,        0, 85.0511287798066F, -85.0511287798066F,
                                                  85.0512F, -85.0512F, 89};
            static constexpr float longitudes[] = {-180, 180, 0, 179.99999F, -179.99999F, 90};
            latitude = latitudes[below(8)];
            longitude = longitudes[below(6)];
            break;
        }
        default:
            latitude = static_cast<float>(48 + std::normal_distribution<double>(0, 0.3)(random));
            longitude = static_cast<float>(2 + std::normal_distribution<double>(0, 0.3)(random));
        }
        Item item;
        item.latitude = latitude;
        item.longitude = longitude;
        return item;
    }

    locus_box box() {
        if (chance(0.1))
            return {-90, -180, 90, 180};
        const Item a = place(), b = place();
        locus_box box{a.latitude < b.latitude ? a.latitude : b.latitude, a.longitude,
                      a.latitude < b.latitude ? b.latitude : a.latitude, b.longitude};
        if (chance(0.3)) {
            box.north = box.south + 0.01 < 90 ? box.south + 0.01 : 90;
            box.east = box.west;
        }
        return box; // as likely across the antimeridian as not
    }

    std::mt19937_64 random;
};

// The oracle for boxes: borders included; 180 and -180 are one meridian.
inline bool in_box(const locus_box &box, const Item &item) {
    if (item.latitude < box.south || item.latitude > box.north)
        return false;
    auto inside = [&](double l) {
        if (box.west <= box.east)
            return l >= box.west && l <= box.east;
        return l >= box.west || l <= box.east;
    };
    if (inside(item.longitude))
        return true;
    return (item.longitude == 180 && inside(-180)) || (item.longitude == -180 && inside(180));
}

// The law of haversines, in long double.
inline long double haversine(double latitude, double longitude, const Item &item) {
    const auto radians = [](long double degrees) { return degrees * std::numbers::pi_v<long double> / 180; };
    const auto half = [](long double angle) { return std::sin(angle / 2) * std::sin(angle / 2); };
    const long double a = radians(latitude), b = radians(item.latitude);
    const long double h =
        half(b - a) + std::cos(a) * std::cos(b) * half(radians((long double)item.longitude - longitude));
    return 2 * LOCUS_EARTH_RADIUS * std::asin(std::sqrt(std::min(h, 1.0L)));
}

} // namespace locus::test
