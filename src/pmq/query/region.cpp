// Boxes on the map.
#include "pmq/query/region.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>

namespace locus::pmq {
namespace {

constexpr int64_t last_cell = (int64_t{1} << key_levels) - 1;

int64_t cell(double coordinate) noexcept { return static_cast<int64_t>(map_cell(coordinate, key_levels)); }

} // namespace

void check_degrees(double value, double limit, const char *name) {
    require(value >= -limit && value <= limit, name, " is ", value, ", not within ", -limit, "..", limit, " degrees");
}

locus_box covering_box(double south, double west, double north, double east) noexcept {
    constexpr double slack = 1e-7; // degrees
    locus_box box{std::max(-90.0, south - slack), -180, std::min(90.0, north + slack), 180};
    if (east - west + 3 * slack < 360) {
        box.west = std::remainder(west - slack, 360.0);
        box.east = std::remainder(east + slack, 360.0);
    }
    return box;
}

// The projection is computed in floating point: one cell of slack on either side makes up for its rounding. A border
// that is the end of the map (open) needs none: there is nothing beyond it.
BoxRegion::Cells BoxRegion::Cells::between(int64_t first, int64_t last, bool open_first, bool open_last) noexcept {
    const auto spread = [](int64_t c) {
        return spread_bits(static_cast<uint32_t>(std::clamp<int64_t>(c, 0, last_cell)));
    };
    const int64_t inner_first = open_first ? 0 : first + 2;
    const int64_t inner_last = open_last ? last_cell : last - 2;
    Cells cells;
    cells.outer_first = spread(first - 1);
    cells.outer_last = spread(last + 1);
    if (inner_first <= inner_last) {
        cells.inner_first = spread(inner_first);
        cells.inner_last = spread(inner_last);
    }
    return cells;
}

Relation BoxRegion::Cells::relate(uint64_t first, uint64_t last) const noexcept {
    if (last < outer_first || first > outer_last)
        return Relation::outside;
    return first >= inner_first && last <= inner_last ? Relation::inside : Relation::edge;
}

BoxRegion::BoxRegion(const locus_box &box) : box_(box) {
    check_degrees(box.south, 90, "box.south");
    check_degrees(box.north, 90, "box.north");
    check_degrees(box.west, 180, "box.west");
    check_degrees(box.east, 180, "box.east");
    require(box.south <= box.north, "box.south ", box.south, " is north of box.north ", box.north);
    rows_ = Cells::between(cell(map_point(box.north, 0).y), cell(map_point(box.south, 0).y), box.north == 90,
                           box.south == -90);
    if (box.west <= box.east) {
        add_columns(box.west, box.east);
        if (box.east == 180 && box.west != -180)
            add_columns(-180, -180);
    } else {
        add_columns(box.west, 180);
        add_columns(-180, box.east);
    }
}

void BoxRegion::add_columns(double west, double east) noexcept {
    const auto column = [](double longitude) { return longitude == 180 ? last_cell : cell(map_point(0, longitude).x); };
    columns_[parts_++] = Cells::between(column(west), column(east), west == -180, east == 180);
}

// Corner keys: the even and the odd bits of a quadrant's first key are its first column and row, those of its last key
// the last.
Relation BoxRegion::relate(uint64_t first_key, uint64_t last_key) const noexcept {
    const Relation row = rows_.relate((first_key & key_y_mask) >> 1, (last_key & key_y_mask) >> 1);
    if (row == Relation::outside)
        return row;
    Relation column = Relation::outside;
    for (unsigned part = 0; part < parts_ && column != Relation::inside; ++part)
        column = std::max(column, columns_[part].relate(first_key & key_x_mask, last_key & key_x_mask));
    return std::min(row, column);
}

Relation BoxRegion::relate(const Quadrant &quadrant) const noexcept {
    const KeyRange keys = quadrant.keys();
    return relate(keys.lo, keys.hi - 1);
}

bool BoxRegion::contains(double latitude, double longitude) const noexcept {
    if (latitude < box_.south || latitude > box_.north)
        return false;
    const auto within = [this](double l) {
        return box_.west <= box_.east ? box_.west <= l && l <= box_.east : box_.west <= l || l <= box_.east;
    };
    return within(longitude) || (std::abs(longitude) == 180 && within(-longitude));
}

} // namespace locus::pmq
