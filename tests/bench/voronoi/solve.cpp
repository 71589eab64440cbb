// Engines on volumes.
#include "tests/bench/voronoi/solve.hpp"

#include "tests/bench/harness/clock.hpp"

#include <algorithm>
#include <memory>

namespace bench {
namespace {

constexpr double shortest_run = 0.03; // seconds: small volumes are solved again and again for as long

} // namespace

Solver::Solver(const Volume &volume, const Engine &engine) : engine_(engine), voxels_(volume.voxels()) {
    locus_graph_options options;
    need(locus_graph_options_init(&options, sizeof options));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        options.dims[axis] = volume.dims[axis];
        options.spacing[axis] = volume.spacing[axis];
    }
    options.word_bits = engine.word_bits;
    options.threads = engine.threads;
    options.backend = engine.backend;
    graph_ = make_graph(options, volume.compliance.data());
    locus_diagram_options how;
    need(locus_diagram_options_init(&how, sizeof how));
    how.engine = engine.engine;
    how.on_device = engine.on_device ? 1 : 0;
    std::copy(engine.grain.begin(), engine.grain.end(), how.grain);
    diagram_ = make_diagram(graph_, how);
    need(locus_diagram_add_seeds(diagram_.get(), volume.seeds.data(), volume.seeds.size()));
}

double Solver::solve(Notes &notes) {
    const double start = wall_seconds();
    std::vector<double> times, imports, exports;
    do {
        const double cpu = timed([&] { need(locus_diagram_solve(diagram_.get(), nullptr, nullptr)); });
        const locus_diagram_stats did = stats();
        const double wall = did.seconds_import + did.seconds_solve + did.seconds_export;
        times.push_back(1e3 * (engine_.threads == 1 && engine_.backend == LOCUS_BACKEND_CPU
                                   ? cpu * did.seconds_solve / wall
                                   : did.seconds_solve));
        imports.push_back(1e3 * did.seconds_import);
        exports.push_back(1e3 * did.seconds_export);
    } while (wall_seconds() - start < shortest_run);
    notes.add("import_ms", spread(imports).median);
    notes.add("export_ms", spread(exports).median);
    return spread(times).median;
}

locus_graph_info Solver::info() const {
    locus_graph_info info{};
    info.struct_size = sizeof info;
    need(locus_graph_get_info(graph_.get(), &info));
    return info;
}

locus_diagram_stats Solver::stats() const {
    locus_diagram_stats stats{};
    stats.struct_size = sizeof stats;
    need(locus_diagram_get_stats(diagram_.get(), &stats));
    return stats;
}

std::vector<uint32_t> Solver::labels() const {
    std::vector<uint32_t> out(voxels_);
    need(locus_diagram_labels(diagram_.get(), nullptr, out.data(), out.size()));
    return out;
}

std::vector<uint64_t> Solver::exact_distances() const {
    std::vector<uint64_t> out(voxels_);
    need(locus_diagram_distances_exact(diagram_.get(), nullptr, out.data(), out.size()));
    return out;
}

std::vector<float> Solver::distances() const {
    std::vector<float> out(voxels_);
    need(locus_diagram_distances(diagram_.get(), nullptr, out.data(), out.size()));
    return out;
}

uint32_t Solver::edge_weight(uint64_t u, uint64_t v) const {
    uint64_t steps = 0;
    need(locus_graph_edge_weight(graph_.get(), u, v, &steps));
    return static_cast<uint32_t>(steps);
}

bool has_gpu(std::string *why) {
    locus_graph_options options;
    need(locus_graph_options_init(&options, sizeof options));
    options.dims[0] = options.dims[1] = options.dims[2] = 1;
    options.backend = LOCUS_BACKEND_CUDA;
    const float material = 1;
    locus_graph *graph = nullptr;
    const bool there = locus_graph_create(&options, &material, &graph) == LOCUS_OK;
    locus_graph_destroy(graph);
    if (!there && why != nullptr) {
        *why = locus_last_error();
    }
    return there;
}

const char *simd_name(uint32_t simd) {
    switch (simd) {
    case LOCUS_SIMD_SCALAR:
        return "scalar";
    case LOCUS_SIMD_SSE4:
        return "sse4";
    case LOCUS_SIMD_AVX2:
        return "avx2";
    case LOCUS_SIMD_AVX512:
        return "avx512";
    case LOCUS_SIMD_NEON:
        return "neon";
    default:
        return "auto";
    }
}

bool same_diagram(const Solver &a, const Solver &b) {
    return a.labels() == b.labels() && a.exact_distances() == b.exact_distances();
}

void race_engines(Row &row, const Volume &volume, const std::vector<Engine> &engines) {
    std::vector<std::unique_ptr<Solver>> solvers;
    std::vector<Contestant> contestants;
    for (const Engine &engine : engines) {
        solvers.push_back(std::make_unique<Solver>(volume, engine));
        contestants.push_back(
            {engine.peer, [solver = solvers.back().get()](Notes &notes) { return solver->solve(notes); }});
    }
    race(row, contestants);
    row.threads = engines.front().threads;
    row.target = simd_name(solvers.front()->info().simd);
    row.extras["word_bits"] = solvers.front()->info().word_bits;
    row.extras["voxels"] = static_cast<double>(solvers.front()->info().passable);
    // The heap is the oracle: the contestant where it has the same words, else one for the occasion.
    for (const std::unique_ptr<Solver> &solver : solvers) {
        const uint32_t bits = solver->info().word_bits;
        const auto contestant = std::find_if(solvers.begin(), solvers.end(), [&](const auto &other) {
            return other->stats().engine == LOCUS_ENGINE_HEAP && other->info().word_bits == bits;
        });
        std::unique_ptr<Solver> own;
        if (contestant == solvers.end()) {
            own = std::make_unique<Solver>(volume, Engine{"", LOCUS_ENGINE_HEAP, 1, bits});
            Notes unused;
            own->solve(unused);
        }
        row.check(same_diagram(*solver, own ? *own : **contestant),
                  (solver->peer().empty() ? "ours" : solver->peer()) + " has another diagram than the heap");
    }
}

} // namespace bench
