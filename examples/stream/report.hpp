// What the program prints.
#pragma once

#include "common/events.hpp"
#include "common/source.hpp"
#include "stream/view.hpp"
#include "stream/window.hpp"

#include <string>

namespace demo {

std::string time_text(int64_t microseconds); // 2026-03-21 18:05:09

// Rates, pauses, evictions and memory.
void print_summary(const Window &window, const Source &source, size_t batch, double seconds);

// The newest records in a box, and how many it holds.
void print_newest(const Window &window, const locus_box &box, size_t count);

void print_events(const std::vector<Event> &events);

// The planted bursts as CSV: what an alert must find.
void write_events(const std::string &path, const std::vector<Event> &events);

} // namespace demo
