// The distance ratio of Faure et al. 2011: per seed the distance to it and to the border of its cell.
#pragma once

#include "core/progress.hpp"
#include "core/simd.hpp"
#include "graph/weights/cells.hpp"
#include "graph/weights/rows.hpp"

#include <span>
#include <vector>

namespace locus::graph {

struct RatioJob {
    const Field &field;
    std::span<const Cell> cells;   // survey_cells(field)
    std::span<const Source> seeds; // where labels start, labels unique; those whose weights are wanted
    uint64_t bytes;                // most scratch memory of the searches
    uint32_t threads;
    Simd simd;
    std::span<const uint64_t> voxels; // one per row
};

// Before normalising: what each of the seeds weighs at each voxel, in no order. Distances to borders are whole steps:
// halves are rounded down. Throws LOCUS_E_MEMORY where `bytes` do not suffice for one thread, LOCUS_E_STOPPED.
Rows ratio_parts(const RatioJob &job, Progress &progress);

// The rows that these make, of at most `most` entries (0: all).
Rows ratio_rows(const Rows &parts, uint32_t most);

struct Renewed {
    Rows parts, rows;
    std::vector<uint64_t> changed; // the numbers of the rows that are others now, rising
};
// With what the concerned labels now weigh, `fresh`, in the place of what they weighed.
Renewed renew_rows(const Rows &parts, const Rows &rows, const Rows &fresh, const std::vector<bool> &concerned,
                   uint32_t most);

} // namespace locus::graph
