/* Out of memory: each allocation of each call fails in turn. The call then returns LOCUS_E_MEMORY, the object is as it
 * was, nothing leaks, and the same call works afterwards. */
#include "check.h"

#include <errno.h>
#include <locus/locus.h>
#include <stdlib.h>

/* glibc's own names of what is replaced here. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static long live;               /* blocks allocated and not freed */
static long until_failure = -1; /* allocations that still succeed; negative: all */

static int may_allocate(void) {
    if (until_failure < 0)
        return 1;
    if (until_failure == 0) {
        errno = ENOMEM;
        return 0;
    }
    until_failure--;
    return 1;
}

static void *counted(void *memory) {
    if (memory != NULL)
        live++;
    return memory;
}

void *malloc(size_t size) { return may_allocate() ? counted(__libc_malloc(size)) : NULL; }
void *calloc(size_t count, size_t size) { return may_allocate() ? counted(__libc_calloc(count, size)) : NULL; }
void *aligned_alloc(size_t alignment, size_t size) {
    return may_allocate() ? counted(__libc_memalign(alignment, size)) : NULL;
}
int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory = aligned_alloc(alignment, size);
    return *memory == NULL ? ENOMEM : 0;
}
void *realloc(void *memory, size_t size) {
    if (memory == NULL)
        return malloc(size);
    return may_allocate() ? __libc_realloc(memory, size) : NULL;
}
void free(void *memory) {
    if (memory == NULL)
        return;
    live--;
    __libc_free(memory);
}

/* Run `call` with its 1st, 2nd, ... allocation failing until one run succeeds; `unchanged` is looked at after each
 * failure. `limit` ends a call that would never succeed. */
#define EACH_ALLOCATION_FAILS(call, unchanged, limit)                                                                  \
    do {                                                                                                               \
        locus_status status = LOCUS_E_MEMORY;                                                                          \
        long failing;                                                                                                  \
        for (failing = 0; status == LOCUS_E_MEMORY && failing < (limit); failing++) {                                  \
            until_failure = failing;                                                                                   \
            status = (call);                                                                                           \
            until_failure = -1;                                                                                        \
            if (status == LOCUS_OK)                                                                                    \
                break;                                                                                                 \
            check_status(status, LOCUS_E_MEMORY, #call, __FILE__, __LINE__);                                           \
            CHECK(strstr(locus_last_error(), "memory") != NULL);                                                       \
            CHECK(unchanged);                                                                                          \
            if (check_failures > 0)                                                                                    \
                break;                                                                                                 \
        }                                                                                                              \
        check_status(status, LOCUS_OK, #call, __FILE__, __LINE__);                                                     \
    } while (0)

enum { N = 6, VOXELS = N * N * N, RECORDS = 300 };

static int same_seeds(const locus_diagram *diagram, size_t wanted) {
    locus_seed seeds[8];
    size_t count = 0;
    return locus_diagram_get_seeds(diagram, seeds, 8, &count) == LOCUS_OK && count == wanted;
}

static const locus_voxel_box all = {{0, 0, 0}, {N, N, N}};

static int same_voxels(const locus_graph *graph, float wanted) {
    float values[VOXELS];
    int i;
    if (locus_graph_get_box(graph, &all, values, VOXELS) != LOCUS_OK)
        return 0;
    for (i = 0; i < VOXELS; i++)
        if (values[i] != wanted)
            return 0;
    return 1;
}

static int same_labels(const locus_diagram *diagram, const uint32_t *wanted) {
    uint32_t labels[VOXELS];
    return locus_diagram_labels(diagram, NULL, labels, VOXELS) == LOCUS_OK &&
           memcmp(labels, wanted, sizeof labels) == 0;
}

static void voxels(uint32_t engine) {
    const uint32_t id = 3;
    float ones[VOXELS], twos[VOXELS];
    uint64_t indices[VOXELS];
    uint32_t labels[VOXELS];
    locus_seed seeds[3];
    locus_graph_options options;
    locus_diagram_options how;
    locus_place_options place;
    locus_graph *graph = NULL;
    locus_diagram *diagram = NULL;
    int i;
    for (i = 0; i < VOXELS; i++) {
        ones[i] = 1;
        twos[i] = 2;
        indices[i] = (uint64_t)i;
    }
    memset(seeds, 0, sizeof seeds);
    for (i = 0; i < 3; i++) {
        seeds[i].id = (uint32_t)i + 1;
        seeds[i].x = (uint64_t)i;
    }
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = options.dims[1] = options.dims[2] = N;
    options.material_min = 1;
    options.material_max = 2;
    options.threads = 1;
    EACH_ALLOCATION_FAILS(locus_graph_create(&options, ones, &graph), graph == NULL, 1000);
    EACH_ALLOCATION_FAILS(locus_graph_set_box(graph, &all, twos), same_voxels(graph, 1), 1000);
    EACH_ALLOCATION_FAILS(locus_graph_set_voxels(graph, indices, ones, VOXELS), same_voxels(graph, 2), 1000);
    EACH_ALLOCATION_FAILS(locus_graph_fill_box(graph, &all, 2), same_voxels(graph, 1), 1000);

    WORKS(locus_diagram_options_init(&how, sizeof how));
    how.engine = engine;
    EACH_ALLOCATION_FAILS(locus_diagram_create(graph, &how, &diagram), diagram == NULL, 1000);
    EACH_ALLOCATION_FAILS(locus_diagram_add_seeds(diagram, seeds, 3), same_seeds(diagram, 0), 1000);
    EACH_ALLOCATION_FAILS(locus_diagram_remove_seeds(diagram, &id, 1), same_seeds(diagram, 3), 1000);
    EACH_ALLOCATION_FAILS(locus_diagram_solve(diagram, NULL, NULL), same_seeds(diagram, 2), 100000);
    WORKS(locus_diagram_labels(diagram, NULL, labels, VOXELS));
    EACH_ALLOCATION_FAILS(locus_diagram_solve(diagram, NULL, NULL), same_labels(diagram, labels), 100000);
    WORKS(locus_place_options_init(&place, sizeof place));
    place.count = 3;
    place.first_id = 10;
    place.lloyd_iterations = 2;
    EACH_ALLOCATION_FAILS(locus_diagram_place_seeds(diagram, &place), same_seeds(diagram, 2), 100000);
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
}

static int same_records(const locus_pmq *pmq, uint64_t wanted) {
    uint64_t count = 0;
    return locus_pmq_check(pmq) == LOCUS_OK && locus_pmq_count(pmq, NULL, &count) == LOCUS_OK && count == wanted;
}

static int32_t sink(const void *record, void *user) {
    (void)record;
    ++*(int *)user;
    return 0;
}

static void records(uint32_t index) {
    locus_point32 batch[RECORDS];
    locus_pmq_options options;
    locus_pmq_query west;
    locus_pmq *pmq = NULL;
    uint64_t number = 0;
    int gone = 0, i;
    memset(batch, 0, sizeof batch);
    for (i = 0; i < RECORDS; i++) {
        batch[i].latitude = i % 7 * 10 - 30;
        batch[i].longitude = i % 36 * 10 - 175;
        batch[i].time = i;
    }
    WORKS(locus_pmq_options_init(&options, sizeof options));
    options.index = index;
    options.horizon = 1000;
    options.sink = sink;
    options.sink_user = &gone;
    WORKS(locus_pmq_query_init(&west, sizeof west));
    west.region = LOCUS_REGION_BOX;
    west.box.south = -90;
    west.box.north = 90;
    west.box.west = -180;
    west.box.east = 0;
    EACH_ALLOCATION_FAILS(locus_pmq_create(&options, &pmq), pmq == NULL, 1000);
    EACH_ALLOCATION_FAILS(locus_pmq_insert(pmq, batch, 100, 100), same_records(pmq, 0) && gone == 0, 10000);
    EACH_ALLOCATION_FAILS(locus_pmq_insert(pmq, batch + 100, RECORDS - 100, RECORDS),
                          same_records(pmq, 100) && gone == 0, 10000);
    EACH_ALLOCATION_FAILS(locus_pmq_erase(pmq, &west, &number), same_records(pmq, RECORDS) && gone == 0, 10000);
    CHECK(same_records(pmq, RECORDS - number) && (uint64_t)gone == number);
    /* The clock has run on when the sweep fails: what is older than the horizon is not counted any more, and not lost.
     */
    EACH_ALLOCATION_FAILS(locus_pmq_sweep(pmq, 2000, NULL), locus_pmq_check(pmq) == LOCUS_OK, 10000);
    CHECK(same_records(pmq, 0) && gone == RECORDS);
    locus_pmq_destroy(pmq);
}

int main(void) {
    long before;
    printf("out of memory\n"); /* the stream's buffer is not a leak */
    before = live;
    voxels(LOCUS_ENGINE_HEAP);
    voxels(LOCUS_ENGINE_BUCKET);
    voxels(LOCUS_ENGINE_RELAX);
    records(LOCUS_INDEX_IMPLICIT);
    records(LOCUS_INDEX_EXPLICIT);
    records(LOCUS_INDEX_HEADS);
    CHECK(live == before);
    return check_result();
}
