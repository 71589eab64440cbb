// Seed placement: farthest-point sampling, then Lloyd's iterations on the graph's metric (Faure et al. 2011).
#include "core/error.hpp"
#include "graph/diagram.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace locus::graph {
namespace {

struct Placed { // a seed on its way
    uint64_t voxel;
    double distance;
    bool fixed;
};

std::vector<Source> sources_of(const Graph &metric, std::span<const Placed> seeds) {
    std::vector<Source> sources;
    for (const Placed &seed : seeds) {
        const double steps = std::rint(seed.distance * metric.scale());
        if (!(steps <= static_cast<double>(metric.layout().max_exact())))
            fail(LOCUS_E_RANGE, "a seed starts at the distance ", seed.distance,
                 ": beyond the words of the uniform metric");
        sources.push_back({seed.voxel, static_cast<uint64_t>(steps), static_cast<uint32_t>(sources.size())});
    }
    return sources;
}

// The graph that gives the distances: the diagram's own, or the same voxels with uniform weights.
std::shared_ptr<const Graph> metric_of(const std::shared_ptr<const Graph> &graph, uint32_t metric) {
    if (metric == LOCUS_PLACE_COMPLIANCE || graph->rule() == LOCUS_WEIGHT_UNIFORM)
        return graph;
    return std::make_shared<const Graph>(graph->uniform());
}

// The distance to each voxel's nearest seed so far, kept by the brick engine's updates: a further seed costs what its
// own cell does. The largest distance of every row of voxels along x is kept, too.
template <typename Word>
class Sampler {
public:
    explicit Sampler(const Graph &metric)
        : metric_(metric), engine_(make_engine(LOCUS_ENGINE_BRICKS)), rows_(metric.grid().ny() * metric.grid().nz()) {}

    // The distances to these sources: anew, or with one more source than before.
    void measure(std::span<const Source> sources, bool anew) {
        Progress unheard;
        const Problem problem{metric_, sources};
        Change change;
        for (size_t axis = 0; axis < 3; ++axis)
            change.box.extent[axis] = metric_.grid().dims()[axis];
        const Report report =
            anew ? engine_->solve(problem, words_, unheard) : engine_->update(problem, words_, unheard, change);
        if (anew || found_unreached_) // a source in a part that is reached makes nothing farther
            check_overflow(problem, words_, report);
        look_at_rows(change.box);
    }

    // The voxel with the largest distance, unreached ones first, the lowest index of several.
    uint64_t farthest() {
        const auto most = std::max_element(rows_.begin(), rows_.end()); // the first of several
        if (*most == 0)
            return lowest_passable(); // every voxel lies under a seed
        found_unreached_ = *most == metric_.layout().distance(metric_.layout().unreached());
        const uint64_t nx = metric_.grid().nx();
        uint64_t voxel = static_cast<uint64_t>(most - rows_.begin()) * nx;
        while (distance(voxel) != *most)
            ++voxel;
        return voxel;
    }

    uint64_t lowest_passable() const {
        uint64_t voxel = 0;
        while (!metric_.passable(voxel))
            ++voxel;
        return voxel;
    }

private:
    // 0 for impassable voxels.
    Word distance(uint64_t voxel) const {
        return metric_.passable(voxel)
                   ? static_cast<Word>(metric_.layout().distance(std::get<std::vector<Word>>(words_)[voxel]))
                   : Word{0};
    }
    void look_at_rows(const Box &box) {
        const Grid &grid = metric_.grid();
        for (uint64_t z = box.origin[2]; z < box.origin[2] + box.extent[2]; ++z)
            for (uint64_t y = box.origin[1]; y < box.origin[1] + box.extent[1]; ++y) {
                Word most = 0;
                for (uint64_t voxel = grid.index(0, y, z), end = voxel + grid.nx(); voxel < end; ++voxel)
                    most = std::max(most, distance(voxel));
                rows_[y + grid.ny() * z] = most;
            }
    }

    const Graph &metric_;
    std::unique_ptr<Engine> engine_;
    Words words_;
    std::vector<Word> rows_;
    bool found_unreached_ = false; // the voxel that farthest() named last is unreached
};

// Add `count` seeds to `seeds`; told(n) after each.
template <typename Word, typename Told>
void sample_by(const Graph &metric, std::vector<Placed> &seeds, uint64_t count, Told &&told) {
    uint64_t done = 0;
    Sampler<Word> sampler(metric);
    const auto take = [&] {
        seeds.push_back({sampler.farthest(), 0, false});
        told(++done);
    };
    if (seeds.empty()) {
        const Source corner{sampler.lowest_passable(), 0, 0};
        sampler.measure({&corner, 1}, true);
        take();
    }
    std::vector<Source> sources = sources_of(metric, seeds);
    bool anew = true;
    while (done < count) {
        sampler.measure(sources, std::exchange(anew, false));
        take();
        sources.push_back({seeds.back().voxel, 0, static_cast<uint32_t>(sources.size())});
    }
}

template <typename Told>
void sample(const Graph &metric, std::vector<Placed> &seeds, uint64_t count, Told &&told) {
    if (count == 0)
        return;
    if (metric.layout().bits == 32)
        sample_by<uint32_t>(metric, seeds, count, told);
    else
        sample_by<uint64_t>(metric, seeds, count, told);
}

// The voxel of each cell that lies closest to the cell's centroid (Euclidean, by spacing; the lowest index of several);
// UINT64_MAX for an empty cell.
std::vector<uint64_t> centres(const Graph &metric, const Words &words, size_t cells) {
    struct Sum {
        Wide at[3]{};
        uint64_t count = 0;
    };
    const Grid &grid = metric.grid();
    const WordLayout &layout = metric.layout();
    std::vector<Sum> sums(cells);
    std::vector<uint64_t> nearest(cells, UINT64_MAX);
    std::vector<double> distance(cells);
    const auto visit_cells = [&](const auto &visit) {
        std::visit(
            [&](const auto &each) {
                uint64_t voxel = 0;
                for (uint64_t z = 0; z < grid.nz(); ++z)
                    for (uint64_t y = 0; y < grid.ny(); ++y)
                        for (uint64_t x = 0; x < grid.nx(); ++x, ++voxel)
                            if (layout.reached(each[voxel]))
                                visit(layout.label(each[voxel]), voxel, x, y, z);
            },
            words);
    };
    visit_cells([&](uint32_t cell, uint64_t, uint64_t x, uint64_t y, uint64_t z) {
        Sum &sum = sums[cell];
        sum.at[0] += x;
        sum.at[1] += y;
        sum.at[2] += z;
        ++sum.count;
    });
    visit_cells([&](uint32_t cell, uint64_t voxel, uint64_t x, uint64_t y, uint64_t z) {
        const Sum &sum = sums[cell];
        const uint64_t place[3] = {x, y, z};
        double squared = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            const double centre = static_cast<double>(sum.at[axis]) / static_cast<double>(sum.count);
            const double apart = (static_cast<double>(place[axis]) - centre) * grid.spacing()[axis];
            squared += apart * apart;
        }
        if (nearest[cell] == UINT64_MAX || squared < distance[cell]) {
            nearest[cell] = voxel;
            distance[cell] = squared;
        }
    });
    return nearest;
}

// One round of Lloyd; returns how many seeds have moved. Where few moved in the round before, only their cells and
// those around are looked at again.
size_t lloyd(const Graph &metric, Engine &engine, bool anew, std::vector<Placed> &seeds, Words &words,
             Progress &progress) {
    const std::vector<Source> sources = sources_of(metric, seeds);
    const Problem problem{metric, sources};
    Change change;
    const Report report =
        anew ? engine.solve(problem, words, progress) : engine.update(problem, words, progress, change);
    check_overflow(problem, words, report);
    const std::vector<uint64_t> to = centres(metric, words, seeds.size());
    size_t moved = 0;
    for (size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i].fixed || to[i] == UINT64_MAX || to[i] == seeds[i].voxel)
            continue;
        seeds[i].voxel = to[i];
        ++moved;
    }
    return moved;
}

} // namespace

void Diagram::place_seeds(const locus_place_options &options) {
    require(options.metric <= LOCUS_PLACE_UNIFORM, "options->metric is ", options.metric, ", not one of LOCUS_PLACE_");
    if (graph_->passable_voxels() == 0)
        fail(LOCUS_E_STATE, "the graph has no passable voxel");
    require(options.count <= graph_->passable_voxels() - std::min<uint64_t>(seeds_.size(), graph_->passable_voxels()),
            "options->count is ", options.count, ": with the ", seeds_.size(), " seeds that are there more than the ",
            graph_->passable_voxels(), " passable voxels");
    if (options.count > graph_->layout().labels() - seeds_.size())
        fail(LOCUS_E_RANGE, "options->count is ", options.count, ": more seeds than the graph's ",
             graph_->layout().label_bits, " label bits hold; create it with a larger options->max_seeds");
    require(options.count <= uint64_t{LOCUS_NO_SEED} - options.first_id, "options->first_id is ", options.first_id,
            ": with ", options.count, " seeds the ids would pass LOCUS_NO_SEED");
    for (uint64_t i = 0; i < options.count; ++i)
        require(!slot_of_id_.contains(static_cast<uint32_t>(options.first_id + i)), "options->first_id is ",
                options.first_id, ": the id ", options.first_id + i, " is taken");

    std::vector<Placed> placed;
    for (const Seed &seed : seeds_) {
        const auto [x, y, z] = graph_->grid().place(seed.voxel);
        checked_voxel(x, y, z, "seed " + std::to_string(seed.id));
        placed.push_back({seed.voxel, seed.distance, seed.fixed});
    }
    const size_t old = placed.size();
    const auto metric = metric_of(graph_, options.metric);
    Progress progress(options.progress, options.progress_user);
    const double parts = static_cast<double>(options.count) + static_cast<double>(options.lloyd_iterations);
    sample(*metric, placed, options.count, [&](uint64_t done) { progress.report(static_cast<double>(done) / parts); });
    locus_diagram_options on_host = options_;
    on_host.on_device = 0; // every round looks at the words
    const auto engine = make_engine(*metric, on_host);
    Words words;
    size_t moved = placed.size();
    for (uint32_t round = 0; round < options.lloyd_iterations && !placed.empty(); ++round) {
        const double before = (static_cast<double>(options.count) + round) / parts;
        progress.part(before, before + 1 / parts);
        const bool anew = moved > placed.size() / 4; // an update takes a moved seed's cell away and fills it again
        moved = lloyd(*metric, *engine, anew, placed, words, progress);
        if (moved == 0)
            break;
    }
    progress.part(0, 1);
    progress.report(1);

    std::vector<locus_seed> added;
    for (size_t i = old; i < placed.size(); ++i) {
        const auto [x, y, z] = graph_->grid().place(placed[i].voxel);
        added.push_back({x, y, z, 0, static_cast<uint32_t>(options.first_id + (i - old)), 0});
    }
    add_seeds(added);
    for (size_t i = 0; i < old; ++i)
        seeds_[i].voxel = placed[i].voxel;
    seeds_changed_ = true;
    solved_ = false;
}

} // namespace locus::graph
