// A Voronoi diagram of a graph: the seeds, and the words that the latest solve left behind.
#pragma once

#include "core/progress.hpp"
#include "graph/engine.hpp"

#include <locus/diagram.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace locus::graph {

struct Seed {
    uint64_t voxel;
    double distance; // what it starts at, as the caller gave it,
    uint64_t steps;  // and in steps
    uint32_t id;
    uint32_t slot; // its label in the words; the order of slots is the order of addition, and so that of ties
    bool fixed;
};

class Diagram {
public:
    Diagram(std::shared_ptr<const Graph> graph, const locus_diagram_options &options);

    const Graph &graph() const { return *graph_; }
    void *stream() const { return options_.stream; }
    Engine &engine() const { return *engine_; }
    const std::vector<Seed> &seeds() const { return seeds_; } // by slot

    // Changes of the seeds; each either succeeds or changes nothing.
    void add_seeds(std::span<const locus_seed> seeds);
    void remove_seeds(std::span<const uint32_t> ids);
    void move_seed(uint32_t id, uint64_t x, uint64_t y, uint64_t z);
    void place_seeds(const locus_place_options &options);

    void solve(Progress &progress);
    // The same result from what is there, looking only at what was edited since where the engine can.
    Change update(Progress &progress);

    // The result of the latest solve; all throw LOCUS_E_STATE where there is none.
    const Words &words() const;
    void check_solved() const;
    // Throws LOCUS_E_STATE also where the graph was edited since.
    void check_unchanged() const;
    // The seeds of that solve, by slot; their place in the words' labels is `slot`.
    const std::vector<Seed> &solved_seeds() const { return solved_seeds_; }
    // Whether the seeds are still those of that solve.
    bool seeds_changed() const { return seeds_changed_; }
    // Positions in solved_seeds() by slot, UINT32_MAX for a slot without a seed.
    const std::vector<uint32_t> &position_of_slot() const { return position_of_slot_; }
    void labels(const Box &box, uint32_t *labels) const;
    void distances(const Box &box, float *distances) const;
    void distances_exact(const Box &box, uint64_t *distances) const;
    // The same into memory of the device that solved the diagram.
    void write_on_device(Told told, const Box &box, void *to) const;
    std::vector<uint64_t> path(uint64_t x, uint64_t y, uint64_t z) const;
    std::vector<uint64_t> cell_sizes() const;
    std::vector<locus_cell_pair> cell_pairs() const;
    locus_diagram_stats stats() const;
    const std::vector<uint64_t> &trace() const;

private:
    Seed checked(const locus_seed &seed, const std::string &name) const;
    uint64_t checked_voxel(uint64_t x, uint64_t y, uint64_t z, const std::string &name) const;
    size_t position(uint32_t id, const std::string &name) const;
    uint64_t cutoff() const;
    void renumber();
    void run(Progress &progress, Change *change);
    void fetch() const;
    uint64_t words_bytes() const;

    std::shared_ptr<const Graph> graph_;
    locus_diagram_options options_;
    std::unique_ptr<Engine> engine_;
    std::vector<Seed> seeds_;
    std::unordered_map<uint32_t, uint32_t> slot_of_id_;
    uint32_t next_slot_ = 0;
    bool seeds_changed_ = false; // since the latest solve

    bool solved_ = false;
    mutable std::mutex reading_; // readers that come by the engine take turns
    mutable Words words_;
    mutable bool fetched_ = true; // else only the engine's device has the result's
    Report report_;
    uint64_t solved_version_ = 0; // of the graph
    std::vector<Seed> solved_seeds_;
    std::vector<uint32_t> position_of_slot_;
};

// Throws LOCUS_E_RANGE where some voxel within the problem's cut-off lies farther than the words of its graph can hold.
void check_overflow(const Problem &problem, const Words &words, const Report &report);

} // namespace locus::graph
