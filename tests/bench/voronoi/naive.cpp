// The definitions, with a binary heap and dense arrays that are cleared only where they were touched.
#include "tests/bench/voronoi/naive.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace bench {
namespace {

constexpr uint32_t unreached = UINT32_MAX;

void normalise(Naive::Row &row) {
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    if (sum > 0) {
        for (double &weight : row) {
            weight /= sum;
        }
    }
}

} // namespace

Naive::Naive(const Volume &volume, const Solver &solver) : volume_(volume) {
    const auto n = static_cast<int64_t>(volume.voxels());
    const auto [nx, ny, nz] = std::array{static_cast<int64_t>(volume.dims[0]), static_cast<int64_t>(volume.dims[1]),
                                         static_cast<int64_t>(volume.dims[2])};
    std::vector<std::array<int64_t, 3>> offsets;
    for (int64_t i = 0; i < 27; ++i) {
        if (i == 13) {
            continue;
        }
        const std::array<int64_t, 3> d{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        offsets.push_back(d);
        const bool face = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] == 1;
        const auto &s = volume.spacing;
        hops_.push_back({d[0] + nx * (d[1] + ny * d[2]), face,
                         d[0] != 0   ? s[1] * s[2]
                         : d[1] != 0 ? s[0] * s[2]
                                     : s[0] * s[1]});
    }
    weights_.reserve(static_cast<std::size_t>(n) * hops_.size());
    for (int64_t v = 0; v < n; ++v) {
        const std::array<int64_t, 3> at{v % nx, v / nx % ny, v / nx / ny};
        for (std::size_t k = 0; k < hops_.size(); ++k) {
            const int64_t x = at[0] + offsets[k][0], y = at[1] + offsets[k][1], z = at[2] + offsets[k][2];
            const bool in = x >= 0 && x < nx && y >= 0 && y < ny && z >= 0 && z < nz;
            weights_.push_back(
                in ? solver.edge_weight(static_cast<uint64_t>(v), static_cast<uint64_t>(v + hops_[k].step)) : 0);
        }
    }
    labels_ = solver.labels();
    for (const uint64_t distance : solver.exact_distances()) {
        nearest_.push_back(static_cast<uint32_t>(std::min<uint64_t>(distance, unreached)));
    }
    distance_.assign(labels_.size(), unreached);
    stolen_.assign(labels_.size(), false);
}

void Naive::steal(uint32_t query) {
    if (nearest_[query] == 0 || nearest_[query] == unreached) {
        return;
    }
    distance_[query] = 0;
    touched_.push_back(query);
    queue_.push_back({0, query});
    while (!queue_.empty()) {
        std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
        const auto [distance, voxel] = queue_.back();
        queue_.pop_back();
        if (distance != distance_[voxel]) {
            continue;
        }
        taken_.push_back(voxel);
        stolen_[voxel] = true;
        for (std::size_t k = 0; k < hops_.size(); ++k) {
            const uint32_t weight = weights_[voxel * hops_.size() + k];
            if (weight == 0) {
                continue;
            }
            const auto next = static_cast<uint32_t>(voxel + hops_[k].step);
            const uint32_t there = distance + weight;
            if (there < nearest_[next] && there < distance_[next]) {
                distance_[next] = there;
                touched_.push_back(next);
                queue_.push_back({there, next});
                std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
            }
        }
    }
}

void Naive::forget() {
    for (const uint32_t voxel : touched_) {
        distance_[voxel] = unreached;
        stolen_[voxel] = false;
    }
    touched_.clear();
    taken_.clear();
}

Naive::Row Naive::nearest(uint32_t query) const {
    Row row(volume_.seeds.size());
    if (nearest_[query] != unreached) {
        row[labels_[query]] = 1;
    }
    return row;
}

Naive::Row Naive::sibson(uint32_t query) {
    steal(query);
    Row row(volume_.seeds.size());
    for (const uint32_t voxel : taken_) {
        row[labels_[voxel]] += 1;
    }
    if (taken_.empty()) {
        row = nearest(query);
    }
    normalise(row);
    forget();
    return row;
}

Naive::Row Naive::laplace(uint32_t query) {
    steal(query);
    Row row(volume_.seeds.size());
    std::vector<uint32_t> shortest(row.size(), unreached);
    for (const uint32_t voxel : taken_) {
        for (std::size_t k = 0; k < hops_.size(); ++k) {
            const uint32_t weight = weights_[voxel * hops_.size() + k];
            const auto next = static_cast<uint32_t>(voxel + hops_[k].step);
            if (!hops_[k].face || weight == 0 || nearest_[next] == unreached || stolen_[next]) {
                continue;
            }
            row[labels_[next]] += hops_[k].area;
            uint32_t &least = shortest[labels_[next]];
            least = std::min(least, distance_[voxel] + weight + nearest_[next]);
        }
    }
    bool any = false;
    for (std::size_t seed = 0; seed < row.size(); ++seed) {
        any |= row[seed] > 0;
        row[seed] = row[seed] > 0 ? row[seed] / shortest[seed] : 0;
    }
    if (!any) {
        row = nearest(query);
    }
    normalise(row);
    forget();
    return row;
}

std::vector<uint32_t> Naive::spread(const std::vector<Entry> &sources) const {
    std::vector<uint32_t> distance(labels_.size(), unreached);
    std::vector<Entry> queue;
    const auto reach = [&](uint32_t voxel, uint32_t there) {
        if (there < distance[voxel]) {
            distance[voxel] = there;
            queue.push_back({there, voxel});
            std::push_heap(queue.begin(), queue.end(), std::greater<>());
        }
    };
    for (const auto &[there, voxel] : sources) {
        reach(voxel, there);
    }
    while (!queue.empty()) {
        std::pop_heap(queue.begin(), queue.end(), std::greater<>());
        const auto [there, voxel] = queue.back();
        queue.pop_back();
        if (there != distance[voxel]) {
            continue;
        }
        for (std::size_t k = 0; k < hops_.size(); ++k) {
            if (const uint32_t weight = weights_[voxel * hops_.size() + k]; weight != 0) {
                reach(static_cast<uint32_t>(voxel + hops_[k].step), there + weight);
            }
        }
    }
    return distance;
}

template <class Visit>
void Naive::for_border(uint32_t label, Visit visit) const {
    for (uint32_t voxel = 0; voxel < labels_.size(); ++voxel) {
        for (std::size_t k = 0; labels_[voxel] == label && k < hops_.size(); ++k) {
            const auto next = static_cast<uint32_t>(voxel + hops_[k].step);
            if (hops_[k].face && weights_[voxel * hops_.size() + k] != 0 && labels_[next] != label) {
                visit(voxel, next);
            }
        }
    }
}

std::vector<Naive::Row> Naive::ratio() const {
    std::vector<Row> rows(labels_.size(), Row(volume_.seeds.size()));
    for (const locus_seed &seed : volume_.seeds) {
        const uint64_t place = seed.x + volume_.dims[0] * (seed.y + volume_.dims[1] * seed.z);
        const std::vector<uint32_t> to_seed = spread({{0, static_cast<uint32_t>(place)}});
        uint32_t farthest = 0;
        for (uint32_t voxel = 0; voxel < labels_.size(); ++voxel) {
            farthest = labels_[voxel] == seed.id ? std::max(farthest, nearest_[voxel]) : farthest;
        }
        std::vector<Entry> border;
        for_border(seed.id, [&](uint32_t inside, uint32_t outside) {
            farthest = std::max(farthest, nearest_[outside]);
            const uint32_t middle = (nearest_[outside] + to_seed[outside]) / 2;
            border.push_back({(to_seed[outside] - nearest_[outside]) / 2, outside});
            border.push_back({middle > nearest_[inside] ? middle - nearest_[inside] : 0, inside});
        });
        const std::vector<uint32_t> to_border = spread(border);
        for (uint32_t voxel = 0; voxel < labels_.size(); ++voxel) {
            const double dp = to_seed[voxel], db = to_border[voxel];
            double weight = 0;
            if (labels_[voxel] == seed.id) {
                weight = dp == 0 || border.empty() ? 1 : (1 + db / (dp + db)) / 2;
            } else if (to_seed[voxel] / 2 <= farthest && dp <= 2.0 * farthest && dp > db) {
                weight = (1 - db / (dp - db)) / 2;
            }
            rows[voxel][seed.id] = weight < 1e-4 ? 0 : weight > 1 - 1e-4 ? 1 : weight;
        }
    }
    for (Row &row : rows) {
        normalise(row);
    }
    return rows;
}

} // namespace bench
