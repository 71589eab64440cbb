// thesis.table3.2.*: the steady phase of a window under several horizons; thesis.fig3.8.*: under several rates of
// arrival, whose longest call is the removal pass of table 3.3. A time step is a second and brings one batch.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <numeric>

namespace bench {
namespace {

using Point = locus_point32;

// The packed array of the thesis fills up in 1889 steps at most of its rates: its removal pass falls into these.
constexpr std::size_t steady_steps = 2000;
// What is drawn of figure 3.8: means of so many stretches of the steady phase.
constexpr std::size_t stretches = 50;

/// Numbers of table 3.2, and what figure 3.8 draws: the box of (b) and the course of (a).
double note_steady(Notes &notes, const std::vector<double> &pauses) {
    constexpr std::pair<const char *, double> quantiles[] = {{"p0_ms", 0},     {"p25_ms", 0.25}, {"p50_ms", 0.5},
                                                             {"p75_ms", 0.75}, {"p99_ms", 0.99}, {"p100_ms", 1}};
    for (const auto &[name, q] : quantiles) {
        notes.add(name, 1e3 * quantile(pauses, q));
    }
    const std::size_t stretch = pauses.size() / stretches;
    for (std::size_t i = 0; i < stretches; ++i) {
        const auto from = pauses.begin() + static_cast<std::ptrdiff_t>(i * stretch);
        const double sum = std::accumulate(from, from + static_cast<std::ptrdiff_t>(stretch), 0.0);
        notes.add("step" + std::to_string(i * stretch) + "_ms", 1e3 * sum / static_cast<double>(stretch));
    }
    return 1e3 * std::accumulate(pauses.begin(), pauses.end(), 0.0) / static_cast<double>(pauses.size());
}

/// A window of `horizon` steps that `batch` records a step have filled, and then the steps that are timed.
void steady_case(Row &row, std::size_t horizon, std::size_t batch) {
    if (row.quick) {
        horizon /= 100;
    }
    const std::size_t timed_steps = row.quick ? 200 : steady_steps;
    const std::vector<Point> records = clustered<Point>((horizon + timed_steps) * batch, batch);
    const std::span<const Point> before = std::span(records).first(horizon * batch);
    const auto range = static_cast<int64_t>(horizon) * second;
    std::vector<Point> live;
    std::copy_if(records.begin(), records.end(), std::back_inserter(live),
                 [&](const Point &record) { return record.time >= records.back().time - range; });
    const auto contestant = [&](const char *peer, Layout layout) -> Contestant {
        return {peer, [&, peer, layout](Notes &notes) {
                    provide_memory(4 * live.size() * sizeof(Point)); // a growing array holds two
                    const auto store = make_locus<Point>(layout, range);
                    store->load(before, before.back().time);
                    const std::vector<double> pauses =
                        feed<Point>(*store, std::span(records).subspan(before.size()), batch);
                    check_store<Point>(row, peer, *store, live);
                    notes.add("bytes_per_record",
                              static_cast<double>(store->bytes()) / static_cast<double>(live.size()));
                    return note_steady(notes, pauses);
                }};
    };
    race(row,
         {contestant("", Layout::ours), contestant("array", Layout::array),
          contestant("array_heads", Layout::array_heads)},
         1);
    row.extras["records"] = static_cast<double>(live.size());
}

} // namespace

void add_thesis_steady(Cases &cases) {
    for (const std::size_t hours : {3, 6, 9, 12}) {
        cases.push_back({"thesis.table3.2." + std::to_string(hours) + "h", "ms/batch", {}, [=](Row &row) {
                             steady_case(row, hours * 3600, 1000);
                         }});
    }
    for (const std::size_t batch : {250, 500, 1000, 2000, 4000}) {
        cases.push_back({"thesis.fig3.8.b" + std::to_string(batch), "ms/batch", {}, [=](Row &row) {
                             steady_case(row, 6 * 3600, batch);
                         }});
    }
}

} // namespace bench
