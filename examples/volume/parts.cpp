// Connected parts of a material.
#include "volume/model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace volume {
namespace {

// Give the part around `start` its number by a flood; returns its size.
template <typename Neighbours>
uint64_t flood(size_t start, uint32_t number, std::vector<uint32_t> &parts, Neighbours neighbours) {
    std::vector<size_t> open{start};
    uint64_t size = 0;
    parts[start] = number;
    while (!open.empty()) {
        const size_t voxel = open.back();
        open.pop_back();
        ++size;
        neighbours(voxel, [&](size_t next) {
            if (parts[next] != 0)
                return;
            parts[next] = number;
            open.push_back(next);
        });
    }
    return size;
}

} // namespace

uint64_t keep_largest_part(std::vector<float> &stiffness, const uint64_t dims[3], uint32_t connectivity) {
    const int64_t n[3] = {static_cast<int64_t>(dims[0]), static_cast<int64_t>(dims[1]), static_cast<int64_t>(dims[2])};
    const int most_steps = connectivity == 6    ? 1
                           : connectivity == 18 ? 2
                                                : 3; // axes along which a neighbour may differ
    const auto neighbours = [&](size_t voxel, auto use) {
        const int64_t index = static_cast<int64_t>(voxel);
        const int64_t x = index % n[0], y = index / n[0] % n[1], z = index / n[0] / n[1];
        for (int64_t k = std::max<int64_t>(z - 1, 0); k <= std::min(z + 1, n[2] - 1); ++k)
            for (int64_t j = std::max<int64_t>(y - 1, 0); j <= std::min(y + 1, n[1] - 1); ++j)
                for (int64_t i = std::max<int64_t>(x - 1, 0); i <= std::min(x + 1, n[0] - 1); ++i) {
                    const size_t next = static_cast<size_t>(i + n[0] * (j + n[1] * k));
                    if (std::abs(i - x) + std::abs(j - y) + std::abs(k - z) <= most_steps &&
                        !std::isnan(stiffness[next]))
                        use(next);
                }
    };
    std::vector<uint32_t> parts(stiffness.size(), 0); // 0: none yet
    uint32_t count = 0, largest = 0;
    uint64_t most = 0, passable = 0;
    for (size_t voxel = 0; voxel < stiffness.size(); ++voxel) {
        if (std::isnan(stiffness[voxel]) || parts[voxel] != 0)
            continue;
        const uint64_t size = flood(voxel, ++count, parts, neighbours);
        passable += size;
        if (size > most) {
            most = size;
            largest = count;
        }
    }
    for (size_t voxel = 0; voxel < stiffness.size(); ++voxel)
        if (parts[voxel] != largest)
            stiffness[voxel] = std::nanf("");
    return passable - most;
}

} // namespace volume
