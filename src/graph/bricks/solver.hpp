// The brick solver: visits of bricks, in the order and on the threads that the schedule gives them, until no row
// improves.
#pragma once

#include "core/progress.hpp"
#include "core/team.hpp"
#include "graph/bricks/metric.hpp"
#include "graph/bricks/schedule.hpp"
#include "graph/bricks/store.hpp"

#include <memory>

namespace locus::bricks {

// The cut edges by brick, null where a brick has none; empty where the graph has none.
using BlockedBricks = std::vector<std::unique_ptr<Blocked>>;

template <typename Word>
class Solver {
public:
    Solver(Store<Word> &store, const Recipe<Word> &recipe, const BlockedBricks &blocked, unsigned threads,
           unsigned width_bits)
        : store_(store), recipe_(recipe), blocked_(blocked), threads_(threads), schedule_(store, threads, width_bits) {}

    // Lower the word of a voxel, as a seed does.
    void lower(const std::array<uint64_t, 3> &voxel, Word word) {
        const Place place = place_of(voxel);
        const size_t brick = store_.at(place);
        const auto row = static_cast<unsigned>(voxel[1] % kSide + kSide * (voxel[2] % kSide));
        const auto lane = static_cast<unsigned>(voxel[0] % kWidth + 1);
        Word &own = store_[brick].row[row].word[lane];
        if (word >= own)
            return;
        own = word;
        const RowMask bit = RowMask{1} << row;
        typename Schedule<Word>::Work work{dilate(bit), bit, 0, 0};
        if (lane == 1)
            work.changed_first = bit;
        if (lane == kWidth)
            work.changed_last = bit;
        schedule_.add(brick, work, word);
    }

    void run(Progress &progress) {
        run_team(threads_, [&](uint32_t thread) {
            try {
                work(thread, thread == 0 ? &progress : nullptr);
            } catch (...) {
                schedule_.stop();
                throw;
            }
        });
    }

    uint64_t visits() const { return schedule_.visits(); }
    uint64_t updates() const { return updates_; }

private:
    using Taken = typename Schedule<Word>::Taken;

    // The calling thread alone reports progress.
    void work(unsigned thread, Progress *progress) {
        Visit<Word> visit;
        uint64_t updates = 0, visits = 0;
        auto taken = schedule_.next(thread, nullptr, nullptr);
        while (taken) {
            prepare(visit, *taken);
            (visit.blocked != nullptr ? recipe_.visit_cut : recipe_.visit)(visit);
            copy_borders(visit);
            updates += visit.updates;
            if (progress != nullptr && ++visits % 64 == 0)
                progress->report(schedule_.fraction());
            const Taken done = *taken;
            taken = schedule_.next(thread, &done, &visit);
        }
        updates_ += updates;
    }

    void prepare(Visit<Word> &visit, const Taken &taken) {
        visit = Visit<Word>{};
        visit.metric = &recipe_.metric;
        visit.place = taken.place;
        visit.blocked = blocked_.empty() ? nullptr : blocked_[taken.brick].get();
        visit.active = taken.work.active;
        visit.changed = taken.work.changed;
        visit.changed_first = taken.work.changed_first;
        visit.changed_last = taken.work.changed_last;
        unsigned i = 0;
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                visit.around[i++] = &store_[store_.at({taken.place.x, taken.place.y + dy, taken.place.z + dz})];
    }

    // The x-neighbours keep copies of this brick's edge lanes.
    void copy_borders(const Visit<Word> &visit) {
        copy_lane(visit, visit.changed_first, -1, 1, kLanes - 1);
        copy_lane(visit, visit.changed_last, 1, kWidth, 0);
    }
    void copy_lane(const Visit<Word> &visit, RowMask rows, int dx, unsigned from_lane, unsigned to_lane) {
        const size_t neighbour = store_.at({visit.place.x + dx, visit.place.y, visit.place.z});
        if (neighbour == store_.outside())
            return;
        const Brick<Word> &own = *visit.around[4];
        Brick<Word> &other = store_[neighbour];
        for (; rows != 0; rows &= rows - 1) {
            const int row = std::countr_zero(rows);
            other.row[row].word[to_lane] = own.row[row].word[from_lane];
        }
    }

    Store<Word> &store_;
    const Recipe<Word> &recipe_;
    const BlockedBricks &blocked_;
    unsigned threads_;
    Schedule<Word> schedule_;
    std::atomic<uint64_t> updates_{0};
};

} // namespace locus::bricks
