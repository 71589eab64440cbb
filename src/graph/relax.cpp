// The thesis' base algorithm (sections 2.4.1 to 2.4.3, algorithms 2.2 to 2.4) on the CPU: in each iteration every
// active voxel lowers its neighbours' estimates (relax), and the voxels that were lowered become the active ones
// (update). The active voxels stand in a list instead of a mask over the volume; their number per iteration is that of
// figure 2.10.
#include "graph/engines.hpp"
#include "graph/lattice.hpp"

namespace locus::graph {
namespace {

template <typename Word, typename Place>
Report iterate(const Problem &problem, Lattice<Word, Place> &lattice, Progress &progress) {
    const WordLayout &layout = problem.graph.layout();
    const auto limit = static_cast<Word>(layout.pack(problem.limit(), layout.labels() - 1));
    Report report;
    std::vector<Word> &settled = lattice.words(); // C0 of the thesis
    std::vector<Word> estimate = settled;         // C1
    std::vector<Place> active;
    std::vector<Place> lowered;
    for (const Source &source : problem.sources) {
        const Place place = lattice.place(source.voxel);
        const auto word = static_cast<Word>(layout.pack(source.distance, source.label));
        if (word >= estimate[place] || word > limit)
            continue;
        if (estimate[place] == settled[place])
            lowered.push_back(place);
        estimate[place] = word;
    }
    uint64_t relaxed = 0;
    with_weights(lattice, [&](auto from) {
        for (;;) {
            for (const Place place : lowered)
                settled[place] = estimate[place];
            active.swap(lowered);
            lowered.clear();
            if (active.empty())
                break;
            for (const Place place : active) {
                relax(settled[place], place, estimate.data(), lattice.hops(), from, layout.label_bits, limit,
                      report.clipped, [&](uint64_t next, Word old, Word) {
                          if (old == settled[next])
                              lowered.push_back(static_cast<Place>(next));
                      });
            }
            relaxed += active.size();
            ++report.iterations;
            if (problem.trace)
                report.trace.push_back(active.size());
            // How many iterations there will be is not known: approach 1 as they go by.
            const auto done = static_cast<double>(report.iterations);
            progress.report(done / (done + 64));
        }
    });
    report.relaxations = relaxed * lattice.hops().size();
    return report;
}

class RelaxEngine final : public Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_RELAX; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return solve_on_lattice(problem, words, progress, [](const Problem &p, auto &lattice, Progress &told) {
            return iterate(p, lattice, told);
        });
    }
};

} // namespace

std::unique_ptr<Engine> make_relax_engine() { return std::make_unique<RelaxEngine>(); }

} // namespace locus::graph
