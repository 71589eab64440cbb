// Cuts along surfaces. An edge is a segment between two voxel centres; it is cut where the surface passes between them.
#include "graph/cuts.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace locus::graph {
namespace {

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point &a, const Point &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The edges to be cut, by voxel.
using Cut = std::unordered_map<uint64_t, uint16_t>;

uint64_t disable(Graph &graph, const Cut &cut) {
    std::vector<uint64_t> voxels;
    std::vector<uint16_t> masks;
    uint64_t count = 0;
    for (const auto &[voxel, mask] : cut) {
        const uint16_t already = graph.cuts() != nullptr ? graph.cuts()[voxel] : uint16_t{0};
        const auto fresh = static_cast<uint16_t>(mask & ~already);
        if (fresh == 0)
            continue;
        voxels.push_back(voxel);
        masks.push_back(fresh);
        count += static_cast<uint64_t>(std::popcount(fresh));
    }
    graph.cut_edges(voxels, masks);
    return count;
}

Point centre(const Grid &grid, const std::array<uint64_t, 3> &place) {
    return {static_cast<double>(place[0]) * grid.spacing()[0], static_cast<double>(place[1]) * grid.spacing()[1],
            static_cast<double>(place[2]) * grid.spacing()[2]};
}

// Cut the edges inside `box` whose ends lie on different sides of the plane and that crosses(a, b, da, db) confirms; da
// and db are the ends' distances from the plane along the normal.
template <typename Crosses>
void cut_sides(const Grid &grid, const Point &point, const Point &normal, const Box &box, Cut &cut, Crosses &&crosses) {
    // No voxel farther away has an edge across; the slack covers the roundings.
    double reach = 0;
    for (size_t axis = 0; axis < 3; ++axis)
        reach += std::abs(normal[axis]) * grid.spacing()[axis] * (1 + 1e-9);
    const auto in_box = [&](const std::array<uint64_t, 3> &place) {
        return place[0] - box.origin[0] < box.extent[0] && place[1] - box.origin[1] < box.extent[1] &&
               place[2] - box.origin[2] < box.extent[2];
    };
    for_each_voxel(grid, box, [&](uint64_t voxel, uint64_t) {
        const auto place = grid.place(voxel);
        const Point a = centre(grid, place);
        const double da = dot(minus(a, point), normal);
        if (std::abs(da) > reach)
            return;
        for (const Neighbour &to : grid.neighbours()) {
            const std::array<uint64_t, 3> end = {place[0] + static_cast<uint64_t>(to.dx),
                                                 place[1] + static_cast<uint64_t>(to.dy),
                                                 place[2] + static_cast<uint64_t>(to.dz)};
            if (to.number < first_forward || !in_box(end))
                continue;
            const Point b = centre(grid, end);
            const double db = dot(minus(b, point), normal);
            if ((da < 0) == (db < 0) || !crosses(a, b, da, db))
                continue;
            uint16_t &mask = cut[voxel];
            mask = static_cast<uint16_t>(mask | 1u << (to.number - first_forward));
        }
    });
}

struct Triangle {
    std::array<Point, 3> corner;
    Point normal;

    // Whether p, on the plane, lies in the triangle, its border included with a margin: triangles that share an edge
    // leave no gap between them.
    bool holds(const Point &p) const {
        const double area = dot(normal, normal);
        for (size_t i = 0; i < 3; ++i) {
            const Point &a = corner[i];
            const Point &b = corner[(i + 1) % 3];
            if (dot(cross(minus(b, a), minus(p, a)), normal) < -1e-9 * area)
                return false;
        }
        return true;
    }
};

// The voxels around a triangle; nothing where it lies outside the grid.
bool box_around(const Grid &grid, const Triangle &triangle, Box &box) {
    for (size_t axis = 0; axis < 3; ++axis) {
        double low = triangle.corner[0][axis], high = low;
        for (const Point &corner : triangle.corner) {
            low = std::min(low, corner[axis]);
            high = std::max(high, corner[axis]);
        }
        const auto dim = static_cast<double>(grid.dims()[axis]);
        const double first = std::max(0.0, std::floor(low / grid.spacing()[axis]) - 1);
        const double last = std::min(dim - 1, std::ceil(high / grid.spacing()[axis]) + 1);
        if (!(first <= last))
            return false;
        box.origin[axis] = static_cast<uint64_t>(first);
        box.extent[axis] = static_cast<uint64_t>(last) - box.origin[axis] + 1;
    }
    return true;
}

void cut_triangle(const Grid &grid, Triangle triangle, Cut &cut) {
    triangle.normal =
        cross(minus(triangle.corner[1], triangle.corner[0]), minus(triangle.corner[2], triangle.corner[0]));
    const auto lead =
        std::find_if(triangle.normal.begin(), triangle.normal.end(), [](double component) { return component != 0; });
    Box box{};
    if (lead == triangle.normal.end() || !box_around(grid, triangle, box))
        return; // no area, or outside
    if (*lead < 0) {
        std::swap(triangle.corner[1], triangle.corner[2]);
        for (double &component : triangle.normal)
            component = -component;
    }
    cut_sides(grid, triangle.corner[0], triangle.normal, box, cut,
              [&](const Point &a, const Point &b, double da, double db) {
                  const double t = da / (da - db);
                  return triangle.holds({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
              });
}

} // namespace

uint64_t cut_by_plane(Graph &graph, const Point &point, const Point &normal, const Box &box) {
    graph.grid().check(box);
    for (size_t axis = 0; axis < 3; ++axis) {
        require(std::isfinite(point[axis]), "point[", axis, "] is ", point[axis], ", not a finite number");
        require(std::isfinite(normal[axis]), "normal[", axis, "] is ", normal[axis], ", not a finite number");
    }
    require(dot(normal, normal) > 0, "normal is zero");
    Cut cut;
    cut_sides(graph.grid(), point, normal, box, cut, [](const Point &, const Point &, double, double) { return true; });
    return disable(graph, cut);
}

uint64_t cut_by_mesh(Graph &graph, std::span<const double> vertices, std::span<const uint32_t> triangles) {
    for (size_t i = 0; i < vertices.size(); ++i)
        require(std::isfinite(vertices[i]), "vertices[", i, "] is ", vertices[i], ", not a finite number");
    const size_t count = vertices.size() / 3;
    for (size_t i = 0; i < triangles.size(); ++i)
        require(triangles[i] < count, "triangles[", i, "] is ", triangles[i], ": there are ", count, " vertices");
    Cut cut;
    for (size_t i = 0; i < triangles.size(); i += 3) {
        Triangle triangle{};
        for (size_t corner = 0; corner < 3; ++corner)
            std::copy_n(vertices.begin() + static_cast<ptrdiff_t>(size_t{3} * triangles[i + corner]), 3,
                        triangle.corner[corner].begin());
        cut_triangle(graph.grid(), triangle, cut);
    }
    return disable(graph, cut);
}

} // namespace locus::graph
