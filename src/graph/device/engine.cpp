#include "graph/device/engine.hpp"

#include "graph/device/field.hpp"

namespace locus::device {
namespace {

using graph::Change;
using graph::Graph;
using graph::Problem;
using graph::Report;
using graph::Words;

// The device is opened by the first solve. After a failure all that is on it is let go, and the next solve begins anew.
class DeviceEngine : public graph::Engine {
public:
    DeviceEngine(const Table &table, void *stream) : table_(table), stream_(stream) {}
    uint32_t backend() const override { return LOCUS_BACKEND_CUDA; }

protected:
    template <typename Run>
    Report on_device(Run &&run) {
        try {
            if (!device_)
                device_ = std::make_unique<Device>(table_, stream_);
            return run(*device_);
        } catch (...) {
            forget();
            device_.reset();
            throw;
        }
    }
    virtual void forget() {}
    // Wait for what is in the queue, unless that is the caller's to do.
    void finish() {
        if (stream_ == nullptr)
            device_->finish();
    }

private:
    const Table &table_;
    void *stream_;
    std::unique_ptr<Device> device_;
};

class DenseEngine final : public DeviceEngine {
public:
    DenseEngine(const Table &table, uint32_t kind, const Grain &grain, void *stream)
        : DeviceEngine(table, stream), kind_(kind), grain_(grain) {}
    uint32_t kind() const override { return kind_; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return on_device([&](Device &device) { return solve_dense(device, grain_, problem, words, progress); });
    }

private:
    uint32_t kind_;
    Grain grain_;
};

class BrickEngine final : public DeviceEngine {
public:
    BrickEngine(const Table &table, void *stream, bool keeps) : DeviceEngine(table, stream), keeps_(keeps) {}
    ~BrickEngine() override { forget(); } // before the device goes
    uint32_t kind() const override { return LOCUS_ENGINE_BRICKS; }
    Report solve(const Problem &problem, Words &words, Progress &progress) override {
        return with_field(problem.graph, [&](auto &field) { return field.solve(problem, own(words), progress); });
    }
    Report update(const Problem &problem, Words &words, Progress &progress, Change &change) override {
        bool can = false;
        with_field(problem.graph, [&](auto &field) {
            can = field.can_update(problem, own(words));
            if (can)
                return field.update(problem, own(words), progress, change);
            return keeps_ ? field.solve(problem, nullptr, progress, &change) : Report{};
        });
        return can || keeps_ ? last_ : graph::Engine::update(problem, words, progress, change);
    }
    void fetch(Words &words) override {
        on_result([&](auto &field) { field.give(words); });
    }
    void write(const graph::Reading &reading, void *to) override {
        on_result([&](auto &field) { field.write(reading, to); });
        finish();
    }
    size_t bytes() const override { return narrow_ ? narrow_->bytes() : wide_ ? wide_->bytes() : 0; }

private:
    // Where the engine is to leave the words.
    Words *own(Words &words) const { return keeps_ ? nullptr : &words; }
    template <typename Run>
    void on_result(Run &&run) {
        if (narrow_ && narrow_->solved())
            run(*narrow_);
        else if (wide_ && wide_->solved())
            run(*wide_);
        else
            fail(LOCUS_E_STATE,
                 "the GPU failed after the diagram was solved: its result is in the host's memory alone");
    }
    void forget() override {
        narrow_.reset();
        wide_.reset();
    }
    template <typename Run>
    Report with_field(const Graph &graph, Run &&run) {
        last_ = on_device([&](Device &device) {
            if (graph_ != &graph)
                forget();
            graph_ = &graph;
            return graph.layout().bits == 32 ? run(made(device, narrow_)) : run(made(device, wide_));
        });
        return last_;
    }
    template <typename Word>
    Field<Word> &made(Device &device, std::unique_ptr<Field<Word>> &field) {
        if (!field)
            field = std::make_unique<Field<Word>>(device, *graph_);
        return *field;
    }

    bool keeps_;
    const Graph *graph_ = nullptr;
    std::unique_ptr<Field<uint32_t>> narrow_;
    std::unique_ptr<Field<uint64_t>> wide_;
    Report last_;
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
