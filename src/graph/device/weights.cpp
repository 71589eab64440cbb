#include "graph/device/weights.hpp"

#include "graph/device/metric.hpp"
#include "graph/device/sibson.hpp"
#include "graph/device/transfer.hpp"

#include <algorithm>

namespace locus::device {
namespace {

using graph::Graph;
using graph::NaturalJob;
using graph::RawShare;
using graph::RowPile;

constexpr uint64_t first_margin = 12; // voxels around a query that its window holds, until that proves too small
constexpr uint64_t queries_at_once = 1 << 16; // of a launch
constexpr uint64_t labels_expected = 16;      // that a query steals from, on average

struct Query {
    uint64_t voxel;
    uint64_t row;
};

template <typename Word>
class Batches {
public:
    Batches(Device &device, const NaturalJob &job)
        : device_(device), job_(job), graph_(job.field.graph()), tables_(device, graph_) {
        import();
        all_windows_ = *std::max_element(graph_.grid().dims().begin(), graph_.grid().dims().end());
    }

    std::vector<RowPile> run(Progress &progress) {
        std::vector<Query> left = searched();
        const auto all = static_cast<double>(left.size());
        uint64_t margin = first_margin;
        with_rule_of<Word>(graph_, tables_, [&](const auto &rule, const Launch &launch) {
            while (!left.empty()) {
                make_scratch(rule, launch, margin, left.size());
                std::vector<Query> too_small;
                while (!left.empty()) {
                    answer(rule, launch, margin, left, too_small);
                    progress.report(1 - static_cast<double>(left.size() + too_small.size()) / all);
                }
                left = std::move(too_small);
                margin += margin / 2;
            }
        });
        std::vector<RowPile> piles;
        piles.push_back(std::move(pile_));
        return piles;
    }

private:
    // The field as it was solved, once for all queries.
    void import() {
        const uint64_t voxels = graph_.grid().voxels();
        const Operands operands(graph_);
        std::vector<float> values(voxels);
        for (uint64_t v = 0; v < voxels; ++v) {
            values[v] = operands(v);
            if (job_.field.reached(v))
                labels_ = std::max<uint64_t>(labels_, job_.field.label(v) + uint64_t{1});
        }
        operands_ = device_.copy_of(std::span<const float>(values));
        words_ = device_.copy_of(std::span<const Word>(std::get<std::vector<Word>>(job_.field.words())));
        if (graph_.cuts() == nullptr)
            return;
        std::vector<uint32_t> open(voxels);
        for (uint64_t v = 0; v < voxels; ++v)
            open[v] = graph_.open_edges(v);
        open_ = device_.copy_of(std::span<const uint32_t>(open));
    }

    // The queries that can steal something; the rows of the others are known.
    std::vector<Query> searched() {
        std::vector<Query> queries;
        const auto take = [&](uint64_t row) {
            const uint64_t voxel = job_.voxels[row];
            if (job_.field.reached(voxel) && job_.field.distance(voxel) != 0)
                return queries.push_back({voxel, row});
            row_.clear();
            if (job_.field.reached(voxel))
                row_.push_back({job_.field.label(voxel), 1});
            close(row);
        };
        if (job_.rows.empty())
            for (uint64_t row = 0; row < job_.voxels.size(); ++row)
                take(row);
        else
            std::for_each(job_.rows.begin(), job_.rows.end(), take);
        std::reverse(queries.begin(), queries.end()); // they are taken from the end
        return queries;
    }
    void close(uint64_t row) {
        finish_row(row_, job_.most, pile_.shares);
        pile_.close(row);
    }

    template <typename T>
    void fill(const Memory<T> &to, T value) {
        Launch launch{};
        launch.kernel = Kernel::fill_words;
        launch.word_bits = 8 * sizeof(T);
        device_.launch(launch, Fill<T>{to.get(), value, to.count()}, to.count());
    }

    template <typename Rule>
    Sibson<Word, Rule> body(const Rule &rule) const {
        Sibson<Word, Rule> sibson{};
        const graph::Grid &grid = graph_.grid();
        sibson.graph = {{grid.nx(), grid.ny(), grid.nz()}, operands_.get(), open_.get(), classes_of(grid)};
        sibson.rule = rule;
        sibson.words = words_.get();
        sibson.unreached = static_cast<Word>(graph_.layout().unreached());
        sibson.label_bits = graph_.layout().label_bits;
        return sibson;
    }

    // Scratch memory for as many blocks as run at the same time, have a query each and the budget allows.
    template <typename Rule>
    void make_scratch(const Rule &rule, Launch launch, uint64_t margin, uint64_t queries) {
        uint64_t window = 1;
        for (const uint64_t dim : graph_.grid().dims())
            window *= std::min(dim, 2 * margin + 1);
        const uint64_t bytes = window * (sizeof(Word) + 4 * sizeof(uint32_t)) + labels_ * 2 * sizeof(uint32_t);
        if (bytes > job_.bytes || window > UINT32_MAX)
            fail(LOCUS_E_MEMORY, "batch_bytes is ", job_.bytes, ": a query on the GPU needs ", bytes);
        launch.kernel = Kernel::sibson;
        blocks_ = std::min({device_.resident(launch, body(rule)), job_.bytes / bytes, queries});
        reach_ = {};
        cells_ = {};
        by_label_ = {};
        reach_ = device_.allocate<Word>(blocks_ * window);
        cells_ = device_.allocate<uint32_t>(blocks_ * window * 4);
        by_label_ = device_.allocate<uint32_t>(blocks_ * labels_ * 2);
        const uint64_t all = blocks_ * window;
        scratch_ = {reach_.get(),
                    cells_.get(),
                    cells_.get() + all,
                    cells_.get() + 3 * all,
                    by_label_.get(),
                    by_label_.get() + blocks_ * labels_,
                    window,
                    labels_};
        fill(reach_, Sibson<Word, Rule>::kFar);
        fill(cells_, uint32_t{0});
        fill(by_label_, uint32_t{0});
    }

    // One launch: from the end of `left`; those whose windows were too small go to `too_small`, those whose counts
    // found no room back to `left`.
    template <typename Rule>
    void answer(const Rule &rule, Launch launch, uint64_t margin, std::vector<Query> &left,
                std::vector<Query> &too_small) {
        const uint64_t count = std::min<uint64_t>(left.size(), queries_at_once);
        const std::vector<Query> batch(left.end() - static_cast<std::ptrdiff_t>(count), left.end());
        left.resize(left.size() - count);
        const uint64_t room = std::max(count * labels_expected, labels_);
        std::vector<uint64_t> voxels;
        for (const Query &query : batch)
            voxels.push_back(query.voxel);
        const auto queries = device_.copy_of(std::span<const uint64_t>(voxels));
        const auto answers = device_.allocate<Answer>(count);
        const auto stolen = device_.allocate<Stolen>(room);
        const std::array<uint64_t, 2> zeros{};
        const auto counters = device_.copy_of(std::span<const uint64_t>(zeros));

        Sibson<Word, Rule> sibson = body(rule);
        sibson.queries = queries.get();
        sibson.query_count = static_cast<uint32_t>(count);
        sibson.taken = reinterpret_cast<uint32_t *>(counters.get());
        sibson.margin = std::min(margin, all_windows_);
        sibson.scratch = scratch_;
        sibson.answers = answers.get();
        sibson.counts = stolen.get();
        sibson.counted = counters.get() + 1;
        sibson.room = room;
        launch.kernel = Kernel::sibson;
        device_.launch(launch, sibson, std::min(blocks_, count));

        std::vector<Answer> given(count);
        device_.download(std::span<Answer>(given), answers.get());
        uint64_t counted = 0;
        for (const Answer &answer : given)
            if (answer.length < Answer::no_room)
                counted = std::max(counted, answer.first + answer.length);
        std::vector<Stolen> counts(counted);
        device_.download(std::span<Stolen>(counts), stolen.get());
        for (uint64_t i = 0; i < count; ++i) {
            if (given[i].length >= Answer::no_room) {
                (given[i].length == Answer::no_room ? left : too_small).push_back(batch[i]);
                continue;
            }
            row_.clear();
            for (uint64_t k = 0; k < given[i].length; ++k) {
                const Stolen &part = counts[given[i].first + k];
                row_.push_back({part.label, static_cast<double>(part.voxels)});
            }
            close(batch[i].row);
        }
    }

    Device &device_;
    const NaturalJob &job_;
    const Graph &graph_;
    RuleTables<Word> tables_;
    uint64_t labels_ = 1;
    uint64_t all_windows_ = 0; // a margin that holds the whole grid
    Memory<float> operands_;
    Memory<Word> words_;
    Memory<uint32_t> open_;
    uint64_t blocks_ = 0;
    SibsonScratch<Word> scratch_{};
    Memory<Word> reach_;
    Memory<uint32_t> cells_, by_label_;
    std::vector<RawShare> row_;
    RowPile pile_;
};

} // namespace

std::vector<RowPile> sibson_rows(Device &device, const NaturalJob &job, Progress &progress) {
    return job.field.graph().layout().bits == 32 ? Batches<uint32_t>(device, job).run(progress)
                                                 : Batches<uint64_t>(device, job).run(progress);
}

} // namespace locus::device
