// The brick engine: a graph in bricks, kept from one solve or update to the next.
#include "graph/bricks/field.hpp"
#include "graph/engines.hpp"

namespace locus::bricks {
namespace {

using graph::Change;
using graph::Graph;
using graph::Problem;
using graph::Report;
using graph::Words;

class BrickEngine final : public graph::Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_BRICKS; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return with_field(problem.graph, [&](auto &field) { return field.solve(problem, words, progress); });
    }
    Report update(const Problem &problem, Words &words, Progress &progress, Change &change) override {
        return with_field(problem.graph, [&](auto &field) { return field.update(problem, words, progress, change); });
    }
    size_t bytes() const override { return narrow_ ? narrow_->bytes() : wide_ ? wide_->bytes() : 0; }

private:
    template <typename Run>
    Report with_field(const Graph &graph, Run &&run) {
        if (graph_ != &graph) {
            narrow_.reset();
            wide_.reset();
            graph_ = &graph;
        }
        return graph.layout().bits == 32 ? run(made(narrow_)) : run(made(wide_));
    }
    template <typename Word>
    Field<Word> &made(std::unique_ptr<Field<Word>> &field) {
        if (!field)
            field = std::make_unique<Field<Word>>(*graph_);
        return *field;
    }

    const Graph *graph_ = nullptr;
    std::unique_ptr<Field<uint32_t>> narrow_;
    std::unique_ptr<Field<uint64_t>> wide_;
};

} // namespace
} // namespace locus::bricks

namespace locus::graph {

std::unique_ptr<Engine> make_brick_engine() { return std::make_unique<bricks::BrickEngine>(); }

} // namespace locus::graph
