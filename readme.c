#include <locus/locus.h>
#include <stdio.h>

static int failed(locus_status status) {
    if (status != LOCUS_OK) fprintf(stderr, "%s: %s\n", locus_status_name(status), locus_last_error());
    return status != LOCUS_OK;
}

int main(void) {
    /* A store that keeps the last hour, two records at noon, and how many lie in a box around Paris. */
    locus_pmq_options window;
    locus_pmq *store = NULL;
    if (failed(locus_pmq_options_init(&window, sizeof window))) return 1;
    window.horizon = INT64_C(3600) * 1000000;
    if (failed(locus_pmq_create(&window, &store))) return 1;
    const int64_t noon = INT64_C(1700000000) * 1000000;
    const locus_point32 posts[] = {{48.8566, 2.3522, noon - 60000000, 0, 0, 0, 0}, {35.6762, 139.6503, noon, 0, 0, 0, 0}};
    if (failed(locus_pmq_insert(store, posts, 2, noon))) return 1;
    locus_pmq_query paris;
    uint64_t count = 0;
    if (failed(locus_pmq_query_init(&paris, sizeof paris))) return 1;
    paris.region = LOCUS_REGION_BOX;
    paris.box = (locus_box){48.0, 2.0, 49.0, 3.0};
    if (failed(locus_pmq_count(store, &paris, &count))) return 1;
    printf("%llu record near Paris\n", (unsigned long long)count);
    locus_pmq_destroy(store);

    /* A bar of 5 voxels whose middle is ten times softer, a seed at either end, and the distances along it. */
    locus_graph_options grid;
    locus_graph *graph = NULL;
    locus_diagram *diagram = NULL;
    const float compliance[5] = {1, 1, 10, 1, 1};
    const locus_seed seeds[2] = {{0, 0, 0, 0.0, 7, 0}, {4, 0, 0, 0.0, 8, 0}};
    float distances[5];
    if (failed(locus_graph_options_init(&grid, sizeof grid))) return 1;
    grid.dims[0] = 5, grid.dims[1] = 1, grid.dims[2] = 1;
    if (failed(locus_graph_create(&grid, compliance, &graph))) return 1;
    if (failed(locus_diagram_create(graph, NULL, &diagram))) return 1;
    if (failed(locus_diagram_add_seeds(diagram, seeds, 2)) || failed(locus_diagram_solve(diagram, NULL, NULL))) return 1;
    if (failed(locus_diagram_distances(diagram, NULL, distances, 5))) return 1;
    for (int i = 0; i < 5; ++i) printf("%g ", (double)distances[i]);
    printf("\n");
    locus_diagram_destroy(diagram);
    locus_graph_destroy(graph);
    return 0;
}
