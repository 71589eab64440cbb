/* locus/graph.hpp - locus::graph, the owner of a locus_graph. Each member is the C function of its name: see
 * locus/graph.h for units, ranges and errors. */
#ifndef LOCUS_GRAPH_HPP
#define LOCUS_GRAPH_HPP

#include <locus/graph.h>
#include <locus/status.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace locus {

/* The weight of the edge between the voxels u and v; several threads may call it at once. An exception leaves a
 * diagram that was being solved without a result to rely on: solve it again. */
using weight_function = callback<double(std::uint64_t u, std::uint64_t v, double length)>;

/* The C options with their defaults; the callbacks are lambdas. */
struct graph_options : locus_graph_options {
    graph_options() noexcept { locus_graph_options_init(this, sizeof(locus_graph_options)); }
    graph_options(std::uint64_t nx, std::uint64_t ny, std::uint64_t nz) noexcept : graph_options() {
        dims[0] = nx, dims[1] = ny, dims[2] = nz;
    }
    weight_function weight; /* for LOCUS_WEIGHT_CALLER */
    locus::log log;
};

/* The voxels a call is about: a box, or by default the whole grid. */
class within {
public:
    within() noexcept = default;
    within(const locus_voxel_box &box) noexcept : box_(&box) {}
    const locus_voxel_box *get() const noexcept { return box_; }

private:
    const locus_voxel_box *box_ = nullptr;
};

namespace detail {

/* A graph's callbacks, which its diagrams and weights keep too, for they may be called after the graph has ended. */
struct graph_callbacks {
    weight_function weight;
    locus::log log;
    detail::thrown thrown;

    static double on_weight(std::uint64_t u, std::uint64_t v, double length, void *user) noexcept {
        auto &kept = *static_cast<graph_callbacks *>(user);
        /* After an exception more than a word can hold: the call fails, and nothing is computed from it. */
        return kept.thrown.guard(std::numeric_limits<double>::max(), [&] { return kept.weight(u, v, length); });
    }
    static void on_log(std::int32_t level, const char *text, void *user) noexcept {
        auto &kept = *static_cast<graph_callbacks *>(user);
        kept.thrown.guard(0, [&] { return kept.log(level, text), 0; });
    }
};

/* The voxels of a grid or a box; a product too large for 64 bits stays at their maximum. */
inline std::uint64_t voxels(const std::uint64_t (&extent)[3]) noexcept {
    std::uint64_t product = 1;
    for (const std::uint64_t size : extent) {
        if (size != 0 && product > std::numeric_limits<std::uint64_t>::max() / size)
            return std::numeric_limits<std::uint64_t>::max();
        product *= size;
    }
    return product;
}

/* The voxels of a box, but no more than those of the grid: the library refuses a larger one. */
inline std::size_t voxels(within box, const std::uint64_t (&dims)[3]) noexcept {
    const std::uint64_t whole = voxels(dims);
    return static_cast<std::size_t>(box.get() != nullptr ? std::min(voxels(box.get()->extent), whole) : whole);
}

} // namespace detail

class diagram;

class graph {
public:
    /* An empty handle: only assigning to it and destroying it are allowed. */
    graph() noexcept = default;
    /* `material` holds a value per voxel, x fastest; an empty one makes every voxel impassable. */
    explicit graph(const graph_options &options, span<const float> material = {}, status *result = nullptr)
        : callbacks_(std::make_shared<detail::graph_callbacks>()) {
        if (!material.empty() && !detail::has_size("material", material.size(), detail::voxels(options.dims), result))
            return;
        callbacks_->weight = options.weight;
        callbacks_->log = options.log;
        locus_graph_options plain = options;
        plain.weight = options.weight ? detail::graph_callbacks::on_weight : nullptr;
        plain.log = options.log ? detail::graph_callbacks::on_log : nullptr;
        plain.weight_user = plain.log_user = callbacks_.get();
        locus_graph *made = nullptr;
        const locus_status code = locus_graph_create(&plain, material.empty() ? nullptr : material.data(), &made);
        handle_.reset(made);
        settle(code, result);
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_graph *get() const noexcept { return handle_.get(); }

    locus_graph_info info(status *result = nullptr) const {
        locus_graph_info info{};
        info.struct_size = sizeof info;
        detail::settle(locus_graph_get_info(get(), &info), result);
        return info;
    }

    void set_box(const locus_voxel_box &box, span<const float> values, status *result = nullptr) {
        if (detail::has_size("values", values.size(), detail::voxels(box.extent), result))
            settle(locus_graph_set_box(get(), &box, values.data()), result);
    }
    void fill_box(const locus_voxel_box &box, float value, status *result = nullptr) {
        settle(locus_graph_fill_box(get(), &box, value), result);
    }
    void set_voxels(span<const std::uint64_t> voxels, span<const float> values, status *result = nullptr) {
        if (detail::has_size("values", values.size(), voxels.size(), result))
            settle(locus_graph_set_voxels(get(), voxels.data(), values.data(), voxels.size()), result);
    }
    void get_box(span<float> values, within box = {}, status *result = nullptr) const {
        detail::settle(locus_graph_get_box(get(), box.get(), values.data(), values.size()), result);
    }
    std::vector<float> get_box(within box = {}, status *result = nullptr) const {
        status size;
        const locus_graph_info grid = info(&size);
        if (!detail::settle(size.code(), result, size.text()))
            return {};
        std::vector<float> values(detail::voxels(box, grid.dims));
        get_box(values, box, result);
        return values;
    }
    /* The steps of the edge between two voxels, given by their indices; 0: there is no such edge. */
    std::uint64_t edge_weight(std::uint64_t u, std::uint64_t v, status *result = nullptr) const {
        std::uint64_t steps = 0;
        settle(locus_graph_edge_weight(get(), u, v, &steps), result);
        return steps;
    }

    /* Cuts and mending return the number of edges they cut or mended. */
    std::uint64_t cut_plane(const std::array<double, 3> &point, const std::array<double, 3> &normal, within box = {},
                            status *result = nullptr) {
        std::uint64_t edges = 0;
        settle(locus_graph_cut_plane(get(), point.data(), normal.data(), box.get(), &edges), result);
        return edges;
    }
    /* Three coordinates a vertex, three vertex indices a triangle. */
    std::uint64_t cut_mesh(span<const double> vertices, span<const std::uint32_t> triangles, status *result = nullptr) {
        std::uint64_t edges = 0;
        if (!detail::has_size("vertices", vertices.size(), vertices.size() / 3 * 3, result) ||
            !detail::has_size("triangles", triangles.size(), triangles.size() / 3 * 3, result))
            return edges;
        settle(locus_graph_cut_mesh(get(), vertices.data(), vertices.size() / 3, triangles.data(), triangles.size() / 3,
                                    &edges),
               result);
        return edges;
    }
    std::uint64_t mend_box(within box = {}, status *result = nullptr) {
        std::uint64_t edges = 0;
        settle(locus_graph_mend_box(get(), box.get(), &edges), result);
        return edges;
    }

private:
    friend class diagram;
    bool settle(locus_status code, status *result) const {
        if (callbacks_ != nullptr)
            callbacks_->thrown.rethrow();
        return detail::settle(code, result);
    }

    /* In this order: the handle ends before what its callbacks use. */
    std::shared_ptr<detail::graph_callbacks> callbacks_;
    std::unique_ptr<locus_graph, detail::ended_by<locus_graph_destroy>> handle_;
};

} // namespace locus
#endif
