#include "graph/weights/natural.hpp"

#include "core/team.hpp"
#include "graph/weights/queries.hpp"
#include "graph/weights/tally.hpp"

#include <locus/weights.h>

#include <algorithm>
#include <atomic>
#include <mutex>

namespace locus::graph {
namespace {

constexpr uint64_t tile_side = 32;
constexpr uint64_t first_margin = 12; // voxels around a tile that its windows hold, until one proves too small

Box widen(const Grid &grid, const Box &box, uint64_t margin) {
    Box wide;
    for (unsigned a = 0; a < 3; ++a) {
        wide.origin[a] = box.origin[a] - std::min(margin, box.origin[a]);
        wide.extent[a] = std::min(grid.dims()[a], box.origin[a] + box.extent[a] + margin) - wide.origin[a];
    }
    return wide;
}

// The tiles that are still to be done, handed out to the threads of a team; what they have to agree on.
class Work {
public:
    Work(const Plan &plan, Progress &progress) : plan_(plan), progress_(progress), open_(plan.tiles().size()) {
        for (size_t i = 0; i < open_.size(); ++i) open_[i] = open_.size() - 1 - i;
    }
    // The next tile, or nothing.
    const Plan::Tile *take() {
        const std::lock_guard lock(mutex_);
        if (open_.empty()) return nullptr;
        const size_t tile = open_.back();
        open_.pop_back();
        return &plan_.tiles()[tile];
    }
    // A tile that needs a window of so many bytes, more than the thread may take.
    void give_back(const Plan::Tile &tile, uint64_t bytes) {
        const std::lock_guard lock(mutex_);
        large_.push_back(static_cast<size_t>(&tile - plan_.tiles().data()));
        needed_ = std::max(needed_, bytes);
    }
    // The tiles given back are open again; false where there are none.
    bool reopen() {
        open_.swap(large_);
        large_.clear();
        return !open_.empty();
    }
    uint64_t needed() const { return needed_; }
    void done(bool on_callers_thread) {
        const uint64_t done = ++done_;
        if (on_callers_thread) progress_.report(static_cast<double>(done) / static_cast<double>(plan_.batches().size()));
    }
    // Where one thread has failed, the others need not go on.
    std::atomic<bool> failed{false};

private:
    const Plan &plan_;
    Progress &progress_;
    std::mutex mutex_;
    std::vector<size_t> open_;
    std::vector<size_t> large_;
    uint64_t needed_ = 0;
    std::atomic<uint64_t> done_{0};
};

template <typename Word, typename Tally>
class Worker {
public:
    Worker(const NaturalJob &job, const Plan &plan, Work &work, uint64_t bytes, bool on_callers_thread)
        : job_(job), plan_(plan), work_(work), bytes_(bytes), on_callers_thread_(on_callers_thread),
          kernels_(settle_kernels(job.simd).of<Word>()),
          tally_(job.field.grid(), job.field.graph().layout().labels()) {}

    RowPile run() {
        while (const Plan::Tile *tile = work_.take()) {
            if (work_.failed) break;
            run_tile(*tile);
        }
        return std::move(pile_);
    }

private:
    void run_tile(const Plan::Tile &tile) {
        if (!provide(tile)) return;
        for (uint64_t i = tile.first; i < tile.first + tile.count && !work_.failed; ++i) {
            const QueryBatch &batch = plan_.batches()[i];
            start(batch);
            window_.settle(kernels_);
            while (window_.too_small(job_.field.grid())) {
                window_.restore(kernels_);
                margin_ += margin_ / 2;
                if (!provide(tile)) return;
                start(batch);
                window_.settle(kernels_);
            }
            finish(batch);
            window_.restore(kernels_);
            work_.done(on_callers_thread_);
        }
    }

    // A window around the tile; false, with the tile given back, where that takes more memory than allowed.
    bool provide(const Plan::Tile &tile) {
        const Box box = widen(job_.field.grid(), tile.box, margin_);
        if (window_.holds(box)) return true;
        const uint64_t bytes = Window<Word>::bytes(box);
        if (bytes > bytes_) {
            work_.give_back(tile, bytes);
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
            if (searched(query)) window_.start(window_.local(job_.field.grid().place(query.voxel)), lane);
            ++lane;
        }
    }

    void finish(const QueryBatch &batch) {
        tally_.count(window_);
        unsigned lane = 0;
        for (const Query &query : plan_.queries(batch)) {
            row_.clear();
            if (searched(query)) tally_.row(lane, row_);
            if (row_.empty() && job_.field.reached(query.voxel)) row_.push_back({job_.field.label(query.voxel), 1});
            finish_row(row_, job_.most, pile_.shares);
            pile_.close(query.row);
            ++lane;
        }
    }

    const NaturalJob &job_;
    const Plan &plan_;
    Work &work_;
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
    Work work(plan, progress);
    std::vector<RowPile> piles;
    uint32_t threads = static_cast<uint32_t>(std::min<uint64_t>(job.threads, std::max<uint64_t>(plan.tiles().size(), 1)));
    do {
        if (work.needed() > job.bytes)
            fail(LOCUS_E_MEMORY, "a batch needs ", work.needed(), " bytes, batch_bytes allow ", job.bytes);
        if (work.needed() != 0) threads = static_cast<uint32_t>(std::min<uint64_t>(threads, job.bytes / work.needed()));
        const size_t first = piles.size();
        piles.resize(first + threads);
        run_team(threads, [&](uint32_t rank) {
            try {
                piles[first + rank] = Worker<Word, Tally>(job, plan, work, job.bytes / threads, rank == 0).run();
            } catch (...) {
                work.failed = true;
                throw;
            }
        });
    } while (work.reopen());
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
