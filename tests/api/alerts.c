/* locus/alerts.h: a walk through the calls, and every bad argument. */
#include "check.h"
#include "point.h"

#include <locus/alerts.h>

#include <math.h>

#define SECOND ((int64_t)1000000)

static int32_t count_alerts(const locus_alert *alert, void *user) {
    CHECK(alert->kind == LOCUS_ALERT_JUMP && alert->zoom == 12 && alert->records >= 20);
    CHECK(alert->box.south < 48.85 && 48.85 < alert->box.north && alert->box.west < 2.35 && 2.35 < alert->box.east);
    ++*(int *)user;
    return 0;
}

static int32_t count_shown(uint64_t fence, const void *record, void *user) {
    CHECK(fence == 77 && ((const locus_point32 *)record)->device == 1);
    ++*(int *)user;
    return 0;
}

static void defaults(void) {
    locus_alerts_options options;
    memset(&options, 0xA5, sizeof options);
    WORKS(locus_alerts_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.zoom_from == 5 && options.zoom_to == 12);
    CHECK(options.half_life == 300 * SECOND && options.history == 3600 * SECOND && options.cool_down == 1800 * SECOND);
    CHECK(options.minimum == 20 && options.factor == 4 && isinf(options.rate) && isinf(options.share));
    CHECK(options.max_bytes == (uint64_t)64 << 20 && options.alert == NULL && options.fence == NULL);
    REFUSES(locus_alerts_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_alerts_options_init(&options, sizeof options - 1), LOCUS_E_ARGUMENT, "size");
}

#define BAD_OPTION(change, words)                                                                                      \
    do {                                                                                                               \
        locus_alerts_options options;                                                                                  \
        locus_alerts *alerts = (locus_alerts *)&options;                                                               \
        WORKS(locus_alerts_options_init(&options, sizeof options));                                                    \
        options.change;                                                                                                \
        REFUSES(locus_alerts_create(pmq, &options, &alerts), LOCUS_E_ARGUMENT, words);                                 \
        CHECK(alerts == NULL);                                                                                         \
    } while (0)

static void bad_options(locus_pmq *pmq) {
    locus_alerts *alerts = NULL;
    BAD_OPTION(struct_size = 0, "struct_size is 0");
    BAD_OPTION(zoom_to = 26, "options.zoom_to is 26");
    BAD_OPTION(zoom_from = 13, "options.zoom_from is 13");
    BAD_OPTION(half_life = 0, "options.half_life is 0");
    BAD_OPTION(half_life = -5, "options.half_life is -5");
    BAD_OPTION(history = options.half_life, "options.history is 300000000");
    BAD_OPTION(history = 101 * options.half_life, "options.history");
    BAD_OPTION(cool_down = -1, "options.cool_down is -1");
    BAD_OPTION(minimum = 0, "options.minimum is 0");
    BAD_OPTION(minimum = NAN, "options.minimum");
    BAD_OPTION(minimum = INFINITY, "options.minimum is inf");
    BAD_OPTION(factor = 1, "options.factor is 1");
    BAD_OPTION(factor = NAN, "options.factor");
    BAD_OPTION(rate = 0, "options.rate is 0");
    BAD_OPTION(share = -0.5, "options.share is -0.5");
    BAD_OPTION(share = 1.5, "options.share is 1.5");
    BAD_OPTION(max_bytes = 65535, "options.max_bytes is 65535");
    REFUSES(locus_alerts_create(NULL, NULL, &alerts), LOCUS_E_ARGUMENT, "pmq is NULL");
    REFUSES(locus_alerts_create(pmq, NULL, NULL), LOCUS_E_ARGUMENT, "alerts is NULL");
}

static void bad_fences(locus_alerts *alerts, locus_pmq *pmq) {
    locus_pmq_query query;
    locus_pmq_snapshot *snapshot = NULL;
    WORKS(locus_pmq_query_init(&query, sizeof query));
    REFUSES(locus_alerts_add_fence(NULL, 1, &query), LOCUS_E_ARGUMENT, "alerts is NULL");
    REFUSES(locus_alerts_add_fence(alerts, 1, NULL), LOCUS_E_ARGUMENT, "query is NULL");
    REFUSES(locus_alerts_add_fence(alerts, 77, &query), LOCUS_E_ARGUMENT, "id is 77");
    query.region = LOCUS_REGION_CIRCLE;
    query.circle.radius = NAN;
    REFUSES(locus_alerts_add_fence(alerts, 1, &query), LOCUS_E_ARGUMENT, "circle.radius");
    query.region = LOCUS_REGION_ALL;
    WORKS(locus_pmq_snapshot_create(pmq, &snapshot));
    query.snapshot = snapshot;
    REFUSES(locus_alerts_add_fence(alerts, 1, &query), LOCUS_E_ARGUMENT, "query.snapshot");
    locus_pmq_snapshot_destroy(snapshot);
    REFUSES(locus_alerts_remove_fence(NULL, 1), LOCUS_E_ARGUMENT, "alerts is NULL");
    REFUSES(locus_alerts_remove_fence(alerts, 1), LOCUS_E_ARGUMENT, "id is 1");
}

/* A quiet hour, then a burst in Paris. */
static void walk(void) {
    locus_alerts_options options;
    locus_alerts_stats stats;
    locus_alert active[2];
    locus_pmq_query fence;
    locus_pmq *pmq = NULL;
    locus_alerts *alerts = NULL, *second = NULL;
    size_t count = 7;
    int told = 0, shown = 0, i;
    WORKS(locus_pmq_create(NULL, &pmq));
    bad_options(pmq);
    WORKS(locus_alerts_options_init(&options, sizeof options));
    options.alert = count_alerts;
    options.alert_user = &told;
    options.fence = count_shown;
    options.fence_user = &shown;
    WORKS(locus_alerts_create(pmq, &options, &alerts));
    WORKS(locus_alerts_create(pmq, NULL, &second));
    WORKS(locus_pmq_query_init(&fence, sizeof fence));
    fence.region = LOCUS_REGION_CIRCLE;
    fence.circle.latitude = 48.85;
    fence.circle.longitude = 2.35;
    fence.circle.radius = 2000;
    WORKS(locus_alerts_add_fence(alerts, 77, &fence));
    bad_fences(alerts, pmq);
    for (i = 0; i < 3700; i++) {
        locus_point32 records[2];
        records[0] = point(-30 + i % 60, i % 300 - 150, i * SECOND, 0);
        records[1] = point(48.85, 2.35, i * SECOND, 1);
        WORKS(locus_pmq_insert(pmq, records, i >= 3600 ? 2 : 1, i * SECOND));
    }
    CHECK(told == 1 && shown == 100);
    WORKS(locus_alerts_active(alerts, active, 2, &count));
    CHECK(count == 1 && active[0].number == 1 && active[0].records > 80 && active[0].time <= 3625 * SECOND);
    REFUSES(locus_alerts_active(alerts, NULL, 0, &count), LOCUS_E_CAPACITY, "capacity is 0, there are 1");
    CHECK(count == 1);
    REFUSES(locus_alerts_active(NULL, active, 2, &count), LOCUS_E_ARGUMENT, "alerts is NULL");
    REFUSES(locus_alerts_active(alerts, NULL, 2, &count), LOCUS_E_ARGUMENT, "active is NULL");
    REFUSES(locus_alerts_active(alerts, active, 2, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    stats.struct_size = sizeof stats;
    WORKS(locus_alerts_get_stats(alerts, &stats));
    CHECK(stats.raised == 1 && stats.shown == 100 && stats.fences == 1 && stats.regions > 12 && stats.bytes > 0);
    WORKS(locus_alerts_get_stats(second, &stats));
    CHECK(stats.raised == 1 && stats.shown == 0);
    REFUSES(locus_alerts_get_stats(NULL, &stats), LOCUS_E_ARGUMENT, "alerts is NULL");
    REFUSES(locus_alerts_get_stats(alerts, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    stats.struct_size = 8;
    REFUSES(locus_alerts_get_stats(alerts, &stats), LOCUS_E_ARGUMENT, "struct_size is 8");
    WORKS(locus_alerts_remove_fence(alerts, 77));
    locus_alerts_destroy(second);
    locus_pmq_destroy(pmq);
    locus_alerts_destroy(alerts); /* may outlive its store */
    locus_alerts_destroy(NULL);
}

int main(void) {
    defaults();
    walk();
    return check_result();
}
