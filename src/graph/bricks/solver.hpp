// The brick solver: visits of bricks until no row improves.
#pragma once

#include "graph/bricks/schedule.hpp"
#include "graph/bricks/store.hpp"
#include "graph/bricks/team.hpp"
#include "graph/bricks/visit.hpp"

#include <atomic>

namespace locus::bricks {

// Run the scheduled visits to their end.
template <typename Word>
class Solver {
public:
    Solver(Store<Word> &store, const Metric<Word> &metric, const Kernels<Word> &kernels, unsigned threads,
           unsigned width_bits)
        : store_(store), metric_(metric), visit_(metric.isotropic ? kernels.mean_isotropic : kernels.mean_anisotropic),
          threads_(threads), schedule_(store, threads, width_bits) {}

    Schedule<Word> &schedule() { return schedule_; }

    // Lower the word of a voxel, as a seed does.
    void lower(uint64_t x, uint64_t y, uint64_t z, Word word) {
        const Place place{static_cast<int32_t>(x / kWidth), static_cast<int32_t>(y / kSide),
                          static_cast<int32_t>(z / kSide)};
        const size_t brick = store_.at(place);
        const auto row = static_cast<unsigned>(y % kSide + kSide * (z % kSide));
        const auto lane = static_cast<unsigned>(x % kWidth + 1);
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

    void run() {
        run_team(
            threads_, [this](unsigned thread) { work(thread); }, [this] { schedule_.stop(); });
    }

    uint64_t updates() const { return updates_; }

private:
    void work(unsigned thread) {
        Visit<Word> visit;
        uint64_t updates = 0;
        auto taken = schedule_.next(thread, nullptr, nullptr);
        while (taken) {
            prepare(visit, *taken);
            visit_(visit);
            copy_borders(visit, *taken);
            updates += visit.updates;
            const auto done = *taken;
            taken = schedule_.next(thread, &done, &visit);
        }
        updates_ += updates;
    }

    void prepare(Visit<Word> &visit, const typename Schedule<Word>::Taken &taken) {
        visit = Visit<Word>{};
        visit.metric = &metric_;
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
    void copy_borders(const Visit<Word> &visit, const typename Schedule<Word>::Taken &taken) {
        copy_lane(visit, visit.changed_first, {taken.place.x - 1, taken.place.y, taken.place.z}, 1, kLanes - 1);
        copy_lane(visit, visit.changed_last, {taken.place.x + 1, taken.place.y, taken.place.z}, kWidth, 0);
    }
    void copy_lane(const Visit<Word> &visit, RowMask rows, const Place &to, unsigned from_lane, unsigned to_lane) {
        const size_t neighbour = store_.at(to);
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
    Metric<Word> metric_;
    void (*visit_)(Visit<Word> &);
    unsigned threads_;
    Schedule<Word> schedule_;
    std::atomic<uint64_t> updates_{0};
};

} // namespace locus::bricks
