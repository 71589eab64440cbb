#include "graph/device/engine.hpp"

#include "graph/device/weights.hpp"

#include <mutex>

namespace locus::device {
namespace {

using graph::Change;
using graph::Graph;
using graph::NaturalJob;
using graph::Problem;
using graph::Report;
using graph::RowPile;
using graph::Words;

// The device is opened by the first solve. After a failure all that is on it is let go, and the next solve begins anew.
class DeviceEngine : public graph::Engine {
public:
    DeviceEngine(const Table &table, void *stream) : table_(table), stream_(stream) {}
    uint32_t backend() const override { return LOCUS_BACKEND_CUDA; }
    // One call at a time: others, of a progress callback too, find the device in use.
    bool natural_rows(const NaturalJob &job, std::vector<RowPile> &piles, Progress &progress) override {
        const std::unique_lock lock(use_, std::try_to_lock);
        if (!lock || making_rows_)
            return false;
        making_rows_ = true;
        const std::unique_ptr<bool, Clear> until_done(&making_rows_);
        with_field(job.field.graph(), Failure::may_pass, [&]<typename Word>(Device &device, Field<Word> &field) {
            if (!field.solved() && !taken_)
                field.take(job.field.words());
            taken_ = !field.solved();
            piles = sibson_rows(device, field, kept_, job, progress);
        });
        return true;
    }
    size_t bytes() const override {
        return kept_.bytes() + (narrow_ ? narrow_->bytes() : 0) + (wide_ ? wide_->bytes() : 0);
    }

protected:
    // may_pass: what the field holds outlives failures that are not the device's.
    enum class Failure { lets_go, may_pass };

    template <typename Run>
    void on_device(Failure failure, Run &&run) {
        try {
            if (!device_)
                device_ = std::make_unique<Device>(table_, stream_);
            return run(*device_);
        } catch (const Error &error) {
            const bool holds = (narrow_ && narrow_->solved()) || (wide_ && wide_->solved());
            if (failure == Failure::lets_go || error.status() == LOCUS_E_DEVICE || !holds)
                let_go();
            throw;
        } catch (...) {
            let_go();
            throw;
        }
    }
    // run(device, field), the field of the graph's words.
    template <typename Run>
    void with_field(const Graph &graph, Failure failure, Run &&run) {
        on_device(failure, [&](Device &device) {
            if (graph_ != &graph)
                forget();
            graph_ = &graph;
            graph.layout().bits == 32 ? run(device, made(device, narrow_)) : run(device, made(device, wide_));
        });
    }
    // run(field), that which solved.
    template <typename Run>
    void on_result(Run &&run) {
        const std::lock_guard lock(use_);
        if (narrow_ && narrow_->solved())
            run(*narrow_);
        else if (wide_ && wide_->solved())
            run(*wide_);
        else
            fail(LOCUS_E_STATE,
                 "the GPU failed after the diagram was solved: its result is in the host's memory alone");
    }
    // Wait for what is in the queue, unless that is the caller's to do.
    void finish() {
        if (stream_ == nullptr)
            device_->finish();
    }
    // Before the words change: those in a field are no more the latest, unless it makes the next ones.
    void forget_taken() { taken_ = false; }

private:
    struct Clear {
        void operator()(bool *flag) const { *flag = false; }
    };
    template <typename Word>
    Field<Word> &made(Device &device, std::unique_ptr<Field<Word>> &field) {
        if (!field)
            field = std::make_unique<Field<Word>>(device, *graph_);
        return *field;
    }
    void forget() {
        narrow_.reset();
        wide_.reset();
        taken_ = false;
    }
    void let_go() {
        forget();
        kept_ = {};
        device_.reset();
    }

    const Table &table_;
    void *stream_;
    std::unique_ptr<Device> device_; // goes after what is on it
    const Graph *graph_ = nullptr;
    std::unique_ptr<Field<uint32_t>> narrow_;
    std::unique_ptr<Field<uint64_t>> wide_;
    bool taken_ = false; // a field holds the latest words, which it has not solved
    Memory<uint64_t> kept_;
    std::recursive_mutex use_; // by calls that may come at the same time
    bool making_rows_ = false;
};

class DenseEngine final : public DeviceEngine {
public:
    DenseEngine(const Table &table, uint32_t kind, const Grain &grain, void *stream)
        : DeviceEngine(table, stream), kind_(kind), grain_(grain) {}
    uint32_t kind() const override { return kind_; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        Report report;
        forget_taken();
        on_device(Failure::lets_go,
                  [&](Device &device) { report = solve_dense(device, grain_, problem, words, progress); });
        return report;
    }

private:
    uint32_t kind_;
    Grain grain_;
};

class BrickEngine final : public DeviceEngine {
public:
    BrickEngine(const Table &table, void *stream, bool keeps) : DeviceEngine(table, stream), keeps_(keeps) {}
    uint32_t kind() const override { return LOCUS_ENGINE_BRICKS; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        Report report;
        forget_taken();
        with_field(problem.graph, Failure::lets_go,
                   [&](Device &, auto &field) { report = field.solve(problem, own(words), progress); });
        return report;
    }
    Report update(const Problem &problem, Words &words, Progress &progress, Change &change) override {
        bool can = false;
        Report report;
        with_field(problem.graph, Failure::lets_go, [&](Device &, auto &field) {
            can = field.can_update(problem, own(words));
            if (can)
                report = field.update(problem, own(words), progress, change);
            else if (keeps_) {
                forget_taken();
                report = field.solve(problem, nullptr, progress, &change);
            }
        });
        return can || keeps_ ? report : graph::Engine::update(problem, words, progress, change);
    }
    void fetch(Words &words) override {
        on_result([&](auto &field) { field.give(words); });
    }
    void write(const graph::Reading &reading, void *to) override {
        on_result([&](auto &field) {
            field.write(reading, to);
            finish();
        });
    }

private:
    // Where the engine is to leave the words.
    Words *own(Words &words) const { return keeps_ ? nullptr : &words; }

    bool keeps_;
};

} // namespace

std::unique_ptr<graph::Engine> make_engine(const Table &table, uint32_t kind, const Grain &grain, void *stream,
                                           bool keeps) {
    switch (kind) {
    case LOCUS_ENGINE_RELAX:
        return std::make_unique<DenseEngine>(table, kind, Grain{}, stream);
    case LOCUS_ENGINE_COMPACT:
        return std::make_unique<DenseEngine>(table, kind, grain, stream);
    default:
        return std::make_unique<BrickEngine>(table, stream, keeps);
    }
}

} // namespace locus::device
