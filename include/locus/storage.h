/* locus/storage.h - a store on disk: saving and loading a file, and a folder whose append log loses no acknowledged
 * batch when the process is killed.
 *
 * A saved file is one moment of a store: its records in the order (key, arrival), its clock, checksums over everything.
 * It loads into any layout. A folder holds a saved file and a log of what happened since: locus_pmq_open recovers the
 * store from both and goes on logging, locus_pmq_checkpoint saves anew and lets go of the log. Files are little-endian
 * and made for one machine family: they say so in their header, with a version.
 *
 * Paths are as the operating system takes them (UTF-8, as a rule). Errors of files are LOCUS_E_IO (the operating system
 * refused: no such file, no room on the disk, ...) and LOCUS_E_FORMAT (the bytes are not what they claim to be: cut
 * off, flipped, of another version); the text names the file and, where there is one, the byte. */
#ifndef LOCUS_STORAGE_H
#define LOCUS_STORAGE_H

#include <locus/pmq.h>

#ifdef __cplusplus
extern "C" {
#endif

/* When the log is flushed to the disk. Without a flush a batch that was acknowledged survives the end of the process,
 * however it ends; with one it survives a loss of power, too. */
#define LOCUS_SYNC_NONE 0     /* when the operating system sees fit, and at a checkpoint */
#define LOCUS_SYNC_BATCH 1    /* before every call that changes the store returns */
#define LOCUS_SYNC_INTERVAL 2 /* by the first such call after sync_interval or sync_bytes; see locus_pmq_sync */

/* What a saved file says of itself. */
typedef struct locus_pmq_file_info {
    uint64_t struct_size;
    uint32_t version; /* of the format */
    uint32_t record;  /* LOCUS_RECORD_ */
    uint64_t records; /* saved records */
    uint64_t bytes;   /* of the file */
    int64_t now;      /* the store's clock, microseconds; INT64_MIN: nothing had been inserted */
} locus_pmq_file_info;

typedef struct locus_pmq_log_options {
    uint64_t struct_size;
    uint32_t sync;         /* LOCUS_SYNC_; default LOCUS_SYNC_BATCH */
    uint32_t redeliver;    /* hand over again at recovery what left since the last save, see below: 0 or 1; default 1 */
    int64_t sync_interval; /* LOCUS_SYNC_INTERVAL: microseconds, >= 0; default 1,000,000 */
    uint64_t sync_bytes;   /* LOCUS_SYNC_INTERVAL: bytes, >= 1; default 16 MiB */
    uint32_t keep;   /* saved generations to keep beside the newest, with their logs, 0..100: a newest file that turns
                        out to be damaged is then no loss; default 1 */
    uint32_t repair; /* 1: a log damaged in the middle is cut there, and what comes behind is lost; 0, the default:
                        that is LOCUS_E_FORMAT. Needed after a loss of power without flushes. */
} locus_pmq_log_options;

/* What locus_pmq_open found. */
typedef struct locus_pmq_recovery {
    uint64_t struct_size;
    uint32_t created;  /* 1: there was no store, the folder is new */
    uint32_t skipped;  /* saved files that are newer than the one loaded, but damaged */
    uint64_t number;   /* of the saved file that was loaded: store-NUMBER */
    uint64_t saved;    /* records in it */
    uint64_t changes;  /* batches, sweeps and erasures replayed from the log, */
    uint64_t inserted; /* with so many records */
    uint64_t departed; /* of both, records that had left, or were expired */
    uint64_t records;  /* live records recovered */
    uint64_t cut;      /* bytes cut off the log's end: a change that was never acknowledged (or damage, if repaired) */
    int64_t now;       /* the clock */
} locus_pmq_recovery;

typedef struct locus_pmq_log_stats {
    uint64_t struct_size;
    uint64_t number;   /* of the log that is being written: log-NUMBER */
    uint64_t bytes;    /* its size, */
    uint64_t unsynced; /* of which so many are not known to be on the disk */
    uint64_t changes;  /* batches, sweeps and erasures logged since the folder was opened */
    uint64_t syncs;    /* flushes to the disk since then */
    uint32_t attached; /* 1: the store has a log */
    uint32_t stopped;  /* 1: the log has stopped, see locus_pmq_open */
} locus_pmq_log_stats;

/* Save the store as `path`, atomically: the file is written beside it, flushed and renamed, so that a process killed at
 * any point leaves the old file or the new one. `snapshot` (may be NULL: the present) is the moment to be saved.
 * Records that have expired but have not been handed to the sink yet are saved, too, and reach the sink of the store
 * that loads them; those that wait for a sink that stopped (stats.pending) are not. Memory: a few hundred kilobytes.
 * `progress` (may be NULL) may cancel: LOCUS_E_STOPPED, `path` is as before. Errors: LOCUS_E_ARGUMENT, LOCUS_E_IO,
 * LOCUS_E_STALE, LOCUS_E_MEMORY; `path` is as before. Beside readers and, with ring leaves, the writer; a packed
 * array's writer waits. Since 0.1. */
LOCUS_API locus_status locus_pmq_save(const locus_pmq *pmq, const locus_pmq_snapshot *snapshot, const char *path,
                                      locus_progress_fn progress, void *user) LOCUS_NOEXCEPT;

/* Make a store from a saved file, of any layout, whatever it was saved from. `options` are those of locus_pmq_create
 * (NULL: the defaults, with the file's record layout); options->record must be the file's. The clock is the saved one,
 * the horizon and the limits are those of the options; what is beyond them, or had expired before, waits for the sink
 * (pending). stats count from here: the file's records are `inserted`. Everything is validated: checksums, places,
 * order, times. A large file is read by up to four threads, started for the call and joined before it returns; all
 * callbacks are called by the caller's. `*pmq` is the caller's; NULL on any error. Errors: LOCUS_E_ARGUMENT,
 * LOCUS_E_IO, LOCUS_E_FORMAT, LOCUS_E_MEMORY, LOCUS_E_STOPPED (by `progress`, which may be NULL). Any thread. Since
 * 0.1. */
LOCUS_API locus_status locus_pmq_load(const char *path, const locus_pmq_options *options, locus_progress_fn progress,
                                      void *user, locus_pmq **pmq) LOCUS_NOEXCEPT;

/* Read a saved file's header, and check it against its checksum and the file's size; set info->struct_size first.
 * Errors: LOCUS_E_ARGUMENT, LOCUS_E_IO, LOCUS_E_FORMAT. Any thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_get_file_info(const char *path, locus_pmq_file_info *info) LOCUS_NOEXCEPT;

/* Fill the options (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_pmq_log_options_init(locus_pmq_log_options *options, size_t size) LOCUS_NOEXCEPT;

/* Recover the store of a folder, or make a new one where there is none (the folder itself, too, but not its parents),
 * and log every change from now on before it is acknowledged: when an insert, a sweep or an erase has returned, a
 * process killed at any later point, also amid a checkpoint, finds its effect again. Recovered are the live records in
 * their order and the clock, exactly: what left by horizon, limits, predicate or erase does not come back (of records
 * equal in every byte the earliest count as those that left). The limits are then held anew, as by a sweep; the
 * predicate is not asked. A call that the end interrupted is there wholly or not at all.
 *
 * Two options that only matter with a sink: records that left since the last save reach it again, unless `redeliver` is
 * 0: it may have had no time to keep them. So a sink gets each record at least once, and just once unless the process
 * was killed. They wait in memory until the first insert, sweep or erase (stats.pending).
 *
 * A change that cannot be logged (a full disk, as a rule) is LOCUS_E_IO and has not happened; the next one is tried as
 * usual. With a predicate or limits the log learns what left only afterwards: if that fails, the call is LOCUS_E_IO,
 * too, but the store has changed, and the log, which is behind it now, has stopped (locus_pmq_log_stats.stopped); so it
 * has when a flush fails. Changes then return LOCUS_E_STATE and do nothing, queries go on, and a checkpoint that
 * succeeds makes the log go on.
 *
 * `options` as for locus_pmq_load, `log_options` may be NULL for the defaults. `*recovery` (may be NULL; set its
 * struct_size first) tells what was found. `*pmq` is the caller's; NULL on any error. Errors: LOCUS_E_ARGUMENT,
 * LOCUS_E_IO, LOCUS_E_FORMAT (the folder is as before), LOCUS_E_BUSY (another store, in this process or another, has
 * the folder open), LOCUS_E_MEMORY, LOCUS_E_STOPPED. locus_pmq_destroy closes the folder. Any thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_open(const char *folder, const locus_pmq_options *options,
                                      const locus_pmq_log_options *log_options, locus_progress_fn progress, void *user,
                                      locus_pmq_recovery *recovery, locus_pmq **pmq) LOCUS_NOEXCEPT;

/* Give a store that has no log a folder that has no store (made where there is none): save it there, then log every
 * change, as above. Other changes wait meanwhile. Errors: LOCUS_E_ARGUMENT, LOCUS_E_STATE (the store has a folder, or
 * the folder a store), LOCUS_E_IO, LOCUS_E_BUSY, LOCUS_E_MEMORY, LOCUS_E_STOPPED; the store has no log then. Beside
 * readers and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_attach(locus_pmq *pmq, const char *folder, const locus_pmq_log_options *log_options,
                                        locus_progress_fn progress, void *user) LOCUS_NOEXCEPT;

/* Save the present moment into the store's folder, begin a new log and remove files that are no longer needed. An
 * interrupted or failed checkpoint loses nothing: the log goes on, recovery begins at the save before. Errors:
 * LOCUS_E_ARGUMENT, LOCUS_E_STATE (the store has no folder), LOCUS_E_BUSY (a checkpoint is at work), LOCUS_E_IO,
 * LOCUS_E_MEMORY, LOCUS_E_STOPPED. Beside readers and the writer, which waits for the log's change (two flushes) and
 * with the packed array for the save; not from within a callback of the store. Since 0.1. */
LOCUS_API locus_status locus_pmq_checkpoint(locus_pmq *pmq, locus_progress_fn progress, void *user) LOCUS_NOEXCEPT;

/* Flush the log to the disk. With LOCUS_SYNC_INTERVAL a writer that pauses calls it, for what was logged last. Errors:
 * LOCUS_E_ARGUMENT, LOCUS_E_STATE (the store has no folder), LOCUS_E_IO (the log has stopped). Beside readers and the
 * writer, which waits; not from within a callback of the store. Since 0.1. */
LOCUS_API locus_status locus_pmq_sync(locus_pmq *pmq) LOCUS_NOEXCEPT;

/* Store the log's figures; set stats->struct_size first. Zeros without a log. Errors: LOCUS_E_ARGUMENT. Beside readers
 * and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_get_log_stats(const locus_pmq *pmq, locus_pmq_log_stats *stats) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
