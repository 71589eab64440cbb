// What the program prints.
#pragma once

#include "common/events.hpp"
#include "common/source.hpp"
#include "stream/view.hpp"
#include "stream/window.hpp"

#include <string>

namespace demo {

std::string time_text(int64_t microseconds); // 2026-03-21 18:05:09

// The largest place nearby, or the coordinates.
std::string place_text(const World &world, Position position);

// Rates, pauses, evictions and memory.
void print_summary(const Window &window, const Source &source, size_t batch, double seconds);

// The newest records in a box, and how many it holds.
void print_newest(const Window &window, const locus_box &box, size_t count);

// The best records at a place: near it, and young.
void print_best(const Window &window, Position at, const std::string &place, size_t count);

// For a window with a folder: it is restarted, and asked together with what has left it. Throws std::runtime_error,
// also where a record was lost.
void print_kept(Window &window, Position at, const std::string &place);

// The planted bursts as CSV: what an alert must find.
void write_events(const std::string &path, const std::vector<Event> &events);

} // namespace demo
