// The best records by place and time: top-k by the space-time score (thesis section 3.5.3), and the k nearest.
#pragma once

#include "core/sphere.hpp"
#include "pmq/layout/layout.hpp"
#include "pmq/query/selection.hpp"

#include <vector>

namespace locus::pmq {

// score = alpha * distance / unit_distance + (1 - alpha) * age / unit_age; the lower, the better.
struct Ranking {
    Site centre;
    double alpha;         // 0..1
    double unit_distance; // metres
    double unit_age;      // microseconds
    double reach;         // metres: nothing farther counts
    uint64_t oldest;      // microseconds: nothing of a larger age counts

    double score(double distance, double age) const noexcept {
        return alpha * (distance / unit_distance) + (1 - alpha) * (age / unit_age);
    }
};

struct Ranked {
    double score;
    uint64_t key, arrival; // arrival: compares records of one key
    Bytes record;          // valid while the view is held
    bool operator<(const Ranked &other) const noexcept {
        if (score != other.score)
            return score < other.score;
        return key != other.key ? key < other.key : arrival < other.arrival;
    }
};

// The k best of the selected records, best first, ties in the store's order. The selection's region is ignored.
std::vector<Ranked> best(const View &view, const Selection &selection, const Ranking &ranking, size_t k);

} // namespace locus::pmq
