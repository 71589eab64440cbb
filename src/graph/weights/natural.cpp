#include "graph/weights/natural.hpp"

#include "graph/weights/queries.hpp"
#include "graph/weights/tally.hpp"
#include "graph/weights/tasks.hpp"

#include <locus/weights.h>

#include <algorithm>

namespace locus::graph {
namespace {

constexpr uint64_t tile_side = 32;
constexpr uint64_t first_margin = 12; // voxels around a tile that its windows hold, until one proves too small

template <typename Word, typename Tally>
class Worker {
public:
    Worker(const NaturalJob &job, const Plan &plan, Tasks &tasks, uint64_t bytes, bool on_callers_thread)
        : job_(job), plan_(plan), tasks_(tasks), bytes_(bytes), on_callers_thread_(on_callers_thread),
          kernels_(settle_kernels(job.simd).of<Word>()), tally_(job.field.grid(), job.field.graph().layout().labels()) {
    }

    RowPile run() {
        while (const auto tile = tasks_.take())
            run_tile(*tile);
        return std::move(pile_);
    }

private:
    void run_tile(size_t number) {
        const Plan::Tile &tile = plan_.tiles()[number];
        if (!provide(number))
            return;
        for (uint64_t i = tile.first; i < tile.first + tile.count && !tasks_.failed(); ++i) {
            const QueryBatch &batch = plan_.batches()[i];
            start(batch);
            window_.settle(kernels_);
            while (window_.too_small(job_.field.grid())) {
                window_.restore(kernels_);
                margin_ += margin_ / 2;
                if (!provide(number))
                    return;
                start(batch);
                window_.settle(kernels_);
            }
            finish(batch);
            window_.restore(kernels_);
            tasks_.done(on_callers_thread_);
        }
    }

    // A window around the tile; false, with the tile given back, where that takes more memory than allowed.
    bool provide(size_t number) {
        const Box box = widen(job_.field.grid(), plan_.tiles()[number].box, margin_);
        if (window_.holds(box))
            return true;
        const uint64_t bytes = Window<Word>::bytes(box);
        if (bytes > bytes_) {
            tasks_.give_back(number, bytes);
            return false;
        }
        window_.open(job_.field, box);
        return true;
    }

    // Whether a query has to be searched: a row is known where nothing can be stolen.
    bool searched(const Query &query) const {
        return job_.field.reached(query.voxel) && job_.field.distance(query.voxel) != 0;
    }

    void start(const QueryBatch &batch) {
        unsigned lane = 0;
        for (const Query &query : plan_.queries(batch)) {
            if (searched(query))
                window_.start(window_.local(job_.field.grid().place(query.voxel)), lane);
            ++lane;
        }
    }

    void finish(const QueryBatch &batch) {
        window_.mark(kernels_);
        tally_.count(window_);
        unsigned lane = 0;
        for (const Query &query : plan_.queries(batch)) {
            row_.clear();
            if (searched(query))
                tally_.row(lane, row_);
            if (row_.empty() && job_.field.reached(query.voxel))
                row_.push_back({job_.field.label(query.voxel), 1});
            finish_row(row_, job_.most, pile_.shares);
            pile_.close(query.row);
            ++lane;
        }
    }

    const NaturalJob &job_;
    const Plan &plan_;
    Tasks &tasks_;
    uint64_t bytes_;
    bool on_callers_thread_;
    const SettleKernels<Word> &kernels_;
    Tally tally_;
    Window<Word> window_;
    uint64_t margin_ = first_margin;
    std::vector<RawShare> row_;
    RowPile pile_;
};

template <typename Word, typename Tally>
std::vector<RowPile> run(const NaturalJob &job, Progress &progress) {
    const Plan plan(job.field.grid(), job.voxels, job.rows, tile_side);
    Tasks tasks(plan.tiles().size(), plan.batches().size(), progress);
    std::vector<RowPile> piles;
    std::mutex mutex;
    tasks.run(job.threads, job.bytes, [&](uint32_t rank, uint64_t bytes) {
        RowPile pile = Worker<Word, Tally>(job, plan, tasks, bytes, rank == 0).run();
        const std::lock_guard lock(mutex);
        piles.push_back(std::move(pile));
    });
    return piles;
}

template <typename Word>
std::vector<RowPile> run(const NaturalJob &job, Progress &progress) {
    return job.method == LOCUS_METHOD_SIBSON ? run<Word, SibsonTally>(job, progress)
                                             : run<Word, LaplaceTally>(job, progress);
}

} // namespace

std::vector<RowPile> natural_rows(const NaturalJob &job, Progress &progress) {
    // Lanes hold distances without labels: 32 bits serve far beyond 32-bit words.
    return job.field.farthest() < far_away<uint32_t> ? run<uint32_t>(job, progress) : run<uint64_t>(job, progress);
}

} // namespace locus::graph
