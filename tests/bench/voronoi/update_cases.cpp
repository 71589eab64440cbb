// update.*: a small change of a solved 128^3 cube, brought up to date, against solving it all again.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/voronoi/solve.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace bench {
namespace {

/// A change and the way back, on a solver's graph or diagram.
struct Edit {
    std::function<void(const Solver &)> apply, undo;
};
using MakeEdit = std::function<Edit(const Volume &, std::mt19937_64 &)>;

/// A box of `extent` voxels at random that holds no seed.
locus_voxel_box free_box(const Volume &volume, const std::array<uint64_t, 3> &extent, std::mt19937_64 &random) {
    for (;;) {
        locus_voxel_box box{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.extent[axis] = extent[axis];
            box.origin[axis] = random() % (volume.dims[axis] - extent[axis] + 1);
        }
        const auto holds = [&](const locus_seed &seed) {
            return seed.x - box.origin[0] < extent[0] && seed.y - box.origin[1] < extent[1] &&
                   seed.z - box.origin[2] < extent[2];
        };
        if (std::none_of(volume.seeds.begin(), volume.seeds.end(), holds)) {
            return box;
        }
    }
}

/// Give a box of 10^3 voxels one material.
Edit fill(const Volume &volume, std::mt19937_64 &random, float value) {
    const locus_voxel_box box = free_box(volume, {10, 10, 10}, random);
    std::vector<float> before;
    for (uint64_t z = 0; z < 10; ++z) {
        for (uint64_t y = 0; y < 10; ++y) {
            for (uint64_t x = 0; x < 10; ++x) {
                before.push_back(
                    volume.compliance[box.origin[0] + x +
                                      volume.dims[0] * (box.origin[1] + y + volume.dims[1] * (box.origin[2] + z))]);
            }
        }
    }
    return {[=](const Solver &solver) { need(locus_graph_fill_box(solver.graph(), &box, value)); },
            [=](const Solver &solver) { need(locus_graph_set_box(solver.graph(), &box, before.data())); }};
}

/// Disable the edges through the middle plane of a box of 32x32x2 voxels.
Edit cut_edges(const Volume &volume, std::mt19937_64 &random) {
    const uint64_t side = std::min<uint64_t>(32, volume.dims[0] / 2);
    const locus_voxel_box box = free_box(volume, {side, side, 2}, random);
    return {[=](const Solver &solver) {
                const double point[3] = {0, 0, static_cast<double>(box.origin[2]) + 0.5}, normal[3] = {0, 0, 1};
                need(locus_graph_cut_plane(solver.graph(), point, normal, &box, nullptr));
            },
            [=](const Solver &solver) { need(locus_graph_mend_box(solver.graph(), &box, nullptr)); }};
}

/// Move a seed by one voxel along x.
Edit move_seed(const Volume &volume, std::mt19937_64 &random) {
    const locus_seed seed = volume.seeds[random() % volume.seeds.size()];
    const uint64_t x = seed.x + 1 < volume.dims[0] ? seed.x + 1 : seed.x - 1;
    return {[=](const Solver &solver) { need(locus_diagram_move_seed(solver.diagram(), seed.id, x, seed.y, seed.z)); },
            [=](const Solver &solver) {
                need(locus_diagram_move_seed(solver.diagram(), seed.id, seed.x, seed.y, seed.z));
            }};
}

void update(const Solver &solver) { need(locus_diagram_update(solver.diagram(), nullptr, nullptr, nullptr, nullptr)); }

/// Ours is the whole call of the update, the peer the solving alone; one thread, the mean over some places.
void update_case(Row &row, const MakeEdit &make) {
    const Volume volume = cube("gradient", row.quick ? 48 : 128, 10);
    const Engine engine{"", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32};
    Solver updated(volume, engine), full(volume, engine);
    Notes unused;
    updated.solve(unused);
    full.solve(unused);
    std::mt19937_64 random(13);
    std::vector<Edit> edits;
    for (int i = 0; i < (row.quick ? 2 : 8); ++i) {
        edits.push_back(make(volume, random));
    }
    const auto count = static_cast<double>(edits.size());
    race(row, {{"",
                [&](Notes &) {
                    double seconds = 0;
                    for (const Edit &edit : edits) {
                        edit.apply(updated);
                        seconds += timed([&] { update(updated); });
                        edit.undo(updated);
                        update(updated);
                    }
                    return 1e3 * seconds / count;
                }},
               {"full", [&](Notes &notes) {
                    double milliseconds = 0;
                    for (const Edit &edit : edits) {
                        edit.apply(full);
                        milliseconds += full.solve(notes);
                        edit.undo(full);
                    }
                    return milliseconds / count;
                }}});
    row.target = simd_name(updated.info().simd);
    for (std::size_t i = 0; i < edits.size(); ++i) {
        edits[i].apply(updated);
        update(updated);
        edits[i].apply(full);
        full.solve(unused);
        row.check(same_diagram(updated, full), "the update of edit " + std::to_string(i) + " is not a fresh solve");
        edits[i].undo(updated);
        edits[i].undo(full);
        update(updated);
    }
}

} // namespace

void add_updates(Cases &cases) {
    const auto add = [&](const char *name, double goal, const MakeEdit &make) {
        cases.push_back({std::string("update.cube128.") + name, "ms", {{"full", goal}}, [make](Row &row) {
                             update_case(row, make);
                         }});
    };
    const auto filled = [](float value) {
        return [value](const Volume &volume, std::mt19937_64 &random) { return fill(volume, random, value); };
    };
    add("cut", 25, filled(std::numeric_limits<float>::quiet_NaN()));
    add("stiffen", 25, filled(0.01F)); // the stiffest and the softest material of the gradient
    add("soften", 25, filled(0.1F));
    add("edge_cut", 10, cut_edges);
    add("seed", 4, move_seed);
}

} // namespace bench
