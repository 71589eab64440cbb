/* locus/diagram.hpp - locus::diagram, the owner of a locus_diagram. Each member is the C function of its name: see
 * locus/diagram.h for units, ranges and errors. */
#ifndef LOCUS_DIAGRAM_HPP
#define LOCUS_DIAGRAM_HPP

#include <locus/diagram.h>
#include <locus/graph.hpp>

namespace locus {

struct diagram_options : locus_diagram_options {
    diagram_options() noexcept { locus_diagram_options_init(this, sizeof(locus_diagram_options)); }
};

struct place_options : locus_place_options {
    explicit place_options(std::uint64_t seeds = 0) noexcept {
        locus_place_options_init(this, sizeof(locus_place_options));
        count = seeds;
    }
    locus::progress progress;
};

/* What an update changed: the smallest box around it, and how many voxels. */
struct diagram_change {
    locus_voxel_box box{};
    std::uint64_t voxels = 0;
};

class weights;

class diagram {
public:
    /* An empty handle: only assigning to it and destroying it are allowed. */
    diagram() noexcept = default;
    diagram(diagram &&) noexcept = default;
    diagram &operator=(diagram &&) noexcept = default;
    explicit diagram(graph &graph, const diagram_options &options = {}, status *result = nullptr)
        : callbacks_(graph.callbacks_) {
        locus_diagram *made = nullptr;
        const locus_status code = locus_diagram_create(graph.get(), &options, &made);
        handle_ = {made, locus_diagram_destroy};
        if (!detail::settle(code, result))
            return;
        const locus_graph_info info = graph.info(result);
        for (int axis = 0; axis < 3; ++axis)
            dims_[axis] = info.dims[axis];
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_diagram *get() const noexcept { return handle_.get(); }

    void add_seeds(span<const locus_seed> seeds, status *result = nullptr) {
        detail::settle(locus_diagram_add_seeds(get(), seeds.data(), seeds.size()), result);
    }
    void remove_seeds(span<const std::uint32_t> ids, status *result = nullptr) {
        detail::settle(locus_diagram_remove_seeds(get(), ids.data(), ids.size()), result);
    }
    void move_seed(std::uint32_t id, std::uint64_t x, std::uint64_t y, std::uint64_t z, status *result = nullptr) {
        detail::settle(locus_diagram_move_seed(get(), id, x, y, z), result);
    }
    std::vector<locus_seed> seeds(status *result = nullptr) const {
        return listed<locus_seed>(
            [this](locus_seed *into, std::size_t room, std::size_t *count) {
                return locus_diagram_get_seeds(get(), into, room, count);
            },
            result);
    }
    void place_seeds(const place_options &options, status *result = nullptr) {
        detail::progress_call call(options.progress, thrown());
        locus_place_options plain = options;
        plain.progress = detail::progress_call::at;
        plain.progress_user = &call;
        settle(locus_diagram_place_seeds(get(), &plain), call, result);
    }

    void solve(const progress &told = {}, status *result = nullptr) {
        detail::progress_call call(told, thrown());
        settle(locus_diagram_solve(get(), detail::progress_call::at, &call), call, result);
    }
    diagram_change update(const progress &told = {}, status *result = nullptr) {
        detail::progress_call call(told, thrown());
        diagram_change change;
        settle(locus_diagram_update(get(), &change.box, &change.voxels, detail::progress_call::at, &call), call,
               result);
        return change;
    }

    /* The result of a box, x fastest, into memory of yours or into a new vector. */
    void labels(span<std::uint32_t> into, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_labels(get(), box.get(), into.data(), into.size()), result);
    }
    void distances(span<float> into, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_distances(get(), box.get(), into.data(), into.size()), result);
    }
    void distances_exact(span<std::uint64_t> into, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_distances_exact(get(), box.get(), into.data(), into.size()), result);
    }
    /* The same into memory of the GPU that solved the diagram, with room for `capacity` elements. */
    void labels_on_device(void *into, std::size_t capacity, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_labels_on_device(get(), box.get(), into, capacity), result);
    }
    void distances_on_device(void *into, std::size_t capacity, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_distances_on_device(get(), box.get(), into, capacity), result);
    }
    void distances_exact_on_device(void *into, std::size_t capacity, within box = {}, status *result = nullptr) const {
        detail::settle(locus_diagram_distances_exact_on_device(get(), box.get(), into, capacity), result);
    }
    std::vector<std::uint32_t> labels(within box = {}, status *result = nullptr) const {
        std::vector<std::uint32_t> found(size(box));
        labels(found, box, result);
        return found;
    }
    std::vector<float> distances(within box = {}, status *result = nullptr) const {
        std::vector<float> found(size(box));
        distances(found, box, result);
        return found;
    }
    std::vector<std::uint64_t> distances_exact(within box = {}, status *result = nullptr) const {
        std::vector<std::uint64_t> found(size(box));
        distances_exact(found, box, result);
        return found;
    }

    /* The voxels of the shortest path from (x, y, z) to its seed; empty where no seed reaches. */
    std::vector<std::uint64_t> path(std::uint64_t x, std::uint64_t y, std::uint64_t z, status *result = nullptr) const {
        return listed<std::uint64_t>(
            [&](std::uint64_t *into, std::size_t room, std::size_t *count) {
                return locus_diagram_path(get(), x, y, z, into, room, count);
            },
            result);
    }
    std::vector<std::uint64_t> cell_sizes(status *result = nullptr) const {
        return listed<std::uint64_t>(
            [this](std::uint64_t *into, std::size_t room, std::size_t *count) {
                return locus_diagram_cell_sizes(get(), into, room, count);
            },
            result);
    }
    std::vector<locus_cell_pair> cell_pairs(status *result = nullptr) const {
        return listed<locus_cell_pair>(
            [this](locus_cell_pair *into, std::size_t room, std::size_t *count) {
                return locus_diagram_cell_pairs(get(), into, room, count);
            },
            result);
    }
    locus_diagram_stats stats(status *result = nullptr) const {
        locus_diagram_stats stats{};
        stats.struct_size = sizeof stats;
        detail::settle(locus_diagram_get_stats(get(), &stats), result);
        return stats;
    }
    std::vector<std::uint64_t> trace(status *result = nullptr) const {
        return listed<std::uint64_t>(
            [this](std::uint64_t *into, std::size_t room, std::size_t *count) {
                return locus_diagram_trace(get(), into, room, count);
            },
            result);
    }

private:
    friend class weights;
    std::size_t size(within box) const noexcept { return detail::voxels(box, dims_); }
    detail::thrown *thrown() const noexcept { return callbacks_ != nullptr ? &callbacks_->thrown : nullptr; }
    bool settle(locus_status code, detail::progress_call &call, status *result) {
        if (callbacks_ != nullptr)
            callbacks_->thrown.rethrow();
        call.rethrow();
        return detail::settle(code, result);
    }
    /* A list whose length the library tells: asked for with no room first, then with what it needs. */
    template <class Element, class Fill>
    std::vector<Element> listed(Fill &&fill, status *result) const {
        std::size_t count = 0;
        locus_status code = fill(nullptr, 0, &count);
        std::vector<Element> found;
        if ((code == LOCUS_OK || code == LOCUS_E_CAPACITY) && count > 0) {
            found.resize(count);
            code = fill(found.data(), found.size(), &count);
        }
        if (!detail::settle(code, result))
            found.clear();
        return found;
    }

    /* In this order: the handle ends before what its callbacks use. */
    std::shared_ptr<detail::graph_callbacks> callbacks_;
    std::shared_ptr<locus_diagram> handle_; /* the weights of the diagram hold it too */
    std::uint64_t dims_[3] = {0, 0, 0};
};

} // namespace locus
#endif
