#include "graph/weights/affected.hpp"

#include "graph/weights/field.hpp"

namespace locus::graph {

std::vector<bool> edited_voxels(const Graph &graph, uint64_t version) {
    const Grid &grid = graph.grid();
    const auto edits = graph.edits_since(version);
    std::vector<bool> edited(grid.voxels(), !edits);
    if (!edits)
        return edited;
    for (const Box &box : *edits)
        for (uint64_t z = 0; z < box.extent[2]; ++z)
            for (uint64_t y = 0; y < box.extent[1]; ++y)
                for (uint64_t x = 0; x < box.extent[0]; ++x)
                    edited[grid.index(box.origin[0] + x, box.origin[1] + y, box.origin[2] + z)] = true;
    return edited;
}

std::vector<bool> changed_voxels(const Graph &graph, const Words &before, uint64_t version, const Words &now) {
    std::vector<bool> changed = edited_voxels(graph, version);
    std::visit(
        [&](const auto &a, const auto &b) {
            for (uint64_t v = 0; v < changed.size(); ++v)
                if (a[v] != b[v])
                    changed[v] = true;
        },
        before, now);
    return changed;
}

std::vector<bool> with_neighbours(const Grid &grid, const std::vector<bool> &voxels) {
    std::vector<bool> near = voxels;
    for (uint64_t v = 0; v < grid.voxels(); ++v) {
        if (!voxels[v])
            continue;
        const uint32_t inside = grid.inside(grid.place(v));
        for (const Neighbour &to : grid.neighbours())
            if (inside >> to.number & 1)
                near[v + static_cast<uint64_t>(to.step)] = true;
    }
    return near;
}

std::vector<bool> affected_voxels(const Graph &graph, const Words &before, uint64_t version, const Words &now) {
    const Grid &grid = graph.grid();
    const Field field(graph, now);
    std::vector<bool> affected = changed_voxels(graph, before, version, now);
    const std::vector<bool> near = with_neighbours(grid, affected);
    uint64_t most = 0;
    for (uint64_t v = 0; v < grid.voxels(); ++v)
        if (near[v] && field.reached(v))
            most = std::max(most, field.distance(v));
    if (most == 0)
        return affected;
    std::vector<Source> sources;
    for (uint64_t v = 0; v < grid.voxels(); ++v)
        if (near[v] && field.reached(v) && field.distance(v) > 0)
            sources.push_back({v, most - field.distance(v), 0});
    Words reach;
    Progress silent;
    make_engine(LOCUS_ENGINE_AUTO)->solve({graph, sources, most - 1}, reach, silent);
    const Field found(graph, reach);
    for (uint64_t v = 0; v < grid.voxels(); ++v)
        if (found.reached(v))
            affected[v] = true;
    return affected;
}

} // namespace locus::graph
