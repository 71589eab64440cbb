// The interpolants straight from their definitions, one query at a time: the oracle of the fast ones.
#pragma once

#include "graph/weights/field.hpp"
#include "graph/weights/rows.hpp"

#include <algorithm>
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

// Distances from the sources, by Dijkstra; UINT64_MAX where they do not reach.
inline std::vector<uint64_t> distances(const Field &field, const std::vector<std::pair<uint64_t, uint64_t>> &sources) {
    std::vector<uint64_t> distance(field.grid().voxels(), UINT64_MAX);
    using Entry = std::pair<uint64_t, uint64_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto reach = [&](uint64_t voxel, uint64_t d) {
        if (d >= distance[voxel])
            return;
        distance[voxel] = d;
        queue.push({d, voxel});
    };
    for (const auto &[voxel, d] : sources)
        reach(voxel, d);
    while (!queue.empty()) {
        const auto [d, voxel] = queue.top();
        queue.pop();
        if (d != distance[voxel])
            continue;
        const uint32_t inside = field.grid().inside(field.grid().place(voxel));
        for (const Neighbour &to : field.grid().neighbours()) {
            const uint64_t next = voxel + static_cast<uint64_t>(to.step);
            const uint64_t weight = inside >> to.number & 1 ? field.graph().weight(voxel, to) : 0;
            if (weight != 0 && field.reached(next))
                reach(next, d + weight);
        }
    }
    return distance;
}

// visit(inside, outside) for every face with an edge through which the cell of `label` ends.
template <typename Visit>
void for_border(const Field &field, uint32_t label, Visit &&visit) {
    for (uint64_t v = 0; v < field.grid().voxels(); ++v) {
        if (!field.reached(v) || field.label(v) != label)
            continue;
        const uint32_t inside = field.grid().inside(field.grid().place(v));
        for (const Neighbour &to : field.grid().neighbours()) {
            if (std::abs(to.dx) + std::abs(to.dy) + std::abs(to.dz) != 1 || (inside >> to.number & 1) == 0)
                continue;
            const uint64_t next = v + static_cast<uint64_t>(to.step);
            if (field.reached(next) && field.label(next) != label && field.graph().weight(v, to) != 0)
                visit(v, next);
        }
    }
}

// The distance ratio of every voxel, seed after seed, before normalising.
inline std::vector<Row> ratio(const Field &field, const std::vector<Source> &seeds) {
    std::vector<Row> rows(field.grid().voxels());
    for (const Source &seed : seeds) {
        uint64_t farthest = 0;
        for (uint64_t v = 0; v < rows.size(); ++v)
            if (field.reached(v) && field.label(v) == seed.label)
                farthest = std::max(farthest, field.distance(v));
        const auto to_seed = distances(field, {{seed.voxel, seed.distance}});
        std::vector<std::pair<uint64_t, uint64_t>> border;
        for_border(field, seed.label, [&](uint64_t inside, uint64_t outside) {
            farthest = std::max(farthest, field.distance(outside));
            const uint64_t middle = (field.distance(outside) + to_seed[outside]) / 2;
            border.emplace_back(outside, (to_seed[outside] - field.distance(outside)) / 2);
            border.emplace_back(inside, middle > field.distance(inside) ? middle - field.distance(inside) : 0);
        });
        const auto to_border = distances(field, border);
        for (uint64_t v = 0; v < rows.size(); ++v) {
            if (!field.reached(v))
                continue;
            const auto dp = static_cast<double>(to_seed[v]), db = static_cast<double>(to_border[v]);
            double weight = 0;
            if (field.label(v) == seed.label)
                weight = dp == 0 || border.empty() ? 1 : (1 + db / (dp + db)) / 2;
            else if (to_seed[v] <= 2 * farthest && dp > db)
                weight = (1 - db / (dp - db)) / 2;
            if (weight > 1 - 1e-4)
                weight = 1;
            if (weight >= 1e-4)
                rows[v][seed.label] = weight;
        }
    }
    return rows;
}

// The row as the library gives it: the `most` largest (0: all), the smaller label first on ties, divided by their sum.
inline std::vector<Share> finished(const Row &row, uint32_t most = 0) {
    std::vector<std::pair<double, uint32_t>> sorted; // the smallest of these is the largest weight
    for (const auto &[label, weight] : row)
        sorted.emplace_back(-weight, label);
    std::ranges::sort(sorted);
    if (most != 0 && sorted.size() > most)
        sorted.resize(most);
    double sum = 0;
    for (const auto &[negative, label] : sorted)
        sum -= negative;
    std::vector<Share> shares;
    for (const auto &[negative, label] : sorted)
        shares.push_back({label, static_cast<float>(-negative / sum)});
    return shares;
}

} // namespace locus::graph::naive
