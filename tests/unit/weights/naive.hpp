// The interpolants straight from their definitions, one query at a time: the oracle of the fast ones.
#pragma once

#include "graph/weights/field.hpp"
#include "graph/weights/rows.hpp"

#include <array>
#include <functional>
#include <map>
#include <queue>
#include <unordered_map>
#include <vector>

namespace locus::graph::naive {

// The voxels that a query steals, with their distances from it: Dijkstra, bounded by d(q, v) < D(v).
inline std::unordered_map<uint64_t, uint64_t> stolen(const Field &field, uint64_t query) {
    std::unordered_map<uint64_t, uint64_t> settled, best;
    if (!field.reached(query) || field.distance(query) == 0)
        return settled;
    using Entry = std::pair<uint64_t, uint64_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.push({0, query});
    while (!queue.empty()) {
        const auto [distance, voxel] = queue.top();
        queue.pop();
        if (!settled.emplace(voxel, distance).second)
            continue;
        const auto place = field.grid().place(voxel);
        const uint32_t inside = field.grid().inside(place);
        for (const Neighbour &to : field.grid().neighbours()) {
            if ((inside >> to.number & 1) == 0)
                continue;
            const uint64_t next = voxel + static_cast<uint64_t>(to.step);
            const uint64_t weight = field.graph().weight(voxel, to);
            if (weight == 0 || !field.reached(next) || distance + weight >= field.distance(next))
                continue;
            const auto [known, fresh] = best.emplace(next, distance + weight);
            if (!fresh && known->second <= distance + weight)
                continue;
            known->second = distance + weight;
            queue.push({distance + weight, next});
        }
    }
    return settled;
}

// Rows as maps from label to the weight before normalising.
using Row = std::map<uint32_t, double>;

inline Row sibson(const Field &field, uint64_t query) {
    Row row;
    for (const auto &[voxel, distance] : stolen(field, query))
        row[field.label(voxel)] += 1;
    if (row.empty() && field.reached(query))
        row[field.label(query)] = 1;
    return row;
}

inline Row laplace(const Field &field, uint64_t query) {
    struct Border {
        std::array<uint64_t, 3> faces{};
        uint64_t shortest = UINT64_MAX;
    };
    std::map<uint32_t, Border> borders;
    const auto &s = field.grid().spacing();
    const auto taken = stolen(field, query);
    for (const auto &[voxel, distance] : taken) {
        const uint32_t inside = field.grid().inside(field.grid().place(voxel));
        for (const Neighbour &to : field.grid().neighbours()) {
            if (std::abs(to.dx) + std::abs(to.dy) + std::abs(to.dz) != 1 || (inside >> to.number & 1) == 0)
                continue;
            const uint64_t next = voxel + static_cast<uint64_t>(to.step);
            const uint64_t weight = field.graph().weight(voxel, to);
            if (weight == 0 || !field.reached(next) || taken.contains(next))
                continue;
            Border &border = borders[field.label(next)];
            ++border.faces[to.dx != 0 ? 0 : (to.dy != 0 ? 1 : 2)];
            border.shortest = std::min(border.shortest, distance + weight + field.distance(next));
        }
    }
    Row row;
    for (const auto &[label, border] : borders) {
        const std::array<double, 3> size = {s[1] * s[2], s[0] * s[2], s[0] * s[1]};
        double area = 0;
        for (unsigned axis = 0; axis < 3; ++axis)
            area += static_cast<double>(border.faces[axis]) * size[axis];
        row[label] = area / static_cast<double>(border.shortest);
    }
    if (row.empty() && field.reached(query))
        row[field.label(query)] = 1;
    return row;
}

// The row as the library gives it.
inline std::vector<Share> finished(const Row &row, uint32_t most = 0) {
    std::vector<RawShare> raw;
    for (const auto &[label, weight] : row)
        raw.push_back({label, weight});
    std::vector<Share> shares;
    finish_row(raw, most, shares);
    return shares;
}

} // namespace locus::graph::naive
