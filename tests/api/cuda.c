/* The CUDA backend through the C interface: every form of the solver, updates and Sibson's weights against the CPU's.
 * Without a GPU it tells why, and forcing the backend must say the same.
 * cuda [rounds [words]]: how many random graphs are compared; `words` must stand in the reason why there is no GPU;
 * "GPU" asks for one, "stream" for one that works on a caller's stream alone, "fails" for one that fails before a
 * diagram is solved, and "keeps" for one that fails while results are on it. */
#include "check.h"
#include "device_memory.h"

#include <locus/locus.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static uint32_t state = 1;
static uint32_t draw(uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (uint32_t)(((uint64_t)state * below) >> 32);
}

/* The stream that all work is put on: CUDA's cudaStreamPerThread, which no program has to make. */
static void *callers_stream = NULL;

static int warnings = 0;
static void log_line(int32_t level, const char *text, void *user) {
    (void)user;
    if (level >= LOCUS_LOG_WARNING)
        ++warnings;
    if (strstr(text, "GPU") != NULL)
        printf("log: %s\n", text);
}

/* A graph of random materials, one of the two backends', and its diagram. */
typedef struct pair {
    locus_graph *graph[2];
    locus_diagram *diagram[2];
    size_t voxels;
    uint64_t dims[3];
} pair;

static void make(pair *both, uint32_t engine) {
    locus_graph_options options;
    locus_diagram_options drawing;
    locus_seed seeds[5];
    float *material;
    size_t i, k;
    memset(both, 0, sizeof *both);
    WORKS(locus_graph_options_init(&options, sizeof options));
    for (k = 0; k < 3; ++k)
        both->dims[k] = options.dims[k] = 5 + draw(30);
    both->voxels = (size_t)(options.dims[0] * options.dims[1] * options.dims[2]);
    options.connectivity = draw(3) == 0 ? 6 : draw(2) == 0 ? 18 : 26;
    options.weight_rule = draw(4);
    options.word_bits = draw(2) == 0 ? LOCUS_WORD_32 : LOCUS_WORD_64;
    options.stiffness_exponent = draw(2) == 0 ? 1 : 1.5;
    options.max_seeds = 64;
    options.precision = 0.25;
    options.material_min = 0.5;
    options.material_max = 9;
    options.spacing[draw(3)] = draw(2) == 0 ? 1 : 1.75;
    options.log = log_line;
    material = malloc(both->voxels * sizeof *material);
    if (material == NULL)
        exit(2);
    for (i = 0; i < both->voxels; ++i)
        material[i] = draw(8) == 0 ? NAN : 0.5f + (float)draw(1000) / 125;
    for (i = 0; i < 5; ++i) {
        uint64_t at;
        seeds[i].x = draw((uint32_t)options.dims[0]);
        seeds[i].y = draw((uint32_t)options.dims[1]);
        seeds[i].z = draw((uint32_t)options.dims[2]);
        seeds[i].distance = i == 3 ? 2.5 : 0;
        seeds[i].id = 10 + (uint32_t)i;
        seeds[i].fixed = 0;
        at = seeds[i].x + options.dims[0] * (seeds[i].y + options.dims[1] * seeds[i].z);
        material[at] = 1;
    }
    WORKS(locus_diagram_options_init(&drawing, sizeof drawing));
    CHECK(drawing.grain[0] == 8 && drawing.grain[1] == 4 && drawing.grain[2] == 4 && drawing.stream == NULL);
    CHECK(drawing.on_device == 0);
    drawing.stream = callers_stream;
    drawing.on_device = draw(2);
    if (draw(3) == 0)
        drawing.max_distance = 30;
    for (k = 0; k < 2; ++k) {
        options.backend = k == 0 ? LOCUS_BACKEND_CPU : LOCUS_BACKEND_CUDA;
        WORKS(locus_graph_create(&options, material, &both->graph[k]));
        drawing.engine = k == 0 ? LOCUS_ENGINE_HEAP : engine;
        WORKS(locus_diagram_create(both->graph[k], &drawing, &both->diagram[k]));
        WORKS(locus_diagram_add_seeds(both->diagram[k], seeds, 5));
    }
    free(material);
}

static void end(pair *both) {
    size_t k;
    for (k = 0; k < 2; ++k) {
        locus_diagram_destroy(both->diagram[k]);
        locus_graph_destroy(both->graph[k]);
    }
}

static void expect_same(const pair *both) {
    uint64_t *distance[2];
    uint32_t *label[2];
    size_t k;
    for (k = 0; k < 2; ++k) {
        distance[k] = malloc(both->voxels * sizeof **distance);
        label[k] = malloc(both->voxels * sizeof **label);
        if (distance[k] == NULL || label[k] == NULL)
            exit(2);
        WORKS(locus_diagram_distances_exact(both->diagram[k], NULL, distance[k], both->voxels));
        WORKS(locus_diagram_labels(both->diagram[k], NULL, label[k], both->voxels));
    }
    CHECK(memcmp(distance[0], distance[1], both->voxels * sizeof **distance) == 0);
    CHECK(memcmp(label[0], label[1], both->voxels * sizeof **label) == 0);
    for (k = 0; k < 2; ++k) {
        free(distance[k]);
        free(label[k]);
    }
}

static void expect_same_stats(const pair *both) {
    locus_diagram_stats stats[2];
    size_t k;
    for (k = 0; k < 2; ++k) {
        stats[k].struct_size = sizeof stats[k];
        WORKS(locus_diagram_get_stats(both->diagram[k], &stats[k]));
    }
    CHECK(stats[0].backend == LOCUS_BACKEND_CPU && stats[1].backend == LOCUS_BACKEND_CUDA);
    CHECK(stats[0].reached == stats[1].reached && stats[0].max_exact == stats[1].max_exact);
    CHECK(stats[0].max_distance == stats[1].max_distance);
}

typedef locus_status (*host_read)(const locus_diagram *, const locus_voxel_box *, void *, size_t);
static locus_status host_labels(const locus_diagram *diagram, const locus_voxel_box *box, void *to, size_t room) {
    return locus_diagram_labels(diagram, box, to, room);
}
static locus_status host_distances(const locus_diagram *diagram, const locus_voxel_box *box, void *to, size_t room) {
    return locus_diagram_distances(diagram, box, to, room);
}
static locus_status host_exact(const locus_diagram *diagram, const locus_voxel_box *box, void *to, size_t room) {
    return locus_diagram_distances_exact(diagram, box, to, room);
}
static const struct {
    host_read host, device;
    size_t bytes;
} reads[3] = {{host_labels, locus_diagram_labels_on_device, sizeof(uint32_t)},
              {host_distances, locus_diagram_distances_on_device, sizeof(float)},
              {host_exact, locus_diagram_distances_exact_on_device, sizeof(uint64_t)}};

/* The result of a random box, or of the whole grid, in the device's memory. */
static void expect_same_on_device(const pair *both, uint32_t engine) {
    const size_t kind = draw(3);
    const int whole = draw(2) == 0;
    locus_voxel_box box;
    size_t voxels = 1, axis;
    void *memory;
    char *found, *expected;
    for (axis = 0; axis < 3; ++axis) {
        box.origin[axis] = whole ? 0 : draw((uint32_t)both->dims[axis]);
        box.extent[axis] = whole ? both->dims[axis] : 1 + draw((uint32_t)(both->dims[axis] - box.origin[axis]));
        voxels *= (size_t)box.extent[axis];
    }
    memory = device_memory(voxels * reads[kind].bytes);
    if (engine == LOCUS_ENGINE_RELAX || engine == LOCUS_ENGINE_COMPACT) {
        CHECK(reads[kind].device(both->diagram[1], &box, memory, voxels) == LOCUS_E_UNSUPPORTED);
        CHECK(strstr(locus_last_error(), "leaves nothing on the GPU") != NULL);
        device_free(memory);
        return;
    }
    found = malloc(voxels * reads[kind].bytes);
    expected = malloc(voxels * reads[kind].bytes);
    if (found == NULL || expected == NULL)
        exit(2);
    WORKS(reads[kind].host(both->diagram[0], &box, expected, voxels));
    WORKS(reads[kind].device(both->diagram[1], whole ? NULL : &box, memory, voxels));
    from_device(found, memory, voxels * reads[kind].bytes);
    CHECK(memcmp(found, expected, voxels * reads[kind].bytes) == 0);
    free(found);
    free(expected);
    device_free(memory);
}

/* Several threads that are the first ones to read a result on the host, or beside it on the device. */
typedef struct reader {
    const pair *both;
    const uint32_t *expected;
    void *memory;
    int wrong;
} reader;
static void *read_labels(void *user) {
    reader *const own = user;
    uint32_t *const labels = malloc(own->both->voxels * sizeof *labels);
    locus_status status;
    if (labels == NULL)
        exit(2);
    if (own->memory != NULL)
        status = locus_diagram_labels_on_device(own->both->diagram[1], NULL, own->memory, own->both->voxels);
    else
        status = locus_diagram_labels(own->both->diagram[1], NULL, labels, own->both->voxels);
    own->wrong = status != LOCUS_OK ||
                 (own->memory == NULL && memcmp(labels, own->expected, own->both->voxels * sizeof *labels) != 0);
    if (status != LOCUS_OK)
        printf("a reader: %s\n", locus_last_error());
    free(labels);
    return NULL;
}
static void expect_same_by_threads(const pair *both, uint32_t engine) {
    enum { READERS = 4 };
    const int kept = engine == LOCUS_ENGINE_AUTO || engine == LOCUS_ENGINE_BRICKS;
    reader readers[READERS];
    pthread_t threads[READERS];
    uint32_t *const expected = malloc(both->voxels * sizeof *expected);
    int i;
    if (expected == NULL)
        exit(2);
    WORKS(locus_diagram_labels(both->diagram[0], NULL, expected, both->voxels));
    for (i = 0; i < READERS; ++i) {
        reader one = {NULL, NULL, NULL, 1};
        one.both = both;
        one.expected = expected;
        one.memory = i == 0 && kept ? device_memory(both->voxels * sizeof *expected) : NULL;
        readers[i] = one;
        if (pthread_create(&threads[i], NULL, read_labels, &readers[i]) != 0)
            exit(2);
    }
    for (i = 0; i < READERS; ++i) {
        pthread_join(threads[i], NULL);
        CHECK(!readers[i].wrong);
    }
    if (readers[0].memory != NULL)
        device_free(readers[0].memory);
    free(expected);
}

/* The same edits of both graphs. */
static void edit(pair *both) {
    locus_voxel_box box;
    double point[3], normal[3];
    const uint32_t kind = draw(4);
    const float value = draw(2) == 0 ? NAN : 0.5f + (float)draw(8);
    const uint32_t id = 10 + draw(5);
    const uint64_t sources[3] = {draw((uint32_t)both->dims[0]), draw((uint32_t)both->dims[1]),
                                 draw((uint32_t)both->dims[2])};
    size_t k, axis;
    for (axis = 0; axis < 3; ++axis) {
        box.origin[axis] = draw((uint32_t)both->dims[axis]);
        box.extent[axis] = 1 + draw((uint32_t)(both->dims[axis] - box.origin[axis]) / 3 + 1);
        if (box.origin[axis] + box.extent[axis] > both->dims[axis])
            box.extent[axis] = both->dims[axis] - box.origin[axis];
        point[axis] = draw((uint32_t)both->dims[axis]);
        normal[axis] = (double)draw(100) - 49.5;
    }
    for (k = 0; k < 2; ++k) {
        if (kind == 0)
            WORKS(locus_graph_fill_box(both->graph[k], &box, value));
        if (kind == 1)
            WORKS(locus_graph_cut_plane(both->graph[k], point, normal, &box, NULL));
        if (kind == 2) {
            const locus_voxel_box one = {{sources[0], sources[1], sources[2]}, {1, 1, 1}};
            WORKS(locus_graph_fill_box(both->graph[k], &one, 1));
            WORKS(locus_diagram_move_seed(both->diagram[k], id, sources[0], sources[1], sources[2]));
        }
        if (kind == 3)
            WORKS(locus_graph_mend_box(both->graph[k], NULL, NULL));
    }
    if (kind != 0)
        return;
    /* A seed that stands on nothing any more is given its voxel back. */
    for (k = 0; k < 2; ++k) {
        locus_seed seeds[5];
        size_t count, i;
        WORKS(locus_diagram_get_seeds(both->diagram[k], seeds, 5, &count));
        for (i = 0; i < count; ++i) {
            const uint64_t voxel = seeds[i].x + both->dims[0] * (seeds[i].y + both->dims[1] * seeds[i].z);
            const float one = 1;
            WORKS(locus_graph_set_voxels(both->graph[k], &voxel, &one, 1));
        }
    }
}

static void compare_weights(const pair *both) {
    locus_weights *weights[2];
    uint64_t entries[2], rows, i;
    size_t k;
    uint64_t *offsets[2];
    uint32_t *ids[2];
    float *values[2];
    uint64_t voxels[40];
    for (i = 0; i < 40; ++i)
        voxels[i] = draw((uint32_t)both->voxels);
    for (k = 0; k < 2; ++k) {
        WORKS(locus_weights_create_for(both->diagram[k], NULL, voxels, 40, &weights[k]));
        WORKS(locus_weights_size(weights[k], &rows, &entries[k]));
        offsets[k] = calloc(rows + 1, sizeof **offsets);
        ids[k] = calloc(entries[k] + 1, sizeof **ids);
        values[k] = calloc(entries[k] + 1, sizeof **values);
        if (offsets[k] == NULL || ids[k] == NULL || values[k] == NULL)
            exit(2);
        WORKS(locus_weights_rows(weights[k], 0, rows, offsets[k], ids[k], values[k], entries[k], NULL));
        locus_weights_destroy(weights[k]);
    }
    CHECK(entries[0] == entries[1]);
    if (entries[0] == entries[1]) {
        CHECK(memcmp(offsets[0], offsets[1], 41 * sizeof **offsets) == 0);
        CHECK(memcmp(ids[0], ids[1], entries[0] * sizeof **ids) == 0);
        CHECK(memcmp(values[0], values[1], entries[0] * sizeof **values) == 0);
    }
    for (k = 0; k < 2; ++k) {
        free(offsets[k]);
        free(ids[k]);
        free(values[k]);
    }
}

static void compare(int rounds) {
    const uint32_t engines[] = {LOCUS_ENGINE_AUTO, LOCUS_ENGINE_RELAX, LOCUS_ENGINE_COMPACT, LOCUS_ENGINE_BRICKS};
    int round;
    for (round = 0; round < rounds; ++round) {
        pair both;
        int i;
        make(&both, engines[round % 4]);
        for (i = 0; i < 2; ++i)
            WORKS(locus_diagram_solve(both.diagram[i], NULL, NULL));
        expect_same_on_device(&both, engines[round % 4]);
        expect_same_stats(&both);
        expect_same_by_threads(&both, engines[round % 4]);
        expect_same(&both);
        if (round % 3 == 0)
            compare_weights(&both);
        for (i = 0; i < 4; ++i) {
            uint64_t changed[2];
            locus_voxel_box box[2];
            edit(&both);
            WORKS(locus_diagram_update(both.diagram[0], &box[0], &changed[0], NULL, NULL));
            WORKS(locus_diagram_update(both.diagram[1], &box[1], &changed[1], NULL, NULL));
            CHECK(changed[0] == changed[1] && memcmp(&box[0], &box[1], sizeof box[0]) == 0);
            expect_same_on_device(&both, engines[round % 4]);
            if (i % 2 == 0) /* else only the device has looked at it */
                expect_same(&both);
            expect_same_stats(&both);
        }
        end(&both);
        if (check_failures > 0) {
            printf("in round %d\n", round);
            return;
        }
    }
    printf("%d random graphs, the same on the GPU and the CPU\n", rounds);
}

/* A graph of so many voxels, `side` of them along y and z, automatic backend. */
static locus_graph *automatic_graph(uint64_t voxels, uint64_t side) {
    locus_graph_options options;
    locus_graph *graph = NULL;
    float *material = malloc(voxels * sizeof *material);
    uint64_t i;
    if (material == NULL)
        exit(2);
    for (i = 0; i < voxels; ++i)
        material[i] = (float)(1 + i % 3);
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = voxels / (side * side);
    options.dims[1] = options.dims[2] = side;
    options.log = log_line;
    WORKS(locus_graph_create(&options, material, &graph));
    free(material);
    return graph;
}

static uint32_t backend_of(const locus_graph *graph) {
    locus_graph_info info;
    info.struct_size = sizeof info;
    WORKS(locus_graph_get_info(graph, &info));
    return info.backend;
}

/* A GPU that fails in the middle: the CPU goes on, and says so once. */
static void falls_back(void) {
    locus_graph *graph = automatic_graph(65536, 2);
    locus_diagram *diagram = NULL;
    locus_diagram_stats stats;
    locus_weights *weights = NULL;
    const locus_seed seeds[2] = {{1, 1, 1, 0.0, 6, 0}, {200, 1, 1, 0.0, 7, 0}};
    const uint64_t voxel = 100;
    uint32_t label = 0;
    const locus_voxel_box last = {{16383, 1, 1}, {1, 1, 1}};
    CHECK(backend_of(graph) == LOCUS_BACKEND_CUDA);
    WORKS(locus_diagram_create(graph, NULL, &diagram));
    WORKS(locus_diagram_add_seeds(diagram, seeds, 2));
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    stats.struct_size = sizeof stats;
    WORKS(locus_diagram_get_stats(diagram, &stats));
    CHECK(stats.backend == LOCUS_BACKEND_CPU && stats.engine == LOCUS_ENGINE_BRICKS && stats.reached == 65536);
    WORKS(locus_diagram_labels(diagram, &last, &label, 1));
    CHECK(label == 7 && warnings == 1);
    WORKS(locus_weights_create_for(diagram, NULL, &voxel, 1, &weights));
    CHECK(warnings == 2);
    locus_weights_destroy(weights);
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
}

/* A GPU that fails while results are on it: what it takes with it is said, and nothing else is ever read. */
static void keeps(void) {
    const locus_seed seeds[2] = {{1, 1, 1, 0.0, 6, 0}, {50, 20, 20, 0.0, 7, 0}};
    const locus_voxel_box box = {{40, 10, 10}, {3, 2, 1}};
    enum { VOXELS = 65536, SIDE = 32 };
    static uint32_t labels[2][VOXELS], memory[VOXELS];
    locus_graph *graph[2];
    locus_diagram *diagram[2];
    locus_diagram_options options;
    locus_diagram_stats stats;
    locus_voxel_box changed[2];
    uint64_t voxels[2];
    int k, i;
    WORKS(locus_diagram_options_init(&options, sizeof options));
    for (k = 0; k < 2; ++k) {
        graph[k] = automatic_graph(VOXELS, SIDE);
        options.engine = k == 0 ? LOCUS_ENGINE_HEAP : LOCUS_ENGINE_AUTO; /* the heap is the CPU's */
        options.on_device = 1;
        WORKS(locus_diagram_create(graph[k], &options, &diagram[k]));
        WORKS(locus_diagram_add_seeds(diagram[k], seeds, 2));
        WORKS(locus_diagram_solve(diagram[k], NULL, NULL));
    }
    for (i = 0; i < 3; ++i) {
        locus_status status = locus_diagram_labels(diagram[1], NULL, labels[1], VOXELS);
        WORKS(locus_diagram_labels(diagram[0], NULL, labels[0], VOXELS));
        if (status != LOCUS_OK) {
            printf("step %d: the GPU does not give its result\n", i);
            REFUSES(locus_diagram_labels(diagram[1], NULL, labels[1], VOXELS), LOCUS_E_DEVICE, "told to fail");
            REFUSES(locus_diagram_labels_on_device(diagram[1], NULL, memory, VOXELS), LOCUS_E_DEVICE, "told to fail");
            WORKS(locus_diagram_get_stats(diagram[1], (stats.struct_size = sizeof stats, &stats)));
            CHECK(stats.backend == LOCUS_BACKEND_CUDA && stats.reached == VOXELS - (i == 1 ? 6 : 0));
        } else {
            CHECK(memcmp(labels[0], labels[1], sizeof labels[0]) == 0);
            status = locus_diagram_labels_on_device(diagram[1], NULL, memory, VOXELS);
            if (status == LOCUS_OK)
                CHECK(memcmp(labels[0], memory, sizeof labels[0]) == 0);
            else
                CHECK(status == LOCUS_E_DEVICE || status == LOCUS_E_UNSUPPORTED);
        }
        for (k = 0; k < 2; ++k) {
            WORKS(locus_graph_fill_box(graph[k], &box, i % 2 == 0 ? NAN : 2));
            WORKS(locus_diagram_update(diagram[k], &changed[k], &voxels[k], NULL, NULL));
        }
        stats.struct_size = sizeof stats;
        WORKS(locus_diagram_get_stats(diagram[1], &stats));
        if (stats.backend == LOCUS_BACKEND_CPU && voxels[1] == VOXELS) {
            printf("step %d: all changed\n", i);
            CHECK(changed[1].extent[0] == 64 && changed[1].extent[1] == SIDE && changed[1].extent[2] == SIDE);
        } else {
            CHECK(voxels[0] == voxels[1] && memcmp(&changed[0], &changed[1], sizeof changed[0]) == 0);
        }
    }
    for (k = 0; k < 2; ++k) {
        locus_diagram_destroy(diagram[k]);
        locus_graph_destroy(graph[k]);
    }
}

/* Calls for results in the device's memory that are refused. */
static void refused(void) {
    const locus_seed seed = {1, 1, 1, 0.0, 6, 0};
    const locus_voxel_box row = {{0, 0, 0}, {8, 1, 1}}, outside = {{0, 1, 0}, {1, 2, 1}};
    locus_graph *const graph = automatic_graph(65536, 2);
    locus_diagram_options options;
    locus_diagram *diagram = NULL;
    char *const memory = device_memory(8 * sizeof(uint64_t));
    WORKS(locus_diagram_options_init(&options, sizeof options));
    options.stream = callers_stream;
    WORKS(locus_diagram_create(graph, &options, &diagram));
    WORKS(locus_diagram_add_seeds(diagram, &seed, 1));
    REFUSES(locus_diagram_labels_on_device(diagram, &row, memory, 8), LOCUS_E_STATE, "not solved");
    WORKS(locus_diagram_solve(diagram, NULL, NULL));
    WORKS(locus_diagram_labels_on_device(diagram, &row, memory, 8));
    REFUSES(locus_diagram_labels_on_device(diagram, &row, NULL, 8), LOCUS_E_ARGUMENT, "labels is NULL");
    REFUSES(locus_diagram_labels_on_device(diagram, &row, memory + 2, 7), LOCUS_E_CAPACITY, "capacity is 7");
    REFUSES(locus_diagram_labels_on_device(diagram, &row, memory + 2, 8), LOCUS_E_ARGUMENT, "not a multiple of 4");
    REFUSES(locus_diagram_distances_on_device(diagram, NULL, memory, 8), LOCUS_E_CAPACITY, "the box has 65536 voxels");
    REFUSES(locus_diagram_distances_exact_on_device(diagram, &outside, memory, 8), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_diagram_distances_exact_on_device(diagram, &row, memory + 4, 8), LOCUS_E_ARGUMENT, "multiple of 8");
    if (have_driver()) {
        uint32_t *const host = malloc(8 * sizeof *host);
        REFUSES(locus_diagram_labels_on_device(diagram, &row, host, 8), LOCUS_E_ARGUMENT, "can write to");
        free(host);
    }
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
    device_free(memory);
}

/* What is the same with and without a GPU. */
static void automatic(int gpu) {
    locus_diagram_options drawing;
    locus_diagram *diagram = NULL;
    locus_graph *graph = automatic_graph(8, 2);
    CHECK(backend_of(graph) == LOCUS_BACKEND_CPU);
    locus_graph_destroy(graph);
    graph = automatic_graph(65536, 2);
    CHECK(backend_of(graph) == (gpu ? LOCUS_BACKEND_CUDA : LOCUS_BACKEND_CPU));
    WORKS(locus_diagram_options_init(&drawing, sizeof drawing));
    drawing.reserved0 = 1;
    REFUSES(locus_diagram_create(graph, &drawing, &diagram), LOCUS_E_ARGUMENT, "reserved0 is 1");
    drawing.reserved0 = 0;
    drawing.engine = LOCUS_ENGINE_COMPACT;
    if (gpu) {
        drawing.grain[1] = 0;
        REFUSES(locus_diagram_create(graph, &drawing, &diagram), LOCUS_E_ARGUMENT, "grain[1] is 0, outside 1..1024");
        drawing.grain[1] = 1025;
        REFUSES(locus_diagram_create(graph, &drawing, &diagram), LOCUS_E_ARGUMENT, "grain[1] is 1025");
        drawing.grain[1] = 1;
        WORKS(locus_diagram_create(graph, &drawing, &diagram));
    } else {
        REFUSES(locus_diagram_create(graph, &drawing, &diagram), LOCUS_E_UNSUPPORTED, "LOCUS_ENGINE_COMPACT");
    }
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
}

static double callers(uint64_t u, uint64_t v, double length, void *user) {
    (void)user;
    return length * (double)(1 + (u + v) % 3);
}

int main(int argc, char **argv) {
    const int rounds = argc > 1 ? atoi(argv[1]) : 12;
    const char *const words = argc > 2 ? argv[2] : "";
    locus_graph_options options;
    locus_graph *graph = NULL;
    const float material = 1;
    locus_status status;
    if (strcmp(words, "fails") == 0) {
        falls_back();
        return check_result();
    }
    if (strcmp(words, "keeps") == 0) {
        keeps();
        return check_result();
    }
    if (strcmp(words, "stream") == 0)
        callers_stream = (void *)(size_t)2;
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = options.dims[1] = options.dims[2] = 1;
    options.backend = LOCUS_BACKEND_CUDA;
    status = locus_graph_create(&options, &material, &graph);
    locus_graph_destroy(graph);
    printf("%s\n", status == LOCUS_OK ? "there is a GPU" : locus_last_error());
    if (status != LOCUS_OK) {
        CHECK(strcmp(words, "GPU") != 0 && callers_stream == NULL);
        CHECK(strstr(locus_last_error(), words) != NULL);
        if (status == LOCUS_E_DEVICE)
            REFUSES(locus_graph_create(&options, &material, &graph), LOCUS_E_DEVICE, "backend is LOCUS_BACKEND_CUDA: ");
        else
            REFUSES(locus_graph_create(&options, &material, &graph), LOCUS_E_UNSUPPORTED,
                    "backend is LOCUS_BACKEND_CUDA: ");
        CHECK(graph == NULL);
    } else {
        compare(rounds);
        refused();
    }
    options.weight_rule = LOCUS_WEIGHT_CALLER;
    options.weight = callers;
    REFUSES(locus_graph_create(&options, &material, &graph), LOCUS_E_UNSUPPORTED, "LOCUS_WEIGHT_CALLER");
    automatic(status == LOCUS_OK);
    CHECK(warnings == 0);
    return check_result();
}
