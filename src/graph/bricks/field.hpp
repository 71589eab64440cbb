// A graph in bricks: its materials, its cut edges and the words of the latest solve, kept for the next solve or update.
#pragma once

#include "graph/bricks/solver.hpp"
#include "graph/bricks/transfer.hpp"
#include "graph/engine.hpp"

#include <optional>

namespace locus::bricks {

template <typename Word>
class Field {
public:
    explicit Field(const graph::Graph &graph);

    // Engine::solve and Engine::update.
    graph::Report solve(const graph::Problem &problem, graph::Words &words, Progress &progress,
                        graph::Change *change = nullptr);
    graph::Report update(const graph::Problem &problem, graph::Words &words, Progress &progress, graph::Change &change);
    size_t bytes() const;

private:
    unsigned threads(size_t bricks) const;
    template <typename Body>
    void for_bricks(Body &&body);
    Word unreached_of(const graph::Problem &problem) const;
    Pass<Word> pass(const Recipe<Word> &recipe);
    void start();

    void import(const Recipe<Word> &recipe, Word unreached);
    Exported give(Word unreached, graph::Words &words, bool compare) const;
    Anchor<Word> anchor(const graph::Source &source) const;

    void lower(const Anchor<Word> &anchor);

    // update.cpp
    bool can_update(const graph::Problem &problem, const graph::Words &words) const;
    void mark(size_t brick, RowMask rows);
    void mark_box(const graph::Box &box);
    void reimport(const Recipe<Word> &recipe);
    std::vector<graph::Source> changed_sources(std::span<const graph::Source> sources);
    void set_anchors(std::span<const graph::Source> sources);
    void schedule_lowering(std::span<const graph::Source> added);
    std::optional<Word> nearest_around(size_t brick) const;

    const graph::Graph &graph_;
    Store<Word> store_;
    BlockedBricks blocked_;
    std::optional<uint64_t> imported_; // the graph's version when its materials were read
    std::unique_ptr<Schedule<Word>> schedule_;

    bool solved_ = false; // the words in the store are those of sources_ at version imported_
    Word unreached_ = 0;
    uint64_t reached_ = 0;
    std::vector<graph::Source> sources_;
    std::vector<Anchor<Word>> anchors_; // the same, sorted by brick

    // The rows that an update starts from: per brick, and the bricks that have some. Empty between updates.
    std::vector<RowMask> marked_;
    std::vector<size_t> marked_bricks_;
};

} // namespace locus::bricks
