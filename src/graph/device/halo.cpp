#include "graph/device/halo.hpp"

namespace locus::device {
namespace {

// `out`: the axes on which the cell lies outside, `behind`: and behind the brick, not before it; `in`: where on the
// others.
BorderCell border_cell(unsigned out, unsigned behind, const unsigned (&in)[3]) {
    unsigned at[3], nearest[3], voxel[3];
    int side = 13, sides = 1;
    for (unsigned a = 0; a < 3; ++a) {
        const bool outside = (out >> a & 1) != 0, after = (behind >> a & 1) != 0;
        at[a] = !outside ? in[a] + 1 : after ? kHalo - 1 : 0;
        nearest[a] = !outside ? in[a] + 1 : after ? kSide : 1;
        voxel[a] = !outside ? in[a] : after ? 0 : kSide - 1;
        side += !outside ? 0 : after ? sides : -sides;
        sides *= 3;
    }
    return {static_cast<uint16_t>(cell_at(at[0], at[1], at[2])),
            static_cast<uint16_t>(cell_at(nearest[0], nearest[1], nearest[2])),
            static_cast<uint16_t>(voxel[0] + kSide * (voxel[1] + kSide * voxel[2])), static_cast<uint16_t>(side)};
}

} // namespace

std::vector<BorderCell> border_cells() {
    std::vector<BorderCell> cells;
    for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned holder = 0; holder < BorderCell::holders; ++holder) {
            unsigned in[3] = {};
            in[axis == 0 ? 1 : 0] = holder % kSide;
            in[axis == 2 ? 1 : 2] = holder / kSide % kSide;
            cells.push_back(border_cell(1u << axis, holder / (kSide * kSide) << axis, in));
        }
    for (unsigned along = 0; along < 3; ++along)
        for (unsigned holder = 0; holder < 32; ++holder) {
            const unsigned which = holder / kSide; // of the four edges
            const unsigned behind[3] = {which << 1, (which & 1) | (which & 2) << 1, which};
            const unsigned in = holder % kSide;
            cells.push_back(border_cell(7u & ~(1u << along), behind[along], {in, in, in}));
        }
    for (unsigned holder = 0; holder < 32; ++holder)
        cells.push_back(holder < 8 ? border_cell(7, holder, {0, 0, 0}) : BorderCell{0, 0, 0, 13});
    return cells;
}

} // namespace locus::device
