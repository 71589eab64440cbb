/* A client of version 0.1 as it was compiled then: with declarations and constants of its own, which never change, and
 * option structs as short as the first ones. Whatever the library grows, this goes on working: an error here means that
 * programs in the field break, and is not mended in this file. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef struct old_pmq_options {
    uint64_t struct_size;
    uint32_t record, layout, index, future;
    int64_t horizon;
    uint64_t max_records, max_bytes;
    int32_t (*remove)(const void *, void *);
    void *remove_user;
    int32_t (*sink)(const void *, void *);
    void *sink_user;
    void (*log)(int32_t, const char *, void *);
    void *log_user;
    uint32_t segment_slots, reserved0;
    double rho_leaf, tau_leaf, rho_root, tau_root;
    uint64_t snapshot_bytes;
} old_pmq_options;

typedef struct old_pmq_query {
    uint64_t struct_size;
    uint32_t region, expired;
    double box[4]; /* south, west, north, east */
    int64_t time_from, time_to;
    int32_t (*filter)(const void *, void *);
    void *filter_user;
    const void *snapshot;
    double circle[3];
    const void *polygon[3]; /* pointers and a count: not used here */
} old_pmq_query;

typedef struct old_point32 {
    double latitude, longitude;
    int64_t time;
    uint16_t device, application, language, spare;
} old_point32;

typedef struct old_graph_options {
    uint64_t struct_size, dims[3];
    double spacing[3];
    uint32_t connectivity, weight_rule, material, word_bits;
    double stiffness_exponent;
    double (*weight)(uint64_t, uint64_t, double, void *);
    void *weight_user;
    uint64_t max_seeds;
    double scale, precision, material_min, material_max;
    uint32_t threads, backend, simd, reserved0;
    void (*log)(int32_t, const char *, void *);
    void *log_user;
} old_graph_options;

typedef struct old_diagram_options {
    uint64_t struct_size;
    uint32_t engine, record_trace;
    double max_distance;
} old_diagram_options;

typedef struct old_seed {
    uint64_t x, y, z;
    double distance;
    uint32_t id, fixed;
} old_seed;

extern int32_t locus_pmq_options_init(old_pmq_options *, uint64_t);
extern int32_t locus_pmq_query_init(old_pmq_query *, uint64_t);
extern int32_t locus_pmq_create(const old_pmq_options *, void **);
extern int32_t locus_pmq_insert(void *, const void *, size_t, int64_t);
extern int32_t locus_pmq_count(const void *, const old_pmq_query *, uint64_t *);
extern void locus_pmq_destroy(void *);
extern int32_t locus_graph_options_init(old_graph_options *, uint64_t);
extern int32_t locus_graph_create(const old_graph_options *, const float *, void **);
extern void locus_graph_destroy(void *);
extern int32_t locus_diagram_options_init(old_diagram_options *, uint64_t);
extern int32_t locus_diagram_create(void *, const old_diagram_options *, void **);
extern int32_t locus_diagram_add_seeds(void *, const old_seed *, size_t);
extern int32_t locus_diagram_solve(void *, void *, void *);
extern int32_t locus_diagram_distances(const void *, const void *, float *, uint64_t);
extern void locus_diagram_destroy(void *);
extern const char *locus_last_error(void);

static int failures = 0;
static void expect(int good, const char *what) {
    if (good)
        return;
    ++failures;
    printf("not so: %s; last error: %s\n", what, locus_last_error());
}
#define EXPECT(what) expect((what), #what)

/* What follows the short structs in this program's memory stays untouched. */
static const unsigned char guard_byte = 0xA5;
static int guarded(const unsigned char *bytes, size_t count) {
    size_t i;
    for (i = 0; i < count; ++i)
        if (bytes[i] != guard_byte)
            return 0;
    return 1;
}

static void stream(void) {
    struct {
        old_pmq_options options;
        unsigned char guard[64];
    } window;
    struct {
        old_pmq_query query;
        unsigned char guard[64];
    } paris;
    const int64_t noon = INT64_C(1700000000) * 1000000;
    const old_point32 posts[2] = {{48.8566, 2.3522, noon, 1, 2, 3, 4}, {35.6762, 139.6503, noon, 0, 0, 0, 0}};
    void *store = NULL;
    uint64_t count = 0;
    memset(&window, guard_byte, sizeof window);
    memset(&paris, guard_byte, sizeof paris);
    EXPECT(sizeof(old_pmq_options) == 144 && sizeof(old_pmq_query) == 136 && sizeof(old_point32) == 32);
    EXPECT(locus_pmq_options_init(&window.options, sizeof window.options) == 0);
    EXPECT(window.options.struct_size == 144 && window.options.record == 32 && window.options.layout == 0);
    EXPECT(window.options.horizon == INT64_MAX && window.options.max_records == UINT64_MAX);
    EXPECT(guarded(window.guard, sizeof window.guard));
    window.options.horizon = INT64_C(3600) * 1000000;
    EXPECT(locus_pmq_create(&window.options, &store) == 0);
    EXPECT(locus_pmq_insert(store, posts, 2, noon) == 0);
    EXPECT(locus_pmq_query_init(&paris.query, sizeof paris.query) == 0);
    EXPECT(guarded(paris.guard, sizeof paris.guard));
    EXPECT(locus_pmq_count(store, &paris.query, &count) == 0 && count == 2);
    paris.query.region = 1;
    paris.query.box[0] = 48, paris.query.box[1] = 2, paris.query.box[2] = 49, paris.query.box[3] = 3;
    EXPECT(locus_pmq_count(store, &paris.query, &count) == 0 && count == 1);
    locus_pmq_destroy(store);
}

static void volume(void) {
    old_graph_options grid;
    struct {
        old_diagram_options options;
        unsigned char guard[64];
    } drawing;
    const float compliance[5] = {1, 1, 10, 1, 1};
    const old_seed seeds[2] = {{0, 0, 0, 0.0, 7, 0}, {4, 0, 0, 0.0, 8, 0}};
    const float wanted[5] = {0, 1, 6.5f, 1, 0};
    float distances[5];
    void *graph = NULL, *diagram = NULL;
    int i;
    memset(&drawing, guard_byte, sizeof drawing);
    EXPECT(sizeof(old_graph_options) == 168 && sizeof(old_diagram_options) == 24 && sizeof(old_seed) == 40);
    EXPECT(locus_graph_options_init(&grid, sizeof grid) == 0);
    EXPECT(grid.struct_size == 168 && grid.connectivity == 26 && grid.max_seeds == 65535 && grid.reserved0 == 0);
    grid.dims[0] = 5, grid.dims[1] = grid.dims[2] = 1;
    grid.backend = 1;
    EXPECT(locus_graph_create(&grid, compliance, &graph) == 0);
    EXPECT(locus_diagram_options_init(&drawing.options, sizeof drawing.options) == 0);
    EXPECT(drawing.options.struct_size == 24 && guarded(drawing.guard, sizeof drawing.guard));
    EXPECT(locus_diagram_create(graph, &drawing.options, &diagram) == 0);
    EXPECT(locus_diagram_add_seeds(diagram, seeds, 2) == 0 && locus_diagram_solve(diagram, NULL, NULL) == 0);
    EXPECT(locus_diagram_distances(diagram, NULL, distances, 5) == 0);
    for (i = 0; i < 5; ++i)
        EXPECT(distances[i] > wanted[i] - 0.02f && distances[i] < wanted[i] + 0.02f);
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
}

int main(void) {
    stream();
    volume();
    if (failures == 0)
        printf("an old client works\n");
    return failures != 0;
}
