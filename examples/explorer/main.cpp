// explorer: a live map over a stream, in the browser. See --help and docs/explorer.md.
#include "common/file_source.hpp"
#include "explorer/demo_source.hpp"
#include "explorer/options.hpp"
#include "explorer/routes.hpp"
#include "explorer/server.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

namespace explorer {
namespace {

constexpr double second = 1e6;
constexpr double megabyte = 1e6;
constexpr size_t spare_threads = 32; // beside those of the listeners

// Folders are where the repository or an installation has them, seen from the program: build/x/bin/explorer,
// prefix/bin/explorer.
std::string find_folder(const std::string &given, const std::string &in_tree, const std::string &installed) {
    if (!given.empty())
        return given;
    namespace fs = std::filesystem;
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path &folder :
         {program / ".." / ".." / ".." / in_tree, program / ".." / "share" / "locus" / installed})
        if (fs::is_directory(folder))
            return folder.lexically_normal().string();
    throw std::runtime_error("cannot find the folder " + in_tree + " beside the program " + program.string());
}

// SIGINT and SIGTERM are waited for by main alone; every thread made after this has them blocked.
sigset_t block_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return signals;
}

class Program {
public:
    explicit Program(const Options &options)
        : options_(options), pace_(pace_kind(), options.speed < 0 ? 1 : options.speed),
          world_(demo::load_world(find_folder(options.places, "examples/data", "places"))),
          assets_(find_folder(options.pages, "examples/explorer/static", "explorer")), live_(live_settings()),
          feed_(source_name(), source(), pace_, horizon()), answers_(live_, options.max_results),
          statistics_(live_, feed_, alerts_, counters_, statistics_settings()),
          events_(live_, statistics_, alerts_, counters_, options.listeners),
          ingest_(live_, token_of(options), loopback(options.bind)),
          routes_({loopback(options.bind), options.allow_origin}, answers_, events_, alerts_, statistics_, ingest_,
                  assets_, counters_),
          server_(
              server_settings(), [this](const Request &request) { return routes_.refusal(request); },
              [this](const Request &request) { return routes_.answer(request); }) {}

    void start() {
        server_.start();
        feed_.start(live_);
        std::printf("explorer: http://%s:%d  (%s)\n", options_.bind.c_str(), server_.port(), source_name().c_str());
        std::fflush(stdout);
    }

    // False: the source cannot be woken, and the program has to end without it.
    bool stop() {
        const bool woken = feed_.stop();
        events_.stop();
        server_.stop();
        live_.stop();
        return woken;
    }

private:
    bool replays() const { return !options_.file.input.empty(); }

    Pace::Kind pace_kind() const {
        if (!replays())
            return Pace::Kind::wall;
        const bool unpaced = options_.speed == 0 || (options_.speed < 0 && options_.file.input == "-");
        return unpaced ? Pace::Kind::records : Pace::Kind::replay;
    }

    int64_t horizon() const {
        return options_.horizon > 0 ? static_cast<int64_t>(options_.horizon * second) : LOCUS_NO_HORIZON;
    }

    LiveSettings live_settings() {
        const bool limited = options_.memory > 0;
        return {horizon(),
                limited ? static_cast<uint64_t>(options_.memory * megabyte) : LOCUS_NO_LIMIT,
                options_.data,
                options_.save,
                older_settings(),
                [this] { return pace_.now(); },
                [this](locus_pmq *store) { alerts_.watch(store); }};
    }

    std::optional<OlderSettings> older_settings() const {
        if (options_.keep <= 0)
            return std::nullopt;
        return OlderSettings{static_cast<int64_t>((options_.horizon + options_.keep) * second),
                             options_.keep_mb > 0 ? static_cast<uint64_t>(options_.keep_mb * megabyte)
                                                  : LOCUS_NO_LIMIT};
    }

    std::string source_name() const {
        if (options_.empty)
            return "ingest";
        if (!replays())
            return "demo stream";
        return options_.file.input == "-" ? "standard input"
                                          : std::filesystem::path(options_.file.input).filename().string();
    }

    Feed::Open source() {
        if (options_.empty)
            return nullptr;
        if (replays())
            return [this] {
                return std::make_unique<demo::FileSource>(options_.file.input, demo::reader_options(options_.file));
            };
        const double past = options_.prefill >= 0 ? options_.prefill : options_.horizon;
        return [this, past] {
            // What the folder has brought back is not made again.
            const int64_t start = std::max(wall_clock() - static_cast<int64_t>(past * second), live_.recovered());
            return std::make_unique<DemoSource>(world_, options_.rate, start, options_.seed);
        };
    }

    StatisticsSettings statistics_settings() const {
        return {options_.horizon, options_.keep, static_cast<uint64_t>(options_.memory * megabyte),
                options_.max_results, "places: GeoNames, CC BY 4.0"};
    }

    ServerSettings server_settings() const {
        ServerSettings settings;
        settings.bind = options_.bind;
        settings.port = options_.port;
        settings.threads = options_.listeners + spare_threads;
        settings.max_body = options_.max_body << 20;
        settings.request_seconds = options_.request_seconds;
        return settings;
    }

    Options options_;
    Pace pace_;
    demo::World world_;
    Assets assets_;
    AlertLog alerts_{world_}; // before live_: it watches to the end
    Counters counters_;
    Live live_;
    Feed feed_;
    Answers answers_;
    Statistics statistics_;
    Events events_;
    Ingest ingest_;
    Routes routes_;
    Server server_;
};

int run(const Options &options) {
    const sigset_t signals = block_signals();
    Program program(options);
    program.start();
    int signal = 0;
    sigwait(&signals, &signal);
    const bool whole = program.stop();
    std::printf("explorer: stopped\n");
    std::fflush(stdout);
    if (!whole)
        std::_Exit(0);
    return 0;
}

} // namespace
} // namespace explorer

int main(int argc, char **argv) {
    try {
        int status = 0;
        const auto options = explorer::parse_options(argc, argv, status);
        return options ? explorer::run(*options) : status;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "explorer: %s\n", error.what());
        return 1;
    }
}
