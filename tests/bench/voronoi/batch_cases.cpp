// thesis.table2.2 and thesis.fig2.18: Sibson's weights of all 80,000 voxels of the plate, some at a time, as a
// simulation asks for them; the thesis' printed numbers beside ours.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/voronoi/naive.hpp"

#include <cmath>
#include <numeric>

namespace bench {
namespace {

using Weights = std::unique_ptr<locus_weights, Destroy<locus_weights_destroy>>;

/// A line of table 2.2: a Tesla K40c; 0 where the thesis has no such batches. Milliseconds.
struct Printed {
    uint32_t size;   ///< queries in a batch
    uint32_t one_in; ///< so many batches one is measured
    double gpu_mean_ms, gpu_sum_ms;
};

constexpr Printed table[] = {{1, 40, 9.746, 779657.760},
                             {10, 4, 12.414, 99309.125},
                             {100, 1, 29.537, 23629.871},
                             {150, 1, 34.807, 18587.131},
                             {1000, 1, 0, 0},
                             {10000, 1, 0, 0},
                             {80000, 1, 0, 0}};
constexpr double thesis_cpu_sum_ms = 80284.528; // one query at a time, a K40c's host

Weights weights_of(const Solver &solver, const std::vector<uint64_t> &queries) {
    locus_weights *weights = nullptr;
    need(locus_weights_create_for(solver.diagram(), nullptr, queries.data(), queries.size(), &weights));
    return Weights(weights);
}

/// One in so many batches, once; the milliseconds that each took.
std::vector<double> run_batches(const Solver &solver, uint32_t voxels, uint32_t size, uint32_t one_in) {
    std::vector<double> times;
    for (uint32_t first = 0; first < voxels; first += size * one_in) {
        std::vector<uint64_t> queries(std::min(size, voxels - first));
        std::iota(queries.begin(), queries.end(), uint64_t{first});
        Weights weights;
        times.push_back(1e3 * timed([&] { weights = weights_of(solver, queries); }));
    }
    return times;
}

/// Mean, deviation and their standard errors; returns what all batches take.
double add_statistics(Notes &notes, const std::vector<double> &times, double batches) {
    const auto count = static_cast<double>(times.size());
    const double mean = std::accumulate(times.begin(), times.end(), 0.0) / count;
    double square = 0;
    for (const double time : times) {
        square += (time - mean) * (time - mean) / count;
    }
    notes.add("batches", batches);
    notes.add("mean_ms", mean);
    notes.add("sd_ms", std::sqrt(square));
    notes.add("sem_ms", std::sqrt(square / count));
    notes.add("ses_ms", std::sqrt(square * batches));
    return mean * batches;
}

/// The definition's rows of every `every`-th voxel against ours, and the milliseconds that all would take.
double naive_sum(Naive &naive, uint32_t voxels, uint32_t every, std::vector<Naive::Row> &rows) {
    rows.clear();
    const double seconds = timed([&] {
        for (uint32_t voxel = 0; voxel < voxels; voxel += every) {
            rows.push_back(naive.sibson(voxel));
        }
    });
    return 1e3 * seconds / static_cast<double>(rows.size()) * voxels;
}

void check_rows(Row &row, const Solver &solver, const Volume &volume, uint32_t every,
                const std::vector<Naive::Row> &rows) {
    std::vector<uint64_t> queries;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        queries.push_back(i * every);
    }
    std::vector<uint32_t> ids;
    for (const locus_seed &seed : volume.seeds) {
        ids.push_back(seed.id);
    }
    std::vector<float> ours(queries.size() * ids.size());
    need(locus_weights_dense(weights_of(solver, queries).get(), 0, queries.size(), ids.data(), ids.size(), ours.data(),
                             ours.size()));
    bool same = true;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        same = same && std::abs(static_cast<double>(ours[i]) - rows[i / ids.size()][i % ids.size()]) <= 1e-5;
    }
    row.check(same, "a row is not the definition's");
}

void batch_case(Row &row, const Printed &line) {
    const Volume volume = plate("constant", 20);
    const uint32_t every = row.quick ? 37 : 97; // voxels to one query that the definition is asked
    const uint32_t voxels = row.quick ? std::max(line.size, uint32_t{200}) : static_cast<uint32_t>(volume.voxels());
    Solver solver(volume, {"", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32});
    Notes unused;
    solver.solve(unused);
    Naive naive(volume, solver);
    std::vector<Naive::Row> rows;
    race(row, {{"",
                [&](Notes &notes) {
                    const std::vector<double> times = run_batches(solver, voxels, line.size, line.one_in);
                    return add_statistics(notes, times, std::ceil(static_cast<double>(voxels) / line.size));
                }},
               {"naive", [&](Notes &) { return naive_sum(naive, voxels, every, rows); }}});
    row.target = simd_name(solver.info().simd);
    check_rows(row, solver, volume, every, rows);
    row.extras["us_per_query"] = 1e3 * row.ours.median / voxels;
    row.extras["batches_one_in"] = line.one_in;
    row.extras["thesis_cpu_sum_ms"] = thesis_cpu_sum_ms;
    if (line.gpu_sum_ms > 0) {
        row.extras["thesis_gpu_mean_ms"] = line.gpu_mean_ms;
        row.extras["thesis_gpu_sum_ms"] = line.gpu_sum_ms;
    }
}

} // namespace

void add_thesis_weights(Cases &cases) {
    for (const Printed &line : table) {
        const char *name = line.gpu_sum_ms > 0 ? "thesis.table2.2.b" : "thesis.fig2.18.b"; // whose plots go on with it
        cases.push_back({name + std::to_string(line.size), "ms", {}, [&line](Row &row) { batch_case(row, line); }});
    }
}

} // namespace bench
