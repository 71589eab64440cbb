// A voxel's 26 neighbours in kernels; numbers and order are those of graph/grid.hpp.
#pragma once

#include "core/word.hpp"

namespace locus::device {

// The axes an offset moves along: bit 0 x, bit 1 y, bit 2 z; and how many they are.
LOCUS_HD constexpr unsigned axes_of(int dx, int dy, int dz) {
    return (dx != 0 ? 1u : 0u) | (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
}
LOCUS_HD constexpr unsigned moves(unsigned axes) { return (axes & 1) + (axes >> 1 & 1) + (axes >> 2); }
LOCUS_HD constexpr unsigned number_of(int dx, int dy, int dz) {
    const int position = dx + 1 + 3 * (dy + 1) + 9 * (dz + 1);
    return static_cast<unsigned>(position > 13 ? position - 1 : position);
}
// The numbers of all neighbours that are at most so many axes away, as bits.
LOCUS_HD constexpr uint32_t neighbours_within(unsigned classes) {
    uint32_t all = 0;
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const unsigned moved = moves(axes_of(dx, dy, dz)); moved >= 1 && moved <= classes)
                    all |= 1u << number_of(dx, dy, dz);
    return all;
}

} // namespace locus::device
