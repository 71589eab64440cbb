// Where a query looks: a set of places that can be compared with quadrants of the map.
#pragma once

#include "pmq/query/many_keys.hpp"

#include <locus/pmq.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace locus::pmq {

enum class Relation { outside, edge, inside };

class BoxRegion;

class Region {
public:
    virtual ~Region() = default;
    // Itself, if it is one: it can be asked about a key without a call.
    virtual const BoxRegion *as_box() const noexcept { return nullptr; }
    // How the places whose key lies in the quadrant relate to the region. `edge` may be said of any quadrant: its
    // records are then tested one by one. Latitudes beyond the Mercator square have the keys of its edge rows.
    virtual Relation relate(const Quadrant &quadrant) const noexcept = 0;
    // The same for one key.
    virtual Relation relate(uint64_t key) const noexcept { return relate(Quadrant{key_levels, key}); }
    virtual bool contains(double latitude, double longitude) const noexcept = 0;
};

// A box in degrees, borders included, across the antimeridian when west > east. Longitudes 180 and -180 are one
// meridian.
class BoxRegion final : public Region {
public:
    explicit BoxRegion(const locus_box &box);
    Relation relate(const Quadrant &quadrant) const noexcept override;
    Relation relate(uint64_t key) const noexcept override { return relate_quickly(key); }
    bool contains(double latitude, double longitude) const noexcept override;
    const BoxRegion *as_box() const noexcept override { return this; }
    // For asking about many keys of a range.
    KeysOfBox among(const KeyRange &range) const noexcept { return {range, rows_, {columns_[0], columns_[1]}}; }
    // relate(key), with no branch to mispredict.
    Relation relate_quickly(uint64_t key) const noexcept {
        const uint64_t x = key & key_x_mask, y = (key & key_y_mask) >> 1;
        const unsigned column = std::max(columns_[0].rank(x), columns_[1].rank(x));
        return static_cast<Relation>(std::min(column, rows_.rank(y)));
    }

private:
    struct Cells : MapCells {
        static Cells between(int64_t first, int64_t last, bool open_first, bool open_last) noexcept;
        Relation relate(uint64_t first, uint64_t last) const noexcept;
        // The number of relate(cell, cell).
        unsigned rank(uint64_t cell) const noexcept {
            const bool outer = (cell >= outer_first) & (cell <= outer_last);
            const bool inner = (cell >= inner_first) & (cell <= inner_last);
            return unsigned{outer} + unsigned{inner};
        }
    };
    Relation relate(uint64_t first_key, uint64_t last_key) const noexcept;
    void add_columns(double west, double east) noexcept;

    locus_box box_;
    Cells rows_;
    std::array<Cells, 2> columns_; // the box's parts on both sides of the antimeridian
    unsigned parts_ = 0;
};

// Throws Error(LOCUS_E_ARGUMENT) unless a coordinate lies within -limit..limit degrees.
void check_degrees(double value, double limit, const char *name);

// A box around places with latitudes south..north and longitudes west..east, which may run past 180 degrees: a bit
// larger, far more than rounding needs.
locus_box covering_box(double south, double west, double north, double east) noexcept;

} // namespace locus::pmq
