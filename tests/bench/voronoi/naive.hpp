// Interpolation weights straight from their definitions (locus/weights.h), one query or one seed at a time, as peer and
// oracle.
#ifndef LOCUS_BENCH_NAIVE_HPP
#define LOCUS_BENCH_NAIVE_HPP

#include "tests/bench/voronoi/solve.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace bench {

class Naive {
public:
    /// From a solved diagram whose seed ids are 0, 1, ...; edge weights and distances in the graph's steps.
    Naive(const Volume &volume, const Solver &solver);

    using Row = std::vector<double>; ///< a weight for every seed, their sum 1 (0 for an unreached voxel)
    Row sibson(uint32_t query);
    Row laplace(uint32_t query);
    std::vector<Row> ratio() const; ///< of all voxels

private:
    using Entry = std::pair<uint32_t, uint32_t>; // distance, voxel
    struct Hop {
        int64_t step;
        bool face;
        double area; // of the face between
    };

    void steal(uint32_t query); // taken_: what the query steals, with the distances in distance_
    void forget();
    std::vector<uint32_t> spread(const std::vector<Entry> &sources) const;
    template <class Visit>
    void for_border(uint32_t label, Visit visit) const;
    Row nearest(uint32_t query) const;

    std::vector<Hop> hops_;
    std::vector<uint32_t> weights_; // hops_.size() for each voxel; 0: no edge
    std::vector<uint32_t> labels_, nearest_, distance_, taken_, touched_;
    std::vector<bool> stolen_;
    std::vector<Entry> queue_; // a binary heap
    const Volume &volume_;
};

} // namespace bench
#endif
