#include "graph/weights/cells.hpp"

#include "graph/weights/settle.hpp"

namespace locus::graph {
namespace {

void include(Box &box, const std::array<uint64_t, 3> &place) {
    for (unsigned a = 0; a < 3; ++a) {
        if (box.extent[a] == 0) {
            box.origin[a] = place[a];
            box.extent[a] = 1;
        }
        const uint64_t end = std::max(box.origin[a] + box.extent[a], place[a] + 1);
        box.origin[a] = std::min(box.origin[a], place[a]);
        box.extent[a] = end - box.origin[a];
    }
}

} // namespace

std::vector<Cell> survey_cells(const Field &field) {
    const Grid &grid = field.grid();
    std::vector<Cell> cells(field.graph().layout().labels());
    const auto meet = [&](uint64_t inside, uint64_t outside, uint64_t weight) {
        Cell &cell = cells[field.label(inside)];
        cell.alone = false;
        cell.farthest = std::max(cell.farthest, field.distance(outside));
        cell.crossing = std::max(cell.crossing, field.distance(inside) + weight);
    };
    for (uint64_t v = 0; v < grid.voxels(); ++v) {
        if (!field.reached(v))
            continue;
        const auto place = grid.place(v);
        Cell &cell = cells[field.label(v)];
        include(cell.box, place);
        cell.farthest = std::max(cell.farthest, field.distance(v));
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (place[axis] == 0)
                continue;
            const Neighbour &to = grid.neighbour(backward_face[axis]);
            const uint64_t before = v + static_cast<uint64_t>(to.step);
            if (!field.reached(before) || field.label(before) == field.label(v))
                continue;
            const uint64_t weight = field.graph().weight(v, to);
            if (weight == 0)
                continue;
            meet(v, before, weight);
            meet(before, v, weight);
        }
    }
    return cells;
}

} // namespace locus::graph
