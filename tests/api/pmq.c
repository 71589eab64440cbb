/* locus/pmq.h: a walk through the calls, and every bad argument. */
#include "check.h"
#include "point.h"

#include <locus/pmq.h>

#include <math.h>

#define SECOND ((int64_t)1000000)

static locus_pmq_query everything(void) {
    locus_pmq_query query;
    WORKS(locus_pmq_query_init(&query, sizeof query));
    return query;
}

static locus_pmq_query box(double south, double west, double north, double east) {
    locus_pmq_query query = everything();
    query.region = LOCUS_REGION_BOX;
    query.box.south = south;
    query.box.west = west;
    query.box.north = north;
    query.box.east = east;
    return query;
}

static void defaults(void) {
    locus_pmq_options options;
    locus_pmq_query query;
    memset(&options, 0xA5, sizeof options);
    memset(&query, 0xA5, sizeof query);
    WORKS(locus_pmq_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.record == LOCUS_RECORD_POINT32);
    CHECK(options.layout == LOCUS_LAYOUT_RING_LEAVES && options.index == LOCUS_INDEX_IMPLICIT);
    CHECK(options.future == LOCUS_FUTURE_REFUSE && options.horizon == LOCUS_NO_HORIZON);
    CHECK(options.max_records == LOCUS_NO_LIMIT && options.max_bytes == LOCUS_NO_LIMIT);
    CHECK(options.remove == NULL && options.sink == NULL && options.log == NULL);
    CHECK(options.segment_slots == 8 && options.reserved0 == 0);
    CHECK(options.rho_leaf == 0.08 && options.tau_leaf == 0.92 && options.rho_root == 0.30 && options.tau_root == 0.70);
    REFUSES(locus_pmq_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_pmq_options_init(&options, sizeof options - 1), LOCUS_E_ARGUMENT, "size");
    WORKS(locus_pmq_query_init(&query, sizeof query));
    CHECK(query.struct_size == sizeof query && query.region == LOCUS_REGION_ALL && query.expired == 0);
    CHECK(query.time_from == INT64_MIN && query.time_to == INT64_MAX && query.filter == NULL && query.left == NULL);
    CHECK(query.order == LOCUS_ORDER_KEY && query.reserved0 == 0);
    REFUSES(locus_pmq_query_init(NULL, sizeof query), LOCUS_E_ARGUMENT, "query");
    REFUSES(locus_pmq_query_init(&query, 0), LOCUS_E_ARGUMENT, "size");
}

static void keys(void) {
    uint64_t west = 0, east = 0;
    WORKS(locus_pmq_key(0, -180, &west));
    WORKS(locus_pmq_key(90, 180, &east));
    CHECK(west < (uint64_t)1 << 50 && east < (uint64_t)1 << 50);
    REFUSES(locus_pmq_key(NAN, 0, &west), LOCUS_E_ARGUMENT, "latitude");
    REFUSES(locus_pmq_key(90.5, 0, &west), LOCUS_E_ARGUMENT, "latitude is 90.5");
    REFUSES(locus_pmq_key(0, -180.5, &west), LOCUS_E_ARGUMENT, "longitude is -180.5");
    REFUSES(locus_pmq_key(0, INFINITY, &west), LOCUS_E_ARGUMENT, "longitude");
    REFUSES(locus_pmq_key(0, 0, NULL), LOCUS_E_ARGUMENT, "key is NULL");
}

/* One option is wrong: the text names it, and no store is made. */
#define BAD_OPTION(change, words)                                                                                      \
    do {                                                                                                               \
        locus_pmq_options options;                                                                                     \
        locus_pmq *pmq = (locus_pmq *)&options;                                                                        \
        WORKS(locus_pmq_options_init(&options, sizeof options));                                                       \
        options.change;                                                                                                \
        REFUSES(locus_pmq_create(&options, &pmq), LOCUS_E_ARGUMENT, words);                                            \
        CHECK(pmq == NULL);                                                                                            \
    } while (0)

static void bad_options(void) {
    union {
        locus_pmq_options options;
        unsigned char bytes[sizeof(locus_pmq_options) + 8];
    } newer;
    locus_pmq *pmq = NULL;
    REFUSES(locus_pmq_create(NULL, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    BAD_OPTION(struct_size = 0, "struct_size is 0");
    BAD_OPTION(struct_size = sizeof options - 8, "struct_size");
    BAD_OPTION(record = 33, "record is 33");
    BAD_OPTION(layout = 99, "layout is 99");
    BAD_OPTION(index = 9, "index is 9");
    BAD_OPTION(future = 9, "future is 9");
    BAD_OPTION(horizon = 0, "horizon is 0");
    BAD_OPTION(horizon = -1, "horizon is -1");
    BAD_OPTION(max_records = 0, "max_records is 0");
    BAD_OPTION(max_bytes = 65535, "max_bytes is 65535");
    BAD_OPTION(segment_slots = 0, "segment_slots is 0");
    BAD_OPTION(segment_slots = 2, "segment_slots is 2");
    BAD_OPTION(segment_slots = 12, "segment_slots is 12");
    BAD_OPTION(segment_slots = 8192, "segment_slots is 8192");
    BAD_OPTION(reserved0 = 1, "reserved0 is 1");
    BAD_OPTION(rho_leaf = -0.25, "rho_leaf");
    BAD_OPTION(rho_leaf = NAN, "rho_leaf");
    BAD_OPTION(rho_leaf = 0.5, "rho_leaf");
    BAD_OPTION(rho_root = 0.5, "rho_root");
    BAD_OPTION(tau_root = 0.95, "tau_root");
    BAD_OPTION(tau_leaf = 1.5, "tau_leaf");
    WORKS(locus_pmq_options_init(&newer.options, sizeof newer));
    WORKS(locus_pmq_create(&newer.options, &pmq));
    locus_pmq_destroy(pmq);
    newer.bytes[sizeof newer - 1] = 1;
    REFUSES(locus_pmq_create(&newer.options, &pmq), LOCUS_E_ARGUMENT, "struct_size");
    CHECK(pmq == NULL);
}

static int32_t count_them(const void *record, void *user) {
    (void)record;
    ++*(int *)user;
    return 0;
}

static int32_t stop_at_three(const void *record, void *user) {
    (void)record;
    return ++*(int *)user == 3;
}

static int32_t odd_device(const void *record, void *user) {
    (void)user;
    return ((const locus_point32 *)record)->device % 2;
}

/* Every call that takes a query refuses the same bad ones. */
#define BAD_QUERY(change, words)                                                                                       \
    do {                                                                                                               \
        locus_pmq_query query = box(10, 20, 30, 40);                                                                   \
        query.change;                                                                                                  \
        REFUSES(locus_pmq_count(pmq, &query, &number), LOCUS_E_ARGUMENT, words);                                       \
        REFUSES(locus_pmq_read(pmq, &query, records, 8, &count), LOCUS_E_ARGUMENT, words);                             \
        REFUSES(locus_pmq_visit(pmq, &query, count_them, &calls), LOCUS_E_ARGUMENT, words);                            \
        REFUSES(locus_pmq_erase(pmq, &query, &number), LOCUS_E_ARGUMENT, words);                                       \
    } while (0)

static void bad_queries(locus_pmq *pmq) {
    const locus_pmq_query region = box(0, 0, 1, 1);
    const uint64_t four = 4;
    locus_position ring[4] = {{0, 0}, {2, 2}, {0, 2}, {2, 0}};
    locus_polygon bow;
    locus_point32 records[8];
    uint32_t bins[4];
    uint64_t number = 0;
    size_t count = 0;
    int calls = 0;
    bow.vertices = ring;
    bow.ring_sizes = &four;
    bow.rings = 1;
    BAD_QUERY(struct_size = 0, "struct_size is 0");
    BAD_QUERY(struct_size = 128, "struct_size");
    BAD_QUERY(region = 99, "region is 99");
    BAD_QUERY(expired = 2, "expired is 2");
    BAD_QUERY(order = 2, "order is 2");
    BAD_QUERY(reserved0 = 1, "reserved0 is 1");
    BAD_QUERY(box.south = 50, "south");
    BAD_QUERY(box.south = -90.5, "south");
    BAD_QUERY(box.north = 91, "north");
    BAD_QUERY(box.north = NAN, "north");
    BAD_QUERY(box.west = -181, "west");
    BAD_QUERY(box.east = 181, "east");
    BAD_QUERY(box.east = NAN, "east");
    BAD_QUERY(region = LOCUS_REGION_CIRCLE; query.circle.radius = -1, "circle.radius is -1");
    BAD_QUERY(region = LOCUS_REGION_CIRCLE; query.circle.radius = NAN, "circle.radius");
    BAD_QUERY(region = LOCUS_REGION_CIRCLE; query.circle.radius = 20015200, "half the globe");
    BAD_QUERY(region = LOCUS_REGION_CIRCLE; query.circle.latitude = 91, "circle.latitude is 91");
    BAD_QUERY(region = LOCUS_REGION_CIRCLE; query.circle.longitude = NAN, "circle.longitude");
    BAD_QUERY(region = LOCUS_REGION_POLYGON, "polygon.rings is 0");
    BAD_QUERY(region = LOCUS_REGION_POLYGON; query.polygon.rings = 1, "polygon.ring_sizes is NULL");
    BAD_QUERY(region = LOCUS_REGION_POLYGON; query.polygon.rings = 1;
              query.polygon.ring_sizes = &four, "polygon.vertices is NULL");
    BAD_QUERY(region = LOCUS_REGION_POLYGON; query.polygon = bow, "crosses");
    ring[1].latitude = NAN;
    BAD_QUERY(region = LOCUS_REGION_POLYGON; query.polygon = bow, "polygon.vertices[1].latitude");
    CHECK(calls == 0);
    REFUSES(locus_pmq_count(NULL, NULL, &number), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_count(pmq, NULL, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_pmq_read(NULL, NULL, records, 8, &count), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_read(pmq, NULL, NULL, 8, &count), LOCUS_E_ARGUMENT, "records is NULL");
    REFUSES(locus_pmq_read(pmq, NULL, records, 8, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_pmq_visit(NULL, NULL, count_them, &calls), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_visit(pmq, NULL, NULL, &calls), LOCUS_E_ARGUMENT, "visit is NULL");
    REFUSES(locus_pmq_erase(NULL, NULL, &number), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_tile(NULL, 0, 0, 0, 1, NULL, bins, 4, &number), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_tile(pmq, 26, 0, 0, 1, NULL, bins, 4, &number), LOCUS_E_ARGUMENT, "zoom is 26");
    REFUSES(locus_pmq_tile(pmq, 3, 8, 0, 1, NULL, bins, 4, &number), LOCUS_E_ARGUMENT, "x is 8");
    REFUSES(locus_pmq_tile(pmq, 3, 0, 9, 1, NULL, bins, 4, &number), LOCUS_E_ARGUMENT, "y is 9");
    REFUSES(locus_pmq_tile(pmq, 3, 0, 0, 9, NULL, bins, 4, &number), LOCUS_E_ARGUMENT, "log2_bins is 9");
    REFUSES(locus_pmq_tile(pmq, 3, 0, 0, 1, &region, bins, 4, &number), LOCUS_E_ARGUMENT, "region is 1");
    REFUSES(locus_pmq_tile(pmq, 3, 0, 0, 1, NULL, NULL, 4, &number), LOCUS_E_ARGUMENT, "bins is NULL");
    REFUSES(locus_pmq_tile(pmq, 3, 0, 0, 1, NULL, bins, 3, &number), LOCUS_E_CAPACITY, "capacity is 3");
}

static void rankings(locus_pmq *pmq) {
    const locus_pmq_query region = box(0, 0, 1, 1);
    locus_pmq_score score, bad;
    locus_point32 records[4];
    double scores[4];
    size_t count = 0;
    WORKS(locus_pmq_score_init(&score, sizeof score));
    CHECK(score.struct_size == sizeof score && score.radius == 30000 && score.alpha == 0.2);
    CHECK(score.period == 10000 * SECOND && score.latitude == 0 && score.longitude == 0);
    REFUSES(locus_pmq_score_init(NULL, sizeof score), LOCUS_E_ARGUMENT, "score is NULL");
    WORKS(locus_pmq_nearest(pmq, 0, 180, NULL, 4, records, scores, &count));
    CHECK(count == 4 && records[0].device == 0 && records[1].device == 99 && records[2].device == 1);
    CHECK(scores[0] > 1000 && scores[0] < 1200 && scores[0] < scores[1]);
    score.longitude = 180;
    score.radius = 500000; /* 4.5 degrees: devices 0, 1 and 99 */
    score.alpha = 0;
    score.period = 50 * SECOND; /* and of these only the last is young */
    WORKS(locus_pmq_topk(pmq, &score, NULL, 4, records, scores, &count));
    CHECK(count == 1 && records[0].device == 99 && scores[0] == 0);
    score.period = 100 * SECOND;
    WORKS(locus_pmq_topk(pmq, &score, NULL, 2, records, NULL, &count));
    CHECK(count == 2 && records[0].device == 99 && records[1].device == 1);
#define BAD_SCORE(change, words)                                                                                       \
    bad = score;                                                                                                       \
    bad.change;                                                                                                        \
    REFUSES(locus_pmq_topk(pmq, &bad, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, words)
    BAD_SCORE(struct_size = 8, "struct_size is 8");
    BAD_SCORE(latitude = NAN, "score.latitude");
    BAD_SCORE(longitude = 181, "score.longitude is 181");
    BAD_SCORE(radius = 0, "score.radius is 0");
    BAD_SCORE(radius = 20015200, "half the globe");
    BAD_SCORE(alpha = 1.5, "score.alpha is 1.5");
    BAD_SCORE(alpha = NAN, "score.alpha");
    BAD_SCORE(period = 0, "score.period is 0");
    REFUSES(locus_pmq_topk(NULL, &score, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_topk(pmq, NULL, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, "score is NULL");
    REFUSES(locus_pmq_topk(pmq, &score, &region, 4, records, scores, &count), LOCUS_E_ARGUMENT, "query.region");
    REFUSES(locus_pmq_topk(pmq, &score, NULL, 0, records, scores, &count), LOCUS_E_ARGUMENT, "k is 0");
    REFUSES(locus_pmq_topk(pmq, &score, NULL, 4, NULL, scores, &count), LOCUS_E_ARGUMENT, "records is NULL");
    REFUSES(locus_pmq_topk(pmq, &score, NULL, 4, records, scores, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_pmq_nearest(NULL, 0, 0, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_nearest(pmq, 91, 0, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, "latitude is 91");
    REFUSES(locus_pmq_nearest(pmq, 0, NAN, NULL, 4, records, scores, &count), LOCUS_E_ARGUMENT, "longitude");
    REFUSES(locus_pmq_nearest(pmq, 0, 0, NULL, 0, records, scores, &count), LOCUS_E_ARGUMENT, "k is 0");
}

static double half(const void *record, void *user) {
    (void)record;
    return *(const double *)user;
}

static uint64_t by_decade(const void *record, void *user) {
    (void)user;
    return ((const locus_point32 *)record)->device / 10;
}

static void pages_and_sums(locus_pmq *pmq) {
    const locus_pmq_query region = box(0, 0, 1, 1);
    locus_pmq_query odd = everything();
    locus_pmq_cursor cursor = {0, 0};
    locus_pmq_group groups[16];
    locus_point32 records[100];
    double bins[16], total = 0, weight = 0.5;
    size_t count = 0, seen = 0;
    int i;
    odd.filter = odd_device;
    do {
        WORKS(locus_pmq_read_page(pmq, &odd, &cursor, records, 20, &count));
        seen += count;
        for (i = 0; i < (int)count; i++)
            CHECK(records[i].device % 2 == 1);
    } while (count > 0);
    CHECK(seen == 50 && cursor.key == LOCUS_KEY_END && cursor.passed == 0);
    WORKS(locus_pmq_read_page(pmq, NULL, &cursor, records, 20, &count));
    CHECK(count == 0);
    cursor.key = 0;
    REFUSES(locus_pmq_read_page(NULL, NULL, &cursor, records, 20, &count), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_read_page(pmq, NULL, NULL, records, 20, &count), LOCUS_E_ARGUMENT, "cursor is NULL");
    REFUSES(locus_pmq_read_page(pmq, NULL, &cursor, NULL, 20, &count), LOCUS_E_ARGUMENT, "records is NULL");
    REFUSES(locus_pmq_read_page(pmq, NULL, &cursor, records, 0, &count), LOCUS_E_ARGUMENT, "capacity is 0");
    REFUSES(locus_pmq_read_page(pmq, NULL, &cursor, records, 20, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    cursor.passed = 3;
    REFUSES(locus_pmq_read_page(pmq, NULL, &cursor, records, 20, &count), LOCUS_E_ARGUMENT, "cursor->passed is 3");
    cursor.key = LOCUS_KEY_END + 1;
    REFUSES(locus_pmq_read_page(pmq, NULL, &cursor, records, 20, &count), LOCUS_E_ARGUMENT, "cursor->key is 1125");

    WORKS(locus_pmq_groups(pmq, &odd, LOCUS_FIELD_CALLER, by_decade, NULL, groups, 16, &count));
    CHECK(count == 10 && groups[0].value == 0 && groups[0].count == 5 && groups[9].newest == 99 * SECOND);
    WORKS(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_LANGUAGE, NULL, NULL, groups, 1, &count));
    CHECK(count == 1 && groups[0].value == 0 && groups[0].count == 100);
    REFUSES(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_DEVICE, NULL, NULL, groups, 16, &count), LOCUS_E_CAPACITY,
            "capacity is 16, there are 100 groups");
    CHECK(count == 100 && groups[0].value == 0 && groups[15].value == 15);
    REFUSES(locus_pmq_groups(NULL, NULL, LOCUS_FIELD_DEVICE, NULL, NULL, groups, 16, &count), LOCUS_E_ARGUMENT, "pmq");
    REFUSES(locus_pmq_groups(pmq, NULL, 4, by_decade, NULL, groups, 16, &count), LOCUS_E_ARGUMENT, "field is 4");
    REFUSES(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_CALLER, NULL, NULL, groups, 16, &count), LOCUS_E_ARGUMENT,
            "group is NULL");
    REFUSES(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_DEVICE, NULL, NULL, NULL, 16, &count), LOCUS_E_ARGUMENT,
            "groups is NULL");
    REFUSES(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_DEVICE, NULL, NULL, groups, 16, NULL), LOCUS_E_ARGUMENT, "count");

    WORKS(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, &odd, half, &weight, bins, 16, &total));
    CHECK(total == 25);
    REFUSES(locus_pmq_weighted_tile(NULL, 0, 0, 0, 2, NULL, half, &weight, bins, 16, &total), LOCUS_E_ARGUMENT, "pmq");
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, NULL, NULL, NULL, bins, 16, &total), LOCUS_E_ARGUMENT, "weight");
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, NULL, half, &weight, NULL, 16, &total), LOCUS_E_ARGUMENT, "bins");
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, NULL, half, &weight, bins, 15, &total), LOCUS_E_CAPACITY,
            "capacity is 15");
    REFUSES(locus_pmq_weighted_tile(pmq, 3, 8, 0, 2, NULL, half, &weight, bins, 16, &total), LOCUS_E_ARGUMENT,
            "x is 8");
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 9, NULL, half, &weight, bins, 16, &total), LOCUS_E_ARGUMENT,
            "log2_bins is 9");
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, &region, half, &weight, bins, 16, &total), LOCUS_E_ARGUMENT,
            "region is 1");
    weight = INFINITY;
    REFUSES(locus_pmq_weighted_tile(pmq, 0, 0, 0, 2, NULL, half, &weight, bins, 16, &total), LOCUS_E_ARGUMENT,
            "weight returned inf");
}

static void bad_inserts(locus_pmq *pmq, int64_t now) {
    locus_point32 records[2];
    uint64_t before = 0, after = 0;
    locus_pmq_stats stats;
    WORKS(locus_pmq_count(pmq, NULL, &before));
#define BAD_RECORD(bad, words)                                                                                         \
    records[0] = point(1, 2, now, 0);                                                                                  \
    records[1] = bad;                                                                                                  \
    REFUSES(locus_pmq_insert(pmq, records, 2, now), LOCUS_E_ARGUMENT, words);                                          \
    REFUSES(locus_pmq_insert(pmq, records, 2, now), LOCUS_E_ARGUMENT, "1") /* its index */
    BAD_RECORD(point(NAN, 0, now, 0), "latitude");
    BAD_RECORD(point(-90.25, 0, now, 0), "-90.25");
    BAD_RECORD(point(0, 180.25, now, 0), "180.25");
    BAD_RECORD(point(0, -INFINITY, now, 0), "longitude");
    BAD_RECORD(point(0, 0, now + 1, 0), "time");
    records[1] = point(3, 4, now - 1, 0);
    REFUSES(locus_pmq_insert(NULL, records, 2, now), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_insert(pmq, NULL, 2, now), LOCUS_E_ARGUMENT, "records is NULL");
    records[0].time = now - 1;
    REFUSES(locus_pmq_insert(pmq, records, 2, now - 1), LOCUS_E_ARGUMENT, "now is");
    REFUSES(locus_pmq_sweep(NULL, now, NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_sweep(pmq, now - 1, NULL), LOCUS_E_ARGUMENT, "now is");
    REFUSES(locus_pmq_check(NULL), LOCUS_E_ARGUMENT, "pmq is NULL");
    stats.struct_size = sizeof stats;
    REFUSES(locus_pmq_get_stats(NULL, &stats), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_pmq_get_stats(pmq, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    stats.struct_size = 16;
    REFUSES(locus_pmq_get_stats(pmq, &stats), LOCUS_E_ARGUMENT, "struct_size is 16");
    WORKS(locus_pmq_count(pmq, NULL, &after));
    CHECK(before == after);
    WORKS(locus_pmq_check(pmq));
}

static void queries(locus_pmq *pmq) {
    locus_pmq_query query = box(-1, 170, 1, -170);
    const locus_position ring[4] = {{-1, 170}, {-1, 190}, {1, 190}, {1, 170}};
    const uint64_t four = 4;
    locus_point32 records[100];
    uint32_t bins[16];
    uint64_t number = 0, sum = 0;
    size_t count = 0;
    int calls = 0, i;
    WORKS(locus_pmq_count(pmq, NULL, &number));
    CHECK(number == 100);
    WORKS(locus_pmq_count(pmq, &query, &number)); /* across the antimeridian: devices 0, 1, 2, 98, 99 */
    CHECK(number == 5);
    query = everything();
    query.region = LOCUS_REGION_CIRCLE;
    query.circle.longitude = 180;
    query.circle.radius = 1e6; /* 9 degrees: devices 0, 1, 2, 98, 99 */
    WORKS(locus_pmq_count(pmq, &query, &number));
    CHECK(number == 5);
    query.region = LOCUS_REGION_POLYGON;
    query.polygon.vertices = ring;
    query.polygon.ring_sizes = &four;
    query.polygon.rings = 1;
    WORKS(locus_pmq_count(pmq, &query, &number));
    CHECK(number == 5);
    query = box(-1, -1, 1, 90);
    query.filter = odd_device;
    query.time_to = 75 * SECOND;
    WORKS(locus_pmq_read(pmq, &query, records, 100, &count));
    CHECK(count == 12); /* odd devices 51..73 */
    CHECK(records[0].device % 2 == 1 && records[0].time <= 75 * SECOND);
    query.order = LOCUS_ORDER_ANY;
    WORKS(locus_pmq_read(pmq, &query, records, 100, &count));
    CHECK(count == 12);
    for (number = 51; number <= 73; number += 2) {
        const locus_point32 *at = records;
        while (at < records + 12 && at->device != number)
            ++at;
        CHECK(at < records + 12);
    }
    REFUSES(locus_pmq_read(pmq, &query, records, 5, &count), LOCUS_E_CAPACITY, "capacity is 5");
    CHECK(count == 12);
    REFUSES(locus_pmq_read(pmq, &query, NULL, 0, &count), LOCUS_E_CAPACITY, "capacity is 0");
    CHECK(count == 12);
    WORKS(locus_pmq_visit(pmq, NULL, count_them, &calls));
    CHECK(calls == 100);
    calls = 0;
    REFUSES(locus_pmq_visit(pmq, NULL, stop_at_three, &calls), LOCUS_E_STOPPED, "visit");
    CHECK(calls == 3);
    WORKS(locus_pmq_tile(pmq, 0, 0, 0, 2, NULL, bins, 16, &number));
    for (i = 0; i < 16; i++)
        sum += bins[i];
    CHECK(number == 100 && sum == 100);
}

static int32_t handed_over(const void *record, void *user) {
    int *const seen = (int *)user;
    seen[((const locus_point32 *)record)->device]++;
    return 0;
}

/* A hundred points along the equator, one a second and 3.6 degrees further each, from -180 on. */
static void walk(uint32_t index) {
    int gone[100] = {0}, i;
    locus_pmq_options options;
    locus_pmq_query query = box(-1, 100, 1, 180);
    locus_pmq_stats stats;
    locus_point32 records[100];
    locus_pmq *pmq = NULL;
    uint64_t number = 0;
    for (i = 0; i < 100; i++)
        records[i] = point(0, -180 + 3.6 * i + 0.01, i * SECOND, (uint16_t)i);
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.index = index;
    options.horizon = 100 * SECOND;
    options.sink = handed_over;
    options.sink_user = gone;
    WORKS(locus_pmq_create(&options, &pmq));
    WORKS(locus_pmq_insert(pmq, records, 60, 59 * SECOND));
    WORKS(locus_pmq_insert(pmq, NULL, 0, 60 * SECOND));
    WORKS(locus_pmq_insert(pmq, records + 60, 40, 99 * SECOND));
    WORKS(locus_pmq_check(pmq));
    queries(pmq);
    rankings(pmq);
    pages_and_sums(pmq);
    bad_queries(pmq);
    bad_inserts(pmq, 99 * SECOND);

    WORKS(locus_pmq_sweep(pmq, 110 * SECOND, &number)); /* 0..9 are older than 10 s */
    CHECK(number == 10 && gone[9] == 1 && gone[10] == 0);
    WORKS(locus_pmq_erase(pmq, &query, &number));
    CHECK(number == 22 && gone[99] == 1);
    WORKS(locus_pmq_erase(pmq, NULL, NULL));
    for (i = 0; i < 100; i++)
        CHECK(gone[i] == 1);
    stats.struct_size = sizeof stats;
    WORKS(locus_pmq_get_stats(pmq, &stats));
    CHECK(stats.records == 0 && stats.pending == 0 && stats.inserted == 100 && stats.evicted == 10);
    CHECK(stats.erased == 90 && stats.batches >= 2 && stats.now == 110 * SECOND && stats.bytes > 0);
    WORKS(locus_pmq_check(pmq));
    locus_pmq_destroy(pmq);
    locus_pmq_destroy(NULL);
}

static void count_lines(int32_t level, const char *text, void *user) {
    CHECK(level == LOCUS_LOG_INFO && strchr(text, '\n') == NULL);
    ++*(int *)user;
}

static void logs(void) {
    locus_pmq_options options;
    locus_point32 records[100];
    locus_pmq *pmq = NULL;
    int lines = 0, i;
    for (i = 0; i < 100; i++)
        records[i] = point(i * 0.5, i, 0, 0);
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    options.log = count_lines;
    options.log_user = &lines;
    WORKS(locus_pmq_create(&options, &pmq));
    WORKS(locus_pmq_insert(pmq, records, 100, 0)); /* the array grows */
    CHECK(lines > 0);
    locus_pmq_destroy(pmq);
}

static void texts(void) {
    locus_pmq_options options;
    locus_text156 records[2], back[2];
    locus_pmq *pmq = NULL;
    size_t count = 0;
    memset(records, 0, sizeof records);
    memset(records[0].text, 'x', sizeof records[0].text);
    records[0].latitude = 89.5f;
    records[0].time = 5;
    records[1].latitude = -89.5f;
    records[1].time = 9; /* after now: clamped */
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    options.future = LOCUS_FUTURE_CLAMP;
    WORKS(locus_pmq_create(&options, &pmq));
    WORKS(locus_pmq_insert(pmq, records, 2, 7));
    WORKS(locus_pmq_read(pmq, NULL, back, 2, &count));
    CHECK(count == 2 && back[0].latitude == 89.5f && back[0].text[139] == 'x'); /* north comes first */
    CHECK(back[1].latitude == -89.5f && back[1].time == 7);
    REFUSES(locus_pmq_groups(pmq, NULL, LOCUS_FIELD_LANGUAGE, NULL, NULL, NULL, 0, &count), LOCUS_E_UNSUPPORTED,
            "field is 2");
    locus_pmq_destroy(pmq);
}

static void snapshots(void) {
    const locus_point32 record = point(48, 2, 0, 0);
    locus_pmq_query query;
    locus_pmq_snapshot *snapshot = NULL;
    locus_pmq *pmq = NULL;
    uint64_t count = 0;
    WORKS(locus_pmq_query_init(&query, sizeof query));
    CHECK(query.snapshot == NULL);
    WORKS(locus_pmq_create(NULL, &pmq));
    WORKS(locus_pmq_insert(pmq, &record, 1, 0));
    WORKS(locus_pmq_snapshot_create(pmq, &snapshot));
    WORKS(locus_pmq_erase(pmq, NULL, NULL));
    query.snapshot = snapshot;
    WORKS(locus_pmq_count(pmq, &query, &count));
    CHECK(count == 1);
    REFUSES(locus_pmq_erase(pmq, &query, NULL), LOCUS_E_ARGUMENT, "query.snapshot");
    REFUSES(locus_pmq_snapshot_create(NULL, &snapshot), LOCUS_E_ARGUMENT, "pmq");
    CHECK(snapshot == NULL);
    REFUSES(locus_pmq_snapshot_create(pmq, NULL), LOCUS_E_ARGUMENT, "snapshot");
    locus_pmq_destroy(pmq);
    locus_pmq_snapshot_destroy((locus_pmq_snapshot *)query.snapshot); /* may outlive its store */
    locus_pmq_snapshot_destroy(NULL);
}

/* Records outside a store. */
static void selections(void) {
    const locus_point32 here = point(48, 2, 10, 1), there = point(10, 2, 10, 2);
    locus_pmq_query query = box(47, 1, 49, 3);
    locus_pmq_selection *selection = NULL;
    locus_key_range ranges[16];
    uint64_t key = 0;
    size_t count = 0, i;
    int32_t matches = -1, covered = 0;
    WORKS(locus_pmq_selection_create(&query, LOCUS_RECORD_POINT32, &selection));
    WORKS(locus_pmq_selection_ranges(selection, ranges, 16, &count));
    CHECK(count >= 1 && count <= 16);
    WORKS(locus_pmq_key(here.latitude, here.longitude, &key));
    for (i = 0; i < count; i++)
        covered |= ranges[i].first <= key && key <= ranges[i].last;
    CHECK(covered);
    WORKS(locus_pmq_selection_matches(selection, &here, 0, &matches));
    CHECK(matches == 1);
    WORKS(locus_pmq_selection_matches(selection, &there, 0, &matches));
    CHECK(matches == 0);
    REFUSES(locus_pmq_selection_ranges(NULL, ranges, 16, &count), LOCUS_E_ARGUMENT, "selection is NULL");
    REFUSES(locus_pmq_selection_ranges(selection, NULL, 16, &count), LOCUS_E_ARGUMENT, "ranges is NULL");
    REFUSES(locus_pmq_selection_ranges(selection, ranges, 0, &count), LOCUS_E_ARGUMENT, "capacity is 0");
    REFUSES(locus_pmq_selection_ranges(selection, ranges, 16, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_pmq_selection_matches(NULL, &here, 0, &matches), LOCUS_E_ARGUMENT, "selection is NULL");
    REFUSES(locus_pmq_selection_matches(selection, NULL, 0, &matches), LOCUS_E_ARGUMENT, "record is NULL");
    REFUSES(locus_pmq_selection_matches(selection, &here, 2, &matches), LOCUS_E_ARGUMENT, "inside is 2");
    REFUSES(locus_pmq_selection_matches(selection, &here, 0, NULL), LOCUS_E_ARGUMENT, "matches is NULL");
    locus_pmq_selection_destroy(selection);
    locus_pmq_selection_destroy(NULL);
    REFUSES(locus_pmq_selection_create(&query, 7, &selection), LOCUS_E_ARGUMENT, "record is 7");
    CHECK(selection == NULL);
    query.box.north = 46;
    REFUSES(locus_pmq_selection_create(&query, LOCUS_RECORD_TEXT156, &selection), LOCUS_E_ARGUMENT, "south");
    REFUSES(locus_pmq_selection_create(&query, LOCUS_RECORD_POINT32, NULL), LOCUS_E_ARGUMENT, "selection is NULL");
}

/* Expired records, and how many had left. */
static void departures(void) {
    const locus_point32 record = point(48, 2, 0, 0);
    locus_pmq_options options;
    locus_pmq_query query = everything();
    locus_pmq *pmq = NULL;
    uint64_t count = 0, left = 99;
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.horizon = 10;
    WORKS(locus_pmq_create(&options, &pmq));
    WORKS(locus_pmq_insert(pmq, &record, 1, 0));
    query.left = &left;
    query.expired = 1;
    WORKS(locus_pmq_count(pmq, &query, &count));
    CHECK(count == 1 && left == 0);
    REFUSES(locus_pmq_erase(pmq, &query, NULL), LOCUS_E_ARGUMENT, "query.expired");
    WORKS(locus_pmq_sweep(pmq, 100, NULL));
    WORKS(locus_pmq_count(pmq, &query, &count));
    CHECK(count == 0 && left == 1);
    locus_pmq_destroy(pmq);
}

int main(void) {
    locus_pmq *pmq = NULL;
    snapshots();
    selections();
    departures();
    defaults();
    keys();
    bad_options();
    walk(LOCUS_INDEX_IMPLICIT);
    walk(LOCUS_INDEX_EXPLICIT);
    walk(LOCUS_INDEX_HEADS);
    texts();
    logs();
    WORKS(locus_pmq_create(NULL, &pmq));
    WORKS(locus_pmq_check(pmq));
    locus_pmq_destroy(pmq);
    return check_result();
}
