// What can be read off a solved diagram: paths, cells, and what the solve did.
#include "core/error.hpp"
#include "graph/diagram.hpp"

#include <algorithm>

namespace locus::graph {

// Paths and edges between cells follow the graph's edges: they must be those of the solve.
void Diagram::check_unchanged() const {
    check_solved();
    if (solved_version_ != graph_->version())
        fail(LOCUS_E_STATE, "the graph was edited after the diagram was solved");
}

std::vector<uint64_t> Diagram::path(uint64_t x, uint64_t y, uint64_t z) const {
    check_unchanged();
    const Grid &grid = graph_->grid();
    require(grid.holds(x, y, z), "(", x, ", ", y, ", ", z, ") lies outside the grid of ", grid.nx(), " x ", grid.ny(),
            " x ", grid.nz(), " voxels");
    const WordLayout &layout = graph_->layout();
    const Words &words = this->words();
    const auto word_of = [&](uint64_t voxel) {
        return std::visit([&](const auto &each) { return uint64_t{each[voxel]}; }, words);
    };
    std::vector<uint64_t> path;
    uint64_t voxel = grid.index(x, y, z);
    uint64_t word = word_of(voxel);
    if (!layout.reached(word))
        return path;
    const Seed &seed = solved_seeds_[position_of_slot_[layout.label(word)]];
    path.push_back(voxel);
    while (voxel != seed.voxel) {
        const uint32_t open = graph_->open_edges(voxel);
        const size_t before = path.size();
        for (const Neighbour &to : grid.neighbours()) {
            if ((open >> to.number & 1) == 0)
                continue;
            const uint64_t next = voxel + static_cast<uint64_t>(to.step);
            const uint64_t through = word_of(next);
            if (through >= word || layout.label(through) != seed.slot)
                continue;
            const uint64_t weight = graph_->weight(voxel, to);
            if (weight == 0 || layout.distance(through) + weight != layout.distance(word))
                continue;
            voxel = next;
            word = through;
            path.push_back(voxel);
            break;
        }
        if (path.size() == before)
            fail(LOCUS_E_INTERNAL, "no neighbour leads from voxel ", voxel, " to its seed ", seed.id);
    }
    return path;
}

std::vector<uint64_t> Diagram::cell_sizes() const {
    check_solved();
    if (seeds_changed_)
        fail(LOCUS_E_STATE, "the seeds were changed after the diagram was solved");
    const WordLayout &layout = graph_->layout();
    std::vector<uint64_t> sizes(solved_seeds_.size());
    std::visit(
        [&](const auto &each) {
            for (const auto word : each)
                if (layout.reached(word))
                    ++sizes[position_of_slot_[layout.label(word)]];
        },
        words());
    return sizes;
}

std::vector<locus_cell_pair> Diagram::cell_pairs() const {
    check_unchanged();
    const Grid &grid = graph_->grid();
    const WordLayout &layout = graph_->layout();
    std::unordered_map<uint64_t, uint64_t> edges; // by both positions, the smaller one in the high half
    const auto count = [&](const auto &each) {
        for_each_voxel(grid, grid.whole(), [&](uint64_t u, uint64_t) {
            if (!layout.reached(each[u]))
                return;
            const uint32_t inside = grid.inside(grid.place(u));
            for (const Neighbour &to : grid.neighbours()) {
                if (to.number < first_forward || (inside >> to.number & 1) == 0)
                    continue;
                const uint64_t there = each[u + static_cast<uint64_t>(to.step)];
                if (!layout.reached(there) || layout.label(there) == layout.label(each[u]))
                    continue;
                if (graph_->weight(u, to) == 0)
                    continue;
                const uint64_t a = position_of_slot_[layout.label(each[u])];
                const uint64_t b = position_of_slot_[layout.label(there)];
                ++edges[std::min(a, b) << 32 | std::max(a, b)];
            }
        });
    };
    std::visit(count, words());
    std::vector<std::pair<uint64_t, uint64_t>> sorted(edges.begin(), edges.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<locus_cell_pair> pairs;
    pairs.reserve(sorted.size());
    for (const auto &[key, number] : sorted)
        pairs.push_back({solved_seeds_[key >> 32].id, solved_seeds_[key & 0xFFFFFFFFu].id, number});
    return pairs;
}

locus_diagram_stats Diagram::stats() const {
    locus_diagram_stats stats{};
    stats.struct_size = sizeof stats;
    const WordLayout &layout = graph_->layout();
    check_solved();
    if (report_.kept) {
        stats.reached = report_.kept->reached;
        stats.max_exact = report_.kept->max_exact;
    } else {
        std::visit(
            [&](const auto &each) {
                for (const auto word : each) {
                    if (!layout.reached(word))
                        continue;
                    ++stats.reached;
                    stats.max_exact = std::max(stats.max_exact, layout.distance(word));
                }
            },
            words());
    }
    stats.bytes = words_bytes();
    stats.seeds = solved_seeds_.size();
    stats.relaxations = report_.relaxations;
    stats.iterations = report_.iterations;
    stats.max_distance = static_cast<double>(stats.max_exact) / graph_->scale();
    stats.seconds_import = report_.seconds_import;
    stats.seconds_solve = report_.seconds_solve;
    stats.seconds_export = report_.seconds_export;
    stats.bytes += engine_->bytes() + sizeof *this + (seeds_.capacity() + solved_seeds_.capacity()) * sizeof(Seed) +
                   position_of_slot_.capacity() * sizeof(uint32_t) + report_.trace.capacity() * sizeof(uint64_t);
    stats.engine = engine_->kind();
    stats.backend = engine_->backend();
    stats.threads = report_.threads;
    return stats;
}

uint64_t Diagram::words_bytes() const {
    const std::lock_guard lock(reading_);
    return std::visit([](const auto &each) { return each.capacity() * sizeof each[0]; }, words_);
}

const std::vector<uint64_t> &Diagram::trace() const {
    check_solved();
    if (options_.record_trace == 0)
        fail(LOCUS_E_STATE, "no trace was recorded: the diagram was made without options->record_trace");
    if (report_.trace.empty() && report_.iterations > 0)
        fail(LOCUS_E_STATE, "no trace was recorded: the engine that ran does not work in iterations");
    return report_.trace;
}

} // namespace locus::graph
