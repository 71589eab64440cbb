/* locus/records.h: a walk through the calls, and every bad argument. */
#define _XOPEN_SOURCE 700

#include <locus/records.h>

#define LAST_ERROR locus_io_last_error
#include "check.h"

#include <stdlib.h>
#include <unistd.h>

static char file[] = "/tmp/locus-api-XXXXXX";

static void write_file(const char *text) {
    FILE *const stream = fopen(file, "wb");
    CHECK(stream != NULL && fwrite(text, strlen(text), 1, stream) == 1);
    if (stream != NULL)
        fclose(stream);
}

static void bad_line(uint64_t line, const char *reason, void *user) {
    CHECK(reason != NULL && reason[0] != '\0');
    *(uint64_t *)user = line;
}

static void defaults(void) {
    locus_records_options options;
    memset(&options, 0xA5, sizeof options);
    WORKS(locus_records_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.record == LOCUS_RECORD_TEXT156);
    CHECK(options.format == LOCUS_RECORDS_AUTO && options.time_unit == LOCUS_TIME_AUTO);
    CHECK(options.bad_lines == LOCUS_BAD_LINES_COUNT && options.separator == ',' && options.max_line == 65536);
    CHECK(options.time_column == NULL && options.text_column == NULL && options.bad_line == NULL);
    REFUSES(locus_records_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_records_options_init(&options, 8), LOCUS_E_ARGUMENT, "size is 8");
}

static void bad_opens(void) {
    locus_records_options options;
    locus_records *reader = NULL;
    union {
        locus_records_options options;
        unsigned char bytes[sizeof(locus_records_options) + 8];
    } newer;
    REFUSES(locus_records_open(NULL, NULL, &reader), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_records_open(file, NULL, NULL), LOCUS_E_ARGUMENT, "reader is NULL");
    REFUSES(locus_records_open("/nowhere/at/all", NULL, &reader), LOCUS_E_IO, "/nowhere/at/all");
    REFUSES(locus_records_open("/tmp", NULL, &reader), LOCUS_E_IO, "/tmp");
    REFUSES(locus_records_open_fd(-1, "input", NULL, &reader), LOCUS_E_ARGUMENT, "fd is -1");
    REFUSES(locus_records_open_fd(0, NULL, NULL, &reader), LOCUS_E_ARGUMENT, "name is NULL");
    REFUSES(locus_records_open_fd(0, "input", NULL, NULL), LOCUS_E_ARGUMENT, "reader is NULL");
#define BAD_OPTION(change, words)                                                                                      \
    WORKS(locus_records_options_init(&options, sizeof options));                                                       \
    options.change;                                                                                                    \
    reader = (locus_records *)&options;                                                                                \
    REFUSES(locus_records_open(file, &options, &reader), LOCUS_E_ARGUMENT, words);                                     \
    CHECK(reader == NULL);                                                                                             \
    REFUSES(locus_records_open_fd(0, "input", &options, &reader), LOCUS_E_ARGUMENT, words)
    BAD_OPTION(struct_size = 0, "struct_size is 0");
    BAD_OPTION(record = 33, "record is 33");
    BAD_OPTION(format = 3, "format is 3");
    BAD_OPTION(time_unit = 5, "time_unit is 5");
    BAD_OPTION(bad_lines = 2, "bad_lines is 2");
    BAD_OPTION(separator = 0, "separator");
    BAD_OPTION(separator = '"', "separator");
    BAD_OPTION(separator = 200, "separator");
    BAD_OPTION(max_line = 63, "max_line is 63");
    BAD_OPTION(max_line = (1u << 30) + 1, "max_line is 1073741825");
    WORKS(locus_records_options_init(&newer.options, sizeof newer));
    WORKS(locus_records_open(file, &newer.options, &reader));
    locus_records_close(reader);
    newer.bytes[sizeof newer - 1] = 1;
    REFUSES(locus_records_open(file, &newer.options, &reader), LOCUS_E_ARGUMENT, "struct_size");
}

static void walk(void) {
    locus_records_options options;
    locus_records *reader = NULL;
    locus_records_stats stats;
    locus_text156 records[4];
    size_t count = 0;
    uint64_t line = 0;
    write_file(
        "time,lat,lon,text\n1211018404,37.75,-122.39,\"hello, \"\"you\"\"\"\n1211018405,99,0,x\n1211018406,0,180,z");
    WORKS(locus_records_options_init(&options, sizeof options));
    options.bad_line = bad_line;
    options.bad_line_user = &line;
    WORKS(locus_records_open(file, &options, &reader));
    REFUSES(locus_records_next(NULL, records, 4, &count), LOCUS_E_ARGUMENT, "reader is NULL");
    REFUSES(locus_records_next(reader, NULL, 4, &count), LOCUS_E_ARGUMENT, "records is NULL");
    REFUSES(locus_records_next(reader, records, 0, &count), LOCUS_E_ARGUMENT, "capacity is 0");
    REFUSES(locus_records_next(reader, records, 4, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    WORKS(locus_records_next(reader, records, 4, &count));
    CHECK(count == 2 && line == 3);
    CHECK(records[0].time == INT64_C(1211018404000000) && records[0].latitude == 37.75f);
    CHECK(strcmp(records[0].text, "hello, \"you\"") == 0 && records[1].longitude == 180);
    WORKS(locus_records_next(reader, records, 4, &count));
    CHECK(count == 0);
    stats.struct_size = sizeof stats;
    REFUSES(locus_records_get_stats(NULL, &stats), LOCUS_E_ARGUMENT, "reader is NULL");
    REFUSES(locus_records_get_stats(reader, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    WORKS(locus_records_get_stats(reader, &stats));
    CHECK(stats.records == 2 && stats.bad == 1 && stats.line == 4 && stats.bytes == stats.bytes_read);
    stats.struct_size = 8;
    REFUSES(locus_records_get_stats(reader, &stats), LOCUS_E_ARGUMENT, "struct_size is 8");
    locus_records_close(reader);
    locus_records_close(NULL);

    /* The good ones first, then the bad line, now and ever after. */
    options.bad_lines = LOCUS_BAD_LINES_REFUSE;
    WORKS(locus_records_open(file, &options, &reader));
    WORKS(locus_records_next(reader, records, 4, &count));
    CHECK(count == 1);
    REFUSES(locus_records_next(reader, records, 4, &count), LOCUS_E_FORMAT, "3");
    REFUSES(locus_records_next(reader, records, 4, &count), LOCUS_E_FORMAT, "lat");
    CHECK(count == 0);
    locus_records_close(reader);

    options.text_column = "colour";
    WORKS(locus_records_open(file, &options, &reader));
    REFUSES(locus_records_next(reader, records, 4, &count), LOCUS_E_FORMAT, "colour");
    locus_records_close(reader);
}

static void pipes(void) {
    const char row[] = "{\"time\": \"2008-05-17T10:00:04Z\", \"lat\": -1.5, \"lon\": 2}\n";
    locus_records_options options;
    locus_records *reader = NULL;
    locus_point32 record;
    size_t count = 0;
    int ends[2];
    CHECK(pipe(ends) == 0);
    CHECK(write(ends[1], row, strlen(row)) == (ssize_t)strlen(row));
    WORKS(locus_records_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_POINT32;
    WORKS(locus_records_open_fd(ends[0], "a pipe", &options, &reader));
    WORKS(locus_records_next(reader, &record, 1, &count));
    CHECK(count == 1 && record.latitude == -1.5 && record.time == INT64_C(1211018404000000));
    close(ends[1]);
    WORKS(locus_records_next(reader, &record, 1, &count));
    CHECK(count == 0);
    locus_records_close(reader);
    CHECK(close(ends[0]) == 0); /* it stayed the caller's */
}

int main(void) {
    const int descriptor = mkstemp(file);
    if (descriptor < 0)
        return 2;
    close(descriptor);
    defaults();
    bad_opens();
    walk();
    pipes();
    remove(file);
    return check_result();
}
