/* locus/storage.h: a walk through the calls, and every bad argument. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "check.h"

#include <locus/storage.h>

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

enum { RECORDS = 100, PATH = 4096 };

static char folder[PATH]; /* of this test's files, beside the program */

static const char *at(const char *name) {
    static char paths[4][PATH + 64];
    static int next = 0;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static void remove_folder(const char *path) {
    DIR *entries = opendir(path);
    const struct dirent *entry;
    char name[PATH + 512];
    while (entries != NULL && (entry = readdir(entries)) != NULL) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (unlink(name) != 0)
            remove_folder(name);
    }
    if (entries != NULL)
        closedir(entries);
    rmdir(path);
}

static void fill(locus_pmq *pmq, int64_t first) {
    locus_point32 batch[RECORDS];
    int i;
    memset(batch, 0, sizeof batch);
    for (i = 0; i < RECORDS; i++) {
        batch[i].latitude = i % 90;
        batch[i].longitude = i % 7;
        batch[i].time = first + i;
    }
    WORKS(locus_pmq_insert(pmq, batch, RECORDS, first + RECORDS));
}

static uint64_t count(const locus_pmq *pmq) {
    uint64_t records = 0;
    WORKS(locus_pmq_count(pmq, NULL, &records));
    return records;
}

static int32_t cancel(double fraction, void *user) {
    (void)user;
    return fraction >= 0;
}

static int32_t watch(double fraction, void *user) {
    double *last = (double *)user;
    CHECK(fraction >= *last && fraction <= 1);
    *last = fraction;
    return 0;
}

static void files(void) {
    locus_pmq_options options;
    locus_pmq_file_info info;
    locus_pmq_snapshot *snapshot = NULL;
    locus_pmq *pmq = NULL, *other = NULL, *loaded = NULL;
    double told = 0;
    WORKS(locus_pmq_create(NULL, &pmq));
    WORKS(locus_pmq_create(NULL, &other));
    fill(pmq, 1000);
    WORKS(locus_pmq_snapshot_create(pmq, &snapshot));
    fill(pmq, 2000);
    WORKS(locus_pmq_save(pmq, NULL, at("saved"), watch, &told));
    CHECK(told == 1);
    told = 0;
    WORKS(locus_pmq_load(at("saved"), NULL, watch, &told, &loaded));
    CHECK(told == 1 && count(loaded) == 2 * RECORDS);
    locus_pmq_destroy(loaded);
    WORKS(locus_pmq_save(pmq, snapshot, at("saved"), NULL, NULL));
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    WORKS(locus_pmq_get_file_info(at("saved"), &info));
    CHECK(info.version == 1 && info.record == LOCUS_RECORD_POINT32 && info.records == RECORDS && info.now == 1100);
    CHECK(info.bytes > RECORDS * sizeof(locus_point32));

    REFUSES(locus_pmq_save(NULL, NULL, "x", NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_save(pmq, NULL, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_pmq_save(pmq, NULL, "", NULL, NULL), LOCUS_E_ARGUMENT, "path is empty");
    REFUSES(locus_pmq_save(other, snapshot, "x", NULL, NULL), LOCUS_E_ARGUMENT, "snapshot is another");
    REFUSES(locus_pmq_save(pmq, NULL, at("no/such"), NULL, NULL), LOCUS_E_IO, "no/such");
    REFUSES(locus_pmq_save(pmq, NULL, at("saved"), cancel, NULL), LOCUS_E_STOPPED, "progress");
    locus_pmq_snapshot_destroy(snapshot);

    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    loaded = pmq;
    REFUSES(locus_pmq_load(at("saved"), &options, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "options.record is 156");
    CHECK(loaded == NULL);
    options.horizon = 0;
    REFUSES(locus_pmq_load(at("saved"), &options, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "options.record");
    options.record = LOCUS_RECORD_POINT32;
    REFUSES(locus_pmq_load(at("saved"), &options, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "options.horizon is 0");
    options.struct_size = 3;
    REFUSES(locus_pmq_load(at("saved"), &options, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "struct_size is 3");
    REFUSES(locus_pmq_load(NULL, NULL, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_pmq_load("", NULL, NULL, NULL, &loaded), LOCUS_E_ARGUMENT, "path is empty");
    REFUSES(locus_pmq_load("x", NULL, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_load(at("none"), NULL, NULL, NULL, &loaded), LOCUS_E_IO, "none: cannot open");
    REFUSES(locus_pmq_load(folder, NULL, NULL, NULL, &loaded), LOCUS_E_IO, "not a regular file");
    REFUSES(locus_pmq_load("/dev/null", NULL, NULL, NULL, &loaded), LOCUS_E_IO, "not a regular file");
    REFUSES(locus_pmq_load(at("saved"), NULL, cancel, NULL, &loaded), LOCUS_E_STOPPED, "progress");

    REFUSES(locus_pmq_get_file_info(NULL, &info), LOCUS_E_ARGUMENT, "path is NULL");
    REFUSES(locus_pmq_get_file_info("x", NULL), LOCUS_E_ARGUMENT, "info is NULL");
    REFUSES(locus_pmq_get_file_info(at("none"), &info), LOCUS_E_IO, "none");
    info.struct_size = 4;
    REFUSES(locus_pmq_get_file_info(at("saved"), &info), LOCUS_E_ARGUMENT, "info->struct_size is 4");
    locus_pmq_destroy(pmq);
    locus_pmq_destroy(other);
}

/* One log option is wrong: the text names it, and no store is opened. */
#define BAD_LOG_OPTION(change, words)                                                                                  \
    do {                                                                                                               \
        locus_pmq_log_options log;                                                                                     \
        locus_pmq *none = NULL;                                                                                        \
        WORKS(locus_pmq_log_options_init(&log, sizeof log));                                                           \
        log.change;                                                                                                    \
        REFUSES(locus_pmq_open(at("bad"), NULL, &log, NULL, NULL, NULL, &none), LOCUS_E_ARGUMENT, words);              \
        CHECK(none == NULL && access(at("bad"), F_OK) != 0);                                                           \
    } while (0)

static void bad_log_options(void) {
    locus_pmq_log_options log;
    memset(&log, 0xA5, sizeof log);
    WORKS(locus_pmq_log_options_init(&log, sizeof log));
    CHECK(log.struct_size == sizeof log && log.sync == LOCUS_SYNC_BATCH && log.redeliver == 1);
    CHECK(log.sync_interval == 1000000 && log.sync_bytes == 16 << 20 && log.keep == 1 && log.repair == 0);
    REFUSES(locus_pmq_log_options_init(NULL, sizeof log), LOCUS_E_ARGUMENT, "options is NULL");
    REFUSES(locus_pmq_log_options_init(&log, 8), LOCUS_E_ARGUMENT, "size is 8");
    BAD_LOG_OPTION(struct_size = 8, "struct_size is 8");
    BAD_LOG_OPTION(sync = 3, "log_options.sync is 3");
    BAD_LOG_OPTION(redeliver = 2, "log_options.redeliver is 2");
    BAD_LOG_OPTION(sync_interval = -1, "log_options.sync_interval is -1");
    BAD_LOG_OPTION(sync_bytes = 0, "log_options.sync_bytes is 0");
    BAD_LOG_OPTION(keep = 101, "log_options.keep is 101");
    BAD_LOG_OPTION(repair = 2, "log_options.repair is 2");
}

static locus_pmq_log_stats log_stats(const locus_pmq *pmq) {
    locus_pmq_log_stats stats;
    memset(&stats, 0, sizeof stats);
    stats.struct_size = sizeof stats;
    WORKS(locus_pmq_get_log_stats(pmq, &stats));
    return stats;
}

static void folders(void) {
    locus_pmq_recovery recovery;
    locus_pmq_log_options log;
    locus_pmq_log_stats stats;
    locus_pmq *pmq = NULL, *other = NULL;
    memset(&recovery, 0, sizeof recovery);
    recovery.struct_size = sizeof recovery;
    WORKS(locus_pmq_open(at("store"), NULL, NULL, NULL, NULL, &recovery, &pmq));
    CHECK(recovery.created == 1 && recovery.records == 0 && recovery.now == INT64_MIN);
    fill(pmq, 1000);
    stats = log_stats(pmq);
    CHECK(stats.attached == 1 && stats.changes == 1 && stats.syncs == 1 && stats.unsynced == 0 && stats.number == 1);
    WORKS(locus_pmq_checkpoint(pmq, NULL, NULL));
    fill(pmq, 2000);
    WORKS(locus_pmq_sync(pmq));
    CHECK(log_stats(pmq).number == 2);
    REFUSES(locus_pmq_open(at("store"), NULL, NULL, NULL, NULL, NULL, &other), LOCUS_E_BUSY, "store");
    locus_pmq_destroy(pmq);

    WORKS(locus_pmq_log_options_init(&log, sizeof log));
    log.sync = LOCUS_SYNC_INTERVAL;
    log.sync_interval = INT64_MAX;
    log.sync_bytes = 5000;
    WORKS(locus_pmq_open(at("store"), NULL, &log, NULL, NULL, &recovery, &pmq));
    CHECK(recovery.created == 0 && recovery.number == 2 && recovery.saved == RECORDS && recovery.changes == 1);
    CHECK(recovery.inserted == RECORDS && recovery.records == 2 * RECORDS && recovery.cut == 0);
    CHECK(recovery.now == 2100 && count(pmq) == 2 * RECORDS);
    fill(pmq, 3000);
    CHECK(log_stats(pmq).unsynced > RECORDS * 32);
    fill(pmq, 4000);
    CHECK(log_stats(pmq).unsynced == 0 && log_stats(pmq).syncs == 1);
    REFUSES(locus_pmq_checkpoint(pmq, cancel, NULL), LOCUS_E_STOPPED, "progress");
    fill(pmq, 5000);
    locus_pmq_destroy(pmq);
    WORKS(locus_pmq_open(at("store"), NULL, NULL, NULL, NULL, &recovery, &pmq));
    CHECK(recovery.number == 2 && recovery.changes == 4 && count(pmq) == 5 * RECORDS);
    locus_pmq_destroy(pmq);

    WORKS(locus_pmq_create(NULL, &other));
    fill(other, 1000);
    CHECK(log_stats(other).attached == 0);
    REFUSES(locus_pmq_checkpoint(other, NULL, NULL), LOCUS_E_STATE, "no folder");
    REFUSES(locus_pmq_sync(other), LOCUS_E_STATE, "no folder");
    REFUSES(locus_pmq_attach(other, at("store"), NULL, NULL, NULL), LOCUS_E_STATE, "holds a store");
    REFUSES(locus_pmq_attach(other, at("cancelled"), NULL, cancel, NULL), LOCUS_E_STOPPED, "progress");
    WORKS(locus_pmq_attach(other, at("attached"), &log, NULL, NULL));
    REFUSES(locus_pmq_attach(other, at("second"), NULL, NULL, NULL), LOCUS_E_STATE, "attached");
    fill(other, 2000);
    locus_pmq_destroy(other);
    WORKS(locus_pmq_open(at("attached"), NULL, NULL, NULL, NULL, NULL, &other));
    CHECK(count(other) == 2 * RECORDS);

    pmq = other;
    recovery.struct_size = 8;
    REFUSES(locus_pmq_open(at("store"), NULL, NULL, NULL, NULL, &recovery, &pmq), LOCUS_E_ARGUMENT, "recovery->struct");
    CHECK(pmq == NULL);
    REFUSES(locus_pmq_open(NULL, NULL, NULL, NULL, NULL, NULL, &pmq), LOCUS_E_ARGUMENT, "folder is NULL");
    REFUSES(locus_pmq_open("", NULL, NULL, NULL, NULL, NULL, &pmq), LOCUS_E_ARGUMENT, "folder is empty");
    REFUSES(locus_pmq_open("x", NULL, NULL, NULL, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_open(at("no/such"), NULL, NULL, NULL, NULL, NULL, &pmq), LOCUS_E_IO, "no/such");
    REFUSES(locus_pmq_open("/dev/null", NULL, NULL, NULL, NULL, NULL, &pmq), LOCUS_E_IO, "/dev/null");
    REFUSES(locus_pmq_attach(NULL, "x", NULL, NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_attach(other, NULL, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "folder is NULL");
    log.keep = 200;
    REFUSES(locus_pmq_attach(other, "x", &log, NULL, NULL), LOCUS_E_ARGUMENT, "log_options.keep");
    REFUSES(locus_pmq_checkpoint(NULL, NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_sync(NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_get_log_stats(NULL, &stats), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_get_log_stats(other, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    stats.struct_size = 4;
    REFUSES(locus_pmq_get_log_stats(other, &stats), LOCUS_E_ARGUMENT, "stats->struct_size is 4");
    locus_pmq_destroy(other);
}

int main(int count, char **arguments) {
    const char *program = count > 0 ? arguments[0] : "";
    const char *slash = strrchr(program, '/');
    snprintf(folder, sizeof folder, "%.*sstorage-XXXXXX", slash ? (int)(slash + 1 - program) : 0, program);
    if (mkdtemp(folder) == NULL) {
        printf("cannot make a folder like %s\n", folder);
        return 1;
    }
    files();
    bad_log_options();
    folders();
    remove_folder(folder);
    return check_result();
}
