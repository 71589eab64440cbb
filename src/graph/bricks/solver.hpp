// A pass of the brick solver: visits of bricks, in the order and on the threads that the schedule gives them, until no
// row changes any more. A lowering pass is the solver proper; a raising pass takes away words that nothing supports.
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

// Rows of a brick.
struct BrickRows {
    size_t brick;
    RowMask rows;
};

template <typename Word>
struct Pass {
    Store<Word> &store;
    const Recipe<Word> &recipe;
    const BlockedBricks &blocked;
    Schedule<Word> &schedule;
    bool raise = false;
    Word unreached = 0;                    // raise: to this word
    std::span<const Anchor<Word>> anchors; // raise: the seeds, sorted by brick
    bool record = false;                   // keep which rows changed
};

// Of anchors sorted by brick, those in one brick.
template <typename Word>
std::span<const Anchor<Word>> anchors_in(std::span<const Anchor<Word>> anchors, size_t brick) {
    const auto less = [](const Anchor<Word> &a, const Anchor<Word> &b) { return a.brick < b.brick; };
    const auto [first, last] = std::equal_range(anchors.begin(), anchors.end(), Anchor<Word>{brick, 0, 0, 0}, less);
    return {first, last};
}

// What a pass did.
struct PassReport {
    uint64_t visits = 0;
    uint64_t updates = 0;           // rows looked at
    std::vector<BrickRows> changed; // a brick once per visit that changed it
};

// Run a pass to its end on up to `threads` threads; the calling one alone reports progress.
template <typename Word>
PassReport run_pass(const Pass<Word> &pass, unsigned threads, Progress &progress);

} // namespace locus::bricks
