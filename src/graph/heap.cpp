// Dijkstra with std::priority_queue: plain on purpose, the oracle of every other engine.
#include "graph/engines.hpp"
#include "graph/lattice.hpp"

#include <functional>
#include <queue>

namespace locus::graph {
namespace {

template <typename Word, typename Place>
struct Entry {
    Word word;
    Place place;
    bool operator>(const Entry &other) const { return word > other.word; }
};

template <typename Word, typename Place>
Report dijkstra(const Problem &problem, Lattice<Word, Place> &lattice, Progress &progress) {
    const WordLayout &layout = problem.graph.layout();
    const auto limit = static_cast<Word>(layout.pack(problem.limit(), layout.labels() - 1));
    const auto all = static_cast<double>(problem.graph.passable_voxels());
    Report report;
    Word *words = lattice.words().data();
    std::priority_queue<Entry<Word, Place>, std::vector<Entry<Word, Place>>, std::greater<>> queue;
    for (const Source &source : problem.sources) {
        const Place place = lattice.place(source.voxel);
        const auto word = static_cast<Word>(layout.pack(source.distance, source.label));
        if (word >= words[place] || word > limit)
            continue;
        words[place] = word;
        queue.push({word, place});
    }
    with_weights(lattice, [&](auto from) {
        while (!queue.empty()) {
            const Entry<Word, Place> nearest = queue.top();
            queue.pop();
            if (nearest.word != words[nearest.place])
                continue; // it was improved after this entry
            if (++report.iterations % 4096 == 0)
                progress.report(static_cast<double>(report.iterations) / all);
            relax(nearest.word, nearest.place, words, lattice.hops(), from, layout.label_bits, limit, report.clipped,
                  [&](uint64_t next, Word, Word word) {
                      queue.push({word, static_cast<Place>(next)});
                  });
        }
    });
    report.relaxations = report.iterations * lattice.hops().size();
    return report;
}

class HeapEngine final : public Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_HEAP; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return solve_on_lattice(problem, words, progress, [](const Problem &p, auto &lattice, Progress &told) {
            return dijkstra(p, lattice, told);
        });
    }
};

} // namespace

std::unique_ptr<Engine> make_heap_engine() { return std::make_unique<HeapEngine>(); }

} // namespace locus::graph
