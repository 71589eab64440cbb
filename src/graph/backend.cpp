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
    Report update(const Problem &problem, Words &words, Progress &progress, Change &change) override {
        return attempt(problem.graph, [&] { return engine_->update(problem, words, progress, change); });
    }

private:
    template <typename Run>
    Report attempt(const Graph &graph, Run &&run) {
        if (engine_->backend() == LOCUS_BACKEND_CPU)
            return run();
        try {
            return run();
        } catch (const Error &error) {
            if (!device::is_devices_own(error))
                throw;
            graph.log(LOCUS_LOG_WARNING, (std::string("the CPU goes on without the GPU: ") + error.what()).c_str());
        }
        engine_ = engine_->kind() == LOCUS_ENGINE_BRICKS ? make_brick_engine() : make_relax_engine();
        return run();
    }

    std::unique_ptr<Engine> engine_;
};

} // namespace

std::unique_ptr<Engine> make_engine(const Graph &graph, const locus_diagram_options &options) {
    if (graph.backend() != LOCUS_BACKEND_CUDA || !on_device(options.engine))
        return make_engine(options.engine);
    const device::Grain grain = {options.grain[0], options.grain[1], options.grain[2]};
    auto engine = device::make_engine(*device::find().table, options.engine, grain, options.stream);
    if (graph.backend_forced())
        return engine;
    return std::make_unique<EngineWithSpare>(std::move(engine));
}

std::vector<RowPile> natural_rows_on_backend(const NaturalJob &job, Progress &progress) {
    const Graph &graph = job.field.graph();
    if (graph.backend() != LOCUS_BACKEND_CUDA || job.method != LOCUS_METHOD_SIBSON)
        return natural_rows(job, progress);
    try {
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
