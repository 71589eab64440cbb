// The command line.
#pragma once

#include "common/file_options.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace explorer {

struct Options {
    // The source.
    demo::FileOptions file; // no input: the demo stream
    bool demo = false;      // asked for by name
    bool empty = false;
    double rate = 100;
    double prefill = -1; // seconds; negative: the horizon
    uint64_t seed = 1;
    double speed = -1; // negative: 1, and 0 for standard input

    // The window.
    double horizon = 10800; // seconds; 0: none
    double memory = 0;      // MB; 0: no limit
    std::string data;       // folder; empty: in memory alone
    double save = 600;      // seconds
    double keep = 0;        // seconds behind the horizon; 0: what leaves is let go
    double keep_mb = 0;     // MB; 0: no limit

    // The server.
    std::string bind = "127.0.0.1";
    int port = 8080;
    std::string token, token_file;
    size_t max_body = 16; // MB
    size_t max_results = 1000;
    size_t listeners = 128;
    double request_seconds = 30;
    std::string allow_origin;
    std::string pages, places; // folders; empty: found beside the program
};

// Nothing: `status` is what the program ends with at once (after --help, or an error that was printed).
std::optional<Options> parse_options(int argc, char **argv, int &status);

// The token that ingest asks for: from the command line, the file, or the environment. Throws std::runtime_error.
std::string token_of(const Options &options);

} // namespace explorer
