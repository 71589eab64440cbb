// Polygons: which places they hold, and how quadrants lie to them. Only the edges in the same band of latitude are
// looked at.
#include "pmq/query/polygon.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace locus::pmq {

PolygonRegion::PolygonRegion(const locus_polygon &polygon)
    : edges_(edges_of(polygon)), extent_(extent_of(edges_)),
      bounds_(covering_box(extent_.south, extent_.west, extent_.north, extent_.east)) {
    require(extent_.east - extent_.west <= 360, "polygon.vertices span ", extent_.east - extent_.west,
            " degrees of longitude, more than 360");
    refuse_crossings();
    make_bands();
}

PolygonRegion::Rectangle PolygonRegion::extent_of(const std::vector<Edge> &edges) noexcept {
    Rectangle extent{edges[0].a.y, edges[0].a.x, edges[0].a.y, edges[0].a.x};
    for (const Edge &edge : edges) {
        extent.south = std::min(extent.south, edge.a.y);
        extent.north = std::max(extent.north, edge.a.y);
        extent.west = std::min(extent.west, edge.a.x);
        extent.east = std::max(extent.east, edge.a.x);
    }
    return extent;
}

size_t PolygonRegion::band(double y) const noexcept {
    const size_t bands = band_begins_.size() - 1;
    const double share = (y - extent_.south) / (extent_.north - extent_.south); // NaN where the polygon has no height
    return share > 0 ? std::min(static_cast<size_t>(share * static_cast<double>(bands)), bands - 1) : 0;
}

void PolygonRegion::make_bands() {
    const auto bands = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(edges_.size()))));
    band_begins_.assign(bands + 1, 0);
    const auto for_each_band = [this](const Edge &edge, auto &&use) {
        const auto [low, high] = std::minmax(edge.a.y, edge.b.y);
        for (size_t i = band(low); i <= band(high); ++i)
            use(i);
    };
    for (const Edge &edge : edges_)
        for_each_band(edge, [&](size_t i) { ++band_begins_[i + 1]; });
    for (size_t i = 0; i < bands; ++i)
        band_begins_[i + 1] += band_begins_[i];
    band_edges_.resize(band_begins_[bands]);
    std::vector<size_t> next(band_begins_);
    for (size_t e = 0; e < edges_.size(); ++e)
        for_each_band(edges_[e], [&](size_t i) { band_edges_[next[i]++] = e; });
}

// On an edge, or an odd number of edges to the east of it. An edge holds its lower end, not its upper one.
bool PolygonRegion::contains(const PlanePoint &place) const noexcept {
    if (place.y < extent_.south || place.y > extent_.north || place.x < extent_.west || place.x > extent_.east)
        return false;
    bool inside = false;
    const size_t at = band(place.y);
    for (size_t i = band_begins_[at]; i < band_begins_[at + 1]; ++i) {
        const auto &[a, b, ring] = edges_[band_edges_[i]];
        if (place.y < std::min(a.y, b.y) || place.y > std::max(a.y, b.y) || place.x > std::max(a.x, b.x))
            continue;
        const bool crosses = (a.y <= place.y) != (b.y <= place.y);
        if (place.x < std::min(a.x, b.x)) {
            inside ^= crosses;
            continue;
        }
        const int side = orientation(a, b, place);
        if (side == 0)
            return true;
        inside ^= crosses && (side > 0) == (b.y > a.y);
    }
    return inside;
}

bool PolygonRegion::contains(double latitude, double longitude) const noexcept {
    return contains(PlanePoint{longitude, latitude}) || contains(PlanePoint{longitude - 360, latitude}) ||
           contains(PlanePoint{longitude + 360, latitude});
}

// May an edge and a rectangle have a point in common? "Yes" in case of doubt.
bool PolygonRegion::touches(const Edge &edge, const Rectangle &rectangle) noexcept {
    if (std::max(edge.a.x, edge.b.x) < rectangle.west || std::min(edge.a.x, edge.b.x) > rectangle.east ||
        std::max(edge.a.y, edge.b.y) < rectangle.south || std::min(edge.a.y, edge.b.y) > rectangle.north)
        return false;
    const int first = orientation(edge.a, edge.b, {rectangle.west, rectangle.south});
    return first == 0 || orientation(edge.a, edge.b, {rectangle.east, rectangle.south}) != first ||
           orientation(edge.a, edge.b, {rectangle.west, rectangle.north}) != first ||
           orientation(edge.a, edge.b, {rectangle.east, rectangle.north}) != first;
}

// Where no edge comes, all places are alike.
Relation PolygonRegion::relate(const Rectangle &rectangle) const noexcept {
    if (rectangle.north < extent_.south || rectangle.south > extent_.north || rectangle.east < extent_.west ||
        rectangle.west > extent_.east)
        return Relation::outside;
    const size_t first = band_begins_[band(rectangle.south)], last = band_begins_[band(rectangle.north) + 1];
    for (size_t i = first; i < last; ++i)
        if (touches(edges_[band_edges_[i]], rectangle))
            return Relation::edge;
    return contains(PlanePoint{rectangle.west, rectangle.south}) ? Relation::inside : Relation::outside;
}

Relation PolygonRegion::relate(const Quadrant &quadrant) const noexcept {
    if (bounds_.relate(quadrant) == Relation::outside)
        return Relation::outside;
    constexpr double slack = 1e-9; // degrees, far above the rounding of the projection and of a turn
    const uint64_t below = uint64_t{quadrant.y()} + 1;
    const double width = 360.0 / static_cast<double>(uint64_t{1} << quadrant.level);
    const double west = map_longitude(quadrant.x(), quadrant.level);
    const double north = quadrant.y() == 0 ? 90 : map_latitude(quadrant.y(), quadrant.level);
    const double south =
        below >> quadrant.level != 0 ? -90 : map_latitude(static_cast<uint32_t>(below), quadrant.level);
    Relation relation = Relation::outside;
    for (const double turn : {0.0, -360.0, 360.0}) {
        const Relation there =
            relate(Rectangle{south - slack, west + turn - slack, north + slack, west + width + turn + slack});
        if (there == Relation::edge)
            return there;
        relation = std::max(relation, there);
    }
    return relation;
}

Relation PolygonRegion::relate(uint64_t key) const noexcept {
    return bounds_.relate(key) == Relation::outside ? Relation::outside : Relation::edge;
}

} // namespace locus::pmq
