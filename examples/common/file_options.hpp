// Which file a stream comes from, and how it is read.
#pragma once

#include <locus/records.h>

#include <cstdint>
#include <string>

namespace demo {

struct FileOptions {
    std::string input; // empty: no file
    uint32_t format = LOCUS_RECORDS_AUTO;
    std::string time, latitude, longitude, text; // columns; empty: the usual names
    uint32_t time_unit = LOCUS_TIME_AUTO;
    char separator = ',';
    uint32_t bad_lines = LOCUS_BAD_LINES_COUNT;
    uint32_t max_line = 65536;
};

// The library's reader options; the strings stay with `options`.
locus_records_options reader_options(const FileOptions &options);

} // namespace demo
