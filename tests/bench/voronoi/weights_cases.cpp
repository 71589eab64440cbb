// sibson.*, laplace.* and ratio.*: interpolation weights of all 80,000 voxels of the plate against their definitions.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/voronoi/naive.hpp"

#include <cmath>

namespace bench {
namespace {

using Weights = std::unique_ptr<locus_weights, Destroy<locus_weights_destroy>>;

Weights make_weights(const Solver &solver, uint32_t method) {
    locus_weights_options options;
    need(locus_weights_options_init(&options, sizeof options));
    options.method = method;
    locus_weights *weights = nullptr;
    need(locus_weights_create(solver.diagram(), &options, nullptr, &weights));
    return Weights(weights);
}

/// The dense row of a voxel.
std::vector<float> row_of(const Weights &weights, uint64_t voxel, const Volume &volume) {
    std::vector<uint32_t> ids;
    for (const locus_seed &seed : volume.seeds) {
        ids.push_back(seed.id);
    }
    std::vector<float> row(ids.size());
    need(locus_weights_dense(weights.get(), voxel, 1, ids.data(), ids.size(), row.data(), row.size()));
    return row;
}

bool close(const std::vector<float> &ours, const Naive::Row &theirs) {
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (std::abs(static_cast<double>(ours[i]) - theirs[i]) > 1e-5) {
            return false;
        }
    }
    return true;
}

/// The definition's rows of every `every`-th voxel, and the microseconds they take for each; the distance ratio has its
/// rows all at once.
double naive_rows(Naive &naive, uint32_t method, uint32_t voxels, uint32_t every, std::vector<Naive::Row> &rows) {
    rows.clear();
    if (method == LOCUS_METHOD_DISTANCE_RATIO) {
        std::vector<Naive::Row> all;
        const double seconds = timed([&] { all = naive.ratio(); });
        for (uint32_t voxel = 0; voxel < voxels; voxel += every) {
            rows.push_back(all[voxel]);
        }
        return 1e6 * seconds / voxels;
    }
    const double seconds = timed([&] {
        for (uint32_t voxel = 0; voxel < voxels; voxel += every) {
            rows.push_back(method == LOCUS_METHOD_SIBSON ? naive.sibson(voxel) : naive.laplace(voxel));
        }
    });
    return 1e6 * seconds / static_cast<double>(rows.size());
}

void weights_case(Row &row, uint32_t method, const std::string &topology) {
    const Volume volume = plate(topology, 20);
    const auto voxels = static_cast<uint32_t>(volume.voxels());
    const uint32_t every = row.quick ? 997 : 17; // voxels to one query that the definition is asked
    Solver solver(volume, {"", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32});
    Notes unused;
    solver.solve(unused);
    Naive naive(volume, solver);
    Weights weights;
    std::vector<Naive::Row> rows;
    race(row, {{"",
                [&](Notes &) {
                    weights.reset();
                    return 1e6 * timed([&] { weights = make_weights(solver, method); }) / voxels;
                }},
               {"naive", [&](Notes &) { return naive_rows(naive, method, voxels, every, rows); }}});
    row.target = simd_name(solver.info().simd);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        wrong += !close(row_of(weights, i * every, volume), rows[i]);
    }
    row.check(wrong == 0,
              std::to_string(wrong) + " of " + std::to_string(rows.size()) + " rows are not the definition's");
    row.extras["naive_queries_one_in"] = method == LOCUS_METHOD_DISTANCE_RATIO ? 1 : every;
}

/// Two threads beside one, wall time both; rows the same.
void threads_case(Row &row) {
    const Volume volume = plate("constant", 20);
    const auto voxels = static_cast<double>(volume.voxels());
    Solver two(volume, {"", LOCUS_ENGINE_AUTO, 2, LOCUS_WORD_32}),
        one(volume, {"t1", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32});
    Notes unused;
    two.solve(unused);
    one.solve(unused);
    Weights by_two, by_one;
    const auto measure = [voxels](const Solver &solver, Weights &weights) {
        weights.reset();
        return 1e6 * timed_wall([&] { weights = make_weights(solver, LOCUS_METHOD_SIBSON); }) / voxels;
    };
    race(row,
         {{"", [&](Notes &) { return measure(two, by_two); }}, {"t1", [&](Notes &) { return measure(one, by_one); }}});
    row.threads = 2;
    row.target = simd_name(two.info().simd);
    bool same = true;
    for (uint64_t voxel = 0; voxel < volume.voxels(); voxel += 17) {
        same = same && row_of(by_two, voxel, volume) == row_of(by_one, voxel, volume);
    }
    row.check(same, "two threads give other rows than one");
}

} // namespace

void add_weights(Cases &cases) {
    const auto add = [&](const char *name, double goal, uint32_t method, const char *topology) {
        cases.push_back({name, "us/query", {{"naive", goal}}, [=](Row &row) { weights_case(row, method, topology); }});
    };
    add("sibson.plate.s20.constant", 45, LOCUS_METHOD_SIBSON, "constant");
    add("sibson.plate.s20.noise", 18, LOCUS_METHOD_SIBSON, "noise");
    cases.push_back({"sibson.plate.s20.constant.t2", "us/query", {{"t1", 1.7}}, threads_case});
    add("laplace.plate.s20", 15, LOCUS_METHOD_LAPLACE, "constant");
    add("ratio.plate.s20", 15, LOCUS_METHOD_DISTANCE_RATIO, "constant");
}

} // namespace bench
