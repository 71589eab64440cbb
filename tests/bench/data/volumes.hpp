// Material maps with their seeds: cubes, the plate of the thesis, the T-bone steak and a head CT.
#ifndef LOCUS_BENCH_VOLUMES_HPP
#define LOCUS_BENCH_VOLUMES_HPP

#include <locus/diagram.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Volume {
    std::array<uint64_t, 3> dims{};
    std::array<double, 3> spacing{1, 1, 1};
    std::vector<float> compliance; ///< x fastest; NaN where impassable
    std::vector<locus_seed> seeds;

    std::size_t voxels() const { return compliance.size(); }
};

/// A cube of `side` voxels: constant (1), gradient (10 to 1, softest at x = 0), noise (1..10), maze (1, walls between
/// corridors).
Volume cube(const std::string &topology, uint64_t side, std::size_t seeds, uint64_t placement = 1);
/// The thesis' plate: 100x40x20, stiffness 10 to 100 along x (or constant, or noise 1..10 as compliance).
Volume plate(const std::string &topology, std::size_t seeds);
/// The steak with its 3 or 10 seeds; compliance relative to the softest meat.
Volume steak(std::size_t seeds);
/// The head CT of Debian's invesalius-examples: bone 1, soft tissue 10, air impassable.
Volume head_ct(std::size_t seeds);
/// `count` random passable places, none twice.
void scatter_seeds(Volume &volume, std::size_t count, uint64_t placement);

} // namespace bench
#endif
