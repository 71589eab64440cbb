// A caller's rings, checked: numbers, sizes, and that nothing crosses.
#include "pmq/query/polygon.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <numeric>

namespace locus::pmq {
namespace {

// The corners of a ring: its vertices but for those that repeat their neighbour.
std::vector<PlanePoint> corners(const locus_position *vertices, uint64_t first, uint64_t size) {
    std::vector<PlanePoint> points;
    for (uint64_t i = first; i < first + size; ++i) {
        const auto &[latitude, longitude] = vertices[i];
        require(latitude >= -90 && latitude <= 90, "polygon.vertices[", i, "].latitude is ", latitude,
                ", not within -90..90");
        require(longitude >= -360 && longitude <= 360, "polygon.vertices[", i, "].longitude is ", longitude,
                ", not within -360..360");
        const PlanePoint point{longitude, latitude};
        if (points.empty() || points.back() != point)
            points.push_back(point);
    }
    if (points.size() > 1 && points.front() == points.back())
        points.pop_back();
    return points;
}

// The order of points along a line.
bool before(const PlanePoint &p, const PlanePoint &q) noexcept { return p.x < q.x || (p.x == q.x && p.y < q.y); }

} // namespace

std::vector<PolygonRegion::Edge> PolygonRegion::edges_of(const locus_polygon &polygon) {
    require(polygon.rings > 0, "polygon.rings is 0");
    const uint64_t *sizes = &need(polygon.ring_sizes, "polygon.ring_sizes");
    const locus_position *vertices = &need(polygon.vertices, "polygon.vertices");
    std::vector<Edge> edges;
    uint64_t first = 0;
    for (uint64_t ring = 0; ring < polygon.rings; ++ring) {
        const std::vector<PlanePoint> points = corners(vertices, first, sizes[ring]);
        require(points.size() >= 3, "polygon.ring_sizes[", ring, "] is ", sizes[ring], ": the ring has ", points.size(),
                " different vertices, fewer than 3");
        for (size_t i = 0; i < points.size(); ++i)
            edges.push_back({points[i], points[i + 1 < points.size() ? i + 1 : 0], ring});
        first += sizes[ring];
    }
    return edges;
}

// Do two edges meet where they must not? Edges of one ring may share the end of the one that is the beginning of the
// other, edges of two rings a single point that is an end of either.
bool PolygonRegion::may_meet(const Edge &one, const Edge &other) noexcept {
    const int a = orientation(one.a, one.b, other.a), b = orientation(one.a, one.b, other.b);
    const int c = orientation(other.a, other.b, one.a), d = orientation(other.a, other.b, one.b);
    if (a * b > 0 || c * d > 0)
        return true;        // all of one on one side of the other
    if (a == 0 && b == 0) { // on one line
        const auto [low, high] = std::minmax(one.a, one.b, before);
        const auto [from, to] = std::minmax(other.a, other.b, before);
        if (before(high, from) || before(to, low))
            return true; // apart
        if (high != from && to != low)
            return false; // they share more than a point
    } else if (a * b < 0 && c * d < 0) {
        return false;
    }
    return one.ring != other.ring || one.b == other.a || other.b == one.a;
}

// Each edge against those that begin, southwards to northwards, before it ends.
void PolygonRegion::refuse_crossings() const {
    const auto south = [this](size_t e) { return std::min(edges_[e].a.y, edges_[e].b.y); };
    std::vector<size_t> order(edges_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t one, size_t other) { return south(one) < south(other); });
    for (size_t i = 0; i < order.size(); ++i) {
        const Edge &one = edges_[order[i]];
        const auto [west, east] = std::minmax(one.a.x, one.b.x);
        const double north = std::max(one.a.y, one.b.y);
        for (size_t j = i + 1; j < order.size() && south(order[j]) <= north; ++j) {
            const Edge &other = edges_[order[j]];
            if (std::max(other.a.x, other.b.x) < west || std::min(other.a.x, other.b.x) > east)
                continue;
            require(may_meet(one, other), "polygon: the edge from (", one.a.y, ", ", one.a.x, ") to (", one.b.y, ", ",
                    one.b.x, ") crosses or touches the one from (", other.a.y, ", ", other.a.x, ") to (", other.b.y,
                    ", ", other.b.x, ")");
        }
    }
}

} // namespace locus::pmq
