#include "graph/device/dense_engine.hpp"

#include "graph/device/dense.hpp"
#include "graph/device/metric.hpp"
#include "graph/device/transfer.hpp"
#include "graph/lattice.hpp"

namespace locus::device {
namespace {

using graph::Graph;
using graph::Problem;
using graph::Report;

constexpr uint64_t iterations_between_looks = 16;

// What is on the device during one solve.
template <typename Word>
class DenseSolve {
public:
    DenseSolve(Device &device, const Grain &grain, const Problem &problem)
        : device_(device), problem_(problem), tables_(device, problem.graph),
          beyond_(beyond_of<Word>(problem.graph, problem.limit())) {
        const Graph &graph = problem.graph;
        const uint64_t voxels = graph.grid().voxels();
        import(graph);
        settled_ = device.allocate<Word>(voxels);
        estimate_ = device.allocate<Word>(voxels);
        mask_ = device.allocate<uint8_t>(voxels);
        active_ = device.allocate<uint64_t>(iterations_between_looks);
        if (grain[0] != 0)
            make_grains(graph.grid(), grain);
    }

    void run(Report &report, Progress &progress) {
        with_rule_of<Word>(problem_.graph, tables_, [&](const auto &rule, const Launch &launch) {
            launch_ = launch;
            start();
            iterate(rule, report, progress);
        });
        report.relaxations *= problem_.graph.grid().connectivity();
    }

    void give(graph::Words &words, Report &report) {
        std::vector<Word> fresh = graph::memory_of<Word>(words, problem_.graph.grid().voxels());
        device_.download(std::span<Word>(fresh), settled_.get(), problem_.graph.threads());
        const auto unreached = static_cast<Word>(problem_.graph.layout().unreached());
        uint64_t reached = 0;
        for (Word &word : fresh) {
            reached += word < beyond_ ? 1 : 0;
            word = word < beyond_ ? word : unreached;
        }
        report.clipped = reached < problem_.graph.passable_voxels();
        words = std::move(fresh);
    }

private:
    void import(const Graph &graph) {
        const uint64_t voxels = graph.grid().voxels();
        const Operands operands(graph);
        std::vector<float> values(voxels);
        for (uint64_t v = 0; v < voxels; ++v)
            values[v] = operands(v);
        operands_ = device_.copy_of(std::span<const float>(values));
        if (graph.cuts() == nullptr)
            return;
        std::vector<uint32_t> open(voxels);
        for (uint64_t v = 0; v < voxels; ++v)
            open[v] = graph.open_edges(v);
        open_ = device_.copy_of(std::span<const uint32_t>(open));
    }

    void make_grains(const graph::Grid &grid, const Grain &grain) {
        uint64_t all = 1;
        for (size_t a = 0; a < 3; ++a) {
            grains_.size[a] = grain[a];
            grains_.count[a] = (grid.dims()[a] + grain[a] - 1) / grain[a];
            all *= grains_.count[a];
        }
        grain_active_ = device_.allocate<uint8_t>(all);
        grain_list_ = device_.allocate<uint64_t>(all);
        grain_listed_ = device_.allocate<uint64_t>(1);
        grains_.active = grain_active_.get();
        grains_.list = grain_list_.get();
        grains_.listed = grain_listed_.get();
    }

    Dense dense() const {
        const graph::Grid &grid = problem_.graph.grid();
        return {{grid.nx(), grid.ny(), grid.nz()}, operands_.get(), open_.get(), classes_of(grid)};
    }
    template <typename T>
    void fill(const Memory<T> &to, T value, Kernel kernel) {
        Launch launch = launch_;
        launch.kernel = kernel;
        device_.launch(launch, Fill<T>{to.get(), value, to.count()}, to.count());
    }
    void clear(const Memory<uint8_t> &bytes) { fill(bytes, uint8_t{0}, Kernel::fill_bytes); }

    // Make the voxels active whose estimates fell, and tell their number to active_[slot].
    void update(uint64_t slot) {
        if (grain_active_.count() > 0)
            clear(grain_active_);
        const Update<Word> body{dense(), grains_, settled_.get(), estimate_.get(), mask_.get(), active_.get() + slot};
        Launch launch = launch_;
        launch.kernel = Kernel::update;
        device_.launch(launch, body, body.graph.voxels());
        if (grain_active_.count() > 0)
            device_.compact(grain_active_.get(), grain_active_.count(), grain_list_.get(), grain_listed_.get());
    }

    void start() {
        fill(settled_, beyond_, Kernel::fill_words);
        fill(estimate_, beyond_, Kernel::fill_words);
        clear(mask_);
        std::vector<uint64_t> voxels;
        std::vector<Word> seeds;
        for (const graph::Source &source : problem_.sources) {
            voxels.push_back(source.voxel);
            seeds.push_back(static_cast<Word>(problem_.graph.layout().pack(source.distance, source.label)));
        }
        source_voxels_ = device_.copy_of(std::span<const uint64_t>(voxels));
        source_words_ = device_.copy_of(std::span<const Word>(seeds));
        Launch launch = launch_;
        launch.kernel = Kernel::sow;
        device_.launch(launch,
                       Sow<Word>{estimate_.get(), source_voxels_.get(), source_words_.get(), seeds.size(), beyond_},
                       seeds.size());
    }

    // The counts come to the host once for many iterations; those after the last one find nothing to do.
    template <typename Rule>
    void iterate(const Rule &rule, Report &report, Progress &progress) {
        const Relax<Word, Rule> relax{dense(),         grains_,     rule,    settled_.get(),
                                      estimate_.get(), mask_.get(), beyond_, problem_.graph.layout().label_bits};
        const uint64_t most =
            grain_active_.count() > 0 ? grain_active_.count() * grains_.volume() : relax.graph.voxels();
        Launch launch = launch_;
        launch.kernel = Kernel::relax;
        std::vector<uint64_t> active(iterations_between_looks);
        for (;;) {
            device_.upload(active_.get(), std::span<const uint64_t>(std::vector<uint64_t>(active.size())));
            for (uint64_t i = 0; i < active.size(); ++i) {
                update(i);
                device_.launch(launch, relax, most);
            }
            device_.download(std::span<uint64_t>(active), active_.get());
            for (const uint64_t voxels : active) {
                if (voxels == 0)
                    return;
                report.relaxations += voxels;
                ++report.iterations;
                if (problem_.trace)
                    report.trace.push_back(voxels);
            }
            const auto done = static_cast<double>(report.iterations);
            progress.report(done / (done + 64));
        }
    }

    Device &device_;
    const Problem &problem_;
    RuleTables<Word> tables_;
    Word beyond_;
    Launch launch_{};
    Memory<float> operands_;
    Memory<uint32_t> open_;
    Memory<Word> settled_, estimate_;
    Memory<uint8_t> mask_;
    Memory<uint64_t> active_;
    Grains grains_{};
    Memory<uint8_t> grain_active_;
    Memory<uint64_t> grain_list_, grain_listed_;
    Memory<uint64_t> source_voxels_;
    Memory<Word> source_words_;
};

template <typename Word>
Report solve(Device &device, const Grain &grain, const Problem &problem, graph::Words &words, Progress &progress) {
    graph::Stopwatch watch;
    Report report;
    DenseSolve<Word> solving(device, grain, problem);
    report.seconds_import = watch.lap();
    solving.run(report, progress);
    report.seconds_solve = watch.lap();
    solving.give(words, report);
    report.seconds_export = watch.lap();
    return report;
}

} // namespace

Report solve_dense(Device &device, const Grain &grain, const Problem &problem, graph::Words &words,
                   Progress &progress) {
    return problem.graph.layout().bits == 32 ? solve<uint32_t>(device, grain, problem, words, progress)
                                             : solve<uint64_t>(device, grain, problem, words, progress);
}

} // namespace locus::device
