// The command line, by CLI11.
#include "explorer/options.hpp"

#include "common/command_line.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace explorer {
namespace {

constexpr const char *about =
    "Serves a live map over a stream of geo-located records: the last hours of it, while it keeps arriving.\n\n"
    "  explorer                                 a simulated stream, at http://127.0.0.1:8080\n"
    "  explorer --csv taxis.csv.zst --speed 60  a file, sixty times as fast as it happened\n"
    "  tail -f log | explorer --json -          standard input, one JSON object a line\n"
    "  explorer --empty                         what is posted to /ingest, nothing else\n";

void add_source(CLI::App &app, Options &options) {
    const char *group = "Source";
    app.add_flag("--demo", options.demo,
                 "The simulated stream, without end; what is taken where no other source is named")
        ->group(group);
    demo::add_file_options(app, options.file, group);
    CLI::Option *csv = app.get_option("--csv"), *json = app.get_option("--json");
    CLI::Option *empty =
        app.add_flag("--empty", options.empty, "No source but what is posted to /ingest")->group(group);
    CLI::Option *demo = app.get_option("--demo");
    for (CLI::Option *one : {csv, json, empty, demo})
        for (CLI::Option *other : {csv, json, empty, demo})
            if (one != other)
                one->excludes(other);
    app.add_option("--speed", options.speed, "A file: times real time; 0: as fast as it goes [1; standard input: 0]")
        ->default_str("")
        ->check(CLI::Range(0.0, 1e9))
        ->group(group);
    app.add_option("--rate", options.rate, "Demo stream: records a second")->check(CLI::Range(0.01, 1e6))->group(group);
    app.add_option("--prefill", options.prefill, "Demo stream: seconds of its past made at the start [the horizon]")
        ->default_str("")
        ->check(CLI::Range(0.0, 1e8))
        ->group(group);
    app.add_option("--seed", options.seed, "Demo stream: the same one gives the same stream")->group(group);
}

void add_window(CLI::App &app, Options &options) {
    const char *group = "Window";
    app.add_option("--horizon", options.horizon, "Seconds that a record stays; 0: for ever")
        ->check(CLI::Range(0.0, 1e11))
        ->group(group);
    app.add_option("--memory", options.memory,
                   "Most memory of the store, MB; beyond, the oldest records go; 0: no limit")
        ->check(CLI::Range(0.0, 1e7))
        ->group(group);
    CLI::Option *data = app.add_option("--data", options.data,
                                       "Folder that keeps the window over restarts: saved file and log of batches")
                            ->group(group);
    app.add_option("--save", options.save, "Seconds after which it is saved anew, and the log begun afresh")
        ->check(CLI::Range(1.0, 1e9))
        ->group(group);
    CLI::Option *keep =
        app.add_option("--keep", options.keep,
                       "Seconds that a record stays in the folder's database, older.db, after it has left the window; "
                       "0: it does not")
            ->check(CLI::Range(0.0, 1e11))
            ->needs(data)
            ->group(group);
    app.add_option("--keep-mb", options.keep_mb,
                   "Largest size of the database, MB, 10 or more; beyond, what came first goes; 0: no limit")
        ->check(CLI::IsMember({0.0}) | CLI::Range(10.0, 1e9))
        ->needs(keep)
        ->group(group);
}

void add_server(CLI::App &app, Options &options) {
    const char *group = "Server";
    app.add_option("--bind", options.bind, "Address to listen at")->group(group);
    app.add_option("--port", options.port, "Port; 0: any free one, which is printed")
        ->check(CLI::Range(0, 65535))
        ->group(group);
    app.add_option("--token", options.token,
                   "What a client must show to post records; others may see it among the processes")
        ->default_str("")
        ->group(group);
    app.add_option("--token-file", options.token_file, "The same from a file's first line [LOCUS_EXPLORER_TOKEN]")
        ->group(group);
    app.add_option("--max-body", options.max_body, "Largest body posted, MB")->check(CLI::Range(1, 1024))->group(group);
    app.add_option("--max-results", options.max_results, "Most records of an answer")
        ->check(CLI::Range(1, 100'000))
        ->group(group);
    app.add_option("--listeners", options.listeners, "Most event listeners")
        ->check(CLI::Range(1, 10'000))
        ->group(group);
    app.add_option("--request-seconds", options.request_seconds,
                   "A client that needs longer for a request and its answer is cut off")
        ->check(CLI::Range(0.1, 3600.0))
        ->group(group);
    app.add_option("--allow-origin", options.allow_origin, "Another site whose pages may read the answers, or *")
        ->group(group);
    app.add_option("--static", options.pages, "Folder of the page's files [beside the program]")->group(group);
    app.add_option("--places", options.places, "Folder of places.tsv and land.txt [beside the program]")->group(group);
}

} // namespace

std::optional<Options> parse_options(int argc, char **argv, int &status) {
    Options options;
    CLI::App app(about, "explorer");
    app.option_defaults()->always_capture_default();
    app.get_formatter()->column_width(34);
    add_source(app, options);
    add_window(app, options);
    add_server(app, options);
    return demo::parse(app, argc, argv, status) ? std::optional(options) : std::nullopt;
}

std::string token_of(const Options &options) {
    if (!options.token.empty())
        return options.token;
    std::string token;
    if (!options.token_file.empty()) {
        std::ifstream file(options.token_file);
        if (!std::getline(file, token) || token.empty())
            throw std::runtime_error("--token-file " + options.token_file + ": no token in its first line");
        return token;
    }
    const char *environment = std::getenv("LOCUS_EXPLORER_TOKEN");
    return environment == nullptr ? "" : environment;
}

} // namespace explorer
