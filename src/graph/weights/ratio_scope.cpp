#include "graph/weights/ratio_scope.hpp"

#include "graph/weights/affected.hpp"
#include "graph/weights/cells.hpp"

#include <limits>

namespace locus::graph {
namespace {

// Distances from some voxels, or from others at starting distances, as far as the graph's words hold them.
class Reach {
public:
    Reach(const Graph &graph, std::span<const Source> sources, uint64_t limit)
        : graph_(graph), most_(std::min(limit, graph.layout().max_exact())) {
        Progress silent;
        make_engine(LOCUS_ENGINE_AUTO)->solve({graph, sources, most_}, words_, silent);
    }
    // False only where a voxel is farther than `limit`, or cannot be reached at all.
    bool within(uint64_t voxel, uint64_t limit) const {
        const Field field(graph_, words_);
        return field.reached(voxel) ? field.distance(voxel) <= limit : limit > most_;
    }

private:
    const Graph &graph_;
    uint64_t most_;
    Words words_;
};

template <typename Limit>
uint64_t largest(std::span<const Source> seeds, Limit &&limit) {
    uint64_t most = 0;
    for (const Source &seed : seeds)
        most = std::max(most, limit(seed.label));
    return most;
}

// By label, for all that a share of an old row may name: seeds near changed voxels, seeds without a cell, no seeds.
std::vector<bool> affected_labels(const Field &field, std::span<const Source> seeds, const std::vector<Cell> &cells,
                                  const std::vector<bool> &changed) {
    const std::vector<bool> near = with_neighbours(field.grid(), changed);
    std::vector<Source> sources;
    for (uint64_t v = 0; v < near.size(); ++v)
        if (near[v] && field.graph().passable(v))
            sources.push_back({v, 0, 0});
    const auto radius = [&](uint32_t label) { return 2 * std::max(cells[label].support(), cells[label].crossing); };
    const Reach reach(field.graph(), sources, largest(seeds, radius));
    std::vector<bool> affected(cells.size(), true);
    for (const Source &seed : seeds)
        if (cells[seed.label].box.extent[0] != 0)
            affected[seed.label] = reach.within(seed.voxel, radius(seed.label));
    return affected;
}

// The rows that name an affected label, or whose voxel an affected seed supports.
std::vector<uint64_t> affected_rows(const Field &field, std::span<const Source> seeds, const std::vector<Cell> &cells,
                                    const std::vector<bool> &affected, std::span<const uint64_t> voxels,
                                    const Rows &rows) {
    std::vector<Source> sources;
    for (const Source &seed : seeds)
        if (affected[seed.label] && cells[seed.label].box.extent[0] != 0)
            sources.push_back(seed);
    const auto support = [&](uint32_t label) { return cells[label].support(); };
    const uint64_t most = largest(sources, support);
    const bool too_far = most > field.graph().layout().max_exact();
    for (Source &source : sources)
        source = {source.voxel, too_far ? 0 : most - support(source.label), 0};
    const Reach reach(field.graph(), sources, most);
    std::vector<uint64_t> found;
    for (uint64_t row = 0; row < voxels.size(); ++row) {
        bool named = false;
        for (const Share &share : rows.row(row))
            named = named || affected[share.label];
        if (named || (!sources.empty() && reach.within(voxels[row], most)))
            found.push_back(row);
    }
    return found;
}

} // namespace

RatioScope ratio_scope(const Field &field, std::span<const Source> seeds, std::span<const uint64_t> voxels,
                       const std::vector<bool> &changed, const Rows &rows) {
    const std::vector<Cell> cells = survey_cells(field);
    RatioScope scope;
    scope.rows = affected_rows(field, seeds, cells, affected_labels(field, seeds, cells, changed), voxels, rows);
    std::vector<Source> sources;
    for (const uint64_t row : scope.rows)
        if (field.graph().passable(voxels[row]))
            sources.push_back({voxels[row], 0, 0});
    const auto support = [&](uint32_t label) { return cells[label].support(); };
    const Reach reach(field.graph(), sources, largest(seeds, support));
    for (const Source &seed : seeds)
        if (reach.within(seed.voxel, support(seed.label)))
            scope.seeds.push_back(seed);
    return scope;
}

} // namespace locus::graph
