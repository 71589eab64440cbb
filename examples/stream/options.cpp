// The command line, by CLI11.
#include "stream/options.hpp"

#include "common/command_line.hpp"

namespace demo {
namespace {

constexpr const char *about =
    "Replays a stream of geo-located records through the live window of a PMQ store, and draws it.\n"
    "Without --csv or --json the stream is simulated: posts at real places, by day and night, with planted bursts.\n\n"
    "  stream                                         a day of two million posts\n"
    "  stream --csv taxis.csv.zst --zoom-km 40        a file; columns time, lat, lon\n"
    "  zcat log.gz | stream --json - --text message   standard input, one JSON object a line\n";

void add_generator(CLI::App &app, Options &options) {
    const char *group = "Simulated stream";
    app.add_option("--posts", options.posts, "Posts, about; the bursts come on top")
        ->default_str("2000000")
        ->check(CLI::Range(1.0, 1e10))
        ->group(group);
    app.add_option("--hours", options.hours, "Hours that the stream lasts")
        ->check(CLI::Range(0.1, 8760.0))
        ->group(group);
    app.add_option("--seed", options.seed, "Seed: the same one gives the same stream")->group(group);
    app.add_option("--events", options.events, "Planted bursts")->check(CLI::Range(0, 1000))->group(group);
    app.add_option("--start", options.start, "Its first day, YYYY-MM-DD, UTC")->group(group);
}

void add_window(CLI::App &app, Options &options) {
    const char *group = "Window";
    app.add_option("--window", options.window_hours, "Hours that a record stays")
        ->check(CLI::Range(0.001, 1e6))
        ->group(group);
    app.add_option("--batch", options.batch, "Records inserted at once")
        ->check(CLI::Range(1, 10'000'000))
        ->group(group);
    app.add_option("--speed", options.speed, "Times real time; 0: as fast as it goes")
        ->check(CLI::NonNegativeNumber)
        ->group(group);
    add_choice<StoreLayout>(app, "--layout", options.layout,
                            {{"default", StoreLayout::usual},
                             {"ring", StoreLayout::ring_leaves},
                             {"array", StoreLayout::packed_array},
                             {"array-explicit", StoreLayout::packed_array_explicit},
                             {"array-heads", StoreLayout::packed_array_heads}},
                            "Layout of the store: ring leaves, the thesis' packed array, that with its explicit index, "
                            "or one with keys apart",
                            group);
}

void add_results(CLI::App &app, Options &options) {
    const char *group = "Results";
    app.add_option("--zoom", options.zoom, "What the second map shows: the name of a place, LAT,LON, or auto")
        ->group(group);
    app.add_option("--zoom-km", options.zoom_km, "Its width, kilometres; 0: chosen")
        ->check(CLI::Range(0.0, 20000.0))
        ->group(group);
    app.add_option("--newest", options.newest, "Records of that map to print, the newest ones")
        ->check(CLI::Range(0, 1'000'000))
        ->group(group);
    app.add_option("--best", options.best, "Records near its middle and young to print, the best ones")
        ->check(CLI::Range(0, 1'000'000))
        ->group(group);
    app.add_flag("--keep", options.keep,
                 "Keep what leaves the window in FOLDER/older.db; in the end save the window, load it again, ask both")
        ->group(group);
    app.add_option("--frames", options.frames, "Frames of the animation; 0: none")
        ->check(CLI::Range(0, 10'000))
        ->group(group);
    app.add_flag_callback(
           "--no-pictures", [&options] { options.pictures = false; }, "Draw nothing")
        ->group(group);
    app.add_option("--out", options.out, "Folder for the pictures")->type_name("FOLDER")->group(group);
    app.add_option("--data", options.data, "Folder of places.tsv and land.txt")->type_name("FOLDER")->group(group);
}

} // namespace

std::optional<Options> parse_options(int argc, char **argv, int &status) {
    Options options;
    CLI::App app(about, "stream");
    app.option_defaults()->always_capture_default();
    app.get_formatter()->column_width(34);
    add_generator(app, options);
    add_file_options(app, options.file, "Stream from a file");
    add_window(app, options);
    add_results(app, options);
    return parse(app, argc, argv, status) ? std::optional(options) : std::nullopt;
}

} // namespace demo
