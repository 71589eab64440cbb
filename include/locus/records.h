/* locus/records.h - records for a PMQ from CSV or newline-delimited JSON, from a file or a pipe, zstd-compressed or
 * not.
 *
 * A reader turns rows into locus_text156 or locus_point32 records, batch by batch, in the order of the rows and in
 * bounded memory however long a line is. Rows it cannot use are bad lines: counted and told to a callback, or an error,
 * by option.
 *
 * CSV: RFC 4180 quotes (a quoted field may hold separators, doubled quotes and line ends), LF or CRLF, the column names
 * in the first row. JSON: one object a line; only its top-level members count. A UTF-8 byte order mark and blank lines
 * are skipped. Bytes of a text that are not UTF-8 become U+FFFD, NUL becomes a space, and a text longer than its 140
 * bytes is cut before the first character that does not fit whole. */
#ifndef LOCUS_RECORDS_H
#define LOCUS_RECORDS_H

#include <locus/io.h>
#include <locus/pmq.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_records locus_records;

#define LOCUS_RECORDS_AUTO 0 /* JSON if the first line begins with '{', else CSV */
#define LOCUS_RECORDS_CSV 1
#define LOCUS_RECORDS_NDJSON 2

/* What a time is. A text such as 2008-05-18T07:30:00.25+02:00 (ISO 8601; the time of day may be missing, a space may
 * stand for T, UTC where no zone is given) is understood in every case. */
#define LOCUS_TIME_AUTO 0    /* numbers: the unit that puts the first one between 1973 and 5138, else seconds */
#define LOCUS_TIME_SECONDS 1 /* since 1970-01-01 UTC, fractions allowed; the units below likewise */
#define LOCUS_TIME_MILLISECONDS 2
#define LOCUS_TIME_MICROSECONDS 3
#define LOCUS_TIME_NANOSECONDS 4

#define LOCUS_BAD_LINES_COUNT 0  /* go on with the next line */
#define LOCUS_BAD_LINES_REFUSE 1 /* LOCUS_E_FORMAT at the first one */

/* Told each bad line: the number of its first line, counted from 1, and why (UTF-8, valid during the call). Called by
 * the thread that calls locus_records_next; must not throw, longjmp or call into the reader. */
typedef void (*locus_bad_line_fn)(uint64_t line, const char *reason, void *user);

typedef struct locus_records_options {
    uint64_t struct_size;
    uint32_t record;    /* LOCUS_RECORD_ (locus/pmq.h); default LOCUS_RECORD_TEXT156 */
    uint32_t format;    /* LOCUS_RECORDS_; default LOCUS_RECORDS_AUTO */
    uint32_t time_unit; /* LOCUS_TIME_; default LOCUS_TIME_AUTO */
    uint32_t bad_lines; /* LOCUS_BAD_LINES_; default LOCUS_BAD_LINES_COUNT */
    uint32_t separator; /* of CSV fields, one ASCII character; default ',' */
    uint32_t max_line;  /* bytes; a longer line (with those inside its quotes) is a bad one; 64..2^30, default 65536 */
    /* Column or member names, copied. NULL, the default, takes the first of several usual names that is there. */
    const char *time_column;      /* default: time, timestamp, datetime, date, created_at */
    const char *latitude_column;  /* default: lat, latitude, y */
    const char *longitude_column; /* default: lon, lng, long, longitude, x */
    const char *text_column; /* default: text, message, name; without any of these the texts stay empty. Text156 only */
    locus_bad_line_fn bad_line; /* default NULL */
    void *bad_line_user;
} locus_records_options;

typedef struct locus_records_stats {
    uint64_t struct_size;
    uint64_t records;    /* records handed out */
    uint64_t bad;        /* bad lines */
    uint64_t cut;        /* records whose text was cut */
    uint64_t repaired;   /* records whose text held bytes that are not UTF-8 */
    uint64_t line;       /* lines read */
    uint64_t bytes_read; /* from the file, compressed ones as they are */
    uint64_t bytes;      /* size of the file; 0 where it has none, as a pipe */
} locus_records_stats;

/* Fill the options (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_records_options_init(locus_records_options *options, size_t size) LOCUS_NOEXCEPT;

/* Open the file `path`. `options` may be NULL for the defaults. `*reader` is the caller's, to be ended with
 * locus_records_close; NULL on any error. Nothing is read yet. Errors: LOCUS_E_ARGUMENT, LOCUS_E_IO (with the system's
 * reason), LOCUS_E_MEMORY. Any thread. Since 0.1. */
LOCUS_API locus_status locus_records_open(const char *path, const locus_records_options *options,
                                          locus_records **reader) LOCUS_NOEXCEPT;

/* The same from an open descriptor, such as 0 for standard input, which stays the caller's to close and must stay open
 * as long as the reader. `name` stands for it in error texts. Errors and threads as above. Since 0.1. */
LOCUS_API locus_status locus_records_open_fd(int32_t fd, const char *name, const locus_records_options *options,
                                             locus_records **reader) LOCUS_NOEXCEPT;

/* End a reader. NULL is fine. Since 0.1. */
LOCUS_API void locus_records_close(locus_records *reader) LOCUS_NOEXCEPT;

/* Read up to `capacity` >= 1 records of the options' layout into `records`; `*count` is their number, 0 at the end of
 * the input. Waits for the first one only: where a pipe has no more at the moment, those that are there are handed out.
 * Times are microseconds, coordinates as in the input and in range, fields the input does not have are zero. Records
 * read before an error are handed out first, with LOCUS_OK; the error is then the result of the next call and of all
 * later ones, with `*count` 0. Errors: LOCUS_E_FORMAT (a column that is not there, broken compression, a bad line that
 * is to be refused), LOCUS_E_IO, LOCUS_E_MEMORY, LOCUS_E_ARGUMENT. Not beside other calls on the reader. Since 0.1. */
LOCUS_API locus_status locus_records_next(locus_records *reader, void *records, size_t capacity,
                                          size_t *count) LOCUS_NOEXCEPT;

/* Store how far the reader is; set stats->struct_size first. Errors: LOCUS_E_ARGUMENT. Not beside _next. Since 0.1. */
LOCUS_API locus_status locus_records_get_stats(const locus_records *reader, locus_records_stats *stats) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
