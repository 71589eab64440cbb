// thesis.table2.1 and thesis.fig2.11: the thesis' inputs of its Voronoi benchmarks, its printed numbers beside ours.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/voronoi/solve.hpp"

#include <cmath>

namespace bench {
namespace {

/// A line of table 2.1: Intel i7 930, one thread, against a GTX 480; milliseconds.
struct Printed {
    const char *input;
    std::size_t seeds;
    double cpu_ms, gpu_ms, gpu_iterations;
};

constexpr Printed table[] = {
    {"cube32.gradient", 10, 32.24, 1.96, 30},
    {"cube64.gradient", 10, 296.77, 12.13, 70},
    {"cube128.gradient", 10, 3863.54, 105.91, 126},
    {"cube256.gradient", 10, 38756.80, 985.80, 195},
    {"plate.gradient", 20, 77.04, 2.51, 21},
    {"cube32.constant", 10, 21.37, 1.27, 20},
    {"cube64.constant", 10, 190.81, 9.20, 52},
    {"cube128.constant", 10, 1957.65, 61.85, 79},
    {"cube256.constant", 10, 22103.64, 812.03, 159},
    {"plate.constant", 20, 52.31, 2.47, 22},
    {"steak", 3, 10.80, 2.16, 38},
    {"steak", 10, 10.39, 2.72, 45},
};

Volume input_of(const Printed &line, bool quick) {
    const std::string name = line.input;
    if (name == "steak") {
        return steak(line.seeds);
    }
    const std::string topology = name.substr(name.find('.') + 1);
    if (name[0] == 'p') {
        return plate(topology, line.seeds);
    }
    return cube(topology, quick ? 24 : std::stoul(name.substr(4)), line.seeds);
}

void table_case(Row &row, const Printed &line) {
    const Volume volume = input_of(line, row.quick);
    const uint32_t words = line.input[0] == 's' ? LOCUS_WORD_AUTO : LOCUS_WORD_32;
    race_engines(row, volume, {{"", LOCUS_ENGINE_AUTO, 1, words}, {"heap", LOCUS_ENGINE_HEAP, 1, words}});
    // The thesis' own algorithm, for its number of iterations.
    Solver relax(volume, {"relax", LOCUS_ENGINE_RELAX, 1, words});
    Notes notes;
    row.extras["relax_ms"] = relax.solve(notes);
    row.extras["relax_iterations"] = static_cast<double>(relax.stats().iterations);
    if (has_gpu()) {
        Solver base(volume, {"base", LOCUS_ENGINE_RELAX, 1, words, LOCUS_BACKEND_CUDA});
        Solver bricks(volume, {"gpu", LOCUS_ENGINE_BRICKS, 1, words, LOCUS_BACKEND_CUDA});
        for (Solver *const gpu : {&base, &bricks}) {
            gpu->solve(notes); // the first one waits for the device
            row.extras[gpu == &base ? "gpu_base_ms" : "gpu_ms"] = gpu->solve(notes);
            row.check(same_diagram(*gpu, relax), "another diagram on the GPU");
        }
        row.extras["gpu_base_iterations"] = static_cast<double>(base.stats().iterations);
    }
    row.extras["thesis_cpu_ms"] = line.cpu_ms;
    row.extras["thesis_gpu_ms"] = line.gpu_ms;
    row.extras["thesis_gpu_iterations"] = line.gpu_iterations;
    row.extras["thesis_gpu_over_ours"] = line.gpu_ms / row.ours.median;
}

/// Figure 2.11: the speed-up over the heap by the number of seeds, each over 10 random placements.
void seeds_case(Row &row, std::size_t seeds) {
    Volume volume = cube("gradient", row.quick ? 32 : 128, seeds);
    std::vector<double> ours, heap, speedups;
    Notes notes;
    for (uint64_t placement = 1; placement <= (row.quick ? 2U : 10U); ++placement) {
        scatter_seeds(volume, seeds, placement);
        Solver mine(volume, {"", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32});
        Solver oracle(volume, {"heap", LOCUS_ENGINE_HEAP, 1, LOCUS_WORD_32});
        mine.solve(notes); // the first touch of the memory is not timed
        oracle.solve(notes);
        ours.push_back(mine.solve(notes));
        heap.push_back(oracle.solve(notes));
        speedups.push_back(heap.back() / ours.back());
        row.check(same_diagram(mine, oracle), "another diagram than the heap, placement " + std::to_string(placement));
        row.target = simd_name(mine.info().simd);
    }
    row.ours = spread(ours);
    row.peers["heap"] = spread(heap);
    double mean = 0, square = 0;
    for (const double speedup : speedups) {
        mean += speedup / static_cast<double>(speedups.size());
        square += speedup * speedup / static_cast<double>(speedups.size());
    }
    row.extras["speedup_mean"] = mean;
    row.extras["speedup_deviation"] = std::sqrt(std::max(0.0, square - mean * mean));
}

} // namespace

void add_thesis_chapter2(Cases &cases) {
    for (const Printed &line : table) {
        cases.push_back({"thesis.table2.1." + std::string(line.input) + ".s" + std::to_string(line.seeds),
                         "ms",
                         {},
                         [&line](Row &row) { table_case(row, line); }});
    }
    for (std::size_t seeds = 1; seeds <= 64; seeds *= 2) {
        cases.push_back(
            {"thesis.fig2.11.s" + std::to_string(seeds), "ms", {}, [seeds](Row &row) { seeds_case(row, seeds); }});
    }
}

} // namespace bench
