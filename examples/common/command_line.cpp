// What the command lines of the programs on streams share, by CLI11.
#include "common/command_line.hpp"

namespace demo {

void add_file_options(CLI::App &app, FileOptions &options, const char *group) {
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

bool parse(CLI::App &app, int argc, char **argv, int &status) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        status = app.exit(error) == 0 ? 0 : 2;
        return false;
    }
    return true;
}

} // namespace demo
