// The distance ratio of Faure et al. 2011: per seed the distance to it and to the border of its cell.
#pragma once

#include "core/progress.hpp"
#include "core/simd.hpp"
#include "graph/weights/field.hpp"
#include "graph/weights/rows.hpp"

#include <span>
#include <vector>

namespace locus::graph {

struct RatioJob {
    const Field &field;
    std::span<const Source> seeds; // where each label starts, labels unique; those that can weigh in the rows
    uint32_t most;                 // entries a row may keep; 0: all
    uint64_t bytes;                // most scratch memory of the searches
    uint32_t threads;
    Simd simd;
    std::span<const uint64_t> voxels; // one per row
    std::span<const uint64_t> rows;   // the rows to compute; all where empty
};

// A pile with the rows. Distances to borders are whole steps: halves are rounded down. Throws LOCUS_E_MEMORY where
// `bytes` do not suffice for one thread, LOCUS_E_STOPPED.
RowPile ratio_rows(const RatioJob &job, Progress &progress);

} // namespace locus::graph
