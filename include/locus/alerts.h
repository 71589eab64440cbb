/* locus/alerts.h - what happens in a stream: regions where more arrives than their history leads to expect, and records
 * inside the caller's fences.
 *
 * An alerts object watches what is inserted into a PMQ store (locus/pmq.h). Alerts: a quadtree over the Web-Mercator
 * square keeps, for each region (tile) of it, how many records came lately and how many came before, both as sums that
 * decay with the age of the records. Where a region stands out, a callback is told, once. Fences: boxes, circles and
 * polygons under the caller's ids; a callback is shown the records that arrive inside. Both are called after the batch
 * is committed. Memory is bounded, and so is the work for a record: the levels of the quadtree, and the fences near it.
 * Method: thesis section 3.9; exponential decay forward in time after Cormode et al. 2009. */
#ifndef LOCUS_ALERTS_H
#define LOCUS_ALERTS_H

#include <locus/pmq.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_alerts locus_alerts;

/* Threads. The thread that inserts into the store calls the callbacks, within locus_pmq_insert, when the batch is
 * stored and visible; no lock is held. They may query the store, add and remove fences, ask for the active alerts and
 * destroy the object; a change of the store returns LOCUS_E_BUSY. They must not throw or longjmp. Beside an insert, any
 * number of threads may call what is below, unless it says otherwise. */

/* Why a region is reported. */
#define LOCUS_ALERT_JUMP 0  /* far more arrives there than its own history leads to expect */
#define LOCUS_ALERT_RATE 1  /* more records a second than options.rate */
#define LOCUS_ALERT_SHARE 2 /* a larger part of all that arrives than options.share */

typedef struct locus_alert {
    uint64_t number;     /* 1, 2, ... in the order in which this object raised them */
    uint32_t kind;       /* LOCUS_ALERT_ */
    uint32_t zoom, x, y; /* the region: a Web-Mercator tile, x from the west, y from the north, */
    locus_box box;       /* and its borders in degrees */
    int64_t time;        /* the store's clock when it was raised, microseconds */
    double records;      /* records that arrived there lately: each counts 2^(-age / half_life) */
    double rate;         /* the same in records a second: now, */
    double expected;     /* and as the region's history leads to expect */
    double share;        /* its part of all that arrives now, 0..1 */
} locus_alert;

/* Told of a region, once: see locus_alerts_options. `alert` is valid during the call. Return 0 to go on; any other
 * value stops: what is left to tell of this batch is dropped (locus_alerts_active lists its alerts all the same), and
 * locus_pmq_insert returns LOCUS_E_STOPPED. */
typedef int32_t (*locus_alert_fn)(const locus_alert *alert, void *user);

/* Shown a record of the batch that lies inside a fence, in order of arrival; for each record its fences by rising id.
 * `record` is valid during the call. Return 0 to go on; any other value stops, likewise. */
typedef int32_t (*locus_fence_fn)(uint64_t fence, const void *record, void *user);

/* When a region stands out. A record counts by its own time, not by when its batch comes, so late ones raise nothing.
 * Its weight halves with every `half_life` for what came lately, the present; the history is the same with a longer
 * half life, less the present.
 * - JUMP: the present holds `minimum` records or more, and `factor` times what is expected or more. Expected is what
 * the region's history gives, or its part of the whole stream's history gives of the whole stream's present, whichever
 * is more, plus three standard deviations of that estimate. So a young object, or a stream that as a whole is faster
 *   than before, raises nothing by that.
 * - RATE, SHARE: the present holds `minimum` records or more, and the threshold is reached.
 * The deepest such region is reported, and not those that hold it. For a jump, a region coarser than zoom_to has to
 * hold 6 * minimum more than is expected: of what lies on the seam of four of the finest, one of these is reported. A
 * region stays active until its excess is down to half of what it takes; until `cool_down` later no region that touches
 * it, lies in it or holds it is reported again for the same kind. At most 256 are active or cooling down at once;
 * beyond, none is raised. When nothing comes for the length of `history`, everything begins anew. */
typedef struct locus_alerts_options {
    uint64_t struct_size;
    uint32_t zoom_from; /* the coarsest regions that are reported, 0..zoom_to; default 5 */
    uint32_t zoom_to;   /* the finest, ..25; default 12: 10 km at the equator */
    int64_t half_life;  /* of the present, microseconds, > 0; default 5 minutes */
    int64_t history;    /* half life of the history, microseconds, 2..100 times half_life; default 1 hour */
    int64_t cool_down;  /* microseconds, >= 0; default 30 minutes */
    double minimum;     /* records, > 0; default 20 */
    double factor;      /* > 1; default 4; INFINITY: no alerts of this kind */
    double rate;        /* records a second, > 0; default INFINITY: no alerts of this kind */
    double share;       /* 0..1, > 0; default INFINITY: no alerts of this kind */
    /* Most memory of the quadtree, >= 64 KiB; default 64 MiB, about a million regions. When it does not suffice, those
     * with the least history are let go, and what comes there counts for the region that holds them until they have a
     * history again. */
    uint64_t max_bytes;
    locus_alert_fn alert; /* default NULL */
    void *alert_user;
    locus_fence_fn fence; /* default NULL */
    void *fence_user;
} locus_alerts_options;

typedef struct locus_alerts_stats {
    uint64_t struct_size;
    uint64_t regions; /* of the quadtree at present */
    uint64_t fences;
    uint64_t raised; /* alerts so far */
    uint64_t shown;  /* calls of the fence callback so far */
    uint64_t bytes;  /* memory held */
} locus_alerts_stats;

/* Fill the options (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_alerts_options_init(locus_alerts_options *options, size_t size) LOCUS_NOEXCEPT;

/* Watch what is inserted into `pmq` from now on; what it holds already does not count. A store may be watched by
 * several objects, which are told one after the other, in the order of their creation. `options` may be NULL for the
 * defaults.
 * `*alerts` is the caller's, to be ended with locus_alerts_destroy, before or after the store; NULL on any error.
 * Errors: LOCUS_E_ARGUMENT (an option out of its range), LOCUS_E_MEMORY, LOCUS_E_BUSY (another thread changes the
 * store, or this is its callback). Beside readers of the store. Since 0.1. */
LOCUS_API locus_status locus_alerts_create(locus_pmq *pmq, const locus_alerts_options *options,
                                           locus_alerts **alerts) LOCUS_NOEXCEPT;

/* End an alerts object; its callbacks are called no more. NULL is fine. Not beside an insert of another thread. Since
 * 0.1. */
LOCUS_API void locus_alerts_destroy(locus_alerts *alerts) LOCUS_NOEXCEPT;

/* Copy the active alerts into `active`, which has room for `capacity` of them, the latest first, with the numbers of
 * the latest batch. `*count` is how many there are, also when the capacity is too small: then the first `capacity` are
 * copied and the status is LOCUS_E_CAPACITY. Errors: LOCUS_E_ARGUMENT. Since 0.1. */
LOCUS_API locus_status locus_alerts_active(const locus_alerts *alerts, locus_alert *active, size_t capacity,
                                           size_t *count) LOCUS_NOEXCEPT;

/* Add a fence under an id of the caller's: the records that `query` selects, by its region, time window and filter
 * (which is asked without a lock), from the next batch on at the latest. Everything is copied but filter_user. Errors
 * that add nothing: LOCUS_E_ARGUMENT (the id is in use; a bad region; a snapshot), LOCUS_E_MEMORY. Since 0.1. */
LOCUS_API locus_status locus_alerts_add_fence(locus_alerts *alerts, uint64_t id,
                                              const locus_pmq_query *query) LOCUS_NOEXCEPT;

/* Remove a fence: nothing more is shown for it; a call for it that another thread has begun may still go on. Errors:
 * LOCUS_E_ARGUMENT (no such id). Since 0.1. */
LOCUS_API locus_status locus_alerts_remove_fence(locus_alerts *alerts, uint64_t id) LOCUS_NOEXCEPT;

/* Store the statistics; set stats->struct_size first. Errors: LOCUS_E_ARGUMENT. Since 0.1. */
LOCUS_API locus_status locus_alerts_get_stats(const locus_alerts *alerts, locus_alerts_stats *stats) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
