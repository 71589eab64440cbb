// The command line, by CLI11.
#include "stream/options.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace demo {
namespace {

constexpr const char *about =
    "Replays a stream of geo-located records through the live window of a PMQ store, and draws it.\n"
    "Without --csv or --json the stream is simulated: posts at real places, by day and night, with planted bursts.\n\n"
    "  stream                                         a day of two million posts\n"
    "  stream --csv taxis.csv.zst --zoom-km 40        a file; columns time, lat, lon\n"
    "  zcat log.gz | stream --json - --text message   standard input, one JSON object a line\n";

template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// An option that takes one of some words; the first one is the default.
template <typename Value>
void add_choice(CLI::App &app, const char *name, Value &value, const Choices<Value> &choices, const char *text,
                const char *group) {
    std::vector<std::string> words;
    for (const auto &[word, number] : choices)
        words.push_back(word);
    const auto choose = [&value, choices](const std::string &chosen) {
        for (const auto &[word, number] : choices)
            if (word == chosen)
                value = number;
    };
    app.add_option_function<std::string>(name, choose, text)
        ->check(CLI::IsMember(words))
        ->type_name("")
        ->default_str(words.front())
        ->group(group);
}

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

void add_file(CLI::App &app, Options &options) {
    const char *group = "Stream from a file";
    const auto input = [&app, &options, group](const char *name, uint32_t format, const char *text) {
        return app
            .add_option_function<std::string>(
                name,
                [&options, format](const std::string &path) {
                    options.input = path;
                    options.format = format;
                },
                text)
            ->type_name("FILE")
            ->group(group);
    };
    CLI::Option *csv =
        input("--csv", LOCUS_RECORDS_CSV, "CSV with column names in its first row, plain or .zst; - is standard input");
    input("--json", LOCUS_RECORDS_NDJSON, "Newline-delimited JSON, plain or .zst; - is standard input")->excludes(csv);
    app.add_option("--time", options.time, "Name of the time column [time, timestamp, ...]")->group(group);
    app.add_option("--lat", options.latitude, "Name of the latitude column [lat, latitude, y]")->group(group);
    app.add_option("--lon", options.longitude, "Name of the longitude column [lon, lng, longitude, x]")->group(group);
    app.add_option("--text", options.text, "Name of the text column [text, message, name, or none]")->group(group);
    add_choice<uint32_t>(app, "--time-unit", options.time_unit,
                         {{"auto", LOCUS_TIME_AUTO},
                          {"s", LOCUS_TIME_SECONDS},
                          {"ms", LOCUS_TIME_MILLISECONDS},
                          {"us", LOCUS_TIME_MICROSECONDS},
                          {"ns", LOCUS_TIME_NANOSECONDS}},
                         "Unit of times that are numbers; ISO 8601 needs none", group);
    app.add_option("--separator", options.separator, "Separator of CSV fields")->group(group);
    add_choice<uint32_t>(app, "--bad-lines", options.bad_lines,
                         {{"count", LOCUS_BAD_LINES_COUNT}, {"refuse", LOCUS_BAD_LINES_REFUSE}},
                         "Lines that cannot be used: count them and go on, or refuse the file", group);
    app.add_option("--max-line", options.max_line, "Bytes; a longer line is a bad one")
        ->check(CLI::Range(64, 1 << 30))
        ->group(group);
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
    add_choice<StoreLayout>(
        app, "--layout", options.layout,
        {{"default", StoreLayout::usual},
         {"ring", StoreLayout::ring_leaves},
         {"array", StoreLayout::packed_array},
         {"array-explicit", StoreLayout::packed_array_explicit}},
        "Layout of the store: ring leaves, the thesis' packed array, or that with its explicit index", group);
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
    add_file(app, options);
    add_window(app, options);
    add_results(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        status = app.exit(error) == 0 ? 0 : 2;
        return std::nullopt;
    }
    return options;
}

locus_records_options reader_options(const Options &options) {
    locus_records_options reader;
    if (locus_records_options_init(&reader, sizeof reader) != LOCUS_OK)
        throw std::runtime_error(locus_io_last_error());
    const auto name = [](const std::string &text) { return text.empty() ? nullptr : text.c_str(); };
    reader.format = options.format;
    reader.time_column = name(options.time);
    reader.latitude_column = name(options.latitude);
    reader.longitude_column = name(options.longitude);
    reader.text_column = name(options.text);
    reader.time_unit = options.time_unit;
    reader.separator = static_cast<unsigned char>(options.separator);
    reader.bad_lines = options.bad_lines;
    reader.max_line = options.max_line;
    return reader;
}

} // namespace demo
