// gpu.*: the CUDA backend on cubes, the steak and the plate, against the thesis' kernels and the CPU; and the thesis'
// table 2.2 and figure 2.15, which are about a GPU alone. Left out where there is no GPU.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/voronoi/solve.hpp"

#include <algorithm>
#include <memory>

namespace bench {
namespace {

using Weights = std::unique_ptr<locus_weights, Destroy<locus_weights_destroy>>;

constexpr double h200_bytes_per_ms = 4.3e9; // 4.3 TB/s, its memory's nominal speed

void need_gpu(Row &row) {
    std::string why;
    if (!has_gpu(&why)) {
        throw Missing(why);
    }
    row.backend = "cuda";
}

/// Ours, also with results that stay on the GPU, against the thesis' base algorithm and its compaction on the same GPU,
/// and the CPU's bricks, which are the oracle.
void solve_case(Row &row, const Volume &volume, uint32_t words, double goal_ms) {
    need_gpu(row);
    const std::vector<Engine> engines = {{"", LOCUS_ENGINE_BRICKS, 0, words, LOCUS_BACKEND_CUDA},
                                         {"kept", LOCUS_ENGINE_BRICKS, 0, words, LOCUS_BACKEND_CUDA, {}, true},
                                         {"base", LOCUS_ENGINE_RELAX, 1, words, LOCUS_BACKEND_CUDA},
                                         {"compact", LOCUS_ENGINE_COMPACT, 1, words, LOCUS_BACKEND_CUDA},
                                         {"cpu", LOCUS_ENGINE_BRICKS, 0, words, LOCUS_BACKEND_CPU}};
    std::vector<std::unique_ptr<Solver>> solvers;
    std::vector<Contestant> contestants;
    for (const Engine &engine : engines) {
        solvers.push_back(std::make_unique<Solver>(volume, engine));
        Notes unused;
        solvers.back()->solve(unused); // the first one waits for the device
        contestants.push_back(
            {engine.peer, [solver = solvers.back().get()](Notes &notes) { return solver->solve(notes); }});
    }
    race(row, contestants);
    for (const auto &solver : solvers) {
        row.check(same_diagram(*solver, *solvers.back()), solver->peer() + ": another diagram than the CPU's");
    }
    const double floor_ms = 12 * static_cast<double>(volume.voxels()) / h200_bytes_per_ms;
    row.extras["goal_ms"] = goal_ms;
    row.extras["floor_ratio_h200"] = row.ours.median / floor_ms;
    row.extras["word_bits"] = solvers.front()->info().word_bits;
    row.extras["visits"] = static_cast<double>(solvers.front()->stats().iterations);
}

Weights weights_of(const Solver &solver, const std::vector<uint64_t> *voxels = nullptr) {
    locus_weights *weights = nullptr;
    need(voxels == nullptr
             ? locus_weights_create(solver.diagram(), nullptr, nullptr, &weights)
             : locus_weights_create_for(solver.diagram(), nullptr, voxels->data(), voxels->size(), &weights));
    return Weights(weights);
}

bool same_rows(const Weights &a, const Weights &b) {
    struct Rows {
        uint64_t count = 0, entries = 0;
        std::vector<uint64_t> offsets;
        std::vector<uint32_t> ids;
        std::vector<float> values;
        bool operator==(const Rows &) const = default;
        explicit Rows(const Weights &weights) {
            need(locus_weights_size(weights.get(), &count, &entries));
            offsets.resize(count + 1);
            ids.resize(entries);
            values.resize(entries);
            need(locus_weights_rows(weights.get(), 0, count, offsets.data(), ids.data(), values.data(), entries,
                                    nullptr));
        }
    };
    return Rows(a) == Rows(b);
}

struct Plate {
    Solver gpu, cpu;
    Plate()
        : gpu(plate("constant", 20), {"", LOCUS_ENGINE_BRICKS, 1, LOCUS_WORD_32, LOCUS_BACKEND_CUDA}),
          cpu(plate("constant", 20), {"cpu", LOCUS_ENGINE_BRICKS, 0, LOCUS_WORD_32, LOCUS_BACKEND_CPU}) {
        Notes unused;
        gpu.solve(unused);
        cpu.solve(unused);
    }
};

void sibson_case(Row &row) {
    need_gpu(row);
    const Plate plate;
    Weights ours, theirs;
    const auto time = [](Weights &weights, const Solver &solver) {
        const double start = wall_seconds();
        weights = weights_of(solver);
        return 1e3 * (wall_seconds() - start);
    };
    race(row, {{"", [&](Notes &) { return time(ours, plate.gpu); }},
               {"cpu", [&](Notes &) { return time(theirs, plate.cpu); }}});
    row.check(same_rows(ours, theirs), "other rows than the CPU's");
    row.extras["goal_ms"] = 100;
}

/// Table 2.2: all queries of the plate in batches of one size; milliseconds a batch. A Tesla K40c.
void batch_case(Row &row, uint64_t size, double thesis_ms) {
    need_gpu(row);
    const Plate plate;
    const uint64_t voxels = 80000;
    const uint64_t batches = std::min<uint64_t>(row.quick ? 20 : 2000, voxels / size);
    std::vector<double> times;
    for (uint64_t batch = 0; batch < batches; ++batch) {
        std::vector<uint64_t> queries;
        for (uint64_t i = 0; i < size; ++i) { // neighbours in a row, as the thesis goes over the grid
            queries.push_back(batch * (voxels / batches) + i);
        }
        const double start = wall_seconds();
        const Weights weights = weights_of(plate.gpu, &queries);
        times.push_back(1e3 * (wall_seconds() - start));
        if (batch % 50 == 0) {
            row.check(same_rows(weights, weights_of(plate.cpu, &queries)), "other rows than the CPU's");
        }
    }
    row.ours = spread(times);
    row.extras["all_80000_ms"] = row.ours.median * static_cast<double>(voxels) / static_cast<double>(size);
    row.extras["thesis_ms"] = thesis_ms;
}

/// Figure 2.15: the 128^3 gradient with 10 seeds by the grain of the compaction; 0: without.
void grain_case(Row &row, const std::array<uint32_t, 3> &grain) {
    need_gpu(row);
    const Volume volume = cube("gradient", row.quick ? 32 : 128, 10);
    const uint32_t engine = grain[0] == 0 ? LOCUS_ENGINE_RELAX : LOCUS_ENGINE_COMPACT;
    const Engine how = {
        "", engine, 1, LOCUS_WORD_32, LOCUS_BACKEND_CUDA, grain[0] == 0 ? std::array<uint32_t, 3>{1, 1, 1} : grain};
    Solver ours(volume, how), cpu(volume, {"cpu", LOCUS_ENGINE_BRICKS, 0, LOCUS_WORD_32, LOCUS_BACKEND_CPU});
    Notes unused;
    ours.solve(unused);
    cpu.solve(unused);
    race(row, {{"", [&](Notes &notes) { return ours.solve(notes); }}});
    row.check(same_diagram(ours, cpu), "another diagram than the CPU's");
    row.extras["iterations"] = static_cast<double>(ours.stats().iterations);
}

} // namespace

void add_gpu(Cases &cases) {
    for (const uint64_t side : {256U, 512U}) {
        for (const std::string topology : {"constant", "gradient"}) {
            cases.push_back({"gpu.voronoi.cube" + std::to_string(side) + "." + topology + ".s10",
                             "ms",
                             {{"base", 5}},
                             [=](Row &row) {
                                 solve_case(row, cube(topology, row.quick ? side / 8 : side, 10), LOCUS_WORD_32,
                                            side == 256 ? 2 : 12);
                             }});
        }
    }
    cases.push_back({"gpu.voronoi.steak.s10", "ms", {{"base", 5}}, [](Row &row) {
                         solve_case(row, steak(10), LOCUS_WORD_AUTO, 0.5);
                     }});
    cases.push_back({"gpu.sibson.plate.s20", "ms", {}, sibson_case});
    const std::pair<uint64_t, double> batches[] = {{1, 9.746}, {10, 12.414}, {100, 29.537}, {150, 34.807}};
    for (const auto &[size, thesis_ms] : batches) {
        cases.push_back(
            {"gpu.table2.2.b" + std::to_string(size), "ms", {}, [=](Row &row) { batch_case(row, size, thesis_ms); }});
    }
    const std::array<uint32_t, 3> grains[] = {{0, 0, 0}, {1, 1, 1}, {4, 1, 1}, {1, 1, 4}, {16, 1, 1},
                                              {2, 2, 2}, {4, 4, 4}, {8, 4, 4}, {8, 8, 8}, {32, 4, 4}};
    for (const auto &grain : grains) {
        std::string name = "static";
        if (grain[0] != 0) {
            name = std::to_string(grain[0]) + "x" + std::to_string(grain[1]) + "x" + std::to_string(grain[2]);
        }
        cases.push_back({"thesis.fig2.15." + name, "ms", {}, [=](Row &row) { grain_case(row, grain); }});
    }
}

} // namespace bench
