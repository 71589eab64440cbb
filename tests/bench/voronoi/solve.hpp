// Solves a volume's Voronoi diagram with one engine, and compares the results of two.
#ifndef LOCUS_BENCH_SOLVE_HPP
#define LOCUS_BENCH_SOLVE_HPP

#include "tests/bench/data/volumes.hpp"
#include "tests/bench/harness/handles.hpp"
#include "tests/bench/harness/race.hpp"

#include <string>

namespace bench {

struct Engine {
    std::string peer; ///< empty: ours
    uint32_t engine = LOCUS_ENGINE_AUTO;
    uint32_t threads = 1;
    uint32_t word_bits = LOCUS_WORD_32;
    uint32_t backend = LOCUS_BACKEND_CPU;
    std::array<uint32_t, 3> grain{8, 4, 4}; ///< of LOCUS_ENGINE_COMPACT
    bool on_device = false;                 ///< the result stays there
};

/// A volume made ready for one engine.
class Solver {
public:
    Solver(const Volume &volume, const Engine &engine);

    /// Solve, small volumes several times, and note import_ms and export_ms. Median milliseconds of the solving alone:
    /// thread-CPU time for one thread (the call's, in the proportion of the engine's own wall times), wall time for
    /// several.
    double solve(Notes &notes);

    locus_graph_info info() const;
    locus_diagram_stats stats() const;
    std::vector<uint32_t> labels() const;
    std::vector<uint64_t> exact_distances() const;
    std::vector<float> distances() const;
    uint32_t edge_weight(uint64_t u, uint64_t v) const; ///< in steps; 0: no edge
    locus_graph *graph() const { return graph_.get(); }
    locus_diagram *diagram() const { return diagram_.get(); }
    const std::string &peer() const { return engine_.peer; }

private:
    Engine engine_;
    std::size_t voxels_;
    Graph graph_;
    Diagram diagram_;
};

/// Whether there is a GPU that the library can use; `why` (may be null) tells why not.
bool has_gpu(std::string *why = nullptr);

/// The name of an instruction set of graph.h.
const char *simd_name(uint32_t simd);

/// Both have the same labels and exact distances for every voxel.
bool same_diagram(const Solver &a, const Solver &b);

/// Race `engines` over a volume; the heap engine among them is the oracle of all, or one of its own where it is not
/// among them.
void race_engines(Row &row, const Volume &volume, const std::vector<Engine> &engines);

} // namespace bench
#endif
