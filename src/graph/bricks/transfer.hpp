// Between a graph's dense arrays (x fastest) and bricks: materials in, words out.
#pragma once

#include "graph/bricks/store.hpp"
#include "graph/bricks/visit.hpp"
#include "graph/engine.hpp"

#include <memory>

namespace locus::bricks {

// The operands of one brick, its lanes 0 and 15 included; what lies outside the grid is impassable.
template <typename Word>
void import_operands(const graph::Graph &graph, const Place &place, float impassable, Brick<Word> &brick);

template <typename Word>
void fill_words(Word word, Brick<Word> &brick);

// What an export found.
struct Exported {
    uint64_t reached = 0; // voxels with a label
    uint64_t changed = 0; // voxels that were otherwise in the dense memory before, where the export compares,
    uint64_t gained = 0;  // of them those that were unreached before,
    uint64_t lost = 0;    // and those that are unreached now;
    std::array<uint64_t, 3> first = {UINT64_MAX, UINT64_MAX, UINT64_MAX}, last = {}; // the box around them

    void add(const Exported &other);
};

graph::Change change_of(const Exported &exported);

// Copy a brick's words to dense memory; `unreached` becomes the graph's.
template <typename Word>
Exported export_words(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                      Word *words);

// The same, and find what changes.
template <typename Word>
Exported export_changes(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                        Word *words);

// Which edges of a brick are cut; null where none is.
std::unique_ptr<Blocked> blocked_edges(const graph::Graph &graph, const Place &place);

} // namespace locus::bricks
