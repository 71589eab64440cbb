// The blade as a mesh, and as a line in a slice.
#include "volume/blade.hpp"

#include <vector>

namespace volume {
namespace {

// The blade's corners around its border, in grid coordinates.
std::array<std::array<double, 3>, 4> corners(const Blade &blade, double reach) {
    std::array<std::array<double, 3>, 4> around{blade.from, blade.from, blade.side, blade.side};
    for (const size_t corner : {size_t{1}, size_t{2}})
        for (size_t axis = 0; axis < 3; ++axis)
            around[corner][axis] += reach * (blade.to[axis] - blade.from[axis]);
    return around;
}

} // namespace

uint64_t cut_along(const Blade &blade, double reach, const Input &input, locus_graph *graph) {
    std::vector<double> vertices;
    for (const auto &corner : corners(blade, reach))
        for (size_t axis = 0; axis < 3; ++axis)
            vertices.push_back(corner[axis] * input.info.spacing[axis]);
    static constexpr uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
    uint64_t edges = 0;
    check(locus_graph_cut_mesh(graph, vertices.data(), 4, triangles, 2, &edges));
    return edges;
}

std::optional<std::array<std::array<double, 2>, 2>> line_in(const Blade &blade, double reach, const Slicer &slicer,
                                                            const Slice &slice) {
    const auto around = corners(blade, reach);
    const double at = static_cast<double>(slice.at);
    std::vector<std::array<double, 2>> ends; // where the border passes through the slice: twice, or never
    for (size_t i = 0; i < around.size() && ends.size() < 2; ++i) {
        const auto &a = around[i], &b = around[(i + 1) % around.size()];
        const double before = a[slice.through] - at, behind = b[slice.through] - at;
        if ((before < 0) == (behind < 0))
            continue;
        std::array<double, 3> place{};
        for (size_t axis = 0; axis < 3; ++axis)
            place[axis] = a[axis] + before / (before - behind) * (b[axis] - a[axis]);
        ends.push_back(slicer.place_of_grid(slice, place));
    }
    if (ends.size() < 2)
        return std::nullopt;
    return {{ends[0], ends[1]}};
}

} // namespace volume
