/* locus/pmq.h - the PMQ: the live window of a stream of geo-located records, in memory, sorted along the Z-curve.
 *
 * A store holds fixed-size records in the order (key, arrival). The key is the 50-bit Morton code of the record's
 * Web-Mercator tile at zoom 25. Batches come in, records that the window no longer needs go out, and queries read what
 * is there: boxes, heat-map tiles, counts. Method: thesis chapter 3, the packed-memory quadtree (PMQ), on the
 * packed-memory array of Bender et al. 2005. */
#ifndef LOCUS_PMQ_H
#define LOCUS_PMQ_H

#include <locus/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_pmq locus_pmq;
typedef struct locus_pmq_snapshot locus_pmq_snapshot;

/* Threads. One thread at a time changes a store (insert, sweep, erase) or checks it; a second one gets LOCUS_E_BUSY and
 * nothing happens. Any number of threads may ask at the same time, beside the writer, too. Each answer is that of one
 * moment between two batches. With ring leaves nobody waits for readers, and a reader that comes during a small
 * change waits for its end, less than a millisecond as a rule, but never for two. With the packed array readers wait
 * while a change is made, and a change waits for the readers that are at work. Callbacks are called without locks, but
 * for the packed array's: its predicate keeps readers waiting, a reader's filter or visitor the writer, and neither may
 * ask the store. */

/* The record layouts, by size. Latitudes are -90..90 and longitudes -180..180 degrees (180 and -180 are the same
 * meridian and keep the value given; the key takes it as -180); times are microseconds since 1970-01-01 UTC.
 * Coordinates are kept as given; latitudes beyond the Web-Mercator range (85.0511287...) are clamped in the key only.
 */
#define LOCUS_RECORD_POINT32 32
#define LOCUS_RECORD_TEXT156 156

typedef struct locus_point32 {
    double latitude;
    double longitude;
    int64_t time;
    uint16_t device;
    uint16_t application;
    uint16_t language;
    uint16_t spare; /* the caller's */
} locus_point32;

#pragma pack(push, 4)
typedef struct locus_text156 {
    float latitude;
    float longitude;
    int64_t time;
    char text[140]; /* UTF-8, padded with NUL, not necessarily ended by one */
} locus_text156;
#pragma pack(pop)

/* How records lie in memory. Both layouts give the same answers. */
#define LOCUS_LAYOUT_RING_LEAVES 0  /* leaves along the Z-curve, each a ring in order of arrival: no long pauses */
#define LOCUS_LAYOUT_PACKED_ARRAY 1 /* the thesis' packed-memory array, sections 3.2 and 3.4 */

/* How the packed array finds the records of a quadrant. With LOCUS_INDEX_HEADS keys lie apart from the records;
 * segments of 64 slots suit it. */
#define LOCUS_INDEX_IMPLICIT 0 /* binary search on key prefixes over the segments, section 3.4.2 */
#define LOCUS_INDEX_EXPLICIT 1 /* a pointer quadtree whose nodes hold first and last segment, section 3.4.3 */
#define LOCUS_INDEX_HEADS 2    /* a tree of samples over the segments' first keys: fastest, not in the thesis */

/* What to do with a batch that holds a time after `now`. */
#define LOCUS_FUTURE_REFUSE 0 /* LOCUS_E_ARGUMENT names the first such record; nothing of the batch is stored */
#define LOCUS_FUTURE_CLAMP 1  /* the time is set to `now` in the stored copy */

#define LOCUS_NO_HORIZON INT64_MAX
#define LOCUS_NO_LIMIT UINT64_MAX

/* May this record go? 0 keep, 1 remove, negative: stop. Asked at most once per record and pass, in the store's order;
 * the answer permits removal, and when a record goes is the layout's business until locus_pmq_sweep. Called by the
 * thread that inserts or sweeps; must not throw, longjmp or call into the store. After a negative answer the predicate
 * is asked no more in this pass, what it permitted in it stays, horizon and limits hold all the same, and the call
 * returns LOCUS_E_STOPPED. */
typedef int32_t (*locus_remove_fn)(const void *record, void *user);

/* Takes over a record that has just left the store (by predicate, horizon, limit or erase), each exactly once and after
 * the batch is committed. `record` is valid during the call. Return 0 to go on; any other value stops: this record has
 * been taken over, those behind it stay with the store, invisible to queries, and are handed over first by the next
 * insert, sweep or erase. Called by the thread that inserts, sweeps or erases; must not throw, longjmp or call into the
 * store. */
typedef int32_t (*locus_sink_fn)(const void *record, void *user);

/* Limits. A batch that would exceed one makes the oldest records go: by time, of one time in the store's order, records
 * of the batch itself included. So that one pass serves many batches, more go than must: down to a sixteenth below the
 * limit, never further. The packed array needs the memory of a second array while it is written anew; an explicit index
 * that does not fit in max_bytes is given up (same answers, slower). */
typedef struct locus_pmq_options {
    uint64_t struct_size;
    uint32_t record; /* LOCUS_RECORD_; default LOCUS_RECORD_POINT32 */
    uint32_t layout; /* LOCUS_LAYOUT_; default LOCUS_LAYOUT_RING_LEAVES */
    uint32_t index;  /* LOCUS_INDEX_, packed array only; default LOCUS_INDEX_IMPLICIT */
    uint32_t future; /* LOCUS_FUTURE_; default LOCUS_FUTURE_REFUSE */
    int64_t horizon; /* microseconds a record lives: gone once time < now - horizon; > 0; default LOCUS_NO_HORIZON */
    uint64_t max_records; /* most live records, >= 1: see below; default LOCUS_NO_LIMIT */
    uint64_t max_bytes; /* most memory of slots and index between calls, >= 64 KiB, see below; default LOCUS_NO_LIMIT */
    locus_remove_fn remove; /* default NULL */
    void *remove_user;
    locus_sink_fn sink; /* default NULL: evicted records are dropped */
    void *sink_user;
    locus_log_fn log; /* default NULL */
    void *log_user;
    /* The packed array (thesis section 3.2): slots per segment, a power of two 4..4096, default 8; and the bounds of
     * the density, linear from the segment (rho_leaf, tau_leaf) to the whole array (rho_root, tau_root); equations 3.1
     * and 3.4: 0 <= rho_leaf < rho_root < tau_root < tau_leaf <= 1 and 2 * rho_root < tau_root. */
    uint32_t segment_slots;
    uint32_t reserved0; /* 0 */
    double rho_leaf;    /* default 0.08 */
    double tau_leaf;    /* default 0.92 */
    double rho_root;    /* default 0.30 */
    double tau_root;    /* default 0.70 */
    /* Ring leaves: most memory kept only for snapshots, in bytes; beyond, the oldest snapshot turns stale. Default 1
     * GiB. */
    uint64_t snapshot_bytes;
} locus_pmq_options;

/* A box in degrees, borders included. west > east means a box across the antimeridian. Coordinates are compared as they
 * are (a record at a pole has the longitude it was given), but 180 and -180 are one meridian: a border there includes
 * both. */
typedef struct locus_box {
    double south, west, north, east;
} locus_box;

/* The sphere on which distances are measured: the Earth's mean radius in metres (IUGG 1980). */
#define LOCUS_EARTH_RADIUS 6371008.7714

/* The places at most `radius` metres from a centre along the great circle, border included, across the antimeridian and
 * the poles: latitude -90..90, longitude -180..180, radius 0..20015114.35, pi times LOCUS_EARTH_RADIUS: half the
 * globe's circumference. Every longitude at a pole is the same place. Distances are computed in double precision, to a
 * nanometre or the last digit. */
typedef struct locus_circle {
    double latitude, longitude, radius;
} locus_circle;

typedef struct locus_position {
    double latitude, longitude;
} locus_position;

/* Rings with the even-odd rule: a place that an odd number of rings encloses belongs to the polygon, so a ring within
 * another is a hole. Borders are included, those of holes too, exactly. Edges are straight in longitude and latitude.
 * Latitudes are -90..90, longitudes -360..360 and span at most 360 degrees: across the antimeridian they run on (170,
 * 175, 185). Each ring has three vertices or more, its end joins its beginning (a vertex that repeats the one before,
 * or the first at the end, counts once), and it does not touch itself; two rings may touch in single points, and do not
 * cross or share parts of edges. */
typedef struct locus_polygon {
    const locus_position *vertices; /* of all rings, one ring after the other */
    const uint64_t *ring_sizes;     /* vertices per ring */
    uint64_t rings;                 /* number of rings, >= 1 */
} locus_polygon;

/* Accept a record? Not 0: yes. For queries; called by the thread that asks; must not throw, longjmp or call into the
 * store. */
typedef int32_t (*locus_filter_fn)(const void *record, void *user);

/* Receives a record, valid during the call, in the order that was asked for. Return 0 to go on; any other value stops
 * the call, which then returns LOCUS_E_STOPPED. Called by the thread that asks; must not throw, longjmp or change the
 * store. */
typedef int32_t (*locus_visit_fn)(const void *record, void *user);

/* Where a query looks. */
#define LOCUS_REGION_ALL 0
#define LOCUS_REGION_BOX 1
#define LOCUS_REGION_CIRCLE 2
#define LOCUS_REGION_POLYGON 3

/* In which order locus_pmq_read and locus_pmq_visit give records. */
#define LOCUS_ORDER_KEY 0 /* the store's, (key, arrival) */
#define LOCUS_ORDER_ANY 1 /* any, as fast as the layout can: ring leaves need not sort */

typedef struct locus_pmq_query {
    uint64_t struct_size;
    uint32_t region;        /* LOCUS_REGION_; default LOCUS_REGION_ALL */
    uint32_t expired;       /* 1: records that have expired and have not left the store yet, too; default 0 */
    locus_box box;          /* for LOCUS_REGION_BOX */
    int64_t time_from;      /* microseconds, included; default INT64_MIN */
    int64_t time_to;        /* microseconds, included; default INT64_MAX */
    locus_filter_fn filter; /* default NULL */
    void *filter_user;
    /* Ask this snapshot of the same store instead of the present; default NULL. Not for locus_pmq_erase, nor is
     * `expired`. */
    const locus_pmq_snapshot *snapshot;
    locus_circle circle;   /* for LOCUS_REGION_CIRCLE */
    locus_polygon polygon; /* for LOCUS_REGION_POLYGON; read during the call only */
    /* Receives, before the first record is looked at, how many records had left the store by the moment of the answer:
     * that many have been handed to the sink or are going to be, and what is handed over behind them was still in the
     * store. So a place that keeps what the sink takes over and a query with `expired` make one answer; default NULL */
    uint64_t *left;
    uint32_t order;     /* LOCUS_ORDER_, for locus_pmq_read and locus_pmq_visit of a store; default LOCUS_ORDER_KEY */
    uint32_t reserved0; /* 0 */
} locus_pmq_query;

/* What makes a record good for locus_pmq_topk: near to a place, and young. */
typedef struct locus_pmq_score {
    uint64_t struct_size;
    double latitude;  /* -90..90; default 0 */
    double longitude; /* -180..180; default 0 */
    double radius;    /* R, metres, > 0 and at most half the globe, see locus_circle; default 30,000 */
    double alpha;     /* weight of the distance, 0..1; the age has the rest; default 0.2 */
    int64_t period;   /* T, microseconds, > 0; default 10,000 s */
} locus_pmq_score;

typedef struct locus_pmq_stats {
    uint64_t struct_size;
    uint64_t records;          /* live records: what a query of everything counts */
    uint64_t stored;           /* records in slots, the expired ones that are still to be removed included */
    uint64_t pending;          /* evicted records that wait for the sink after it stopped */
    uint64_t slots;            /* slots for records */
    uint64_t bytes;            /* memory held */
    uint64_t inserted;         /* records ever inserted, */
    uint64_t evicted;          /* and removed by predicate, horizon or limit, */
    uint64_t erased;           /* and removed by locus_pmq_erase */
    uint64_t batches;          /* batches inserted */
    uint64_t moved;            /* records moved within the layout */
    uint64_t rebalances;       /* windows rebalanced, or leaves split and merged */
    uint64_t grows;            /* times the array doubled, */
    uint64_t shrinks;          /* and halved */
    uint64_t longest_pause_ns; /* the longest change (insert, sweep, erase) so far, without the sink; wall time */
    double density;            /* stored / slots */
    int64_t now;               /* the clock of the latest insert or sweep; INT64_MIN before the first */
} locus_pmq_stats;

/* Fill the options or the query (of `size` bytes) with the defaults stated at the fields.
 * Errors: LOCUS_E_ARGUMENT. Any thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_options_init(locus_pmq_options *options, size_t size) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_pmq_query_init(locus_pmq_query *query, size_t size) LOCUS_NOEXCEPT;

/* The key of a place: the Morton code of its Web-Mercator tile at zoom 25, 50 bits, y in the odd (higher) bits.
 * Errors: LOCUS_E_ARGUMENT (NaN or outside -90..90, -180..180). Any thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_key(double latitude, double longitude, uint64_t *key) LOCUS_NOEXCEPT;

/* Make an empty store. `options` may be NULL for the defaults. `*pmq` is the caller's, to be ended with
 * locus_pmq_destroy; NULL on any error. Errors: LOCUS_E_ARGUMENT (an option out of its range), LOCUS_E_MEMORY. Any
 * thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_create(const locus_pmq_options *options, locus_pmq **pmq) LOCUS_NOEXCEPT;

/* End a store. Its records are dropped, not handed to the sink. NULL is fine. Since 0.1. */
LOCUS_API void locus_pmq_destroy(locus_pmq *pmq) LOCUS_NOEXCEPT;

/* Insert `count` records of the store's layout, in their order of arrival, and set the store's clock to `now`
 * (microseconds), which never runs back. The batch is committed whole; then what has to go is evicted and handed to the
 * sink. A record that is already older than the horizon is evicted like any other and never seen by a query. Errors
 * that store nothing: LOCUS_E_ARGUMENT (coordinates that are NaN or out of range, a time after `now` unless clamped:
 * the text names the first such record's index and value; a clock that runs back), LOCUS_E_MEMORY. LOCUS_E_STOPPED: the
 * batch is stored and visible, but the predicate, the sink or a callback of locus/alerts.h stopped. LOCUS_E_BUSY.
 * Beside readers. Since 0.1. */
LOCUS_API locus_status locus_pmq_insert(locus_pmq *pmq, const void *records, size_t count, int64_t now) LOCUS_NOEXCEPT;

/* Set the clock to `now` and evict everything that may go: expired records, those the predicate permits, what exceeds
 * the limits. `*evicted` (may be NULL) is the number of records that left. Errors: LOCUS_E_ARGUMENT (a clock that runs
 * back), LOCUS_E_MEMORY (nothing removed), LOCUS_E_STOPPED. LOCUS_E_BUSY. Beside readers. Since 0.1. */
LOCUS_API locus_status locus_pmq_sweep(locus_pmq *pmq, int64_t now, uint64_t *evicted) LOCUS_NOEXCEPT;

/* Remove the live records that `query` selects (NULL: all) and hand them to the sink. `*erased` (may be NULL) is their
 * number. Errors: LOCUS_E_ARGUMENT, LOCUS_E_MEMORY (nothing removed), LOCUS_E_STOPPED (by the sink; they are removed).
 * LOCUS_E_BUSY. Beside readers. Since 0.1. */
LOCUS_API locus_status locus_pmq_erase(locus_pmq *pmq, const locus_pmq_query *query, uint64_t *erased) LOCUS_NOEXCEPT;

/* Keep the present moment, its records and its clock, for several queries (locus_pmq_query.snapshot). What the store
 * changes meanwhile it changes in copies, whose memory is bounded by options.snapshot_bytes: beyond, the oldest
 * snapshot turns stale, and queries of it return LOCUS_E_STALE. `*snapshot` is the caller's, to be ended with
 * locus_pmq_snapshot_destroy, before or after the store; NULL on any error. Errors: LOCUS_E_ARGUMENT, LOCUS_E_MEMORY,
 * LOCUS_E_UNSUPPORTED (packed array). Beside readers and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_snapshot_create(const locus_pmq *pmq, locus_pmq_snapshot **snapshot) LOCUS_NOEXCEPT;

/* End a snapshot. NULL is fine. Not beside a query of it. Since 0.1. */
LOCUS_API void locus_pmq_snapshot_destroy(locus_pmq_snapshot *snapshot) LOCUS_NOEXCEPT;

/* Count the live records that `query` selects (NULL: all). Errors: LOCUS_E_ARGUMENT. LOCUS_E_STALE. Beside readers and
 * the writer. Since 0.1.
 */
LOCUS_API locus_status locus_pmq_count(const locus_pmq *pmq, const locus_pmq_query *query,
                                       uint64_t *count) LOCUS_NOEXCEPT;

/* Copy the live records that `query` selects (NULL: all), in the order (key, arrival) unless `query` asks for another,
 * into `records`, which has room for `capacity` of them. `*count` is how many there are, also when the capacity is too
 * small: then the first `capacity` are copied and the status is LOCUS_E_CAPACITY. Errors: LOCUS_E_ARGUMENT.
 * LOCUS_E_STALE. Beside readers and the writer. Since 0.1.
 */
LOCUS_API locus_status locus_pmq_read(const locus_pmq *pmq, const locus_pmq_query *query, void *records,
                                      size_t capacity, size_t *count) LOCUS_NOEXCEPT;

/* Show the same records to `visit`, one by one. Errors: LOCUS_E_ARGUMENT, LOCUS_E_STOPPED. LOCUS_E_STALE. Beside
 * readers and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_visit(const locus_pmq *pmq, const locus_pmq_query *query, locus_visit_fn visit,
                                       void *user) LOCUS_NOEXCEPT;

/* A position in the order (key, arrival): after every smaller key, and after `passed` of the selected records with this
 * one. All zero is the beginning; LOCUS_KEY_END, 0 is the end. */
#define LOCUS_KEY_END ((uint64_t)1 << 50)
typedef struct locus_pmq_cursor {
    uint64_t key;
    uint64_t passed; /* other than 0 within a snapshot only */
} locus_pmq_cursor;

/* Go on in the order (key, arrival): copy the selected records behind `*cursor` (NULL query: all) into `records`, which
 * has room for `capacity` of them, >= 1, and move the cursor behind the last. `*count` is how many were copied; 0:
 * there are no more. While the store changes from page to page the cursor stays exact, for a page ends between two
 * keys: each page is of one moment, no record is shown twice, and one that is there from the first page to the last is
 * shown once; what comes or goes meanwhile is shown if it is there when its key is passed. So `capacity` must reach for
 * the selected records of one key (as of one place): else LOCUS_E_CAPACITY, `*count` is what that key needs, and the
 * cursor stays. The pages of a snapshot are filled to the capacity, whatever the keys; ask it with the same query all
 * along. Errors: LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY, LOCUS_E_STALE: the cursor stays. Beside readers and the writer.
 * Since 0.1. */
LOCUS_API locus_status locus_pmq_read_page(const locus_pmq *pmq, const locus_pmq_query *query, locus_pmq_cursor *cursor,
                                           void *records, size_t capacity, size_t *count) LOCUS_NOEXCEPT;

/* By what locus_pmq_groups tells records apart: an id field of locus_point32, or a function of the caller's. */
#define LOCUS_FIELD_DEVICE 0
#define LOCUS_FIELD_APPLICATION 1
#define LOCUS_FIELD_LANGUAGE 2
#define LOCUS_FIELD_CALLER 3

/* The group that a record belongs to. Called by the thread that asks, in no particular order; must not throw, longjmp
 * or change the store. */
typedef uint64_t (*locus_group_fn)(const void *record, void *user);

typedef struct locus_pmq_group {
    uint64_t value; /* of the field, or the caller's */
    uint64_t count; /* records, >= 1 */
    int64_t newest; /* the largest time among them, microseconds */
} locus_pmq_group;

/* Count the live records that `query` selects (NULL: all) by the value of `field`, LOCUS_FIELD_; for LOCUS_FIELD_CALLER
 * by what `group` says of them (else it may be NULL; `user` is handed to it). The groups come into `groups`, which has
 * room for `capacity` of them, the largest first, equal ones by rising value. `*count` is how many there are, also when
 * the capacity is too small: then the first `capacity`, the largest, are stored, and the status is LOCUS_E_CAPACITY.
 * Errors: LOCUS_E_ARGUMENT, LOCUS_E_UNSUPPORTED (the store's records have no such field), LOCUS_E_MEMORY,
 * LOCUS_E_STALE. Beside readers and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_groups(const locus_pmq *pmq, const locus_pmq_query *query, uint32_t field,
                                        locus_group_fn group, void *user, locus_pmq_group *groups, size_t capacity,
                                        size_t *count) LOCUS_NOEXCEPT;

/* Count the live records per bin of the Web-Mercator tile (zoom, x, y), zoom 0..25, x from the west, y from the north,
 * both below 2^zoom: 2^log2_bins bins a side (0..8), row by row from the north-west, into `bins`, which has room for
 * `capacity` numbers (a count beyond 2^32 - 1 stays there). A record belongs to the bin of its (clamped) key; finer
 * than the key's 25 levels, of its coordinates. `query` (may be NULL) adds a time window and a filter; its region must
 * be LOCUS_REGION_ALL. `*total` (may be NULL) is the sum. Errors: LOCUS_E_ARGUMENT (a tile that does not exist),
 * LOCUS_E_CAPACITY. LOCUS_E_STALE. Beside readers and the writer. Since 0.1. */
LOCUS_API locus_status locus_pmq_tile(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins,
                                      const locus_pmq_query *query, uint32_t *bins, size_t capacity,
                                      uint64_t *total) LOCUS_NOEXCEPT;

/* The weight of a record, a finite number. For locus_pmq_weighted_tile; called by the thread that asks, in the store's
 * order; must not throw, longjmp or change the store. */
typedef double (*locus_record_weight_fn)(const void *record, void *user);

/* The same with each record counted as the `weight` of it, into bins that hold sums. They are added up in the store's
 * order, so that every layout gives the same bits. Errors: those of locus_pmq_tile; LOCUS_E_ARGUMENT, too, when
 * `weight` returns what is no finite number: then `bins` holds nothing of use. Beside readers and the writer. Since
 * 0.1. */
LOCUS_API locus_status locus_pmq_weighted_tile(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y,
                                               uint32_t log2_bins, const locus_pmq_query *query,
                                               locus_record_weight_fn weight, void *user, double *bins, size_t capacity,
                                               double *total) LOCUS_NOEXCEPT;

/* Fill a score (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread. Since
 * 0.1. */
LOCUS_API locus_status locus_pmq_score_init(locus_pmq_score *score, size_t size) LOCUS_NOEXCEPT;

/* Copy the k live records with the lowest scores, lowest first, ties in the store's order:
 *   score = alpha * distance / R + (1 - alpha) * (now - time) / T
 * for great-circle distances up to R and ages up to T at the store's clock. `records` has room for k records, k >= 1;
 * `scores` (may be NULL) for k numbers; `*count` is how many there are, at most k. `query` (may be NULL) adds a time
 * window and a filter, which is asked in no particular order; its region must be LOCUS_REGION_ALL. Errors:
 * LOCUS_E_ARGUMENT, LOCUS_E_MEMORY, LOCUS_E_STALE. Beside readers and the writer. Source: thesis section 3.5.3. Since
 * 0.1. */
LOCUS_API locus_status locus_pmq_topk(const locus_pmq *pmq, const locus_pmq_score *score, const locus_pmq_query *query,
                                      size_t k, void *records, double *scores, size_t *count) LOCUS_NOEXCEPT;

/* The same for the k records nearest to a place, at any distance and age; `distances` (may be NULL) in metres.
 * Errors and threads as above. Since 0.1. */
LOCUS_API locus_status locus_pmq_nearest(const locus_pmq *pmq, double latitude, double longitude,
                                         const locus_pmq_query *query, size_t k, void *records, double *distances,
                                         size_t *count) LOCUS_NOEXCEPT;

/* A query made ready for records that lie elsewhere, in a file or a database: it tells which keys to look at, and of
 * each record there whether the query selects it. */
typedef struct locus_pmq_selection locus_pmq_selection;

/* Keys first..last, both included. `inside` is 1 when every place with such a key lies in the region. */
typedef struct locus_key_range {
    uint64_t first, last;
    uint32_t inside;
    uint32_t reserved0; /* 0 */
} locus_key_range;

/* Make `query` (NULL: everything) ready for records of a layout, LOCUS_RECORD_. The query is copied, its polygon too;
 * `snapshot`, `expired` and `left` mean nothing here. `*selection` is the caller's, to be ended with
 * locus_pmq_selection_destroy; NULL on any error. Errors: LOCUS_E_ARGUMENT, LOCUS_E_MEMORY. Any thread. Since 0.1. */
LOCUS_API locus_status locus_pmq_selection_create(const locus_pmq_query *query, uint32_t record,
                                                  locus_pmq_selection **selection) LOCUS_NOEXCEPT;

/* End a selection. NULL is fine. Since 0.1. */
LOCUS_API void locus_pmq_selection_destroy(locus_pmq_selection *selection) LOCUS_NOEXCEPT;

/* Key ranges that hold every record the query selects: disjoint, ascending, at most `capacity` >= 1 of them, and the
 * more closely round the region the more there may be. `*count` is their number. Errors: LOCUS_E_ARGUMENT,
 * LOCUS_E_MEMORY. Any number of threads. Since 0.1. */
LOCUS_API locus_status locus_pmq_selection_ranges(const locus_pmq_selection *selection, locus_key_range *ranges,
                                                  size_t capacity, size_t *count) LOCUS_NOEXCEPT;

/* Does the query select this record? `*matches` is 1 or 0. `inside`: 1 if its key lies in a range that is inside, so
 * that the region need not be asked, else 0. The filter is asked last. Errors: LOCUS_E_ARGUMENT. Any number of threads.
 * Since 0.1. */
LOCUS_API locus_status locus_pmq_selection_matches(const locus_pmq_selection *selection, const void *record,
                                                   uint32_t inside, int32_t *matches) LOCUS_NOEXCEPT;

/* Store the statistics; set stats->struct_size first. Errors: LOCUS_E_ARGUMENT. Beside readers and the writer. Since
 * 0.1. */
LOCUS_API locus_status locus_pmq_get_stats(const locus_pmq *pmq, locus_pmq_stats *stats) LOCUS_NOEXCEPT;

/* Verify every invariant of the store: order, counts, densities, index. Reads all records. LOCUS_E_INTERNAL with a text
 * that names what is broken; LOCUS_E_ARGUMENT, LOCUS_E_BUSY. Beside readers. Since 0.1. */
LOCUS_API locus_status locus_pmq_check(const locus_pmq *pmq) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
