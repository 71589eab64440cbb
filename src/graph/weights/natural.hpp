// The natural-neighbour methods, Sibson and Laplace: every query as one more seed of the diagram, sixteen at a
// time, or alone where they are few.
#pragma once

#include "core/progress.hpp"
#include "core/simd.hpp"
#include "graph/weights/field.hpp"
#include "graph/weights/rows.hpp"

#include <span>
#include <vector>

namespace locus::graph {

struct NaturalJob {
    const Field &field;
    uint32_t method; // LOCUS_METHOD_SIBSON or LOCUS_METHOD_LAPLACE
    uint32_t most;   // entries a row may keep; 0: all
    uint64_t bytes;  // most scratch memory
    uint32_t threads;
    Simd simd;
    std::span<const uint64_t> voxels; // one per row
    std::span<const uint64_t> rows;   // the rows to compute; all where empty
    void *stream = nullptr;           // the caller's, for the GPU
    Engine *engine = nullptr;         // that solved the field, where it may be of use
};

// Piles that hold the rows. Throws LOCUS_E_MEMORY where `bytes` do not suffice for one query, LOCUS_E_STOPPED.
std::vector<RowPile> natural_rows(const NaturalJob &job, Progress &progress);

// The same on the backend of the field's graph: Sibson's weights have kernels, and where the GPU was not asked for by
// name and fails, the CPU goes on.
std::vector<RowPile> natural_rows_on_backend(const NaturalJob &job, Progress &progress);

} // namespace locus::graph
