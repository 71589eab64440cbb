// Seed placement: farthest-point sampling, then Lloyd's iterations on the graph's metric (Faure et al. 2011).
#include "core/error.hpp"
#include "graph/diagram.hpp"
#include "graph/spread.hpp"

#include <algorithm>
#include <cmath>

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

// The lattice with distances to all seeds so far; each further seed visits its own cell only.
template <typename Word, typename Place>
class Sampler {
public:
    explicit Sampler(const Graph &metric) : lattice_(metric) {}

    void add(std::span<const Source> sources) {
        Progress unheard;
        const Problem problem{lattice_.graph(), sources};
        const Report report = spread(problem, lattice_, unheard, false);
        if (!report.clipped)
            return;
        Words words;
        lattice_.give(words);
        check_overflow(problem, words, report);
    }

    // The voxel with the largest distance, unreached ones first, the lowest index of several.
    uint64_t farthest() {
        const WordLayout &layout = lattice_.graph().layout();
        Word most = 0; // below every passable voxel's word but those at distance 0, which lie under a seed
        size_t at = 0;
        bool found = false;
        const std::vector<Word> &words = lattice_.words();
        for (size_t i = 0; i < words.size(); ++i) {
            const auto distance = static_cast<Word>(layout.distance(words[i]));
            if (distance > most) {
                most = distance;
                at = i;
                found = true;
            }
        }
        return found ? lattice_.voxel(static_cast<Place>(at)) : lowest_passable();
    }

    uint64_t lowest_passable() const {
        uint64_t voxel = 0;
        while (!lattice_.graph().passable(voxel))
            ++voxel;
        return voxel;
    }

private:
    Lattice<Word, Place> lattice_;
};

// Add `count` seeds to `seeds`; told(n) after each.
template <typename Told>
void sample(const Graph &metric, std::vector<Placed> &seeds, uint64_t count, Told &&told) {
    if (count == 0)
        return;
    const auto with = [&]<typename Word, typename Place>(Lattice<Word, Place> *) {
        uint64_t done = 0;
        if (seeds.empty()) {
            Sampler<Word, Place> first(metric);
            const Source corner{first.lowest_passable(), 0, 0};
            first.add({&corner, 1});
            seeds.push_back({first.farthest(), 0, false});
            told(++done);
        }
        Sampler<Word, Place> sampler(metric);
        sampler.add(sources_of(metric, seeds));
        while (done < count) {
            const Source next{sampler.farthest(), 0, static_cast<uint32_t>(seeds.size())};
            seeds.push_back({next.voxel, 0, false});
            sampler.add({&next, 1});
            told(++done);
        }
    };
    if (metric.layout().bits == 32)
        with(static_cast<Lattice<uint32_t, uint64_t> *>(nullptr));
    else
        with(static_cast<Lattice<uint64_t, uint64_t> *>(nullptr));
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

// One round of Lloyd; whether some seed has moved.
bool lloyd(const Graph &metric, Engine &engine, std::vector<Placed> &seeds, Words &words, Progress &progress) {
    const std::vector<Source> sources = sources_of(metric, seeds);
    const Problem problem{metric, sources};
    const Report report = engine.solve(problem, words, progress);
    check_overflow(problem, words, report);
    const std::vector<uint64_t> to = centres(metric, words, seeds.size());
    bool moved = false;
    for (size_t i = 0; i < seeds.size(); ++i) {
        if (seeds[i].fixed || to[i] == UINT64_MAX || to[i] == seeds[i].voxel)
            continue;
        seeds[i].voxel = to[i];
        moved = true;
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
    const auto engine = make_engine(options_.engine);
    Words words;
    for (uint32_t round = 0; round < options.lloyd_iterations && !placed.empty(); ++round) {
        const double before = (static_cast<double>(options.count) + round) / parts;
        progress.part(before, before + 1 / parts);
        if (!lloyd(*metric, *engine, placed, words, progress))
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
