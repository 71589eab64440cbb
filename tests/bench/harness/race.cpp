// Interleaved runs of the contestants.
#include "tests/bench/harness/race.hpp"

#include "tests/bench/harness/clock.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

struct Lane {
    std::vector<double> times;
    std::size_t wanted = 1;
    Notes notes;
};

void run_once(Lane &lane, const Contestant &contestant, bool quick, std::size_t runs) {
    const double start = wall_seconds();
    lane.times.push_back(contestant.once(lane.notes));
    if (lane.times.size() == 1) {
        const bool long_run = wall_seconds() - start > 5;
        lane.wanted = runs != 0 ? runs : quick ? 2 : long_run ? 3 : 5;
    }
}

} // namespace

void race(Row &row, const std::vector<Contestant> &contestants, std::size_t runs) {
    std::vector<Lane> lanes(contestants.size());
    for (bool busy = true; busy;) {
        busy = false;
        for (std::size_t i = 0; i < lanes.size(); ++i) {
            if (lanes[i].times.size() < lanes[i].wanted) {
                run_once(lanes[i], contestants[i], row.quick, runs);
                busy = true;
            }
        }
    }
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        const std::string &peer = contestants[i].peer;
        (peer.empty() ? row.ours : row.peers[peer]) = spread(lanes[i].times);
        for (const auto &[name, values] : lanes[i].notes.all()) {
            row.extras[peer.empty() ? name : peer + "_" + name] = spread(values).median;
        }
    }
}

double quantile(std::vector<double> values, double q) {
    const auto rank = static_cast<std::size_t>(std::llround(q * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
    return values[rank];
}

} // namespace bench
