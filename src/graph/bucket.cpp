// The bucket engine: Dial's algorithm over a multi-level bucket queue (spread.hpp).
#include "graph/engines.hpp"
#include "graph/spread.hpp"

namespace locus::graph {
namespace {

class BucketEngine final : public Engine {
public:
    uint32_t kind() const override { return LOCUS_ENGINE_BUCKET; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return solve_on_lattice(problem, words, progress, [](const Problem &p, auto &lattice, Progress &told) {
            return spread(p, lattice, told, true);
        });
    }
};

} // namespace

std::unique_ptr<Engine> make_bucket_engine() { return std::make_unique<BucketEngine>(); }

} // namespace locus::graph
