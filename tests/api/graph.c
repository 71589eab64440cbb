/* locus/graph.h: a walk through the calls, and every bad argument. */
#include "check.h"

#include <locus/graph.h>

#include <math.h>

enum { NX = 4, NY = 3, NZ = 2, VOXELS = NX * NY * NZ };

static float material[VOXELS];

static double twice_length(uint64_t u, uint64_t v, double length, void *user) {
    (void)u;
    (void)v;
    ++*(int *)user;
    return 2 * length;
}

static locus_graph_options good_options(void) {
    locus_graph_options options;
    WORKS(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = NX;
    options.dims[1] = NY;
    options.dims[2] = NZ;
    options.threads = 1;
    return options;
}

static void defaults(void) {
    locus_graph_options options;
    memset(&options, 0xA5, sizeof options);
    WORKS(locus_graph_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options);
    CHECK(options.dims[0] == 0 && options.spacing[0] == 1 && options.spacing[1] == 1 && options.spacing[2] == 1);
    CHECK(options.connectivity == 26 && options.weight_rule == LOCUS_WEIGHT_MEAN_COMPLIANCE);
    CHECK(options.material == LOCUS_MATERIAL_COMPLIANCE && options.word_bits == LOCUS_WORD_AUTO);
    CHECK(options.stiffness_exponent == 1 && options.weight == NULL && options.max_seeds == 65535);
    CHECK(options.scale == 0 && options.precision == 1.0 / 256);
    CHECK(isnan(options.material_min) && isnan(options.material_max) && options.threads == 0);
    CHECK(options.backend == LOCUS_BACKEND_AUTO && options.simd == LOCUS_SIMD_AUTO && options.reserved0 == 0);
    CHECK(options.log == NULL && options.log_user == NULL);
    REFUSES(locus_graph_options_init(NULL, sizeof options), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_graph_options_init(&options, sizeof options - 8), LOCUS_E_ARGUMENT, "size");
}

/* A client that was built against a newer header: fine as long as it uses nothing of what is new. */
static void newer_client(void) {
    union {
        locus_graph_options options;
        unsigned char bytes[sizeof(locus_graph_options) + 16];
    } newer;
    locus_graph *graph = NULL;
    WORKS(locus_graph_options_init(&newer.options, sizeof newer));
    CHECK(newer.options.struct_size == sizeof newer);
    newer.options.dims[0] = NX;
    newer.options.dims[1] = NY;
    newer.options.dims[2] = NZ;
    WORKS(locus_graph_create(&newer.options, material, &graph));
    locus_graph_destroy(graph);
    newer.bytes[sizeof newer - 1] = 1;
    REFUSES(locus_graph_create(&newer.options, material, &graph), LOCUS_E_ARGUMENT, "struct_size");
    CHECK(graph == NULL);
}

/* One option is wrong: the text names it, and no graph is made. */
#define BAD_OPTION(change, status, words)                                                                              \
    do {                                                                                                               \
        locus_graph_options options = good_options();                                                                  \
        locus_graph *graph = (locus_graph *)&options;                                                                  \
        options.change;                                                                                                \
        REFUSES(locus_graph_create(&options, material, &graph), (status), (words));                                    \
        CHECK(graph == NULL);                                                                                          \
    } while (0)

static void bad_options(void) {
    locus_graph_options options = good_options();
    locus_graph *graph = NULL;
    REFUSES(locus_graph_create(NULL, material, &graph), LOCUS_E_ARGUMENT, "options");
    REFUSES(locus_graph_create(&options, material, NULL), LOCUS_E_ARGUMENT, "graph");
    REFUSES(locus_graph_create(&options, NULL, &graph), LOCUS_E_ARGUMENT, "material_m");
    BAD_OPTION(struct_size = 0, LOCUS_E_ARGUMENT, "struct_size is 0");
    BAD_OPTION(struct_size = sizeof options - 8, LOCUS_E_ARGUMENT, "struct_size");
    BAD_OPTION(struct_size = UINT64_MAX, LOCUS_E_ARGUMENT, "struct_size");
    BAD_OPTION(dims[0] = 0, LOCUS_E_ARGUMENT, "dims");
    BAD_OPTION(dims[1] = UINT64_MAX, LOCUS_E_ARGUMENT, "dims");
    BAD_OPTION(dims[2] = (uint64_t)1 << 39, LOCUS_E_ARGUMENT, "dims");
    BAD_OPTION(spacing[0] = 0, LOCUS_E_ARGUMENT, "spacing");
    BAD_OPTION(spacing[1] = -1, LOCUS_E_ARGUMENT, "spacing");
    BAD_OPTION(spacing[2] = NAN, LOCUS_E_ARGUMENT, "spacing");
    BAD_OPTION(spacing[2] = INFINITY, LOCUS_E_ARGUMENT, "spacing");
    BAD_OPTION(connectivity = 8, LOCUS_E_ARGUMENT, "connectivity is 8");
    BAD_OPTION(weight_rule = 99, LOCUS_E_ARGUMENT, "weight_rule is 99");
    BAD_OPTION(weight_rule = LOCUS_WEIGHT_CALLER, LOCUS_E_ARGUMENT, "weight");
    BAD_OPTION(material = 2, LOCUS_E_ARGUMENT, "material is 2");
    BAD_OPTION(word_bits = 33, LOCUS_E_ARGUMENT, "word_bits is 33");
    BAD_OPTION(stiffness_exponent = 0, LOCUS_E_ARGUMENT, "stiffness_exponent");
    BAD_OPTION(stiffness_exponent = NAN, LOCUS_E_ARGUMENT, "stiffness_exponent");
    BAD_OPTION(max_seeds = 0, LOCUS_E_ARGUMENT, "max_seeds is 0");
    BAD_OPTION(max_seeds = (1 << 24) + 1, LOCUS_E_ARGUMENT, "max_seeds is 16777217");
    BAD_OPTION(scale = -1, LOCUS_E_ARGUMENT, "scale is -1");
    BAD_OPTION(scale = NAN, LOCUS_E_ARGUMENT, "scale");
    BAD_OPTION(precision = 0, LOCUS_E_ARGUMENT, "precision is 0");
    BAD_OPTION(precision = 0.75, LOCUS_E_ARGUMENT, "precision is 0.75");
    BAD_OPTION(precision = NAN, LOCUS_E_ARGUMENT, "precision");
    BAD_OPTION(backend = 9, LOCUS_E_ARGUMENT, "backend is 9");
    BAD_OPTION(simd = 99, LOCUS_E_ARGUMENT, "simd is 99");
    BAD_OPTION(reserved0 = 1, LOCUS_E_ARGUMENT, "reserved0 is 1");
#if defined(__x86_64__)
    BAD_OPTION(simd = LOCUS_SIMD_NEON, LOCUS_E_UNSUPPORTED, "simd");
#endif
}

static void bad_arguments(locus_graph *graph) {
    const locus_voxel_box box = {{0, 0, 0}, {2, 2, 2}}, outside = {{3, 0, 0}, {2, 1, 1}},
                          empty = {{0, 0, 0}, {0, 1, 1}};
    const locus_voxel_box wraps = {{1, 0, 0}, {UINT64_MAX, 1, 1}};
    const uint64_t voxels[2] = {0, VOXELS};
    float values[VOXELS] = {0};
    const double point[3] = {0.5, 0, 0}, normal[3] = {1, 0, 0}, zero[3] = {0, 0, 0}, nowhere[3] = {0, NAN, 0};
    const double corners[9] = {0.5, 0, 0, 0.5, 1, 0, 0.5, 0, 1};
    const uint32_t triangle[3] = {0, 1, 2}, beyond[3] = {0, 1, 3};
    uint64_t steps = 0;
    locus_graph_info info;
    info.struct_size = sizeof info;
    REFUSES(locus_graph_get_info(NULL, &info), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_get_info(graph, NULL), LOCUS_E_ARGUMENT, "info is NULL");
    info.struct_size = 8;
    REFUSES(locus_graph_get_info(graph, &info), LOCUS_E_ARGUMENT, "struct_size is 8");
    REFUSES(locus_graph_set_box(NULL, &box, values), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_set_box(graph, NULL, values), LOCUS_E_ARGUMENT, "box is NULL");
    REFUSES(locus_graph_set_box(graph, &box, NULL), LOCUS_E_ARGUMENT, "values is NULL");
    REFUSES(locus_graph_set_box(graph, &outside, values), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_graph_set_box(graph, &wraps, values), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_graph_fill_box(NULL, &box, 1), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_fill_box(graph, NULL, 1), LOCUS_E_ARGUMENT, "box is NULL");
    REFUSES(locus_graph_fill_box(graph, &outside, 1), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_graph_set_voxels(NULL, voxels, values, 1), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_set_voxels(graph, NULL, values, 1), LOCUS_E_ARGUMENT, "voxels is NULL");
    REFUSES(locus_graph_set_voxels(graph, voxels, NULL, 1), LOCUS_E_ARGUMENT, "values is NULL");
    REFUSES(locus_graph_set_voxels(graph, voxels, values, 2), LOCUS_E_ARGUMENT, "voxels[1] is 24");
    REFUSES(locus_graph_get_box(NULL, &box, values, VOXELS), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_get_box(graph, &box, NULL, VOXELS), LOCUS_E_ARGUMENT, "values is NULL");
    REFUSES(locus_graph_get_box(graph, &outside, values, VOXELS), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_graph_get_box(graph, &box, values, 7), LOCUS_E_CAPACITY, "capacity is 7");
    REFUSES(locus_graph_edge_weight(NULL, 0, 1, &steps), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_edge_weight(graph, VOXELS, 1, &steps), LOCUS_E_ARGUMENT, "u is 24");
    REFUSES(locus_graph_edge_weight(graph, 0, VOXELS, &steps), LOCUS_E_ARGUMENT, "v is 24");
    REFUSES(locus_graph_edge_weight(graph, 0, 1, NULL), LOCUS_E_ARGUMENT, "steps is NULL");
    REFUSES(locus_graph_cut_plane(NULL, point, normal, NULL, NULL), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_cut_plane(graph, NULL, normal, NULL, NULL), LOCUS_E_ARGUMENT, "point is NULL");
    REFUSES(locus_graph_cut_plane(graph, point, NULL, NULL, NULL), LOCUS_E_ARGUMENT, "normal is NULL");
    REFUSES(locus_graph_cut_plane(graph, nowhere, normal, NULL, NULL), LOCUS_E_ARGUMENT, "point[1]");
    REFUSES(locus_graph_cut_plane(graph, point, zero, NULL, NULL), LOCUS_E_ARGUMENT, "normal");
    REFUSES(locus_graph_cut_plane(graph, point, normal, &outside, NULL), LOCUS_E_ARGUMENT, "box");
    REFUSES(locus_graph_cut_mesh(NULL, corners, 3, triangle, 1, NULL), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_cut_mesh(graph, NULL, 3, triangle, 1, NULL), LOCUS_E_ARGUMENT, "vertices is NULL");
    REFUSES(locus_graph_cut_mesh(graph, corners, 3, NULL, 1, NULL), LOCUS_E_ARGUMENT, "triangles is NULL");
    REFUSES(locus_graph_cut_mesh(graph, corners, 3, beyond, 1, NULL), LOCUS_E_ARGUMENT, "triangles[2] is 3");
    REFUSES(locus_graph_mend_box(NULL, &box, NULL), LOCUS_E_ARGUMENT, "graph is NULL");
    REFUSES(locus_graph_mend_box(graph, &outside, NULL), LOCUS_E_ARGUMENT, "box");
    (void)empty;
    /* Nothing of all this has changed the graph. */
    WORKS(locus_graph_get_box(graph, &box, values, 8));
    CHECK(values[0] == 1 && values[1] == 2 && values[7] == 1 + 5 + 12);
}

/* A plane, the same as a mesh, and mending. */
static void cuts(void) {
    const double point[3] = {0.5, 0, 0}, normal[3] = {1, 0, 0};
    const double corners[12] = {0.5, -9, -9, 0.5, 99, -9, 0.5, -9, 99, 0.5, 99, 99};
    const uint32_t triangles[6] = {0, 1, 2, 1, 3, 2};
    const locus_graph_options options = good_options();
    locus_graph *graph = NULL;
    uint64_t edges = 0, again = 1, steps = 1;
    WORKS(locus_graph_create(&options, material, &graph));
    WORKS(locus_graph_cut_plane(graph, point, normal, NULL, &edges));
    CHECK(edges > 0);
    WORKS(locus_graph_edge_weight(graph, 0, 1, &steps));
    CHECK(steps == 0);
    WORKS(locus_graph_cut_mesh(graph, corners, 4, triangles, 2, &again));
    CHECK(again == 0);
    WORKS(locus_graph_cut_mesh(graph, NULL, 0, NULL, 0, NULL));
    WORKS(locus_graph_mend_box(graph, NULL, &again));
    CHECK(again == edges);
    WORKS(locus_graph_edge_weight(graph, 0, 1, &steps));
    CHECK(steps > 0);
    locus_graph_destroy(graph);
}

static void walk(void) {
    const locus_graph_options options = good_options();
    const locus_voxel_box box = {{1, 1, 0}, {2, 1, 2}};
    const float some[4] = {7, 8, NAN, 9};
    const uint64_t voxels[3] = {0, 5, 0};
    const float values[3] = {3, 4, 5};
    float back[VOXELS];
    uint64_t uv = 0, vu = 1;
    locus_graph *graph = NULL;
    locus_graph_info info;
    int i;
    for (i = 0; i < VOXELS; i++)
        material[i] = (float)(i + 1);
    WORKS(locus_graph_create(&options, material, &graph));
    info.struct_size = sizeof info;
    WORKS(locus_graph_get_info(graph, &info));
    CHECK(info.dims[0] == NX && info.dims[2] == NZ && info.passable == VOXELS && info.connectivity == 26);
    CHECK(info.word_bits == 32 || info.word_bits == 64);
    CHECK(info.scale > 0 && info.max_exact > 0 && info.threads == 1 && info.backend == LOCUS_BACKEND_CPU);
    WORKS(locus_graph_edge_weight(graph, 0, 1, &uv));
    WORKS(locus_graph_edge_weight(graph, 1, 0, &vu));
    CHECK(uv == vu && fabs((double)uv / info.scale - 1.5) <= 1.5 / 256);
    WORKS(locus_graph_edge_weight(graph, 0, 2, &uv)); /* not neighbours */
    CHECK(uv == 0);
    bad_arguments(graph);

    WORKS(locus_graph_set_box(graph, &box, some));
    WORKS(locus_graph_set_voxels(graph, voxels, values, 3));
    WORKS(locus_graph_set_voxels(graph, NULL, NULL, 0));
    WORKS(locus_graph_get_box(graph, &box, back, 4));
    CHECK(back[0] == 4 && back[1] == 8 && isnan(back[2]) && back[3] == 9);
    WORKS(locus_graph_fill_box(graph, &box, NAN));
    WORKS(locus_graph_get_box(graph, &box, back, 4));
    CHECK(isnan(back[0]) && isnan(back[3]));
    WORKS(locus_graph_get_info(graph, &info));
    CHECK(info.passable == VOXELS - 4);
    REFUSES(locus_graph_fill_box(graph, &box, 1e30f), LOCUS_E_RANGE, "value");
    cuts();
    locus_graph_destroy(graph);
    locus_graph_destroy(NULL);
}

static void count_lines(int32_t level, const char *text, void *user) {
    CHECK(level == LOCUS_LOG_INFO || level == LOCUS_LOG_WARNING);
    CHECK(text != NULL && text[0] != '\0' && strchr(text, '\n') == NULL);
    ++((int *)user)[level == LOCUS_LOG_WARNING];
}

static void logs(void) {
    locus_graph_options options = good_options();
    locus_graph *graph = NULL;
    int lines[2] = {0, 0};
    options.log = count_lines;
    options.log_user = lines;
    WORKS(locus_graph_create(&options, material, &graph));
    CHECK(lines[0] == 1 && lines[1] == 0);
    locus_graph_destroy(graph);
    options.word_bits = LOCUS_WORD_32; /* too coarse a word for the longest path */
    options.max_seeds = (uint64_t)1 << 16;
    options.scale = 300;
    WORKS(locus_graph_create(&options, material, &graph));
    CHECK(lines[0] == 2 && lines[1] == 1);
    locus_graph_destroy(graph);
}

static void callers_weight(void) {
    locus_graph_options options = good_options();
    locus_graph *graph = NULL;
    uint64_t steps = 0;
    locus_graph_info info;
    int calls = 0;
    options.weight_rule = LOCUS_WEIGHT_CALLER;
    options.weight = twice_length;
    options.weight_user = &calls;
    options.material_min = options.material_max = 2;
    WORKS(locus_graph_create(&options, material, &graph));
    WORKS(locus_graph_edge_weight(graph, 0, 1, &steps));
    info.struct_size = sizeof info;
    WORKS(locus_graph_get_info(graph, &info));
    CHECK(calls > 0 && fabs((double)steps / info.scale - 2) < 0.01);
    locus_graph_destroy(graph);
}

int main(void) {
    int i;
    for (i = 0; i < VOXELS; i++)
        material[i] = (float)(i + 1);
    defaults();
    newer_client();
    bad_options();
    walk();
    callers_weight();
    logs();
    return check_result();
}
