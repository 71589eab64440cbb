// A graph in bricks: solving it from scratch.
#include "graph/bricks/field.hpp"

#include "core/team.hpp"
#include "graph/lattice.hpp"

#include <mutex>

namespace locus::bricks {

using graph::Problem;
using graph::Report;
using graph::Words;

template <typename Word>
Field<Word>::Field(const graph::Graph &graph) : graph_(graph), store_(Layout(graph.grid().dims())) {
    Brick<Word> &outside = store_[store_.outside()];
    fill_words(static_cast<Word>(graph.layout().unreached()), outside);
    for (auto &row : outside.row)
        std::fill_n(row.operand, kLanes, recipe_of<Word>(graph).impassable);
}

template <typename Word>
size_t Field<Word>::bytes() const {
    size_t cut = 0;
    for (const auto &brick : blocked_)
        cut += sizeof brick + (brick ? sizeof *brick : 0);
    return store_.bytes() + (schedule_ ? schedule_->bytes() : 0) + cut + sources_.capacity() * sizeof(graph::Source) +
           anchors_.capacity() * sizeof(Anchor<Word>) + marked_.capacity() * sizeof(RowMask);
}

// A thread is worth its start for some dozens of bricks.
template <typename Word>
unsigned Field<Word>::threads(size_t bricks) const {
    return static_cast<unsigned>(std::clamp<size_t>(bricks / 64, 1, graph_.threads()));
}

template <typename Word>
template <typename Body>
void Field<Word>::for_bricks(Body &&body) {
    const size_t count = store_.layout().count();
    parallel_for(threads(count), count, 256, [&](uint64_t begin, uint64_t end) {
        for (uint64_t brick = begin; brick < end; ++brick)
            body(brick);
    });
}

// What lies beyond the limit is never stored: words start just above it.
template <typename Word>
Word Field<Word>::unreached_of(const Problem &problem) const {
    return static_cast<Word>(graph_.layout().pack(problem.limit() + 1, 0));
}

template <typename Word>
Pass<Word> Field<Word>::pass(const Recipe<Word> &recipe) {
    return {.store = store_, .recipe = recipe, .blocked = blocked_, .schedule = *schedule_, .anchors = {}};
}

// Until solved_ is true again, the words are of no use to an update. A schedule that was stopped half-way is not used
// again.
template <typename Word>
void Field<Word>::start() {
    if (!solved_ || !schedule_) {
        // A visit should have about ten steps of the front to do.
        const auto width = static_cast<unsigned>(std::bit_width(10 * graph_.smallest_weight())) - 1;
        schedule_ = std::make_unique<Schedule<Word>>(store_, width + graph_.layout().label_bits);
    }
    solved_ = false;
}

// Materials are read again only where they may have changed.
template <typename Word>
void Field<Word>::import(const Recipe<Word> &recipe, Word unreached) {
    const bool stale = imported_ != graph_.version();
    if (stale) {
        imported_.reset();
        blocked_.clear();
        blocked_.resize(graph_.cuts() != nullptr ? store_.layout().count() : 0);
    }
    for_bricks([&](uint64_t brick) {
        const Place place = store_.place(brick);
        fill_words(unreached, store_[brick]);
        if (stale)
            import_operands(graph_, place, recipe.impassable, store_[brick]);
        if (stale && !blocked_.empty())
            blocked_[brick] = blocked_edges(graph_, place);
    });
    imported_ = graph_.version();
}

// The words to dense memory, which is made ready before it changes.
template <typename Word>
Exported Field<Word>::give(Word unreached, Words &words, bool compare) const {
    auto *dense = std::get_if<std::vector<Word>>(&words);
    std::vector<Word> fresh;
    if (dense == nullptr || dense->size() != graph_.grid().voxels()) {
        fresh.resize(graph_.grid().voxels(), static_cast<Word>(graph_.layout().unreached()));
        dense = &fresh;
    }
    Exported whole;
    std::mutex mutex;
    const size_t count = store_.layout().count();
    parallel_for(threads(count), count, 256, [&](uint64_t begin, uint64_t end) {
        Exported part;
        for (uint64_t brick = begin; brick < end; ++brick) {
            const Place place = store_.place(brick);
            part.add(compare ? export_changes(graph_, place, store_[brick], unreached, dense->data())
                             : export_words(graph_, place, store_[brick], unreached, dense->data()));
        }
        const std::lock_guard lock(mutex);
        whole.add(part);
    });
    if (dense == &fresh)
        words = std::move(fresh);
    return whole;
}

template <typename Word>
Anchor<Word> Field<Word>::anchor(const graph::Source &source) const {
    const auto voxel = graph_.grid().place(source.voxel);
    return {store_.at(place_of(voxel)), static_cast<unsigned>(voxel[1] % kSide + kSide * (voxel[2] % kSide)),
            static_cast<unsigned>(voxel[0] % kWidth + 1),
            static_cast<Word>(graph_.layout().pack(source.distance, source.label))};
}

// Lower the word of a seed's voxel and let the next pass spread it.
template <typename Word>
void Field<Word>::lower(const Anchor<Word> &anchor) {
    Word &own = store_[anchor.brick].row[anchor.row].word[anchor.lane];
    if (anchor.word >= own)
        return;
    own = anchor.word;
    const RowMask bit = RowMask{1} << anchor.row;
    schedule_->add(anchor.brick, {dilate(bit), bit, anchor.lane == 1 ? bit : 0, anchor.lane == kWidth ? bit : 0},
                   anchor.word);
}

template <typename Word>
Report Field<Word>::solve(const Problem &problem, Words &words, Progress &progress, graph::Change *change) {
    graph::Stopwatch watch;
    Report report;
    report.threads = threads(store_.layout().count());
    const Recipe<Word> recipe = recipe_of<Word>(graph_);
    const Word unreached = unreached_of(problem);
    start();
    import(recipe, unreached);
    report.seconds_import = watch.lap();

    for (const graph::Source &source : problem.sources)
        lower(anchor(source));
    const PassReport done = run_pass(pass(recipe), report.threads, progress);
    report.iterations = done.visits;
    report.relaxations = done.updates * kWidth * graph_.grid().connectivity();
    report.seconds_solve = watch.lap();

    if (!std::equal(problem.sources.begin(), problem.sources.end(), sources_.begin(), sources_.end()))
        set_anchors(problem.sources);
    const Exported exported = give(unreached, words, change != nullptr);
    if (change != nullptr)
        *change = change_of(exported);
    reached_ = exported.reached;
    report.clipped = reached_ < graph_.passable_voxels();
    unreached_ = unreached;
    solved_ = true;
    report.seconds_export = watch.lap();
    return report;
}

template class Field<uint32_t>;
template class Field<uint64_t>;

} // namespace locus::bricks
