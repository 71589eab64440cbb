// The seeds of a diagram, solving it, and reading the result.
#include "graph/diagram.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <unordered_set>

namespace locus::graph {

Diagram::Diagram(std::shared_ptr<const Graph> graph, const locus_diagram_options &options)
    : graph_(std::move(graph)), options_(options), engine_(make_engine(*graph_, options)) {
    require(options.max_distance >= 0, "options->max_distance is ", options.max_distance, ", not a distance");
    for (size_t axis = 0; axis < 3 && options.engine == LOCUS_ENGINE_COMPACT; ++axis)
        require(options.grain[axis] >= 1 && options.grain[axis] <= 1024, "options->grain[", axis, "] is ",
                options.grain[axis], ", outside 1..1024");
    require(options.record_trace <= 1, "options->record_trace is ", options.record_trace, ", not 0 or 1");
    require(options.on_device <= 1, "options->on_device is ", options.on_device, ", not 0 or 1");
}

uint64_t Diagram::checked_voxel(uint64_t x, uint64_t y, uint64_t z, const std::string &name) const {
    const Grid &grid = graph_->grid();
    require(grid.holds(x, y, z), name, " lies at (", x, ", ", y, ", ", z, "), outside the grid of ", grid.nx(), " x ",
            grid.ny(), " x ", grid.nz(), " voxels");
    const uint64_t voxel = grid.index(x, y, z);
    require(graph_->passable(voxel), name, " lies at (", x, ", ", y, ", ", z, "), an impassable voxel");
    return voxel;
}

Seed Diagram::checked(const locus_seed &seed, const std::string &name) const {
    const std::string named = name + " (id " + std::to_string(seed.id) + ")";
    require(seed.id != LOCUS_NO_SEED, named, " has the id LOCUS_NO_SEED, which is no seed's");
    require(seed.fixed <= 1, named, ": fixed is ", seed.fixed, ", not 0 or 1");
    require(std::isfinite(seed.distance) && seed.distance >= 0, named, " starts at the distance ", seed.distance,
            ", not a finite number >= 0");
    const uint64_t voxel = checked_voxel(seed.x, seed.y, seed.z, named);
    const double steps = std::rint(seed.distance * graph_->scale());
    if (!(steps <= static_cast<double>(graph_->layout().max_exact())))
        fail(LOCUS_E_RANGE, named, " starts at the distance ", seed.distance,
             ": the graph's words hold distances up to ",
             static_cast<double>(graph_->layout().max_exact()) / graph_->scale());
    return {voxel, seed.distance, static_cast<uint64_t>(steps), seed.id, 0, seed.fixed != 0};
}

size_t Diagram::position(uint32_t id, const std::string &name) const {
    const auto found = slot_of_id_.find(id);
    require(found != slot_of_id_.end(), name, " is ", id, ": there is no seed with this id");
    const auto at = std::lower_bound(seeds_.begin(), seeds_.end(), found->second,
                                     [](const Seed &seed, uint32_t slot) { return seed.slot < slot; });
    return static_cast<size_t>(at - seeds_.begin());
}

// Close the holes that removed seeds have left; the order stays.
void Diagram::renumber() {
    for (size_t i = 0; i < seeds_.size(); ++i) {
        seeds_[i].slot = static_cast<uint32_t>(i);
        slot_of_id_.find(seeds_[i].id)->second = seeds_[i].slot;
    }
    next_slot_ = static_cast<uint32_t>(seeds_.size());
}

void Diagram::add_seeds(std::span<const locus_seed> seeds) {
    const uint64_t labels = graph_->layout().labels();
    if (seeds.size() > labels - seeds_.size())
        fail(LOCUS_E_RANGE, "count is ", seeds.size(), ": with the ", seeds_.size(),
             " seeds that are there more than the ", labels, " that the graph's ", graph_->layout().label_bits,
             " label bits hold; create it with a larger options->max_seeds");
    std::vector<Seed> added;
    added.reserve(seeds.size());
    std::unordered_map<uint32_t, uint32_t> ids;
    for (size_t i = 0; i < seeds.size(); ++i) {
        const std::string name = "seeds[" + std::to_string(i) + "]";
        added.push_back(checked(seeds[i], name));
        require(!slot_of_id_.contains(seeds[i].id) && ids.try_emplace(seeds[i].id, 0).second, name, " has the id ",
                seeds[i].id, ", which is taken");
    }
    seeds_.reserve(seeds_.size() + added.size());
    slot_of_id_.reserve(seeds_.size() + added.size());
    if (added.size() > labels - next_slot_)
        renumber();
    uint32_t slot = next_slot_;
    for (Seed &seed : added)
        ids.find(seed.id)->second = seed.slot = slot++;
    slot_of_id_.merge(ids); // hands the nodes over: nothing is allocated
    seeds_.insert(seeds_.end(), added.begin(), added.end());
    next_slot_ = slot;
    if (!added.empty())
        seeds_changed_ = true;
}

void Diagram::remove_seeds(std::span<const uint32_t> ids) {
    std::unordered_set<uint32_t> gone;
    for (size_t i = 0; i < ids.size(); ++i) {
        position(ids[i], "ids[" + std::to_string(i) + "]");
        require(gone.insert(ids[i]).second, "ids[", i, "] is ", ids[i], ", named twice");
    }
    if (gone.empty())
        return;
    for (const uint32_t id : gone)
        slot_of_id_.erase(id);
    std::erase_if(seeds_, [&](const Seed &seed) { return gone.contains(seed.id); });
    seeds_changed_ = true;
}

void Diagram::move_seed(uint32_t id, uint64_t x, uint64_t y, uint64_t z) {
    const size_t at = position(id, "id");
    seeds_[at].voxel = checked_voxel(x, y, z, "seed " + std::to_string(id));
    seeds_changed_ = true;
}

uint64_t Diagram::cutoff() const {
    const double steps = std::floor(options_.max_distance * graph_->scale());
    return steps < 0x1p63 ? static_cast<uint64_t>(steps) : UINT64_MAX;
}

void check_overflow(const Problem &problem, const Words &words, const Report &report) {
    const Graph &graph = problem.graph;
    if (!report.clipped || !problem.may_overflow())
        return;
    const uint64_t next = next_distance(graph, words);
    if (next == UINT64_MAX || next > problem.cutoff)
        return;
    std::ostringstream remedy;
    if (const double scale = graph.safe_scale(); scale > 0)
        remedy << "a scale of " << scale << (graph.layout().bits == 32 ? " or 64-bit words" : "")
               << " would do for every path";
    else
        remedy << (graph.layout().bits == 32 ? "64-bit words would do"
                                             : "fewer label bits (options->max_seeds) would help");
    fail(LOCUS_E_RANGE, "a voxel lies at the distance ", static_cast<double>(next) / graph.scale(),
         " or beyond, and the graph's words of ", graph.layout().bits, " bits hold no more than ",
         static_cast<double>(graph.layout().max_exact()) / graph.scale(), " at the scale ", graph.scale(), "; ",
         remedy.str());
}

void Diagram::solve(Progress &progress) { run(progress, nullptr); }

Change Diagram::update(Progress &progress) {
    Change change;
    run(progress, &change);
    return change;
}

// `change` asks for an update.
void Diagram::run(Progress &progress, Change *change) {
    if (seeds_.empty())
        fail(LOCUS_E_STATE, "the diagram has no seeds");
    std::vector<Source> sources;
    sources.reserve(seeds_.size());
    std::vector<uint32_t> positions(next_slot_, UINT32_MAX);
    for (size_t i = 0; i < seeds_.size(); ++i) {
        const Seed &seed = seeds_[i];
        const auto [x, y, z] = graph_->grid().place(seed.voxel);
        checked_voxel(x, y, z, "seed " + std::to_string(seed.id));
        sources.push_back({seed.voxel, seed.steps, seed.slot});
        positions[seed.slot] = static_cast<uint32_t>(i);
    }
    std::vector<Seed> seeds = seeds_;
    const Problem problem{*graph_, sources, cutoff(), options_.record_trace != 0, !solved_};
    Report report;
    try {
        if (change != nullptr && !solved_)
            words_ = Words(); // what is left there is no result: everything changes
        report = change != nullptr ? engine_->update(problem, words_, progress, *change)
                                   : engine_->solve(problem, words_, progress);
    } catch (const Error &) { // stopped, a caller's weight out of range, a device that failed
        solved_ = false;
        throw;
    } catch (...) { // memory ran out: the old result is still there, unless a device had it or had failed before
        solved_ = solved_ && !report_.kept && !has_memory_gone(words_);
        throw;
    }
    solved_ = false;
    fetched_ = !report.kept;
    if (report.clipped && problem.may_overflow())
        fetch();
    check_overflow(problem, words_, report);
    progress.report(1);
    report_ = std::move(report);
    solved_seeds_.swap(seeds);
    position_of_slot_.swap(positions);
    solved_version_ = graph_->version();
    seeds_changed_ = false;
    solved_ = true;
}

void Diagram::check_solved() const {
    if (!solved_)
        fail(LOCUS_E_STATE, "the diagram is not solved");
}

const Words &Diagram::words() const {
    check_solved();
    fetch();
    return words_;
}

void Diagram::fetch() const {
    const std::lock_guard lock(reading_);
    if (fetched_)
        return;
    engine_->fetch(words_);
    fetched_ = true;
}

void Diagram::labels(const Box &box, uint32_t *labels) const {
    const WordLayout &layout = graph_->layout();
    std::visit(
        [&](const auto &each) {
            for_each_voxel(graph_->grid(), box, [&](uint64_t voxel, uint64_t i) {
                const auto word = each[voxel];
                labels[i] =
                    layout.reached(word) ? solved_seeds_[position_of_slot_[layout.label(word)]].id : LOCUS_NO_SEED;
            });
        },
        words());
}

void Diagram::distances(const Box &box, float *distances) const {
    const WordLayout &layout = graph_->layout();
    std::visit(
        [&](const auto &each) {
            for_each_voxel(graph_->grid(), box, [&](uint64_t voxel, uint64_t i) {
                const auto word = each[voxel];
                distances[i] = layout.reached(word)
                                   ? static_cast<float>(static_cast<double>(layout.distance(word)) / graph_->scale())
                                   : std::numeric_limits<float>::infinity();
            });
        },
        words());
}

void Diagram::distances_exact(const Box &box, uint64_t *distances) const {
    const WordLayout &layout = graph_->layout();
    std::visit(
        [&](const auto &each) {
            for_each_voxel(graph_->grid(), box, [&](uint64_t voxel, uint64_t i) {
                const auto word = each[voxel];
                distances[i] = layout.reached(word) ? layout.distance(word) : UINT64_MAX;
            });
        },
        words());
}

void Diagram::write_on_device(Told told, const Box &box, void *to) const {
    check_solved();
    std::vector<uint32_t> ids;
    if (told == Told::ids)
        for (const uint32_t position : position_of_slot_)
            ids.push_back(position < solved_seeds_.size() ? solved_seeds_[position].id : LOCUS_NO_SEED);
    const std::lock_guard lock(reading_);
    engine_->write({told, box, ids, graph_->scale()}, to);
}

} // namespace locus::graph
