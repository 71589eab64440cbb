// Polygons on the map, with edges straight in longitude and latitude.
#pragma once

#include "core/orientation.hpp"
#include "pmq/query/region.hpp"

#include <vector>

namespace locus::pmq {

// Rings with the even-odd rule, borders included. x is the longitude and runs past 180 across the antimeridian: a place
// belongs to the polygon if it does at its longitude or a turn of the globe east or west of it.
class PolygonRegion final : public Region {
public:
    explicit PolygonRegion(const locus_polygon &polygon);
    Relation relate(const Quadrant &quadrant) const noexcept override;
    Relation relate(uint64_t key) const noexcept override;
    bool contains(double latitude, double longitude) const noexcept override;

private:
    struct Edge {
        PlanePoint a, b;
        size_t ring;
    };
    struct Rectangle {
        double south, west, north, east;
    };
    static std::vector<Edge> edges_of(const locus_polygon &polygon);
    static Rectangle extent_of(const std::vector<Edge> &edges) noexcept;
    static bool touches(const Edge &edge, const Rectangle &rectangle) noexcept;
    static bool may_meet(const Edge &one, const Edge &other) noexcept;
    void refuse_crossings() const;
    void make_bands();
    size_t band(double y) const noexcept;
    bool contains(const PlanePoint &place) const noexcept;
    Relation relate(const Rectangle &rectangle) const noexcept;

    std::vector<Edge> edges_;
    Rectangle extent_;
    BoxRegion bounds_;
    // Bands of equal height: the edges that reach into band i are band_edges_[band_begins_[i] .. band_begins_[i + 1]).
    std::vector<size_t> band_begins_;
    std::vector<size_t> band_edges_;
};

} // namespace locus::pmq
