// locus/graph.h
#include "capi/boundary.hpp"
#include "capi/handles.hpp"
#include "core/options.hpp"
#include "core/simd.hpp"
#include "graph/cuts.hpp"

#include <cstddef>
#include <cstdio>
#include <limits>

using namespace locus;

namespace {

// Sizes of the first release; fields are only ever appended.
constexpr size_t first_options_size = 168;
constexpr size_t first_info_size = 144;
static_assert(sizeof(locus_graph_options) == first_options_size, "append only; then keep first_options_size a number");
static_assert(sizeof(locus_graph_info) == first_info_size, "append only; then keep first_info_size a number");

locus_graph_options defaults() {
    locus_graph_options options{};
    options.struct_size = sizeof options;
    for (double &spacing : options.spacing)
        spacing = 1;
    options.connectivity = 26;
    options.weight_rule = LOCUS_WEIGHT_MEAN_COMPLIANCE;
    options.material = LOCUS_MATERIAL_COMPLIANCE;
    options.word_bits = LOCUS_WORD_AUTO;
    options.stiffness_exponent = 1;
    options.max_seeds = 65535;
    options.precision = 1.0 / 256;
    options.material_min = options.material_max = std::numeric_limits<double>::quiet_NaN();
    options.backend = LOCUS_BACKEND_AUTO;
    options.simd = LOCUS_SIMD_AUTO;
    return options;
}

// What was chosen, and what it may lead to.
void log_choices(const locus_graph_options &options, const locus_graph_info &info) {
    if (options.log == nullptr)
        return;
    char text[200];
    std::snprintf(
        text, sizeof text, "words of %u bits, %u of them for the label, scale %g, weight error up to %g, simd %s",
        info.word_bits, info.label_bits, info.scale, info.weight_error, simd_name(static_cast<Simd>(info.simd)));
    options.log(LOCUS_LOG_INFO, text, options.log_user);
    if (info.overflow_free == 0)
        options.log(LOCUS_LOG_WARNING, "some path may be longer than a word holds: a solve would return LOCUS_E_RANGE",
                    options.log_user);
}

} // namespace

locus_status locus_graph_options_init(locus_graph_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, defaults(), first_options_size); });
}

locus_status locus_graph_create(const locus_graph_options *options, const float *material,
                                locus_graph **graph) noexcept {
    return boundary(__func__, [&] {
        need(graph, "graph");
        *graph = nullptr;
        const locus_graph_options whole = read_options(&need(options, "options"), defaults(), first_options_size);
        require(whole.reserved0 == 0, "options->reserved0 is ", whole.reserved0, ", not 0");
        auto made = std::make_unique<locus_graph>();
        made->graph = std::make_shared<graph::Graph>(whole, material);
        log_choices(whole, made->graph->info());
        *graph = made.release();
    });
}

void locus_graph_destroy(locus_graph *graph) noexcept { delete graph; }

locus_status locus_graph_get_info(const locus_graph *graph, locus_graph_info *info) noexcept {
    return boundary(__func__, [&] { write_report(info, need(graph, "graph").graph->info(), first_info_size, "info"); });
}

locus_status locus_graph_set_box(locus_graph *graph, const locus_voxel_box *box, const float *values) noexcept {
    return boundary(__func__, [&] { need(graph, "graph").graph->set_box(need(box, "box"), &need(values, "values")); });
}

locus_status locus_graph_fill_box(locus_graph *graph, const locus_voxel_box *box, float value) noexcept {
    return boundary(__func__, [&] { need(graph, "graph").graph->fill_box(need(box, "box"), value); });
}

locus_status locus_graph_set_voxels(locus_graph *graph, const uint64_t *voxels, const float *values,
                                    size_t count) noexcept {
    return boundary(__func__, [&] {
        graph::Graph &edited = *need(graph, "graph").graph;
        if (count == 0)
            return;
        edited.set_voxels({&need(voxels, "voxels"), count}, &need(values, "values"));
    });
}

locus_status locus_graph_get_box(const locus_graph *graph, const locus_voxel_box *box, float *values,
                                 size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Graph &read = *need(graph, "graph").graph;
        read.get_box(checked_box(read.grid(), box, capacity), &need(values, "values"));
    });
}

locus_status locus_graph_edge_weight(const locus_graph *graph, uint64_t u, uint64_t v, uint64_t *steps) noexcept {
    return boundary(__func__, [&] {
        const graph::Graph &read = *need(graph, "graph").graph;
        const uint64_t voxels = read.grid().voxels();
        require(u < voxels, "u is ", u, ": the grid has ", voxels, " voxels");
        require(v < voxels, "v is ", v, ": the grid has ", voxels, " voxels");
        need(steps, "steps") = read.weight_between(u, v);
    });
}

locus_status locus_graph_cut_plane(locus_graph *graph, const double point[3], const double normal[3],
                                   const locus_voxel_box *box, uint64_t *edges) noexcept {
    return boundary(__func__, [&] {
        graph::Graph &edited = *need(graph, "graph").graph;
        const double *p = &need(point, "point");
        const double *n = &need(normal, "normal");
        const uint64_t cut = graph::cut_by_plane(edited, {p[0], p[1], p[2]}, {n[0], n[1], n[2]},
                                                 box != nullptr ? *box : edited.grid().whole());
        if (edges != nullptr)
            *edges = cut;
    });
}

locus_status locus_graph_cut_mesh(locus_graph *graph, const double *vertices, size_t vertex_count,
                                  const uint32_t *triangles, size_t triangle_count, uint64_t *edges) noexcept {
    return boundary(__func__, [&] {
        graph::Graph &edited = *need(graph, "graph").graph;
        uint64_t cut = 0;
        require(vertex_count <= UINT32_MAX, "vertex_count is ", vertex_count, ", more than indices of 32 bits reach");
        require(triangle_count <= SIZE_MAX / 12, "triangle_count is ", triangle_count, ", more than memory can hold");
        if (triangle_count > 0)
            cut = graph::cut_by_mesh(edited, {&need(vertices, "vertices"), 3 * vertex_count},
                                     {&need(triangles, "triangles"), 3 * triangle_count});
        if (edges != nullptr)
            *edges = cut;
    });
}

locus_status locus_graph_mend_box(locus_graph *graph, const locus_voxel_box *box, uint64_t *edges) noexcept {
    return boundary(__func__, [&] {
        graph::Graph &edited = *need(graph, "graph").graph;
        const uint64_t mended = edited.mend_edges(box != nullptr ? *box : edited.grid().whole());
        if (edges != nullptr)
            *edges = mended;
    });
}
