/* locus/cold.h - the cold tier of a PMQ: what leaves the store goes into an SQLite database, and a query sees both.
 *
 * liblocus_cold is a library of its own (-llocus_cold), so that programs which keep the live window only do not need
 * SQLite. The rules of locus/locus.h and locus/status.h hold: no exception, abort, exit or print leaves it, and a call
 * that fails leaves every object as it was.
 *
 * A store made with options that locus_cold_attach has filled hands what it lets go to the tier. The tier takes it into
 * a queue in memory, bounded by options.queue_bytes, and a thread of its own writes the queue in large transactions, in
 * the background. Records keep every byte. A query is answered from store, queue and database at one moment: each
 * record that was ever inserted, and that retention has not removed, is in the answer once, whether it is live, has
 * expired in the store, is being handed over, waits in the queue or is in the file.
 *
 * The database. SQLite 3, application id 0x4C434C44, schema version 1, WAL mode. The records lie in runs, tables
 * run_FIRST(key, arrival, record) clustered by (key, arrival) without a rowid: the records of some consecutive
 * transactions, where FIRST is the number of the first record and FIRST + arrival that of a row's. So what is written
 * does not grow with what is stored, and what is too old is dropped with its run. The table `runs` tells of each how
 * many records there are and what times and keys they span; `tier` holds the record layout, how many records were ever
 * written and the clock. Other programs may read the file at any time. One handle at a time has it open: PATH-lock
 * says so.
 *
 * What may be lost. When the process is killed: the queue, so at most what came since the last flush; every transaction
 * that was committed stays, and the file is valid. When the machine loses power: see LOCUS_COLD_SYNC_. */
#ifndef LOCUS_COLD_H
#define LOCUS_COLD_H

#include <locus/pmq.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_cold locus_cold;

/* Threads. Any number may ask at the same time (count, read, visit, get_stats, check), beside each other, the store's
 * writer and the other calls; each of them uses a connection of its own to the database. The sink is called by the one
 * thread that changes the store. flush, sweep and rewind may come from any thread; open, attach and close stand alone.
 */

/* How the file is made safe against loss of power; a transaction is all there or not at all but with OFF. */
#define LOCUS_COLD_SYNC_OFF 0    /* not: the file may be damaged */
#define LOCUS_COLD_SYNC_NORMAL 1 /* valid; transactions since a checkpoint or a flush may be missing */
#define LOCUS_COLD_SYNC_FULL 2   /* valid and complete: each transaction is synced */

/* What to do when the queue is full. */
#define LOCUS_COLD_FULL_WAIT 0   /* the store's change waits for the database */
#define LOCUS_COLD_FULL_REFUSE 1 /* the change returns LOCUS_E_STOPPED; the rest waits in the store */

typedef struct locus_cold_options {
    uint64_t struct_size;
    uint32_t record;        /* LOCUS_RECORD_; default LOCUS_RECORD_POINT32 */
    uint32_t sync;          /* LOCUS_COLD_SYNC_; default LOCUS_COLD_SYNC_NORMAL */
    uint32_t when_full;     /* LOCUS_COLD_FULL_; default LOCUS_COLD_FULL_WAIT */
    uint32_t reserved0;     /* 0 */
    uint64_t queue_bytes;   /* of records in memory, >= 1 MiB; default 64 MiB. 16 bytes a record of the transaction at
                             * work come on top */
    uint64_t batch_records; /* a transaction begins when so many wait, and takes no more; 1..2^26; default 262,144 */
    int64_t delay;          /* microseconds that fewer may wait; > 0; default 1,000,000 */
    uint64_t run_records;   /* a run ends once it has so many; 1..2^32; default 1,048,576 */
    uint64_t cache_bytes;   /* of the writer's page cache, >= 1 MiB; default 64 MiB. A reader's has 8 MiB */
    int64_t max_age;        /* microseconds a record is kept: see locus_cold_sweep; > 0; default LOCUS_NO_HORIZON */
    uint64_t max_bytes;     /* pages in use in the file, without the log beside it; >= 8 MiB; default LOCUS_NO_LIMIT.
                             * Beyond, the run that came first goes, whole; runs are kept to an eighth of it */
} locus_cold_options;

typedef struct locus_cold_stats {
    uint64_t struct_size;
    uint64_t received;     /* records ever taken over, those of earlier handles on the file included */
    uint64_t written;      /* of these, in transactions that were committed; the rest is in the queue */
    uint64_t removed;      /* of these, removed by retention */
    uint64_t stored;       /* rows in the file; what has become too old and is still to be removed included */
    uint64_t runs;         /* runs in the file */
    uint64_t queue_bytes;  /* memory of the queue */
    uint64_t file_bytes;   /* size of the file, without the log beside it, */
    uint64_t free_bytes;   /* of which unused: for the records to come */
    uint64_t transactions; /* committed by this handle */
    uint64_t waits;        /* times the sink waited for room */
    int64_t now;           /* the clock of the latest sweep; INT64_MIN before the first */
    int32_t failure;       /* why the latest transaction failed, LOCUS_E_; LOCUS_OK: it did not */
    uint32_t reserved0;
} locus_cold_stats;

/* What went wrong in the calling thread's latest failed call of liblocus_cold, naming the function, the file and the
 * offending value. It is kept apart from locus_last_error(). The text belongs to the thread: it stays valid until that
 * thread's next failed call of liblocus_cold or its end. "" when nothing has failed yet. Cannot fail. Any thread. Since
 * 0.1. */
LOCUS_API const char *locus_cold_last_error(void) LOCUS_NOEXCEPT;

/* Fill the options (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_cold_options_init(locus_cold_options *options, size_t size) LOCUS_NOEXCEPT;

/* Open the database at `path`, or make it where there is none or an empty file. `options` may be NULL for the defaults.
 * `*cold` is the caller's, to be ended with locus_cold_close; NULL on any error, and then a file that was there is as
 * it was. Errors: LOCUS_E_ARGUMENT (an option out of its range; the file holds records of another layout),
 * LOCUS_E_FORMAT (no SQLite database, one of another program or schema version, a damaged one), LOCUS_E_BUSY (open
 * already, here or in another process), LOCUS_E_IO (the system's reason: the folder is not there or not to be written,
 * the disk is full), LOCUS_E_MEMORY. Since 0.1. */
LOCUS_API locus_status locus_cold_open(const char *path, const locus_cold_options *options,
                                       locus_cold **cold) LOCUS_NOEXCEPT;

/* Write what is queued, as far as the file takes it, and end the tier. The store that it is attached to must have
 * ended, or not change any more. Flush first to learn of failures. NULL is fine. Since 0.1. */
LOCUS_API void locus_cold_close(locus_cold *cold) LOCUS_NOEXCEPT;

/* Set the sink of a store's options to this tier. One store is to be made with them, and handed to the queries below; a
 * second call is for the store that follows once the first has ended. The store counts the records that leave it, and
 * so does the tier: nothing else may use this sink. Errors: LOCUS_E_ARGUMENT (another record layout; a sink that is
 * set). Since 0.1. */
LOCUS_API locus_status locus_cold_attach(locus_cold *cold, locus_pmq_options *options) LOCUS_NOEXCEPT;

/* Count the records that `query` (NULL: all) selects in the attached store and in the tier, as of one moment. `pmq` may
 * be NULL: in the tier alone. With query.snapshot, the moment of that snapshot. What has expired in the store and not
 * left it is part of the answer. Errors: those of locus_pmq_count; LOCUS_E_STATE (records that left the store wait in
 * it, because the sink refused or since it was loaded: sweep it; a store, but none attached), LOCUS_E_IO,
 * LOCUS_E_FORMAT (the file is damaged), LOCUS_E_MEMORY. Since 0.1. */
LOCUS_API locus_status locus_cold_count(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query,
                                        uint64_t *count) LOCUS_NOEXCEPT;

/* Copy them into `records`, which has room for `capacity`, in the order (key, arrival): of equal keys first those in
 * the tier, in the order in which they left the store (that of arrival, where times ascend), then those in the store.
 * `*count` is how many there are, also when the capacity is too small: then the first `capacity` are copied and the
 * status is LOCUS_E_CAPACITY. Errors otherwise as above. Since 0.1. */
LOCUS_API locus_status locus_cold_read(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query,
                                       void *records, size_t capacity, size_t *count) LOCUS_NOEXCEPT;

/* Show them to `visit`, one by one, in the same order and with bounded memory. `visit` must not call into the tier or
 * change the store; while it runs the log beside the file grows with what is written. Errors: as above, LOCUS_E_STOPPED
 * by `visit`. Since 0.1. */
LOCUS_API locus_status locus_cold_visit(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query,
                                        locus_visit_fn visit, void *user) LOCUS_NOEXCEPT;

/* Wait until what has been taken over by now is in the file and, unless options.sync is LOCUS_COLD_SYNC_OFF, on the
 * disk, and until retention has been done. Errors: LOCUS_E_IO (such as a full disk), LOCUS_E_FORMAT, LOCUS_E_MEMORY:
 * the records stay in the queue, remain part of every answer, and are tried again, every second and by the next flush.
 * Since 0.1. */
LOCUS_API locus_status locus_cold_flush(locus_cold *cold) LOCUS_NOEXCEPT;

/* Set the tier's clock to `now` (microseconds), which never runs back. Records of the tier with a time before now -
 * options.max_age are in no answer from then on; their runs are dropped in the background once nothing in them is
 * younger, and runs of mixed age are cleared of them each quarter of max_age. Records that come when they are too old
 * are removed at once. Room in the file that becomes free is used again; once more than a quarter of the file is free
 * it is given back, in steps. Errors: LOCUS_E_ARGUMENT. Since 0.1. */
LOCUS_API locus_status locus_cold_sweep(locus_cold *cold, int64_t now) LOCUS_NOEXCEPT;

/* Forget what was taken over when stats.received had been `received` or more. For a store that was saved, lost and
 * loaded: flush the tier, note stats.received and save the store, all between two changes of it; after the loss load
 * the store, and let the tier forget what had come later, which the loaded store still holds or gets again. Queries
 * must not be at work. Errors: LOCUS_E_ARGUMENT (more than were received), LOCUS_E_STATE (a store is attached),
 * LOCUS_E_IO, LOCUS_E_FORMAT. Since 0.1. */
LOCUS_API locus_status locus_cold_rewind(locus_cold *cold, uint64_t received) LOCUS_NOEXCEPT;

/* Store the statistics; set stats->struct_size first. Errors: LOCUS_E_ARGUMENT. Since 0.1. */
LOCUS_API locus_status locus_cold_get_stats(const locus_cold *cold, locus_cold_stats *stats) LOCUS_NOEXCEPT;

/* Verify the whole file: SQLite's own structure, and that each run holds what `runs` says of it and each row the key of
 * its record. LOCUS_E_FORMAT with a text that names what is broken; LOCUS_E_ARGUMENT, LOCUS_E_IO, LOCUS_E_MEMORY. Since
 * 0.1. */
LOCUS_API locus_status locus_cold_check(locus_cold *cold) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
