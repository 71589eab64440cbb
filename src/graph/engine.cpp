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

} // namespace

uint64_t next_distance(const Graph &graph, const Words &words) {
    return std::visit([&](const auto &each) { return next_distance_of(graph, each); }, words);
}

} // namespace locus::graph
