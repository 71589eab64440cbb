/* locus/diagram.h: a walk through the calls, and every bad argument. */
#include "check.h"

#include <locus/diagram.h>

#include <math.h>

enum { N = 8, VOXELS = N * N * N };

static int32_t stop_at_once(double fraction, void *user) {
    CHECK(fraction >= 0 && fraction <= 1);
    ++*(int *)user;
    return 1;
}

/* N^3 voxels of compliance 1, the last of them impassable. */
static locus_graph *cube(void) {
    static float material[VOXELS];
    locus_graph_options options;
    locus_graph *graph = NULL;
    int i;
    for (i = 0; i < VOXELS; i++)
        material[i] = i == VOXELS - 1 ? NAN : 1.0f;
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = options.dims[1] = options.dims[2] = N;
    options.connectivity = 6;
    options.threads = 2;
    options.max_seeds = 100;
    WORKS(locus_graph_create(&options, material, &graph));
    return graph;
}

static locus_seed seed(uint32_t id, uint64_t x, uint64_t y, uint64_t z) {
    locus_seed result;
    memset(&result, 0, sizeof result);
    result.x = x;
    result.y = y;
    result.z = z;
    result.id = id;
    return result;
}

static void options_of_both(locus_graph *graph, locus_diagram *diagram) {
    locus_diagram_options options;
    locus_place_options place;
    union {
        locus_diagram_options options;
        unsigned char bytes[sizeof(locus_diagram_options) + 8];
    } newer;
    union {
        locus_place_options options;
        unsigned char bytes[sizeof(locus_place_options) + 8];
    } newer_place;
    locus_diagram *other = NULL;

    WORKS(locus_diagram_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.engine == LOCUS_ENGINE_AUTO && options.record_trace == 0);
    CHECK(options.max_distance == INFINITY);
    REFUSES(locus_diagram_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_diagram_options_init(&options, 8), LOCUS_E_ARGUMENT, "size");
    REFUSES(locus_diagram_create(NULL, &options, &other), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_diagram_create(graph, &options, NULL), LOCUS_E_ARGUMENT, "diagram is NULL");
#define BAD_OPTION(change, words)                                                                                      \
    WORKS(locus_diagram_options_init(&options, sizeof options));                                                       \
    options.change;                                                                                                    \
    other = diagram;                                                                                                   \
    REFUSES(locus_diagram_create(graph, &options, &other), LOCUS_E_ARGUMENT, words);                                   \
    CHECK(other == NULL)
    BAD_OPTION(struct_size = 0, "struct_size is 0");
    BAD_OPTION(engine = 99, "engine is 99");
    BAD_OPTION(record_trace = 2, "record_trace is 2");
    BAD_OPTION(on_device = 2, "on_device is 2");
    BAD_OPTION(reserved1 = 3, "reserved1 is 3");
    BAD_OPTION(max_distance = -1, "max_distance is -1");
    BAD_OPTION(max_distance = NAN, "max_distance");
    WORKS(locus_diagram_options_init(&newer.options, sizeof newer));
    WORKS(locus_diagram_create(graph, &newer.options, &other));
    locus_diagram_destroy(other);
    newer.bytes[sizeof newer - 8] = 1;
    REFUSES(locus_diagram_create(graph, &newer.options, &other), LOCUS_E_ARGUMENT, "struct_size");

    WORKS(locus_place_options_init(&place, sizeof place));
    CHECK(place.struct_size == sizeof place && place.count == 0 && place.first_id == 0);
    CHECK(place.lloyd_iterations == 100 && place.metric == LOCUS_PLACE_COMPLIANCE && place.progress == NULL);
    REFUSES(locus_place_options_init(NULL, sizeof place), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_place_options_init(&place, 8), LOCUS_E_ARGUMENT, "size");
    REFUSES(locus_diagram_place_seeds(NULL, &place), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_place_seeds(diagram, NULL), LOCUS_E_ARGUMENT, "options is NULL");
#define BAD_PLACE(change, status, words)                                                                               \
    WORKS(locus_place_options_init(&place, sizeof place));                                                             \
    place.count = 2;                                                                                                   \
    place.first_id = 50;                                                                                               \
    place.change;                                                                                                      \
    REFUSES(locus_diagram_place_seeds(diagram, &place), status, words)
    BAD_PLACE(struct_size = 0, LOCUS_E_ARGUMENT, "struct_size is 0");
    BAD_PLACE(metric = 9, LOCUS_E_ARGUMENT, "metric is 9");
    BAD_PLACE(reserved0 = 9, LOCUS_E_ARGUMENT, "reserved0 is 9");
    BAD_PLACE(first_id = LOCUS_NO_SEED, LOCUS_E_ARGUMENT, "id");
    BAD_PLACE(first_id = 10, LOCUS_E_ARGUMENT, "id");
    BAD_PLACE(count = VOXELS, LOCUS_E_ARGUMENT, "count");
    WORKS(locus_place_options_init(&newer_place.options, sizeof newer_place));
    newer_place.bytes[sizeof newer_place - 8] = 1;
    REFUSES(locus_diagram_place_seeds(diagram, &newer_place.options), LOCUS_E_ARGUMENT, "struct_size");
}

static void bad_seeds(locus_diagram *diagram) {
    const uint32_t ids[2] = {10, 77};
    locus_seed seeds[2], back[4];
    size_t count = 0;
#define BAD_SEED(change, words)                                                                                        \
    seeds[0] = seed(30, 1, 1, 1);                                                                                      \
    seeds[1] = seed(31, 2, 2, 2);                                                                                      \
    seeds[1].change;                                                                                                   \
    REFUSES(locus_diagram_add_seeds(diagram, seeds, 2), LOCUS_E_ARGUMENT, words)
    BAD_SEED(x = N, "seeds[1]");
    BAD_SEED(y = UINT64_MAX, "seeds[1]");
    BAD_SEED(id = 30, "id");
    BAD_SEED(id = 10, "id");
    BAD_SEED(id = LOCUS_NO_SEED, "id");
    BAD_SEED(distance = -1, "distance");
    BAD_SEED(distance = NAN, "distance");
    BAD_SEED(fixed = 2, "fixed");
    seeds[1] = seed(31, N - 1, N - 1, N - 1);
    REFUSES(locus_diagram_add_seeds(diagram, seeds, 2), LOCUS_E_ARGUMENT, "impassable");
    REFUSES(locus_diagram_add_seeds(NULL, seeds, 1), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_add_seeds(diagram, NULL, 1), LOCUS_E_ARGUMENT, "seeds is NULL");
    REFUSES(locus_diagram_remove_seeds(NULL, ids, 1), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_remove_seeds(diagram, NULL, 1), LOCUS_E_ARGUMENT, "ids is NULL");
    REFUSES(locus_diagram_remove_seeds(diagram, ids, 2), LOCUS_E_ARGUMENT, "77");
    REFUSES(locus_diagram_move_seed(NULL, 10, 0, 0, 0), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_move_seed(diagram, 77, 0, 0, 0), LOCUS_E_ARGUMENT, "id");
    REFUSES(locus_diagram_move_seed(diagram, 10, N, 0, 0), LOCUS_E_ARGUMENT, "8");
    REFUSES(locus_diagram_move_seed(diagram, 10, N - 1, N - 1, N - 1), LOCUS_E_ARGUMENT, "impassable");
    REFUSES(locus_diagram_get_seeds(NULL, back, 4, &count), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_get_seeds(diagram, NULL, 4, &count), LOCUS_E_ARGUMENT, "seeds is NULL");
    REFUSES(locus_diagram_get_seeds(diagram, back, 4, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_diagram_get_seeds(diagram, back, 1, &count), LOCUS_E_CAPACITY, "capacity is 1");
    /* None of the refused calls has changed the seeds. */
    CHECK(count == 2);
    WORKS(locus_diagram_get_seeds(diagram, back, 4, &count));
    CHECK(count == 2 && back[0].id == 10 && back[1].id == 20 && back[1].x == N - 1 && back[1].z == 0);
}

static void unsolved(locus_diagram *diagram) {
    uint32_t labels[VOXELS];
    float distances[VOXELS];
    uint64_t numbers[VOXELS];
    locus_cell_pair pairs[4];
    locus_diagram_stats stats;
    size_t count = 0;
    stats.struct_size = sizeof stats;
    REFUSES(locus_diagram_labels(diagram, NULL, labels, VOXELS), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_distances(diagram, NULL, distances, VOXELS), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_distances_exact(diagram, NULL, numbers, VOXELS), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_labels_on_device(diagram, NULL, labels, VOXELS), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_path(diagram, 0, 0, 0, numbers, VOXELS, &count), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_cell_sizes(diagram, numbers, VOXELS, &count), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_cell_pairs(diagram, pairs, 4, &count), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_get_stats(diagram, &stats), LOCUS_E_STATE, "solve");
    REFUSES(locus_diagram_trace(diagram, numbers, VOXELS, &count), LOCUS_E_STATE, "solve");
}

static void bad_reads(locus_diagram *diagram) {
    const locus_voxel_box outside = {{0, 0, 5}, {1, 1, 4}}, row = {{0, 0, 0}, {N, 1, 1}};
    uint32_t labels[N];
    float distances[N];
    uint64_t numbers[2 * N];
    locus_cell_pair pairs[4];
    locus_diagram_stats stats;
    size_t count = 0;
    REFUSES(locus_diagram_solve(NULL, NULL, NULL), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_labels(NULL, &row, labels, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_labels(diagram, &row, NULL, N), LOCUS_E_ARGUMENT, "labels is NULL");
    REFUSES(locus_diagram_labels(diagram, &outside, labels, N), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_diagram_labels(diagram, &row, labels, N - 1), LOCUS_E_CAPACITY, "capacity is 7");
    REFUSES(locus_diagram_labels(diagram, NULL, labels, N), LOCUS_E_CAPACITY, "capacity is 8");
    REFUSES(locus_diagram_distances(NULL, &row, distances, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_distances(diagram, &row, NULL, N), LOCUS_E_ARGUMENT, "distances is NULL");
    REFUSES(locus_diagram_distances(diagram, &outside, distances, N), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_diagram_distances(diagram, &row, distances, N - 1), LOCUS_E_CAPACITY, "capacity is 7");
    REFUSES(locus_diagram_distances_exact(NULL, &row, numbers, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_distances_exact(diagram, &row, NULL, N), LOCUS_E_ARGUMENT, "distances is NULL");
    REFUSES(locus_diagram_distances_exact(diagram, &outside, numbers, N), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_diagram_distances_exact(diagram, &row, numbers, N - 1), LOCUS_E_CAPACITY, "capacity is 7");
    REFUSES(locus_diagram_labels_on_device(NULL, &row, labels, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_labels_on_device(diagram, &row, labels, N), LOCUS_E_UNSUPPORTED, "solved on the CPU");
    REFUSES(locus_diagram_distances_on_device(NULL, &row, distances, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_distances_on_device(diagram, &row, distances, N), LOCUS_E_UNSUPPORTED, "solved on the CPU");
    REFUSES(locus_diagram_distances_exact_on_device(NULL, &row, numbers, N), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_distances_exact_on_device(diagram, &row, numbers, N), LOCUS_E_UNSUPPORTED, "on the CPU");
    REFUSES(locus_diagram_path(NULL, 0, 0, 0, numbers, N, &count), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_path(diagram, N, 0, 0, numbers, N, &count), LOCUS_E_ARGUMENT, "8");
    REFUSES(locus_diagram_path(diagram, 3, 0, 0, NULL, N, &count), LOCUS_E_ARGUMENT, "voxels is NULL");
    REFUSES(locus_diagram_path(diagram, 3, 0, 0, numbers, N, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_diagram_path(diagram, 3, 0, 0, numbers, 3, &count), LOCUS_E_CAPACITY, "capacity is 3");
    CHECK(count == 4);
    REFUSES(locus_diagram_cell_sizes(NULL, numbers, N, &count), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_cell_sizes(diagram, NULL, N, &count), LOCUS_E_ARGUMENT, "sizes is NULL");
    REFUSES(locus_diagram_cell_sizes(diagram, numbers, N, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_diagram_cell_sizes(diagram, numbers, 1, &count), LOCUS_E_CAPACITY, "capacity is 1");
    REFUSES(locus_diagram_cell_pairs(NULL, pairs, 4, &count), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_cell_pairs(diagram, NULL, 4, &count), LOCUS_E_ARGUMENT, "pairs is NULL");
    REFUSES(locus_diagram_cell_pairs(diagram, pairs, 4, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_diagram_cell_pairs(diagram, pairs, 0, &count), LOCUS_E_CAPACITY, "capacity is 0");
    CHECK(count == 1);
    stats.struct_size = 8;
    REFUSES(locus_diagram_get_stats(diagram, &stats), LOCUS_E_ARGUMENT, "struct_size is 8");
    REFUSES(locus_diagram_get_stats(diagram, NULL), LOCUS_E_ARGUMENT, "stats is NULL");
    stats.struct_size = sizeof stats;
    REFUSES(locus_diagram_get_stats(NULL, &stats), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_trace(NULL, numbers, N, &count), LOCUS_E_ARGUMENT, "diagram is NULL");
    REFUSES(locus_diagram_trace(diagram, NULL, N, &count), LOCUS_E_ARGUMENT, "active is NULL");
    REFUSES(locus_diagram_trace(diagram, numbers, N, NULL), LOCUS_E_ARGUMENT, "count is NULL");
    REFUSES(locus_diagram_trace(diagram, numbers, 0, &count), LOCUS_E_CAPACITY, "capacity is 0");
    CHECK(count > 0);
}

static void results(locus_diagram *diagram) {
    const locus_voxel_box row = {{0, 0, 0}, {N, 1, 1}};
    uint32_t labels[N], all[VOXELS];
    float distances[N];
    uint64_t sizes[2], path[N];
    locus_cell_pair pair;
    locus_diagram_stats stats;
    size_t count = 0;
    int x;
    WORKS(locus_diagram_labels(diagram, &row, labels, N));
    WORKS(locus_diagram_distances(diagram, &row, distances, N));
    for (x = 0; x < N; x++) {
        CHECK(labels[x] == (x < N / 2 ? 10u : 20u)); /* the voxels in the middle tie to none: 8 is even */
        CHECK(fabsf(distances[x] - (float)(x < N / 2 ? x : N - 1 - x)) < 0.01f);
    }
    WORKS(locus_diagram_labels(diagram, NULL, all, VOXELS));
    CHECK(all[VOXELS - 1] == LOCUS_NO_SEED);
    WORKS(locus_diagram_cell_sizes(diagram, sizes, 2, &count));
    CHECK(count == 2 && sizes[0] == VOXELS / 2 && sizes[1] == VOXELS / 2 - 1);
    WORKS(locus_diagram_cell_pairs(diagram, &pair, 1, &count));
    CHECK(count == 1 && pair.a == 10 && pair.b == 20 && pair.edges == N * N);
    WORKS(locus_diagram_path(diagram, 2, 0, 0, path, N, &count));
    CHECK(count == 3 && path[0] == 2 && path[1] == 1 && path[2] == 0);
    WORKS(locus_diagram_path(diagram, N - 1, N - 1, N - 1, path, N, &count));
    CHECK(count == 0);
    stats.struct_size = sizeof stats;
    WORKS(locus_diagram_get_stats(diagram, &stats));
    CHECK(stats.reached == VOXELS - 1 && stats.seeds == 2 && stats.relaxations > 0);
    CHECK(fabs(stats.max_distance - (3 + 7 + 7)) < 0.1);
}

int main(void) {
    locus_graph *const graph = cube();
    const locus_seed seeds[2] = {seed(10, 0, 0, 0), seed(20, N - 1, 0, 0)};
    const uint32_t first = 10;
    locus_diagram_options options;
    locus_place_options place;
    locus_diagram *diagram = NULL, *plain = NULL;
    locus_seed back[8];
    uint64_t active[64], changed = 1;
    locus_voxel_box box;
    size_t count = 0;
    int calls = 0;

    WORKS(locus_diagram_options_init(&options, sizeof options));
    options.engine = LOCUS_ENGINE_RELAX;
    options.record_trace = 1;
    options.on_device = 1; /* the CPU does as without */
    WORKS(locus_diagram_create(graph, &options, &diagram));
    REFUSES(locus_diagram_solve(diagram, NULL, NULL), LOCUS_E_STATE, "seed");
    WORKS(locus_diagram_add_seeds(diagram, seeds, 2));
    WORKS(locus_diagram_add_seeds(diagram, NULL, 0));
    options_of_both(graph, diagram);
    bad_seeds(diagram);
    unsolved(diagram);
    REFUSES(locus_diagram_solve(diagram, stop_at_once, &calls), LOCUS_E_STOPPED, "stop");
    CHECK(calls == 1);
    unsolved(diagram);
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    bad_reads(diagram);
    results(diagram);
    WORKS(locus_diagram_trace(diagram, active, 64, &count));
    CHECK(count > 0 && active[0] > 0);

    /* The defaults; a diagram outlives its graph. */
    WORKS(locus_diagram_create(graph, NULL, &plain));
    locus_graph_destroy(graph);
    WORKS(locus_diagram_add_seeds(plain, seeds, 2));
    WORKS(locus_diagram_solve(plain, NULL, NULL));
    results(plain);
    REFUSES(locus_diagram_trace(plain, active, 64, &count), LOCUS_E_STATE, "trace");
    locus_diagram_destroy(plain);

    WORKS(locus_diagram_move_seed(diagram, 20, 0, N - 1, 0));
    WORKS(locus_diagram_remove_seeds(diagram, &first, 1));
    WORKS(locus_place_options_init(&place, sizeof place));
    place.count = 3;
    place.first_id = 100;
    place.lloyd_iterations = 3;
    WORKS(locus_diagram_place_seeds(diagram, &place));
    WORKS(locus_diagram_get_seeds(diagram, back, 8, &count));
    CHECK(count == 4 && back[0].id == 20 && back[1].id == 100 && back[3].id == 102);
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    REFUSES(locus_diagram_update(NULL, &box, &changed, NULL, NULL), LOCUS_E_ARGUMENT, "diagram is NULL");
    WORKS(locus_diagram_update(diagram, &box, &changed, NULL, NULL));
    CHECK(changed == 0 && box.extent[0] == 0);
    WORKS(locus_diagram_move_seed(diagram, 100, 0, 0, 0));
    WORKS(locus_diagram_update(diagram, &box, &changed, NULL, NULL));
    CHECK(changed > 0 && box.extent[0] > 0);
    WORKS(locus_diagram_update(diagram, NULL, NULL, NULL, NULL));
    locus_diagram_destroy(diagram);
    locus_diagram_destroy(NULL);
    return check_result();
}
