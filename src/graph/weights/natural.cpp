#include "graph/weights/natural.hpp"

#include "graph/weights/lone.hpp"
#include "graph/weights/queries.hpp"
#include "graph/weights/tally.hpp"
#include "graph/weights/tasks.hpp"

#include <locus/weights.h>

#include <algorithm>

namespace locus::graph {
namespace {

constexpr uint64_t tile_side = 32;
constexpr uint64_t piece = 64;       // batches of a tile that a thread takes at a time
constexpr uint64_t first_margin = 4; // voxels around a tile that its windows hold at least

// What searching costs, measured on a plate of one material: nanoseconds for each voxel that a query steals, alone or
// in a batch, and for each voxel that is copied into a window.
constexpr uint64_t lone_cost = 130, batch_cost = 70, window_cost = 55;
// Visits of voxels, for each voxel that a query steals (and some more) and each query of a batch (and some more),
// before the batch is left to searches alone. Solid objects take less, but where a thin one turns back and forth sweeps
// are many.
constexpr uint64_t most_pulls = 16, more_stolen = 256, more_queries = 4;

template <typename Word, typename Tally>
class Worker {
public:
    Worker(const NaturalJob &job, const Plan &plan, Tasks &tasks, uint64_t bytes, bool on_callers_thread)
        : job_(job), grid_(job.field.grid()), plan_(plan), tasks_(tasks), bytes_(bytes),
          on_callers_thread_(on_callers_thread), kernels_(settle_kernels(job.simd).of<Word>()), lone_(job.field),
          tally_(grid_, job.field.graph().layout().labels()) {}

    RowPile run() {
        std::optional<size_t> tile;
        while (const auto task = tasks_.take(tile)) {
            if (tile != task->group)
                begin(plan_.tiles()[task->group]);
            tile = task->group;
            run_piece(plan_.tiles()[*tile], *task);
        }
        return std::move(pile_);
    }

private:
    void begin(const Plan::Tile &tile) { together_ = look(tile) && worth_a_window(tile); }

    void run_piece(const Plan::Tile &tile, const Tasks::Task &task) {
        needed_ = 0;
        const uint64_t first = tile.first + task.number * piece;
        const uint64_t end = std::min(first + piece, tile.first + tile.count);
        for (uint64_t i = first; i < end && needed_ == 0 && !tasks_.failed(); ++i) {
            const QueryBatch &batch = plan_.batches()[i];
            together_ = together_ && provide(tile);
            if (!(together_ && search_together(tile, batch)) && needed_ == 0)
                search_alone(batch);
            if (needed_ == 0)
                tasks_.done(on_callers_thread_);
        }
        if (needed_ != 0)
            tasks_.give_back(task, needed_);
    }

    // Search for one of the tile's queries, to learn how much they steal and how far away; false where none of them has
    // to be searched, or memory does not suffice.
    bool look(const Plan::Tile &tile) {
        const auto queries = plan_.queries(tile);
        const size_t first = queries.size() > batch_lanes ? queries.size() / 2 : 0;
        for (size_t i = 0; i < queries.size(); ++i) {
            const Query &query = queries[(first + i) % queries.size()];
            if (!searched(query))
                continue;
            if (!steal(query.voxel))
                return false;
            const auto place = grid_.place(query.voxel);
            const Box box = lone_.box();
            uint64_t reach = 0;
            for (unsigned a = 0; a < 3; ++a)
                reach = std::max({reach, place[a] - box.origin[a], box.origin[a] + box.extent[a] - 1 - place[a]});
            for (margin_ = first_margin; margin_ < reach + reach / 8 + 2;)
                margin_ += margin_ / 2;
            typical_ = lone_.stolen().size();
            return true;
        }
        return false;
    }

    bool worth_a_window(const Plan::Tile &tile) const {
        const Box box = widen(grid_, tile.box, margin_);
        const uint64_t copied = window_.holds(box) ? 0 : Window<Word>::voxels(box);
        return plan_.queries(tile).size() * typical_ * lone_cost >
               copied * window_cost + tile.count * typical_ * batch_cost;
    }

    // A window around the tile; false where that takes more memory than allowed, here or in all.
    bool provide(const Plan::Tile &tile) {
        const Box box = widen(grid_, tile.box, margin_);
        if (window_.holds(box))
            return true;
        const uint64_t bytes = Window<Word>::bytes(box) + lone_.bytes();
        if (bytes > bytes_) {
            if (bytes <= job_.bytes)
                needed_ = bytes;
            return false;
        }
        window_.open(job_.field, box);
        return true;
    }

    // Whether a query has to be searched: a row is known where nothing can be stolen.
    bool searched(const Query &query) const {
        return job_.field.reached(query.voxel) && job_.field.distance(query.voxel) != 0;
    }

    // False where the batch has to be searched alone.
    bool search_together(const Plan::Tile &tile, const QueryBatch &batch) {
        while (provide(tile)) {
            start(batch);
            const bool settled =
                window_.settle(kernels_, most_pulls * (batch.count + more_queries) * (typical_ + more_stolen));
            const bool done = settled && !window_.too_small(grid_);
            if (done)
                finish(batch);
            window_.restore(kernels_);
            if (done || !settled)
                return done;
            margin_ += margin_ / 2;
        }
        return false;
    }

    void start(const QueryBatch &batch) {
        unsigned lane = 0;
        for (const Query &query : plan_.queries(batch)) {
            if (searched(query))
                window_.start(window_.local(grid_.place(query.voxel)), lane);
            ++lane;
        }
    }

    void finish(const QueryBatch &batch) {
        window_.mark(kernels_);
        tally_.count(window_);
        unsigned lane = 0;
        for (const Query &query : plan_.queries(batch))
            close(query, lane++);
    }

    void search_alone(const QueryBatch &batch) {
        for (const Query &query : plan_.queries(batch)) {
            if (searched(query)) {
                if (!steal(query.voxel))
                    return;
                typical_ = std::max<uint64_t>(typical_, lone_.stolen().size());
                tally_.count(lone_);
            }
            close(query, 0);
        }
    }

    // One query's search in what memory the window leaves, or without it.
    bool steal(uint64_t voxel) {
        if (lone_.found(voxel))
            return true;
        const uint64_t held = Window<Word>::bytes(window_.box());
        if (lone_.steal(voxel, bytes_ - std::min(bytes_, held)))
            return true;
        window_ = Window<Word>();
        if (lone_.steal(voxel, bytes_))
            return true;
        needed_ = lone_.bytes_needed();
        return false;
    }

    void close(const Query &query, unsigned lane) {
        row_.clear();
        if (searched(query))
            tally_.row(lane, row_);
        if (row_.empty() && job_.field.reached(query.voxel))
            row_.push_back({job_.field.label(query.voxel), 1});
        finish_row(row_, job_.most, pile_.shares);
        pile_.close(query.row);
    }

    const NaturalJob &job_;
    const Grid &grid_;
    const Plan &plan_;
    Tasks &tasks_;
    uint64_t bytes_;
    bool on_callers_thread_;
    const SettleKernels<Word> &kernels_;
    LoneSearch<Word> lone_;
    Tally tally_;
    Window<Word> window_;
    bool together_ = false; // the tile's queries are searched in batches
    uint64_t margin_ = 0;   // voxels around the tile that its windows hold, until one proves too small
    uint64_t typical_ = 0;  // voxels that a query of the tile steals
    uint64_t needed_ = 0;   // bytes that the tile needs, where they are more than this thread's
    std::vector<RawShare> row_;
    RowPile pile_;
};

template <typename Word, typename Tally>
std::vector<RowPile> run(const NaturalJob &job, Progress &progress) {
    const Plan plan(job.field.grid(), job.voxels, job.rows, tile_side);
    std::vector<size_t> pieces;
    for (const Plan::Tile &tile : plan.tiles())
        pieces.push_back((tile.count + piece - 1) / piece);
    Tasks tasks(pieces, plan.batches().size(), progress);
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
    // Lanes hold distances without labels: 32 bits serve far beyond 32-bit words. Laplace's faces count also where the
    // edge across is too long to steal anything.
    const bool faces = job.method == LOCUS_METHOD_LAPLACE;
    const uint64_t longest = std::max(job.field.farthest(), faces ? job.field.graph().largest_weight() : 0);
    return longest < far_away<uint32_t> ? run<uint32_t>(job, progress) : run<uint64_t>(job, progress);
}

} // namespace locus::graph
