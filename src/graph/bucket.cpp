// Dijkstra with buckets (Dial 1969) as wide as the smallest edge weight allows: nothing in a bucket can then improve
// anything in the same bucket, so its voxels may be settled in any order (Denardo and Fox 1979).
#include "graph/bucket_queue.hpp"
#include "graph/engines.hpp"
#include "graph/lattice.hpp"

#include <bit>

namespace locus::graph {
namespace {

// A voxel whose word falls within its bucket needs no new entry, as the one that brought it there is still queued.
template <typename Word, typename Place>
Report spread(const Problem &problem, Lattice<Word, Place> &lattice, Progress &progress) {
    const WordLayout &layout = problem.graph.layout();
    const auto limit = static_cast<Word>(layout.pack(problem.limit(), layout.labels() - 1));
    const auto all = static_cast<double>(problem.graph.passable_voxels());
    const auto shift = layout.label_bits + static_cast<uint32_t>(std::bit_width(problem.graph.smallest_weight()) - 1);
    Report report;
    Word *words = lattice.words().data();
    const auto key_of = [&](Place place) { return static_cast<uint64_t>(words[place] >> shift); };
    BucketQueue<Place> queue;
    for (const Source &source : problem.sources) {
        const Place place = lattice.place(source.voxel);
        const auto word = static_cast<Word>(layout.pack(source.distance, source.label));
        if (word >= words[place] || word > limit)
            continue;
        words[place] = word;
        queue.push(key_of(place), place);
    }
    uint64_t settled = 0;
    with_weights(lattice, [&](auto from) {
        std::vector<Place> bucket;
        while (queue.pop(bucket, key_of)) {
            const uint64_t before = settled;
            for (const Place place : bucket) {
                if (key_of(place) != queue.last())
                    continue; // it was improved into an earlier bucket
                ++settled;
                relax(words[place], place, words, lattice.hops(), from, layout.label_bits, limit, report.clipped,
                      [&](uint64_t next, Word old, Word word) {
                          if (old >> shift != word >> shift)
                              queue.push(word >> shift, static_cast<Place>(next));
                      });
            }
            if (settled == before)
                continue;
            ++report.iterations;
            if (problem.trace)
                report.trace.push_back(settled - before);
            progress.report(static_cast<double>(settled) / all);
        }
    });
    report.relaxations = settled * lattice.hops().size();
    return report;
}

class BucketEngine final : public Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_BUCKET; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return solve_on_lattice(problem, words, progress, [](const Problem &p, auto &lattice, Progress &told) {
            return spread(p, lattice, told);
        });
    }
};

} // namespace

std::unique_ptr<Engine> make_bucket_engine() { return std::make_unique<BucketEngine>(); }

} // namespace locus::graph
