/* locus/weights.h: a walk through the calls, and every bad argument. */
#include "check.h"

#include <locus/weights.h>

#include <math.h>

enum { N = 8, VOXELS = N * N * N };

static int32_t stop_at_once(double fraction, void *user) {
    CHECK(fraction >= 0 && fraction <= 1);
    ++*(int *)user;
    return 1;
}

/* N^3 voxels of compliance 1, the last of them impassable, and three seeds with the ids 5, 3 and 9. */
static locus_graph *cube(locus_diagram **diagram) {
    static float material[VOXELS];
    const locus_seed seeds[3] = {{0, 0, 0, 0, 5, 0}, {7, 7, 0, 0, 3, 0}, {3, 4, 6, 0, 9, 0}};
    locus_graph_options options;
    locus_graph *graph = NULL;
    int i;
    for (i = 0; i < VOXELS; i++)
        material[i] = i == VOXELS - 1 ? NAN : 1.0f;
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = options.dims[1] = options.dims[2] = N;
    options.threads = 2;
    WORKS(locus_graph_create(&options, material, &graph));
    WORKS(locus_diagram_create(graph, NULL, diagram));
    WORKS(locus_diagram_add_seeds(*diagram, seeds, 3));
    return graph;
}

static void options_of_weights(locus_diagram *diagram) {
    locus_weights_options options;
    union {
        locus_weights_options options;
        unsigned char bytes[sizeof(locus_weights_options) + 8];
    } newer;
    const locus_voxel_box outside = {{0, 0, 5}, {1, 1, 4}};
    const uint64_t far = VOXELS;
    locus_weights *weights = NULL;
    int calls = 0;

    WORKS(locus_weights_options_init(&options, sizeof options));
    CHECK(options.method == LOCUS_METHOD_SIBSON && options.max_per_row == LOCUS_ALL_SEEDS);
    REFUSES(locus_weights_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_weights_options_init(&options, 8), LOCUS_E_ARGUMENT, "size");

    REFUSES(locus_weights_create(diagram, NULL, NULL, &weights), LOCUS_E_STATE, "solve");
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    REFUSES(locus_weights_create(NULL, NULL, NULL, &weights), LOCUS_E_ARGUMENT, "diagram");
    REFUSES(locus_weights_create(diagram, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_create(diagram, NULL, &outside, &weights), LOCUS_E_ARGUMENT, "extent[2] is 4");
    REFUSES(locus_weights_create_for(NULL, NULL, &far, 1, &weights), LOCUS_E_ARGUMENT, "diagram");
    REFUSES(locus_weights_create_for(diagram, NULL, NULL, 1, &weights), LOCUS_E_ARGUMENT, "voxels");
    REFUSES(locus_weights_create_for(diagram, NULL, &far, 1, NULL), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_create_for(diagram, NULL, &far, 1, &weights), LOCUS_E_ARGUMENT, "512");
    options.method = 3;
    REFUSES(locus_weights_create(diagram, &options, NULL, &weights), LOCUS_E_ARGUMENT, "method is 3");
    options.method = LOCUS_METHOD_LAPLACE;
    options.batch_bytes = 77;
    REFUSES(locus_weights_create(diagram, &options, NULL, &weights), LOCUS_E_ARGUMENT, "batch_bytes is 77");
    WORKS(locus_weights_options_init(&options, sizeof options));
    options.progress = stop_at_once;
    options.progress_user = &calls;
    REFUSES(locus_weights_create(diagram, &options, NULL, &weights), LOCUS_E_STOPPED, "stopped");
    CHECK(calls == 1 && weights == NULL);

    memset(&newer, 0, sizeof newer);
    WORKS(locus_weights_options_init(&newer.options, sizeof newer));
    WORKS(locus_weights_create(diagram, &newer.options, NULL, &weights));
    locus_weights_destroy(weights);
    newer.bytes[sizeof newer - 1] = 1;
    REFUSES(locus_weights_create(diagram, &newer.options, NULL, &weights), LOCUS_E_ARGUMENT, "struct_size");
    CHECK(weights == NULL);
    locus_weights_destroy(NULL);
}

static void rows_of_weights(const locus_weights *weights) {
    static uint64_t offsets[VOXELS + 1];
    static uint32_t ids[3 * VOXELS];
    static float values[3 * VOXELS], dense[3 * VOXELS];
    const uint32_t all[3] = {3, 5, 9}, unknown[1] = {4}, twice[2] = {9, 9};
    const float at_seeds[6] = {1, 10, 2, 20, 3, 30};
    uint64_t rows = 0, entries = 0, needed = 0, i, j;

    WORKS(locus_weights_size(weights, &rows, &entries));
    WORKS(locus_weights_size(weights, NULL, NULL));
    REFUSES(locus_weights_size(NULL, &rows, &entries), LOCUS_E_ARGUMENT, "weights");
    CHECK(rows == VOXELS && entries > VOXELS && entries <= 3 * VOXELS);

    REFUSES(locus_weights_rows(weights, 0, rows, offsets, NULL, NULL, 0, &needed), LOCUS_E_CAPACITY, "capacity");
    CHECK(needed == entries && offsets[rows] == entries);
    WORKS(locus_weights_rows(weights, 0, rows, offsets, ids, values, 3 * VOXELS, &needed));
    for (i = 0; i < rows; i++) {
        double sum = 0;
        for (j = offsets[i]; j < offsets[i + 1]; j++) {
            CHECK(ids[j] == 5 || ids[j] == 3 || ids[j] == 9);
            CHECK(j == offsets[i] || values[j] <= values[j - 1]);
            sum += (double)values[j];
        }
        CHECK(i == VOXELS - 1 ? sum == 0 : fabs(sum - 1) < 1e-6);
    }
    CHECK(offsets[1] == 1 && ids[0] == 5 && values[0] == 1.0f);
    REFUSES(locus_weights_rows(NULL, 0, 1, offsets, ids, values, 3, NULL), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_rows(weights, rows, 1, offsets, ids, values, 3, NULL), LOCUS_E_ARGUMENT, "count is 1");
    REFUSES(locus_weights_rows(weights, rows + 1, 0, offsets, ids, values, 3, NULL), LOCUS_E_ARGUMENT, "first is 513");
    REFUSES(locus_weights_rows(weights, 0, 1, NULL, ids, values, 3, NULL), LOCUS_E_ARGUMENT, "offsets");
    REFUSES(locus_weights_rows(weights, 0, 1, offsets, NULL, values, 3, NULL), LOCUS_E_ARGUMENT, "ids");
    REFUSES(locus_weights_rows(weights, 0, 1, offsets, ids, NULL, 3, NULL), LOCUS_E_ARGUMENT, "values");

    WORKS(locus_weights_dense(weights, 0, rows, all, 3, dense, 3 * VOXELS));
    CHECK(dense[0] == 0 && dense[1] == 1.0f && dense[2] == 0);
    REFUSES(locus_weights_dense(NULL, 0, 1, all, 3, dense, 3), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_dense(weights, 0, 1, NULL, 3, dense, 3), LOCUS_E_ARGUMENT, "ids");
    REFUSES(locus_weights_dense(weights, 0, 1, all, 3, NULL, 3), LOCUS_E_ARGUMENT, "dense");
    REFUSES(locus_weights_dense(weights, 0, 1, unknown, 1, dense, 3), LOCUS_E_ARGUMENT, "id 4");
    REFUSES(locus_weights_dense(weights, 0, 1, twice, 2, dense, 3), LOCUS_E_ARGUMENT, "ids[1] is 9");
    REFUSES(locus_weights_dense(weights, 0, 2, all, 3, dense, 5), LOCUS_E_CAPACITY, "capacity is 5");

    WORKS(locus_weights_interpolate(weights, 0, rows, at_seeds, 2, dense, 2 * VOXELS));
    CHECK(dense[0] == 1.0f && dense[1] == 10.0f && isnan(dense[2 * VOXELS - 1]));
    REFUSES(locus_weights_interpolate(NULL, 0, 1, at_seeds, 2, dense, 2), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_interpolate(weights, 0, 1, NULL, 2, dense, 2), LOCUS_E_ARGUMENT, "values");
    REFUSES(locus_weights_interpolate(weights, 0, 1, at_seeds, 2, NULL, 2), LOCUS_E_ARGUMENT, "out");
    REFUSES(locus_weights_interpolate(weights, 0, 1, at_seeds, 2, dense, 1), LOCUS_E_CAPACITY, "capacity is 1");

    WORKS(locus_weights_gradients(weights, 0, rows, 5, dense, 3 * VOXELS));
    CHECK(dense[0] < 0 && dense[1] < 0);
    REFUSES(locus_weights_gradients(NULL, 0, 1, 5, dense, 3), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_gradients(weights, 0, 1, 6, dense, 3), LOCUS_E_ARGUMENT, "id 6");
    REFUSES(locus_weights_gradients(weights, 0, 1, 5, NULL, 3), LOCUS_E_ARGUMENT, "gradients");
    REFUSES(locus_weights_gradients(weights, 0, 1, 5, dense, 2), LOCUS_E_CAPACITY, "capacity is 2");
}

static void updates(locus_diagram *diagram, locus_weights *weights) {
    static uint64_t changed[VOXELS];
    size_t count = 99;

    WORKS(locus_weights_update(weights, changed, VOXELS, &count));
    CHECK(count == 0);
    WORKS(locus_diagram_move_seed(diagram, 9, 3, 4, 5));
    REFUSES(locus_weights_update(weights, NULL, 0, NULL), LOCUS_E_STATE, "solve");
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    REFUSES(locus_weights_update(NULL, changed, VOXELS, &count), LOCUS_E_ARGUMENT, "weights");
    REFUSES(locus_weights_update(weights, NULL, 3, &count), LOCUS_E_ARGUMENT, "changed");
    REFUSES(locus_weights_update(weights, changed, 1, &count), LOCUS_E_CAPACITY, "capacity is 1");
    CHECK(count > 1);
    WORKS(locus_weights_update(weights, NULL, 0, &count));
    CHECK(count == 0);
}

int main(void) {
    const uint64_t voxels[2] = {0, VOXELS - 1};
    uint64_t rows = 0, entries = 0;
    locus_diagram *diagram = NULL;
    locus_weights *weights = NULL, *listed = NULL;
    locus_graph *graph = cube(&diagram);
    float gradient[3];

    options_of_weights(diagram);
    WORKS(locus_weights_create(diagram, NULL, NULL, &weights));
    WORKS(locus_weights_create_for(diagram, NULL, voxels, 2, &listed));
    WORKS(locus_weights_size(listed, &rows, &entries));
    CHECK(rows == 2 && entries == 1);
    REFUSES(locus_weights_gradients(listed, 0, 1, 5, gradient, 3), LOCUS_E_STATE, "list");
    rows_of_weights(weights);
    updates(diagram, weights);
    locus_graph_destroy(graph);
    locus_diagram_destroy(diagram);
    WORKS(locus_weights_update(weights, NULL, 0, NULL));
    locus_weights_destroy(weights);
    locus_weights_destroy(listed);
    return check_result();
}
