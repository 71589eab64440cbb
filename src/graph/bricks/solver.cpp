// A pass of the brick solver.
#include "graph/bricks/solver.hpp"

namespace locus::bricks {
namespace {

template <typename Word>
void prepare(const Pass<Word> &pass, const typename Schedule<Word>::Taken &taken, Visit<Word> &visit) {
    visit = Visit<Word>{};
    visit.metric = &pass.recipe.metric;
    visit.place = taken.place;
    visit.blocked = pass.blocked.empty() ? nullptr : pass.blocked[taken.brick].get();
    visit.active = taken.work.active;
    visit.changed = taken.work.changed;
    visit.changed_first = taken.work.changed_first;
    visit.changed_last = taken.work.changed_last;
    unsigned i = 0;
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
            visit.around[i++] = &pass.store[pass.store.at({taken.place.x, taken.place.y + dy, taken.place.z + dz})];
    if (!pass.raise)
        return;
    visit.raise = true;
    visit.unreached = pass.unreached;
    visit.anchors = anchors_in(pass.anchors, taken.brick);
}

template <typename Word>
void copy_lane(Store<Word> &store, const Visit<Word> &visit, RowMask rows, int dx, unsigned from, unsigned to) {
    const size_t neighbour = store.at({visit.place.x + dx, visit.place.y, visit.place.z});
    if (neighbour == store.outside())
        return;
    const Brick<Word> &own = *visit.around[4];
    Brick<Word> &other = store[neighbour];
    for (; rows != 0; rows &= rows - 1) {
        const int row = std::countr_zero(rows);
        other.row[row].word[to] = own.row[row].word[from];
    }
}

template <typename Word>
PassReport run_thread(const Pass<Word> &pass, unsigned thread, Progress *progress) {
    PassReport report;
    Visit<Word> visit;
    auto taken = pass.schedule.next(thread, nullptr, nullptr);
    while (taken) {
        prepare(pass, *taken, visit);
        (visit.blocked != nullptr ? pass.recipe.visit_cut : pass.recipe.visit)(visit);
        // The x-neighbours keep copies of this brick's edge lanes.
        copy_lane(pass.store, visit, visit.changed_first, -1, 1, kLanes - 1);
        copy_lane(pass.store, visit, visit.changed_last, 1, kWidth, 0);
        report.updates += visit.updates;
        if (pass.record && visit.changed != 0)
            report.changed.push_back({taken->brick, visit.changed});
        if (++report.visits % 8 == 0 && progress != nullptr)
            progress->report(pass.schedule.fraction());
        const auto done = *taken;
        taken = pass.schedule.next(thread, &done, &visit);
    }
    return report;
}

} // namespace

template <typename Word>
PassReport run_pass(const Pass<Word> &pass, unsigned threads, Progress &progress) {
    std::vector<PassReport> reports(threads);
    pass.schedule.begin(threads);
    run_team(threads, [&](uint32_t thread) {
        try {
            reports[thread] = run_thread(pass, thread, thread == 0 ? &progress : nullptr);
        } catch (...) {
            pass.schedule.stop();
            throw;
        }
    });
    PassReport whole = std::move(reports[0]);
    for (unsigned thread = 1; thread < threads; ++thread) {
        whole.visits += reports[thread].visits;
        whole.updates += reports[thread].updates;
        whole.changed.insert(whole.changed.end(), reports[thread].changed.begin(), reports[thread].changed.end());
    }
    return whole;
}

template PassReport run_pass(const Pass<uint32_t> &, unsigned, Progress &);
template PassReport run_pass(const Pass<uint64_t> &, unsigned, Progress &);

} // namespace locus::bricks
