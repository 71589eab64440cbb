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
    for (size_t first = 0, next = 0; first < keyed.size(); first = next) {
        while (next < keyed.size() && keyed[next].key == keyed[first].key)
            queries_.push_back(keyed[next++].query);
        const auto [x, y, z] = grid.place(queries_[first].voxel);
        if (first == 0 || keyed[first].key.tile != keyed[first - 1].key.tile)
            tiles_.push_back({{{x, y, z}, {1, 1, 1}}, batches_.size(), 0});
        add_block(grid, first, next - first);
    }
}

// The queries of a block join the tile's last batch where there is room for all of them.
void Plan::add_block(const Grid &grid, uint64_t first, uint64_t count) {
    Tile &tile = tiles_.back();
    for (uint64_t i = first; i < first + count; ++i) {
        const auto place = grid.place(queries_[i].voxel);
        for (unsigned a = 0; a < 3; ++a) {
            const uint64_t end = std::max(tile.box.origin[a] + tile.box.extent[a], place[a] + 1);
            tile.box.origin[a] = std::min(tile.box.origin[a], place[a]);
            tile.box.extent[a] = end - tile.box.origin[a];
        }
    }
    if (tile.count != 0 && batches_.back().count + count <= batch_lanes) {
        batches_.back().count += count;
        return;
    }
    for (uint64_t taken = 0; taken < count; taken += batch_lanes, ++tile.count)
        batches_.push_back({first + taken, std::min<uint64_t>(count - taken, batch_lanes)});
}

} // namespace locus::graph
