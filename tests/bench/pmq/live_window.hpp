// 10 M records under a live horizon, in ours and in the peers, and queries around places drawn from them.
#ifndef LOCUS_BENCH_LIVE_WINDOW_HPP
#define LOCUS_BENCH_LIVE_WINDOW_HPP

#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <random>

namespace bench {

constexpr std::size_t window_batch = 1000;

/// A stream of which the last `live` records lie inside the horizon, and the stores that have taken it.
struct Window {
    std::vector<locus_point32> records;
    std::span<const locus_point32> live;
    int64_t horizon = 0;

    explicit Window(bool quick) {
        const std::size_t count = quick ? 300'000 : 10'000'000;
        records = clustered<locus_point32>(count + count / 10, window_batch);
        live = std::span(records).last(count);
        horizon = records.back().time - live.front().time;
    }
};

struct Filled {
    std::string peer;
    std::unique_ptr<TileStore<locus_point32>> store;
};

inline std::vector<Filled> fill(const Window &window) {
    std::vector<Filled> stores;
    const auto add = [&](const std::string &peer, std::unique_ptr<TileStore<locus_point32>> store) {
        feed<locus_point32>(*store, window.records, window_batch);
        stores.push_back({peer, std::move(store)});
    };
    add("", make_locus<locus_point32>(Layout::ours, window.horizon));
    add("array", make_locus<locus_point32>(Layout::array, window.horizon));
    if (have_btree()) {
        add("btree", make_btree<locus_point32>(window.horizon));
    }
    return stores;
}

/// The queries: boxes around places drawn from the records, so that busy places are asked for more often.
inline std::vector<locus_box> boxes(const Window &window, double radius_km, std::size_t count) {
    std::mt19937_64 random(11);
    std::vector<locus_box> out;
    while (out.size() < count) {
        const locus_point32 &centre = window.live[random() % window.live.size()];
        out.push_back(box_around(centre.latitude, centre.longitude, radius_km));
    }
    return out;
}

/// Seconds that `round` takes, the mean of as many as fill 20 ms. One goes before, which is not timed, so that nobody
/// pays for what the contestant before has left in the caches.
template <class Round>
double timed_rounds(Round &&round) {
    constexpr double enough = 0.02;
    round();
    double seconds = 0, rounds = 0;
    for (; seconds < enough; ++rounds) {
        seconds += timed(round);
    }
    return seconds / rounds;
}

/// Time `ask` (a query's number; returns its answer's size) over all queries: microseconds for each.
template <class Ask>
double per_query(std::size_t queries, std::vector<uint64_t> &answers, Ask ask) {
    answers.assign(queries, 0);
    const double seconds = timed_rounds([&] {
        for (std::size_t q = 0; q < queries; ++q) {
            answers[q] = ask(q);
        }
    });
    return 1e6 * seconds / static_cast<double>(queries);
}

} // namespace bench
#endif
