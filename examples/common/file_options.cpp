// Which file a stream comes from, and how it is read.
#include "common/file_options.hpp"

#include <stdexcept>

namespace demo {

locus_records_options reader_options(const FileOptions &options) {
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
