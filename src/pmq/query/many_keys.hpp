// Questions about many keys at once, for the leaves on a query's border: their keys lie side by side.
#pragma once

#include "core/simd.hpp"
#include "core/zcurve.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace locus::pmq {

// Columns or rows of the map, bits spread as in keys (x at the even bits, y shifted down to them): outside
// [outer_first, outer_last] there is no record of a box, inside [inner_first, inner_last] there are no others.
struct MapCells {
    uint64_t outer_first = 1, outer_last = 0, inner_first = 1, inner_last = 0; // none
};

// The keys of a range, and how they relate to a box: its rows, and its columns on both sides of the antimeridian.
struct KeysOfBox {
    KeyRange range;
    MapCells rows;
    std::array<MapCells, 2> columns;
};

constexpr size_t most_keys = 512; // of one question,
constexpr size_t worthwhile = 32; // fewer than so many are asked quicker one by one

// Bit i: key i lies in the range, and the places with that key all lie in the box, or perhaps.
struct KeyMarks {
    std::array<uint64_t, most_keys / 64> inside, edge;
};

// How the instruction sets answer; all answer the same.
struct ManyKeys {
    void (*mark)(const KeysOfBox &box, const uint64_t *keys, size_t count, KeyMarks &marks) noexcept;
    size_t (*count_below)(uint64_t bound, const uint64_t *keys, size_t count) noexcept;
    // The bins, row by row, of a tile with 2^log2_bins <= 256 a side: a key shifted by `shift` is its bin's Morton
    // code.
    void (*bins)(unsigned shift, unsigned log2_bins, const uint64_t *keys, size_t count, uint64_t *bins) noexcept;
};
const ManyKeys &many_keys(Simd target) noexcept;
const ManyKeys &many_keys() noexcept; // the widest that is available

} // namespace locus::pmq
