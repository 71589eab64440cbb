// Between a graph's dense arrays (x fastest) and bricks: materials in, words out.
#pragma once

#include "graph/bricks/store.hpp"
#include "graph/bricks/visit.hpp"
#include "graph/graph.hpp"

#include <vector>

namespace locus::bricks {

// The operands of one brick, its lanes 0 and 15 included; what lies outside the grid is impassable.
template <typename Word>
void import_operands(const graph::Graph &graph, const Place &place, float impassable, Brick<Word> &brick);

template <typename Word>
void fill_words(Word word, Brick<Word> &brick);

// Copy a brick's words to dense memory; `unreached` becomes the graph's. Returns how many are reached.
template <typename Word>
uint64_t export_words(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                      Word *words);

// Which edges of each brick are cut; null for a brick without any. Empty for a graph without any.
std::vector<std::unique_ptr<Blocked>> blocked_edges(const graph::Graph &graph, const Layout &layout);

} // namespace locus::bricks
