// locus/records.h
#include <locus/records.h>

#include "core/options.hpp"
#include "io/boundary.hpp"
#include "io/record_reader.hpp"

using locus::need;
using locus::require;
using locus::io::boundary;

struct locus_records {
    locus::io::RecordReader impl;
};

namespace {

constexpr uint32_t longest_max_line = uint32_t{1} << 30;

constexpr locus_records_options defaults{sizeof(locus_records_options),
                                         LOCUS_RECORD_TEXT156,
                                         LOCUS_RECORDS_AUTO,
                                         LOCUS_TIME_AUTO,
                                         LOCUS_BAD_LINES_COUNT,
                                         ',',
                                         65536,
                                         nullptr,
                                         nullptr,
                                         nullptr,
                                         nullptr,
                                         nullptr,
                                         nullptr};
static_assert(sizeof(locus_records_options) == 80, "append only; then update the ABI baseline");

locus_records_options checked(const locus_records_options *options) {
    const locus_records_options whole = locus::read_options(options, defaults, sizeof(locus_records_options));
    require(whole.record == LOCUS_RECORD_TEXT156 || whole.record == LOCUS_RECORD_POINT32, "options->record is ",
            whole.record, ", no LOCUS_RECORD_");
    require(whole.format <= LOCUS_RECORDS_NDJSON, "options->format is ", whole.format, ", no LOCUS_RECORDS_");
    require(whole.time_unit <= LOCUS_TIME_NANOSECONDS, "options->time_unit is ", whole.time_unit, ", no LOCUS_TIME_");
    require(whole.bad_lines <= LOCUS_BAD_LINES_REFUSE, "options->bad_lines is ", whole.bad_lines,
            ", no LOCUS_BAD_LINES_");
    require(whole.separator > 0 && whole.separator < 128 && whole.separator != '"' && whole.separator != '\n' &&
                whole.separator != '\r',
            "options->separator is ", whole.separator, ", not an ASCII character that can separate fields");
    require(whole.max_line >= 64 && whole.max_line <= longest_max_line, "options->max_line is ", whole.max_line,
            ", outside 64..", longest_max_line);
    return whole;
}

} // namespace

locus_status locus_records_options_init(locus_records_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { locus::init_options(options, size, defaults, sizeof(locus_records_options)); });
}

locus_status locus_records_open(const char *path, const locus_records_options *options,
                                locus_records **reader) noexcept {
    return boundary(__func__, [&] {
        need(reader, "reader") = nullptr;
        need(path, "path");
        const locus_records_options whole = checked(options);
        *reader = new locus_records{{locus::io::ByteSource::open(path), whole}};
    });
}

locus_status locus_records_open_fd(int32_t fd, const char *name, const locus_records_options *options,
                                   locus_records **reader) noexcept {
    return boundary(__func__, [&] {
        need(reader, "reader") = nullptr;
        need(name, "name");
        require(fd >= 0, "fd is ", fd, ", no descriptor");
        const locus_records_options whole = checked(options);
        *reader = new locus_records{{{{fd, false}, name}, whole}};
    });
}

void locus_records_close(locus_records *reader) noexcept { delete reader; }

locus_status locus_records_next(locus_records *reader, void *records, size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(count, "count") = 0;
        need(reader, "reader");
        require(records != nullptr, "records is NULL");
        require(capacity >= 1, "capacity is 0");
        *count = reader->impl.next(records, capacity);
    });
}

locus_status locus_records_get_stats(const locus_records *reader, locus_records_stats *stats) noexcept {
    return boundary(__func__, [&] {
        need(stats, "stats");
        locus::write_report(stats, need(reader, "reader").impl.stats(), sizeof(locus_records_stats), "stats");
    });
}
