// Regions and time windows out of parameters.
#include "explorer/selection.hpp"

#include <locus/cold.h>

#include <algorithm>
#include <cmath>

namespace explorer {
namespace {

constexpr size_t most_positions = 1000;
constexpr double second = 1e6;
constexpr double longest = 1e11; // seconds: more than any time in microseconds

void inside(const std::string &name, double value, double bound) {
    if (std::abs(value) > bound)
        throw Failure(400, name + ": " + std::to_string(value) + " is outside -" + std::to_string(std::lround(bound)) +
                               ".." + std::to_string(std::lround(bound)));
}

void check(locus_status status, const char *(*reason)()) {
    if (status == LOCUS_OK)
        return;
    const bool theirs = status == LOCUS_E_ARGUMENT || status == LOCUS_E_RANGE;
    const bool busy = status == LOCUS_E_MEMORY || status == LOCUS_E_BUSY || status == LOCUS_E_STALE;
    throw Failure(theirs ? 400 : busy ? 503 : 500, reason());
}

} // namespace

void check(locus_status status) { check(status, locus_last_error); }

// LOCUS_E_STATE: the database is full of work, and what it is to take waits.
void check_cold(locus_status status) { check(status == LOCUS_E_STATE ? LOCUS_E_BUSY : status, locus_cold_last_error); }

Selection::Selection(Arguments &arguments, int64_t now, bool regions) {
    check(locus_pmq_query_init(&query_, sizeof query_));
    read_window(arguments, now);
    if (regions)
        read_region(arguments);
}

void Selection::read_window(Arguments &arguments, int64_t now) {
    const auto from = arguments.integer("from", INT64_MIN, INT64_MAX);
    const auto to = arguments.integer("to", INT64_MIN, INT64_MAX);
    const auto last = arguments.number("last", 0, longest);
    if (from && last)
        throw Failure(400, "last: from is given, too");
    query_.time_to = to.value_or(INT64_MAX);
    if (from)
        query_.time_from = *from;
    if (last) {
        const auto age = static_cast<int64_t>(*last * second);
        const int64_t end = std::min(now, query_.time_to);
        query_.time_from = end < INT64_MIN + age ? INT64_MIN : end - age;
    }
}

void Selection::read_region(Arguments &arguments) {
    const std::string box = arguments.text("box", "");
    const std::string circle = arguments.text("circle", "");
    const std::string polygon = arguments.text("polygon", "");
    if (arguments.has("box") + arguments.has("circle") + arguments.has("polygon") > 1)
        throw Failure(400, "box, circle, polygon: one of them at most");
    if (arguments.has("box")) {
        const auto values = arguments.numbers("box", box);
        if (values.size() != 4)
            throw Failure(400, "box: " + std::to_string(values.size()) + " numbers, not south,west,north,east");
        query_.region = LOCUS_REGION_BOX;
        query_.box = {values[0], values[1], values[2], values[3]};
        inside("box", values[0], 90), inside("box", values[2], 90);
        inside("box", values[1], 180), inside("box", values[3], 180);
        if (values[0] > values[2])
            throw Failure(400, "box: south is greater than north");
    }
    if (arguments.has("circle")) {
        const auto values = arguments.numbers("circle", circle);
        if (values.size() != 3)
            throw Failure(400, "circle: " + std::to_string(values.size()) + " numbers, not lat,lon,radius");
        query_.region = LOCUS_REGION_CIRCLE;
        query_.circle = {values[0], values[1], values[2]};
        inside("circle", values[0], 90), inside("circle", values[1], 180);
    }
    if (arguments.has("polygon"))
        read_polygon(arguments, polygon);
}

void Selection::read_polygon(Arguments &arguments, const std::string &text) {
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(';', begin), text.size());
        const auto values = arguments.numbers("polygon", text.substr(begin, end - begin));
        if (values.size() % 2 != 0 || values.size() < 6)
            throw Failure(400, "polygon: a ring of " + std::to_string(values.size()) +
                                   " numbers, not three or more pairs lat,lon");
        for (size_t i = 0; i < values.size(); i += 2)
            vertices_.push_back({values[i], values[i + 1]});
        ring_sizes_.push_back(values.size() / 2);
        if (vertices_.size() > most_positions)
            throw Failure(400, "polygon: more than " + std::to_string(most_positions) + " positions");
        begin = end + 1;
    }
    query_.region = LOCUS_REGION_POLYGON;
    query_.polygon = {vertices_.data(), ring_sizes_.data(), ring_sizes_.size()};
}

} // namespace explorer
