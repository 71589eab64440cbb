// A graph in bricks: bringing its words up to date after edits, at a cost that follows what changes.
//
// Raise, then lower. From the rows around the edits on, words that no neighbour's offer supports any more are raised to
// unreached, to a fixpoint: what stays is the length of a path that still exists, perhaps not the shortest. Then the
// solver itself runs from the raised rows, the rows around the edits and the new sources. The fixpoint of lowering is
// unique, so the words equal those of a fresh solve.
#include "graph/bricks/field.hpp"

#include "graph/lattice.hpp"

#include <algorithm>
#include <tuple>

namespace locus::bricks {

using graph::Change;
using graph::Problem;
using graph::Report;
using graph::Source;
using graph::Words;

namespace {

auto order(const Source &source) { return std::tuple(source.voxel, source.distance, source.label); }

} // namespace

template <typename Word>
bool Field<Word>::can_update(const Problem &problem, const Words &words) const {
    const auto *dense = std::get_if<std::vector<Word>>(&words);
    return solved_ && imported_ && unreached_ == unreached_of(problem) && dense != nullptr &&
           dense->size() == graph_.grid().voxels() && graph_.edits_since(*imported_).has_value();
}

template <typename Word>
void Field<Word>::mark(size_t brick, RowMask rows) {
    if (marked_[brick] == 0)
        marked_bricks_.push_back(brick);
    marked_[brick] |= rows;
}

// The rows of all voxels that look at one in the box. Their bricks are also those that hold a copy of one.
template <typename Word>
void Field<Word>::mark_box(const graph::Box &box) {
    std::array<uint64_t, 3> first, last;
    for (size_t axis = 0; axis < 3; ++axis) {
        first[axis] = box.origin[axis] - std::min<uint64_t>(box.origin[axis], 1);
        last[axis] = std::min(box.origin[axis] + box.extent[axis], graph_.grid().dims()[axis] - 1);
    }
    const Place from = place_of(first), to = place_of(last);
    const auto rows_within = [&](size_t axis, int32_t brick) { // of the eight in one axis, as bits
        const uint64_t begin = static_cast<uint64_t>(brick) * kSide;
        const uint64_t a = first[axis] > begin ? first[axis] - begin : 0;
        const uint64_t b = std::min<uint64_t>(last[axis] - begin, kSide - 1);
        return (uint64_t{2} << b) - (uint64_t{1} << a);
    };
    for (int32_t z = from.z; z <= to.z; ++z)
        for (int32_t y = from.y; y <= to.y; ++y) {
            RowMask rows = 0;
            for (unsigned rz = 0; rz < kSide; ++rz)
                if ((rows_within(2, z) >> rz & 1) != 0)
                    rows |= rows_within(1, y) << (kSide * rz);
            for (int32_t x = from.x; x <= to.x; ++x)
                mark(store_.at({x, y, z}), rows);
        }
}

template <typename Word>
void Field<Word>::reimport(const Recipe<Word> &recipe) {
    if (graph_.cuts() != nullptr && blocked_.empty())
        blocked_.resize(store_.layout().count());
    for (const size_t brick : marked_bricks_) {
        const Place place = store_.place(brick);
        import_operands(graph_, place, recipe.impassable, store_[brick]);
        if (!blocked_.empty())
            blocked_[brick] = blocked_edges(graph_, place);
    }
    imported_ = graph_.version();
}

template <typename Word>
void Field<Word>::set_anchors(std::span<const Source> sources) {
    sources_.assign(sources.begin(), sources.end());
    anchors_.clear();
    for (const Source &source : sources_)
        anchors_.push_back(anchor(source));
    std::sort(anchors_.begin(), anchors_.end(), [](const auto &a, const auto &b) { return a.brick < b.brick; });
}

// Mark the rows of the sources that are gone, make the new ones the anchors, and return those that were added.
template <typename Word>
std::vector<Source> Field<Word>::changed_sources(std::span<const Source> sources) {
    if (std::equal(sources.begin(), sources.end(), sources_.begin(), sources_.end()))
        return {};
    std::vector<Source> before = sources_, after(sources.begin(), sources.end()), added, gone;
    const auto less = [](const Source &a, const Source &b) { return order(a) < order(b); };
    std::sort(before.begin(), before.end(), less);
    std::sort(after.begin(), after.end(), less);
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(added), less);
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(gone), less);
    for (const Source &source : gone) {
        const Anchor<Word> there = anchor(source);
        mark(there.brick, RowMask{1} << there.row);
    }
    set_anchors(sources);
    return added;
}

// The smallest word in a brick and along its border; nothing where all of it is unreached, and no row can improve
// before a neighbour does.
template <typename Word>
std::optional<Word> Field<Word>::nearest_around(size_t brick) const {
    Word least = unreached_;
    const auto look = [&](const BrickRow<Word> &row) {
        for (const Word word : row.word)
            least = std::min(least, word);
    };
    const Place place = store_.place(brick);
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy) {
            const Brick<Word> &there = store_[store_.at({place.x, place.y + dy, place.z + dz})];
            for (RowMask rows = touched(~RowMask{0}, dy, dz); rows != 0; rows &= rows - 1)
                look(there.row[std::countr_zero(rows)]);
        }
    return least < unreached_ ? std::optional(least) : std::nullopt;
}

// From the marked rows, the seeds that were added, and those whose voxels were raised.
template <typename Word>
void Field<Word>::schedule_lowering(std::span<const Source> added) {
    for (const Source &source : added)
        lower(anchor(source));
    for (const size_t brick : marked_bricks_) {
        for (const Anchor<Word> &seed : anchors_in(std::span<const Anchor<Word>>(anchors_), brick))
            lower(seed);
        if (const auto key = nearest_around(brick))
            schedule_->add(brick, {marked_[brick]}, *key);
    }
}

template <typename Word>
Report Field<Word>::update(const Problem &problem, Words &words, Progress &progress, Change &change) {
    if (!can_update(problem, words))
        return solve(problem, words, progress, &change);
    graph::Stopwatch watch;
    Report report;
    const Recipe<Word> recipe = recipe_of<Word>(graph_);
    marked_.resize(store_.layout().count());
    start();
    for (const size_t brick : marked_bricks_) // left by an update that failed
        marked_[brick] = 0;
    marked_bricks_.clear();
    const auto edits = *graph_.edits_since(*imported_);
    for (const graph::Box &box : edits)
        mark_box(box);
    reimport(recipe);
    const std::vector<Source> added = changed_sources(problem.sources);
    report.seconds_import = watch.lap();

    Pass<Word> raise = pass(recipe);
    raise.raise = true;
    raise.unreached = unreached_;
    raise.anchors = anchors_;
    raise.record = true;
    for (const size_t brick : marked_bricks_)
        schedule_->add(brick, {marked_[brick]}, 0);
    const unsigned raising_threads = threads(marked_bricks_.size());
    const PassReport raised = run_pass(raise, raising_threads, progress);
    for (const BrickRows &changed : raised.changed)
        mark(changed.brick, changed.rows);

    Pass<Word> lowering = pass(recipe);
    lowering.record = true;
    schedule_lowering(added);
    report.threads = std::max(raising_threads, threads(marked_bricks_.size()));
    const PassReport lowered = run_pass(lowering, threads(marked_bricks_.size()), progress);
    for (const BrickRows &changed : lowered.changed)
        mark(changed.brick, changed.rows);
    report.iterations = raised.visits + lowered.visits;
    report.relaxations = (raised.updates + lowered.updates) * kWidth * graph_.grid().connectivity();
    report.seconds_solve = watch.lap();

    Exported exported;
    for (const size_t brick : marked_bricks_) {
        exported.add(export_changes(graph_, store_.place(brick), store_[brick], unreached_,
                                    std::get<std::vector<Word>>(words).data()));
        marked_[brick] = 0;
    }
    marked_bricks_.clear();
    change = change_of(exported);
    reached_ += exported.gained - exported.lost;
    report.clipped = reached_ < graph_.passable_voxels();
    solved_ = true;
    report.seconds_export = watch.lap();
    return report;
}

template graph::Report Field<uint32_t>::update(const Problem &, Words &, Progress &, Change &);
template graph::Report Field<uint64_t>::update(const Problem &, Words &, Progress &, Change &);
template void Field<uint32_t>::set_anchors(std::span<const Source>);
template void Field<uint64_t>::set_anchors(std::span<const Source>);

} // namespace locus::bricks
