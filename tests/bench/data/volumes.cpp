// Synthetic material maps.
#include "tests/bench/data/volumes.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <unordered_set>

namespace bench {
namespace {

constexpr float wall = std::numeric_limits<float>::quiet_NaN();

template <class Value>
Volume make(std::array<uint64_t, 3> dims, Value value) {
    Volume out;
    out.dims = dims;
    out.compliance.reserve(dims[0] * dims[1] * dims[2]);
    for (uint64_t z = 0; z < dims[2]; ++z) {
        for (uint64_t y = 0; y < dims[1]; ++y) {
            for (uint64_t x = 0; x < dims[0]; ++x) {
                out.compliance.push_back(value(x, y, z));
            }
        }
    }
    return out;
}

/// Corridors of 15x15 voxels between walls of one voxel: a random spanning tree of cells of 16^3 voxels, grown depth
/// first.
Volume maze(uint64_t side) {
    constexpr uint64_t pitch = 16;
    const uint64_t cells = side / pitch;
    Volume out = make({side, side, side}, [](uint64_t x, uint64_t y, uint64_t z) {
        return x % pitch == 0 || y % pitch == 0 || z % pitch == 0 ? wall : 1.0F;
    });
    std::mt19937_64 random(7);
    std::vector<bool> seen(cells * cells * cells);
    std::vector<std::array<uint64_t, 3>> path{{0, 0, 0}};
    const auto index = [&](const std::array<uint64_t, 3> &c) { return c[0] + cells * (c[1] + cells * c[2]); };
    const auto open = [&](const std::array<uint64_t, 3> &cell, std::size_t axis) { // the wall at the cell's low side
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (uint64_t i = 1; i < pitch; ++i) {
            for (uint64_t j = 1; j < pitch; ++j) {
                std::array<uint64_t, 3> p{};
                p[axis] = cell[axis] * pitch;
                p[u] = cell[u] * pitch + i;
                p[v] = cell[v] * pitch + j;
                out.compliance[p[0] + side * (p[1] + side * p[2])] = 1.0F;
            }
        }
    };
    seen[0] = true;
    while (!path.empty()) {
        std::vector<std::pair<std::array<uint64_t, 3>, std::size_t>> next; // a fresh neighbour and the axis to it
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool up : {false, true}) {
                std::array<uint64_t, 3> cell = path.back();
                if (up ? cell[axis] + 1 == cells : cell[axis] == 0) {
                    continue;
                }
                cell[axis] = up ? cell[axis] + 1 : cell[axis] - 1;
                if (!seen[index(cell)]) {
                    next.emplace_back(cell, axis);
                }
            }
        }
        if (next.empty()) {
            path.pop_back();
            continue;
        }
        const auto &[cell, axis] = next[random() % next.size()];
        seen[index(cell)] = true;
        open(cell[axis] > path.back()[axis] ? cell : path.back(), axis);
        path.push_back(cell);
    }
    return out;
}

/// A stiffness from 10 at x = 0 to 100 at the far side, as compliance.
float gradient(uint64_t x, uint64_t nx) {
    return static_cast<float>(1 / (10 + 90 * static_cast<double>(x) / static_cast<double>(nx - 1)));
}

Volume of_topology(const std::string &topology, std::array<uint64_t, 3> dims) {
    if (topology == "constant") {
        return make(dims, [](uint64_t, uint64_t, uint64_t) { return 1.0F; });
    }
    if (topology == "gradient") {
        return make(dims, [&](uint64_t x, uint64_t, uint64_t) { return gradient(x, dims[0]); });
    }
    if (topology == "noise") {
        std::mt19937_64 random(5);
        std::uniform_real_distribution<float> value(1, 10);
        return make(dims, [&](uint64_t, uint64_t, uint64_t) { return value(random); });
    }
    if (topology == "maze") {
        return maze(dims[0]);
    }
    throw std::logic_error("no topology " + topology);
}

} // namespace

void scatter_seeds(Volume &volume, std::size_t count, uint64_t placement) {
    std::mt19937_64 random(placement);
    std::unordered_set<uint64_t> taken;
    volume.seeds.clear();
    while (volume.seeds.size() < count) {
        const uint64_t voxel = random() % volume.voxels();
        if (std::isnan(volume.compliance[voxel]) || !taken.insert(voxel).second) {
            continue;
        }
        locus_seed seed{};
        seed.x = voxel % volume.dims[0];
        seed.y = voxel / volume.dims[0] % volume.dims[1];
        seed.z = voxel / volume.dims[0] / volume.dims[1];
        seed.id = static_cast<uint32_t>(volume.seeds.size());
        volume.seeds.push_back(seed);
    }
}

Volume cube(const std::string &topology, uint64_t side, std::size_t seeds, uint64_t placement) {
    Volume out = of_topology(topology, {side, side, side});
    scatter_seeds(out, seeds, placement);
    return out;
}

Volume plate(const std::string &topology, std::size_t seeds) {
    Volume out = of_topology(topology, {100, 40, 20});
    scatter_seeds(out, seeds, 1);
    return out;
}

} // namespace bench
