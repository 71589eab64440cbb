// Which seeds' distance ratios a change of the diagram concerns.
#pragma once

#include "graph/weights/cells.hpp"

#include <span>
#include <vector>

namespace locus::graph {

// By label; all others weigh at every voxel what they weighed before. `before` and `now` are the two diagrams, `edited`
// the voxels edited in between, `seeds` and `cells` the present ones; labels mean the same seeds in both.
//
// Let G be the voxels edited or reached in only one of the diagrams, E those and the ones with another word, G' and E'
// with their neighbours; s a seed that starts at t, S its support, X = Cell::crossing, e(v) the present distance from v
// to G'. A seed with voxels in E', now or before, is concerned. The cell of any other, its border and what lies beside
// it are as they were, and so are S and X; what s weighs at a voxel q then differs only where dp or db does, or q lies
// in G. A path that is new, or is no more, meets G', and up to the first voxel there it is as long as ever.
// - dp differs, or q lies in G: beyond S nothing has weight, so t + e(s) <= dp <= S.
// - db differs because dp does at a voxel beside the cell, where the search for db starts: t + e(s) <= dp <= X there.
// - db differs by a path P that meets G', from where it starts, at b, to q. On the way from s to b and along P, and on
//   the way from s to q and back along P, G' is not met before e(s): 2 (t + e(s)) <= dp(b) + |P| + dp(q), where dp(b) +
//   |P| <= X + db. Inside the cell dp <= S / 2 and db <= dp + X; outside dp <= S, and as there is no weight unless db <
//   dp / 2, db <= S / 2.
// In every case t + e(s) <= max(S, S / 2 + X).
std::vector<bool> concerned_labels(const Field &now, const Field &before, std::span<const Source> seeds,
                                   std::span<const Cell> cells, const std::vector<bool> &edited);

} // namespace locus::graph
