// The command line.
#pragma once

#include "common/file_options.hpp"
#include "stream/window.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace demo {

struct Options {
    // The generator.
    double posts = 2e6;
    double hours = 24;
    uint64_t seed = 1;
    size_t events = 12;
    std::string start = "2026-03-21";

    FileOptions file; // instead

    // The window.
    double window_hours = 6;
    size_t batch = 1000;
    double speed = 0; // times real time; 0: as fast as it goes
    StoreLayout layout = StoreLayout::usual;

    // What is shown.
    std::string zoom = "auto";
    double zoom_km = 0; // 0: chosen
    size_t newest = 10;
    size_t best = 5;
    bool keep = false;
    size_t frames = 48;
    bool pictures = true;
    std::string out = "build/demo/stream";
    std::string data = "examples/data";
};

// Nothing: `status` is what the program ends with at once (after --help, or an error that was printed).
std::optional<Options> parse_options(int argc, char **argv, int &status);

} // namespace demo
