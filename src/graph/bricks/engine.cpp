// The brick engine: a graph's materials in bricks, kept between solves, and the words back in dense memory.
#include "graph/engines.hpp"

#include "graph/bricks/solver.hpp"
#include "graph/bricks/transfer.hpp"
#include "graph/lattice.hpp"

#include <atomic>
#include <optional>

namespace locus::bricks {
namespace {

using graph::Graph;
using graph::Problem;
using graph::Report;
using graph::Words;

// A graph in bricks.
template <typename Word>
class Field {
public:
    explicit Field(const Graph &graph) : graph_(graph), store_(Layout(graph.grid().dims())) {
        fill_words(static_cast<Word>(graph.layout().unreached()), store_[store_.outside()]);
        for (auto &row : store_[store_.outside()].row)
            std::fill_n(row.operand, kLanes, recipe_of<Word>(graph).impassable);
    }

    Report solve(const Problem &problem, Words &words, Progress &progress) {
        graph::Stopwatch watch;
        Report report;
        report.threads = threads();
        const Recipe<Word> recipe = recipe_of<Word>(graph_);
        const auto unreached = static_cast<Word>(graph_.layout().pack(problem.limit() + 1, 0));
        import(recipe, unreached);
        report.seconds_import = watch.lap();

        Solver<Word> solver(store_, recipe, blocked_, threads(), width_bits());
        for (const graph::Source &source : problem.sources)
            solver.lower(graph_.grid().place(source.voxel),
                         std::min(unreached, static_cast<Word>(graph_.layout().pack(source.distance, source.label))));
        solver.run(progress);
        report.seconds_solve = watch.lap();
        report.iterations = solver.visits();
        report.relaxations = solver.updates() * kWidth * graph_.grid().connectivity();

        report.clipped = give(unreached, words) < graph_.passable_voxels();
        report.seconds_export = watch.lap();
        return report;
    }

private:
    // A thread is worth its start for some dozens of bricks.
    unsigned threads() const {
        return static_cast<unsigned>(std::clamp<size_t>(store_.layout().count() / 64, 1, graph_.threads()));
    }

    // A visit should have about ten steps of the front to do.
    unsigned width_bits() const {
        return static_cast<unsigned>(std::bit_width(10 * graph_.smallest_weight())) - 1 + graph_.layout().label_bits;
    }

    template <typename Body>
    void for_bricks(Body &&body) {
        parallel_for(threads(), store_.layout().count(), 256, [&](uint64_t begin, uint64_t end) {
            for (uint64_t brick = begin; brick < end; ++brick)
                body(brick);
        });
    }

    // Materials are read again only where they may have changed.
    void import(const Recipe<Word> &recipe, Word unreached) {
        const bool stale = imported_ != graph_.version();
        if (stale) {
            imported_.reset();
            blocked_ = blocked_edges(graph_, store_.layout());
        }
        for_bricks([&](uint64_t brick) {
            fill_words(unreached, store_[brick]);
            if (stale)
                import_operands(graph_, store_.place(brick), recipe.impassable, store_[brick]);
        });
        imported_ = graph_.version();
    }

    // The words to dense memory, which is made ready before it changes; the number of reached voxels.
    uint64_t give(Word unreached, Words &words) {
        auto *dense = std::get_if<std::vector<Word>>(&words);
        std::vector<Word> fresh;
        if (dense == nullptr || dense->size() != graph_.grid().voxels()) {
            fresh.resize(graph_.grid().voxels());
            dense = &fresh;
        }
        std::atomic<uint64_t> reached{0};
        for_bricks([&](uint64_t brick) {
            reached += export_words(graph_, store_.place(brick), store_[brick], unreached, dense->data());
        });
        if (dense == &fresh)
            words = std::move(fresh);
        return reached;
    }

    const Graph &graph_;
    Store<Word> store_;
    BlockedBricks blocked_;
    std::optional<uint64_t> imported_; // the graph's version when its materials were read
};

class BrickEngine final : public graph::Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_BRICKS; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return problem.graph.layout().bits == 32 ? with(narrow_, problem, words, progress)
                                                 : with(wide_, problem, words, progress);
    }

private:
    template <typename Word>
    Report with(std::unique_ptr<Field<Word>> &field, const Problem &problem, Words &words, Progress &progress) {
        if (!field || graph_ != &problem.graph) {
            field.reset();
            field = std::make_unique<Field<Word>>(problem.graph);
            graph_ = &problem.graph;
        }
        return field->solve(problem, words, progress);
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
