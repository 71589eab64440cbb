/* locus/cold.h: a walk through the calls, and every bad argument. */
#define _POSIX_C_SOURCE 200809L /* mkdtemp */
#define LAST_ERROR locus_cold_last_error
#include <locus/cold.h>

#include "check.h"
#include "point.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SECOND ((int64_t)1000000)

static char folder[64] = "/tmp/locus-cold-XXXXXX";
static char path[80];

static void remove_files(void) {
    static const char *const endings[] = {"", "-wal", "-shm", "-lock"};
    char name[96];
    size_t i;
    for (i = 0; i < 4; i++) {
        snprintf(name, sizeof name, "%s%s", path, endings[i]);
        remove(name);
    }
    remove(folder);
}

static locus_cold_options defaults(void) {
    locus_cold_options options;
    memset(&options, 0xA5, sizeof options);
    WORKS(locus_cold_options_init(&options, sizeof options));
    return options;
}

static void bad_options(void) {
    locus_cold_options options = defaults();
    locus_cold *cold = (locus_cold *)&options;
    CHECK(options.struct_size == sizeof options && options.record == LOCUS_RECORD_POINT32);
    CHECK(options.sync == LOCUS_COLD_SYNC_NORMAL && options.when_full == LOCUS_COLD_FULL_WAIT);
    CHECK(options.reserved0 == 0 && options.queue_bytes == 64 << 20 && options.batch_records == 1 << 18);
    CHECK(options.delay == SECOND && options.run_records == 1 << 20 && options.cache_bytes == 64 << 20);
    CHECK(options.max_age == LOCUS_NO_HORIZON && options.max_bytes == LOCUS_NO_LIMIT);
    REFUSES(locus_cold_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options is NULL");
    REFUSES(locus_cold_options_init(&options, 8), LOCUS_E_ARGUMENT, "size is 8");
#define BAD_OPTION(change, words)                                                                                      \
    do {                                                                                                               \
        options = defaults();                                                                                          \
        options.change;                                                                                                \
        REFUSES(locus_cold_open(path, &options, &cold), LOCUS_E_ARGUMENT, words);                                      \
        CHECK(cold == NULL);                                                                                           \
    } while (0)
    BAD_OPTION(struct_size = 8, "struct_size is 8");
    BAD_OPTION(record = 33, "record is 33");
    BAD_OPTION(sync = 3, "sync is 3");
    BAD_OPTION(when_full = 2, "when_full is 2");
    BAD_OPTION(reserved0 = 1, "reserved0 is 1");
    BAD_OPTION(queue_bytes = 1000, "queue_bytes is 1000");
    BAD_OPTION(batch_records = 0, "batch_records is 0");
    BAD_OPTION(delay = 0, "delay is 0");
    BAD_OPTION(run_records = 0, "run_records is 0");
    BAD_OPTION(cache_bytes = 1, "cache_bytes is 1");
    BAD_OPTION(max_age = 0, "max_age is 0");
    BAD_OPTION(max_bytes = 1 << 20, "max_bytes is 1048576");
    REFUSES(locus_cold_open(NULL, NULL, &cold), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_cold_open("", NULL, &cold), LOCUS_E_ARGUMENT, "path is empty");
    REFUSES(locus_cold_open(path, NULL, NULL), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_open("/no/such/folder/cold.db", NULL, &cold), LOCUS_E_IO, "No such file");
    CHECK(cold == NULL);
}

static int32_t count_them(const void *record, void *user) {
    (void)record;
    ++*(int *)user;
    return 0;
}

static int32_t stop_at_two(const void *record, void *user) {
    (void)record;
    return ++*(int *)user == 2;
}

/* Half an hour in the store, an hour in the tier, a record a minute. */
static void walk(void) {
    const locus_point32 bad = point(0, 0, 0, 0);
    locus_cold_options options = defaults();
    locus_pmq_options window;
    locus_pmq_query query;
    locus_cold_stats stats;
    locus_cold *cold = NULL, *second = NULL;
    locus_pmq *pmq = NULL;
    locus_point32 records[128];
    uint64_t count = 0;
    size_t number = 0, i;
    int calls = 0, minute;
    options.max_age = 3600 * SECOND;
    WORKS(locus_cold_open(path, &options, &cold));
    REFUSES(locus_cold_open(path, &options, &second), LOCUS_E_BUSY, "open already");
    WORKS(locus_pmq_options_init(&window, sizeof window));
    REFUSES(locus_cold_attach(NULL, &window), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_attach(cold, NULL), LOCUS_E_ARGUMENT, "options is NULL");
    window.record = LOCUS_RECORD_TEXT156;
    REFUSES(locus_cold_attach(cold, &window), LOCUS_E_ARGUMENT, "record is 156");
    window.record = LOCUS_RECORD_POINT32;
    window.horizon = 1800 * SECOND;
    WORKS(locus_pmq_create(&window, &pmq));
    REFUSES(locus_cold_count(cold, pmq, NULL, &count), LOCUS_E_STATE, "none is attached");
    locus_pmq_destroy(pmq);
    WORKS(locus_cold_attach(cold, &window));
    REFUSES(locus_cold_attach(cold, &window), LOCUS_E_ARGUMENT, "sink is set");
    WORKS(locus_pmq_create(&window, &pmq));
    for (minute = 0; minute < 80; minute++) {
        const locus_point32 record = point(48, 2, minute * 60 * SECOND, (uint16_t)minute);
        WORKS(locus_pmq_insert(pmq, &record, 1, record.time));
        WORKS(locus_cold_count(cold, pmq, NULL, &count));
        CHECK(count == (uint64_t)minute + 1);
    }
    WORKS(locus_pmq_sweep(pmq, 79 * 60 * SECOND, &count));
    WORKS(locus_cold_flush(cold));
    WORKS(locus_cold_check(cold));
    WORKS(locus_cold_count(cold, NULL, NULL, &count));
    CHECK(count == 49); /* those of the minutes 0..48 have left */
    WORKS(locus_cold_read(cold, pmq, NULL, records, 128, &number));
    CHECK(number == 80);
    for (i = 0; i < number; i++)
        CHECK(records[i].device == i); /* of one key, as they arrived */
    REFUSES(locus_cold_read(cold, pmq, NULL, records, 5, &number), LOCUS_E_CAPACITY, "there are 80");
    CHECK(number == 80);
    WORKS(locus_cold_visit(cold, pmq, NULL, count_them, &calls));
    CHECK(calls == 80);
    calls = 0;
    REFUSES(locus_cold_visit(cold, pmq, NULL, stop_at_two, &calls), LOCUS_E_STOPPED, "visit");
    CHECK(calls == 2);
    WORKS(locus_pmq_query_init(&query, sizeof query));
    query.time_from = 10 * 60 * SECOND;
    query.time_to = 59 * 60 * SECOND;
    WORKS(locus_cold_count(cold, pmq, &query, &count));
    CHECK(count == 50);
    query.region = LOCUS_REGION_CIRCLE;
    query.circle.latitude = 49;
    query.circle.longitude = 2;
    query.circle.radius = 1000;
    WORKS(locus_cold_count(cold, pmq, &query, &count));
    CHECK(count == 0);
    query.circle.radius = -1;
    REFUSES(locus_cold_count(cold, pmq, &query, &count), LOCUS_E_ARGUMENT, "circle.radius is -1");
    REFUSES(locus_cold_count(NULL, pmq, NULL, &count), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_count(cold, pmq, NULL, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_cold_read(NULL, pmq, NULL, records, 1, &number), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_read(cold, pmq, NULL, NULL, 1, &number), LOCUS_E_ARGUMENT, "records is NULL");
    REFUSES(locus_cold_read(cold, pmq, NULL, records, 1, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_cold_visit(NULL, pmq, NULL, count_them, &calls), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_visit(cold, pmq, NULL, NULL, &calls), LOCUS_E_ARGUMENT, "visit is NULL");

    /* The clock: what is older than an hour goes. */
    WORKS(locus_cold_sweep(cold, 79 * 60 * SECOND));
    REFUSES(locus_cold_sweep(cold, 0), LOCUS_E_ARGUMENT, "now is 0");
    REFUSES(locus_cold_sweep(NULL, 0), LOCUS_E_ARGUMENT, "cold is NULL");
    WORKS(locus_cold_count(cold, pmq, NULL, &count));
    CHECK(count == 61);
    WORKS(locus_cold_flush(cold));
    REFUSES(locus_cold_flush(NULL), LOCUS_E_ARGUMENT, "cold is NULL");
    stats.struct_size = sizeof stats;
    WORKS(locus_cold_get_stats(cold, &stats));
    CHECK(stats.received == 49 && stats.written == 49 && stats.removed == 19 && stats.stored == 30);
    CHECK(stats.runs == 1 && stats.transactions >= 1 && stats.file_bytes > 0 && stats.now == 79 * 60 * SECOND);
    CHECK(stats.failure == LOCUS_OK && stats.waits == 0);
    REFUSES(locus_cold_get_stats(NULL, &stats), LOCUS_E_ARGUMENT, "cold is NULL");
    REFUSES(locus_cold_get_stats(cold, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    stats.struct_size = 8;
    REFUSES(locus_cold_get_stats(cold, &stats), LOCUS_E_ARGUMENT, "struct_size is 8");
    REFUSES(locus_cold_rewind(cold, 40), LOCUS_E_STATE, "attached");
    REFUSES(locus_cold_check(NULL), LOCUS_E_ARGUMENT, "cold is NULL");
    locus_pmq_destroy(pmq);
    locus_cold_close(cold);

    /* It is all there after a restart. */
    options.record = LOCUS_RECORD_TEXT156;
    REFUSES(locus_cold_open(path, &options, &cold), LOCUS_E_ARGUMENT, "holds records of 32 bytes");
    options.record = LOCUS_RECORD_POINT32;
    WORKS(locus_cold_open(path, &options, &cold));
    WORKS(locus_cold_count(cold, NULL, NULL, &count));
    CHECK(count == 30);
    WORKS(locus_pmq_query_init(&query, sizeof query));
    query.snapshot = (const locus_pmq_snapshot *)&bad;
    REFUSES(locus_cold_count(cold, NULL, &query, &count), LOCUS_E_ARGUMENT, "query.snapshot");
    REFUSES(locus_cold_rewind(cold, 50), LOCUS_E_ARGUMENT, "received is 50");
    REFUSES(locus_cold_rewind(NULL, 40), LOCUS_E_ARGUMENT, "cold is NULL");
    WORKS(locus_cold_rewind(cold, 40));
    WORKS(locus_cold_count(cold, NULL, NULL, &count));
    CHECK(count == 21);
    WORKS(locus_cold_check(cold));
    locus_cold_close(cold);
    locus_cold_close(NULL);
}

int main(void) {
    CHECK(mkdtemp(folder) != NULL);
    snprintf(path, sizeof path, "%s/tier.db", folder);
    CHECK(strcmp(locus_cold_last_error(), "") == 0);
    bad_options();
    walk();
    remove_files();
    return check_result();
}
