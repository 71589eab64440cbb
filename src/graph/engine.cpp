// The engines by name, and the check for distances that words cannot hold.
#include "graph/engine.hpp"

#include "core/error.hpp"
#include "graph/engines.hpp"

namespace locus::graph {

std::unique_ptr<Engine> make_engine(uint32_t kind) {
    switch (kind) {
    case LOCUS_ENGINE_HEAP:
        return make_heap_engine();
    case LOCUS_ENGINE_AUTO:
    case LOCUS_ENGINE_BRICKS:
        return make_brick_engine();
    case LOCUS_ENGINE_BUCKET:
        return make_bucket_engine();
    case LOCUS_ENGINE_RELAX:
        return make_relax_engine();
    case LOCUS_ENGINE_COMPACT:
        fail(LOCUS_E_UNSUPPORTED, "options->engine is LOCUS_ENGINE_COMPACT, which only the CUDA backend has");
    default:
        fail(LOCUS_E_ARGUMENT, "options->engine is ", kind, ", not one of LOCUS_ENGINE_");
    }
}

namespace {

template <typename Word>
uint64_t next_distance_of(const Graph &graph, const std::vector<Word> &words) {
    const WordLayout &layout = graph.layout();
    uint64_t next = UINT64_MAX;
    for (uint64_t v = 0; v < words.size(); ++v) {
        if (layout.reached(words[v]) || !graph.passable(v))
            continue;
        const uint32_t inside = graph.grid().inside(graph.grid().place(v));
        for (const Neighbour &to : graph.grid().neighbours()) {
            if ((inside >> to.number & 1) == 0)
                continue;
            const uint64_t word = words[v + static_cast<uint64_t>(to.step)];
            if (!layout.reached(word))
                continue;
            const uint64_t weight = graph.weight(v, to);
            if (weight > 0)
                next = std::min(next, layout.distance(word) + weight);
        }
    }
    return next;
}

template <typename Word>
Change difference_of(const Graph &graph, const std::vector<Word> &before, const std::vector<Word> &after) {
    uint64_t changed = 0;
    std::array<uint64_t, 3> first = graph.grid().dims(), last{};
    for (uint64_t v = 0; v < after.size(); ++v) {
        if (after[v] == (before.empty() ? static_cast<Word>(graph.layout().unreached()) : before[v]))
            continue;
        ++changed;
        const auto place = graph.grid().place(v);
        for (size_t axis = 0; axis < 3; ++axis) {
            first[axis] = std::min(first[axis], place[axis]);
            last[axis] = std::max(last[axis], place[axis]);
        }
    }
    return change_between(changed, first, last);
}

Change difference(const Graph &graph, const Words &before, const Words &after) {
    return std::visit(
        [&](const auto &now) {
            using Dense = std::remove_cvref_t<decltype(now)>;
            const auto *then = std::get_if<Dense>(&before);
            return difference_of(graph, then != nullptr ? *then : Dense{}, now);
        },
        after);
}

} // namespace

Report Engine::update(const Problem &problem, Words &words, Progress &progress, Change &change) {
    Words fresh;
    const Report report = solve(problem, fresh, progress);
    change = difference(problem.graph, words, fresh);
    words = std::move(fresh);
    return report;
}

void Engine::write(const Reading &, void *) {
    fail(LOCUS_E_UNSUPPORTED, "the diagram was solved ",
         backend() == LOCUS_BACKEND_CPU ? "on the CPU" : "by an engine that leaves nothing on the GPU",
         ": its result is in the host's memory alone");
}

uint64_t next_distance(const Graph &graph, const Words &words) {
    return std::visit([&](const auto &each) { return next_distance_of(graph, each); }, words);
}

} // namespace locus::graph
