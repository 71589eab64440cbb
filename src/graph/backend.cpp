// Diagrams on the backend of their graph. Where it was not asked for by name, the CPU goes on when the GPU fails.
#include "core/error.hpp"
#include "graph/device/engine.hpp"
#include "graph/device/weights.hpp"
#include "graph/engine.hpp"
#include "graph/engines.hpp"
#include "graph/weights/natural.hpp"

#include <locus/weights.h>

#include <string>

namespace locus::graph {
namespace {

bool on_device(uint32_t kind) {
    return kind == LOCUS_ENGINE_AUTO || kind == LOCUS_ENGINE_BRICKS || kind == LOCUS_ENGINE_RELAX ||
           kind == LOCUS_ENGINE_COMPACT;
}

class EngineWithSpare final : public Engine {
public:
    explicit EngineWithSpare(std::unique_ptr<Engine> first) : engine_(std::move(first)) {}

    uint32_t kind() const override { return engine_->kind(); }
    uint32_t backend() const override { return engine_->backend(); }
    size_t bytes() const override { return engine_->bytes(); }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return attempt(problem.graph, [&] { return engine_->solve(problem, words, progress); });
    }
    // Where the GPU takes the only words with it that what changed could be told from, all counts as changed.
    Report update(const Problem &problem, Words &words, Progress &progress, Change &change) override {
        const bool alone = engine_->backend() == LOCUS_BACKEND_CUDA && kept_ && !problem.anew;
        Report report = attempt(problem.graph, [&] { return engine_->update(problem, words, progress, change); });
        if (alone && engine_->backend() == LOCUS_BACKEND_CPU)
            change = {problem.graph.grid().voxels(), problem.graph.grid().whole()};
        return report;
    }
    void fetch(Words &words) override {
        engine_->fetch(words);
        kept_ = false;
    }
    void write(const Reading &reading, void *to) override { engine_->write(reading, to); }
    bool natural_rows(const NaturalJob &job, std::vector<RowPile> &piles, Progress &progress) override {
        return engine_->natural_rows(job, piles, progress);
    }

private:
    template <typename Run>
    Report attempt(const Graph &graph, Run &&run) {
        if (engine_->backend() == LOCUS_BACKEND_CPU)
            return run();
        try {
            Report report = run();
            kept_ = report.kept.has_value();
            return report;
        } catch (const Error &error) {
            if (!device::is_devices_own(error))
                throw;
            graph.log(LOCUS_LOG_WARNING, (std::string("the CPU goes on without the GPU: ") + error.what()).c_str());
        }
        engine_ = engine_->kind() == LOCUS_ENGINE_BRICKS ? make_brick_engine() : make_relax_engine();
        return run();
    }

    std::unique_ptr<Engine> engine_;
    bool kept_ = false; // the words of the latest result are nowhere else
};

} // namespace

std::unique_ptr<Engine> make_engine(const Graph &graph, const locus_diagram_options &options) {
    if (graph.backend() != LOCUS_BACKEND_CUDA || !on_device(options.engine))
        return make_engine(options.engine);
    const device::Grain grain = {options.grain[0], options.grain[1], options.grain[2]};
    auto engine =
        device::make_engine(*device::find().table, options.engine, grain, options.stream, options.on_device != 0);
    if (graph.backend_forced())
        return engine;
    return std::make_unique<EngineWithSpare>(std::move(engine));
}

std::vector<RowPile> natural_rows_on_backend(const NaturalJob &job, Progress &progress) {
    const Graph &graph = job.field.graph();
    if (graph.backend() != LOCUS_BACKEND_CUDA || job.method != LOCUS_METHOD_SIBSON)
        return natural_rows(job, progress);
    try {
        std::vector<RowPile> piles;
        if (job.engine != nullptr && job.engine->natural_rows(job, piles, progress))
            return piles;
        device::Device gpu(*device::find().table, job.stream);
        return device::sibson_rows(gpu, job, progress);
    } catch (const Error &error) {
        if (graph.backend_forced() || !device::is_devices_own(error))
            throw;
        graph.log(LOCUS_LOG_WARNING, (std::string("the CPU goes on without the GPU: ") + error.what()).c_str());
    }
    return natural_rows(job, progress);
}

} // namespace locus::graph
