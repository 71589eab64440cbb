// voronoi.cube768: 453 million voxels of constant compliance. No plain engine is waited for: in such a cube the
// shortest path goes along diagonals first, so that the distances are known (the chamfer metric: Borgefors, Distance
// transformations in arbitrary dimensions, 1984).
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/voronoi/solve.hpp"

#include <algorithm>

namespace bench {
namespace {

/// Distances in a constant cube, in steps: from the weights of an edge along an axis, across a face and through a
/// voxel.
struct Chamfer {
    uint64_t axis, face, corner;

    uint64_t distance(const locus_seed &seed, uint64_t x, uint64_t y, uint64_t z) const {
        const auto apart = [](uint64_t a, uint64_t b) { return a > b ? a - b : b - a; };
        uint64_t a = apart(x, seed.x), b = apart(y, seed.y), c = apart(z, seed.z);
        if (a < b) {
            std::swap(a, b);
        }
        if (b < c) {
            std::swap(b, c);
        }
        if (a < b) {
            std::swap(a, b);
        }
        return c * corner + (b - c) * face + (a - b) * axis;
    }
};

/// Of the slices z = 0, `step`, ... the voxels that have another distance than the nearest seed, or the label of a
/// farther one.
uint64_t wrong_voxels(const Volume &volume, const Solver &solver, const Chamfer &chamfer, uint64_t step) {
    const auto [side_x, side_y, side_z] = volume.dims;
    std::vector<uint64_t> exact(side_x * side_y);
    std::vector<uint32_t> labels(exact.size());
    uint64_t wrong = 0;
    for (uint64_t z = 0; z < side_z; z += step) {
        const locus_voxel_box slice{{0, 0, z}, {side_x, side_y, 1}};
        need(locus_diagram_distances_exact(solver.diagram(), &slice, exact.data(), exact.size()));
        need(locus_diagram_labels(solver.diagram(), &slice, labels.data(), labels.size()));
        for (std::size_t i = 0; i < exact.size(); ++i) {
            uint64_t nearest = UINT64_MAX, own = UINT64_MAX;
            for (const locus_seed &seed : volume.seeds) {
                const uint64_t distance = chamfer.distance(seed, i % side_x, i / side_x, z);
                nearest = std::min(nearest, distance);
                own = seed.id == labels[i] ? distance : own;
            }
            wrong += exact[i] != nearest || own != nearest;
        }
    }
    return wrong;
}

void large_case(Row &row, uint32_t threads) {
    const Volume volume = cube("constant", row.quick ? 64 : 768, 10);
    const std::size_t before = peak_bytes();
    Solver solver(volume, {"", LOCUS_ENGINE_AUTO, threads, LOCUS_WORD_32});
    race(row, {{"", [&](Notes &notes) { return solver.solve(notes); }}}, 2);
    row.threads = threads;
    row.target = simd_name(solver.info().simd);
    const auto voxels = static_cast<double>(volume.voxels());
    row.extras["voxels"] = voxels;
    row.extras["peak_bytes_per_voxel"] = static_cast<double>(peak_bytes() - before) / voxels;
    row.extras["peak_gb"] = static_cast<double>(peak_bytes()) / 1e9;
    const double bandwidth = copy_bandwidth(threads);
    row.extras["floor_ratio"] = row.ours.median * bandwidth / (1e3 * 12 * voxels);
    const uint64_t x = volume.dims[0], slice = x * volume.dims[1];
    const Chamfer chamfer{solver.edge_weight(0, 1), solver.edge_weight(0, x + 1), solver.edge_weight(0, slice + x + 1)};
    const uint64_t wrong = wrong_voxels(volume, solver, chamfer, 7);
    row.check(wrong == 0,
              std::to_string(wrong) + " voxels have another distance or label than the chamfer metric gives");
}

} // namespace

void add_voronoi_large(Cases &cases) {
    for (const uint32_t threads : {2U, 1U}) {
        cases.push_back(
            {std::string("voronoi.cube768.constant.s10") + (threads == 1 ? ".t1" : ""), "ms", {}, [=](Row &row) {
                 large_case(row, threads);
             }});
    }
}

} // namespace bench
