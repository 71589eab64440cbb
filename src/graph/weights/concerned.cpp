#include "graph/weights/concerned.hpp"

#include "graph/weights/affected.hpp"

namespace locus::graph {
namespace {

uint64_t reach_of(const Cell &cell) { return std::max(cell.support(), cell.farthest + cell.crossing); }

// Seeds from which one of the voxels is near enough. Distances are found as far as the graph's words hold them; what
// lies beyond counts as near.
void add_near(const Field &now, std::span<const Source> seeds, std::span<const Cell> cells,
              const std::vector<bool> &voxels, std::vector<bool> &concerned) {
    const Graph &graph = now.graph();
    std::vector<Source> sources;
    for (uint64_t v = 0; v < voxels.size(); ++v)
        if (voxels[v] && graph.passable(v))
            sources.push_back({v, 0, 0});
    uint64_t limit = 0;
    for (const Cell &cell : cells)
        limit = std::max(limit, reach_of(cell));
    limit = std::min(limit, graph.layout().max_exact());
    Words words;
    Progress silent;
    make_engine(LOCUS_ENGINE_AUTO)->solve({graph, sources, limit}, words, silent);
    const Field found(graph, words);
    for (const Source &seed : seeds) {
        const uint64_t away = found.reached(seed.voxel) ? found.distance(seed.voxel) : limit + 1;
        if (seed.distance + away <= reach_of(cells[seed.label]))
            concerned[seed.label] = true;
    }
}

} // namespace

std::vector<bool> concerned_labels(const Field &now, const Field &before, std::span<const Source> seeds,
                                   std::span<const Cell> cells, const std::vector<bool> &edited) {
    std::vector<bool> paths = edited, words = edited, concerned(cells.size());
    for (uint64_t v = 0; v < words.size(); ++v) {
        const bool reached = now.reached(v);
        if (reached != before.reached(v))
            paths[v] = words[v] = true;
        else if (reached && (now.distance(v) != before.distance(v) || now.label(v) != before.label(v)))
            words[v] = true;
    }
    words = with_neighbours(now.grid(), words);
    for (uint64_t v = 0; v < words.size(); ++v)
        for (const Field *field : {&now, &before})
            if (words[v] && field->reached(v))
                concerned[field->label(v)] = true;
    add_near(now, seeds, cells, with_neighbours(now.grid(), paths), concerned);
    return concerned;
}

} // namespace locus::graph
