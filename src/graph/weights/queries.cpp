#include "graph/weights/queries.hpp"

#include "graph/weights/settle.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace locus::graph {
namespace {

constexpr std::array<uint64_t, 3> block = {4, 2, 2};

// Where a voxel comes in the order of queries: its tile, its block within.
struct Key {
    uint64_t tile, block;
    bool operator==(const Key &) const = default;
    auto operator<=>(const Key &) const = default;
};

} // namespace

Plan::Plan(const Grid &grid, std::span<const uint64_t> voxels, std::span<const uint64_t> rows, uint64_t tile_side) {
    const auto key = [&](uint64_t voxel) {
        const auto place = grid.place(voxel);
        std::array<uint64_t, 3> tile{}, within{}, tiles{}, blocks{};
        for (unsigned a = 0; a < 3; ++a) {
            tiles[a] = (grid.dims()[a] + tile_side - 1) / tile_side;
            blocks[a] = tile_side / block[a];
            tile[a] = place[a] / tile_side;
            within[a] = place[a] % tile_side / block[a];
        }
        return Key{tile[0] + tiles[0] * (tile[1] + tiles[1] * tile[2]),
                   within[0] + blocks[0] * (within[1] + blocks[1] * within[2])};
    };
    struct Keyed {
        Key key;
        Query query;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(rows.empty() ? voxels.size() : rows.size());
    const auto take = [&](uint64_t row) { keyed.push_back({key(voxels[row]), {voxels[row], row}}); };
    if (rows.empty())
        for (uint64_t row = 0; row < voxels.size(); ++row)
            take(row);
    else
        for (const uint64_t row : rows)
            take(row);
    std::sort(keyed.begin(), keyed.end(), [](const Keyed &a, const Keyed &b) {
        return std::tie(a.key, a.query.voxel, a.query.row) < std::tie(b.key, b.query.voxel, b.query.row);
    });
    queries_.reserve(keyed.size());
    for (size_t i = 0; i < keyed.size(); ++i) {
        const auto [x, y, z] = grid.place(keyed[i].query.voxel);
        const bool new_tile = i == 0 || keyed[i].key.tile != keyed[i - 1].key.tile;
        if (new_tile)
            tiles_.push_back({{{x, y, z}, {1, 1, 1}}, batches_.size(), 0});
        Tile &tile = tiles_.back();
        const std::array<uint64_t, 3> place = {x, y, z};
        for (unsigned a = 0; a < 3; ++a) {
            const uint64_t end = std::max(tile.box.origin[a] + tile.box.extent[a], place[a] + 1);
            tile.box.origin[a] = std::min(tile.box.origin[a], place[a]);
            tile.box.extent[a] = end - tile.box.origin[a];
        }
        if (new_tile || keyed[i].key != keyed[i - 1].key || batches_.back().count == batch_lanes) {
            batches_.push_back({i, 0});
            ++tile.count;
        }
        ++batches_.back().count;
        queries_.push_back(keyed[i].query);
    }
}

} // namespace locus::graph
