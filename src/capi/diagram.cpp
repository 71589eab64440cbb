// locus/diagram.h
#include "capi/boundary.hpp"
#include "capi/handles.hpp"
#include "core/options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace locus;

namespace {

// Sizes of the first release; fields are only ever appended.
constexpr size_t first_options_size = 24;
constexpr size_t first_place_size = 48;
constexpr size_t first_stats_size = 96;
static_assert(sizeof(locus_diagram_options) == 56, "append only");
static_assert(sizeof(locus_place_options) == first_place_size, "append only; then keep first_place_size a number");
static_assert(sizeof(locus_diagram_stats) == 104, "append only");

locus_diagram_options defaults() {
    return {sizeof(locus_diagram_options),
            LOCUS_ENGINE_AUTO,
            0,
            std::numeric_limits<double>::infinity(),
            {8, 4, 4},
            0,
            nullptr,
            0,
            0};
}

locus_place_options place_defaults() {
    return {sizeof(locus_place_options), 0, 0, 100, LOCUS_PLACE_COMPLIANCE, 0, nullptr, nullptr};
}

graph::Diagram &of(locus_diagram *diagram) { return *need(diagram, "diagram").diagram; }
const graph::Diagram &of(const locus_diagram *diagram) { return *need(diagram, "diagram").diagram; }

// Hand a list over: its length always, its elements where there is room.
template <typename T>
void give(const std::vector<T> &list, T *to, const char *name, size_t capacity, size_t *count) {
    need(count, "count") = list.size();
    if (to == nullptr && capacity == 0)
        return;
    need(to, name);
    if (capacity < list.size())
        fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ": ", list.size(), " elements need room");
    std::copy(list.begin(), list.end(), to);
}

// Values of type T into memory of a device.
template <typename T>
void write_on_device(const locus_diagram *diagram, graph::Told told, const locus_voxel_box *box, void *to,
                     const char *name, size_t capacity) {
    const graph::Diagram &read = of(diagram);
    const graph::Box whole = checked_box(read.graph().grid(), box, capacity);
    require(to != nullptr, name, " is NULL");
    require(reinterpret_cast<uintptr_t>(to) % sizeof(T) == 0, name, " is ", to, ", not a multiple of ", sizeof(T));
    read.write_on_device(told, whole, to);
}

} // namespace

locus_status locus_diagram_options_init(locus_diagram_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, defaults(), first_options_size); });
}

locus_status locus_place_options_init(locus_place_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, place_defaults(), first_place_size); });
}

locus_status locus_diagram_create(locus_graph *graph, const locus_diagram_options *options,
                                  locus_diagram **diagram) noexcept {
    return boundary(__func__, [&] {
        need(diagram, "diagram");
        *diagram = nullptr;
        const locus_diagram_options whole = read_options(options, defaults(), first_options_size);
        require(whole.reserved0 == 0, "options->reserved0 is ", whole.reserved0, ", not 0");
        require(whole.reserved1 == 0, "options->reserved1 is ", whole.reserved1, ", not 0");
        *diagram = new locus_diagram{std::make_shared<graph::Diagram>(need(graph, "graph").graph, whole)};
    });
}

void locus_diagram_destroy(locus_diagram *diagram) noexcept { delete diagram; }

locus_status locus_diagram_add_seeds(locus_diagram *diagram, const locus_seed *seeds, size_t count) noexcept {
    return boundary(__func__, [&] {
        graph::Diagram &changed = of(diagram);
        if (count > 0)
            changed.add_seeds({&need(seeds, "seeds"), count});
    });
}

locus_status locus_diagram_remove_seeds(locus_diagram *diagram, const uint32_t *ids, size_t count) noexcept {
    return boundary(__func__, [&] {
        graph::Diagram &changed = of(diagram);
        if (count > 0)
            changed.remove_seeds({&need(ids, "ids"), count});
    });
}

locus_status locus_diagram_move_seed(locus_diagram *diagram, uint32_t id, uint64_t x, uint64_t y, uint64_t z) noexcept {
    return boundary(__func__, [&] { of(diagram).move_seed(id, x, y, z); });
}

locus_status locus_diagram_get_seeds(const locus_diagram *diagram, locus_seed *seeds, size_t capacity,
                                     size_t *count) noexcept {
    return boundary(__func__, [&] {
        const graph::Diagram &read = of(diagram);
        std::vector<locus_seed> list;
        list.reserve(read.seeds().size());
        for (const graph::Seed &seed : read.seeds()) {
            const auto [x, y, z] = read.graph().grid().place(seed.voxel);
            list.push_back({x, y, z, seed.distance, seed.id, seed.fixed ? 1u : 0u});
        }
        give(list, seeds, "seeds", capacity, count);
    });
}

locus_status locus_diagram_place_seeds(locus_diagram *diagram, const locus_place_options *options) noexcept {
    return boundary(__func__, [&] {
        const auto whole = read_options(&need(options, "options"), place_defaults(), first_place_size);
        require(whole.reserved0 == 0, "options->reserved0 is ", whole.reserved0, ", not 0");
        of(diagram).place_seeds(whole);
    });
}

locus_status locus_diagram_solve(locus_diagram *diagram, locus_progress_fn progress, void *user) noexcept {
    return boundary(__func__, [&] {
        Progress told(progress, user);
        of(diagram).solve(told);
    });
}

locus_status locus_diagram_update(locus_diagram *diagram, locus_voxel_box *box, uint64_t *voxels,
                                  locus_progress_fn progress, void *user) noexcept {
    return boundary(__func__, [&] {
        Progress told(progress, user);
        const graph::Change change = of(diagram).update(told);
        if (box != nullptr)
            *box = change.box;
        if (voxels != nullptr)
            *voxels = change.voxels;
    });
}

locus_status locus_diagram_labels(const locus_diagram *diagram, const locus_voxel_box *box, uint32_t *labels,
                                  size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Diagram &read = of(diagram);
        read.labels(checked_box(read.graph().grid(), box, capacity), &need(labels, "labels"));
    });
}

locus_status locus_diagram_distances(const locus_diagram *diagram, const locus_voxel_box *box, float *distances,
                                     size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Diagram &read = of(diagram);
        read.distances(checked_box(read.graph().grid(), box, capacity), &need(distances, "distances"));
    });
}

locus_status locus_diagram_distances_exact(const locus_diagram *diagram, const locus_voxel_box *box,
                                           uint64_t *distances, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Diagram &read = of(diagram);
        read.distances_exact(checked_box(read.graph().grid(), box, capacity), &need(distances, "distances"));
    });
}

locus_status locus_diagram_labels_on_device(const locus_diagram *diagram, const locus_voxel_box *box, void *labels,
                                            size_t capacity) noexcept {
    return boundary(__func__,
                    [&] { write_on_device<uint32_t>(diagram, graph::Told::ids, box, labels, "labels", capacity); });
}

locus_status locus_diagram_distances_on_device(const locus_diagram *diagram, const locus_voxel_box *box,
                                               void *distances, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        write_on_device<float>(diagram, graph::Told::distances, box, distances, "distances", capacity);
    });
}

locus_status locus_diagram_distances_exact_on_device(const locus_diagram *diagram, const locus_voxel_box *box,
                                                     void *distances, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        write_on_device<uint64_t>(diagram, graph::Told::exact_distances, box, distances, "distances", capacity);
    });
}

locus_status locus_diagram_path(const locus_diagram *diagram, uint64_t x, uint64_t y, uint64_t z, uint64_t *voxels,
                                size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] { give(of(diagram).path(x, y, z), voxels, "voxels", capacity, count); });
}

locus_status locus_diagram_cell_sizes(const locus_diagram *diagram, uint64_t *sizes, size_t capacity,
                                      size_t *count) noexcept {
    return boundary(__func__, [&] { give(of(diagram).cell_sizes(), sizes, "sizes", capacity, count); });
}

locus_status locus_diagram_cell_pairs(const locus_diagram *diagram, locus_cell_pair *pairs, size_t capacity,
                                      size_t *count) noexcept {
    return boundary(__func__, [&] { give(of(diagram).cell_pairs(), pairs, "pairs", capacity, count); });
}

locus_status locus_diagram_get_stats(const locus_diagram *diagram, locus_diagram_stats *stats) noexcept {
    return boundary(__func__, [&] { write_report(stats, of(diagram).stats(), first_stats_size, "stats"); });
}

locus_status locus_diagram_trace(const locus_diagram *diagram, uint64_t *active, size_t capacity,
                                 size_t *count) noexcept {
    return boundary(__func__, [&] { give(of(diagram).trace(), active, "active", capacity, count); });
}
