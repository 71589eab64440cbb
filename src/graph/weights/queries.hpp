// The voxels that weights are asked for, and the order in which batches take them.
#pragma once

#include "graph/grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace locus::graph {

struct Query {
    uint64_t voxel;
    uint64_t row; // where its weights go
};

// Up to sixteen queries from blocks of 4 x 2 x 2 voxels, of several where each has few.
struct QueryBatch {
    uint64_t first, count; // into the queries
};

// Queries in tiles, tiles in blocks: neighbours are searched together and one after the other, so that a window serves
// many batches.
class Plan {
public:
    // `voxels` in the order of their rows; `rows` says which to compute (all where empty). A tile spans `tile_side`
    // voxels, a multiple of 4.
    Plan(const Grid &grid, std::span<const uint64_t> voxels, std::span<const uint64_t> rows, uint64_t tile_side);

    struct Tile {
        Box box;
        uint64_t first, count; // into batches()
    };
    const std::vector<Tile> &tiles() const { return tiles_; }
    const std::vector<QueryBatch> &batches() const { return batches_; }
    std::span<const Query> queries(const QueryBatch &batch) const {
        return {queries_.data() + batch.first, batch.count};
    }
    std::span<const Query> queries(const Tile &tile) const {
        const QueryBatch &first = batches_[tile.first], &last = batches_[tile.first + tile.count - 1];
        return {queries_.data() + first.first, last.first + last.count - first.first};
    }

private:
    void add_block(const Grid &grid, uint64_t first, uint64_t count);

    std::vector<Query> queries_;
    std::vector<QueryBatch> batches_;
    std::vector<Tile> tiles_;
};

} // namespace locus::graph
