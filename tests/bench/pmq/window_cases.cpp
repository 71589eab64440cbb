// pmq.window.* and pmq.taxis.replay: a sliding window at a steady horizon.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <utility>

namespace bench {
namespace {

/// Fill the store with what arrives before `timed_from`, then time the batches from there on.
void window_case(Row &row, const std::vector<locus_point32> &records, std::size_t batch, std::size_t timed_from,
                 int64_t horizon) {
    const std::span<const locus_point32> all(records);
    const int64_t oldest = records.back().time - horizon;
    std::vector<locus_point32> live;
    std::copy_if(records.begin(), records.end(), std::back_inserter(live),
                 [&](const locus_point32 &record) { return record.time >= oldest; });
    std::vector<Contestant> contestants;
    for (const Competitor<locus_point32> &competitor : competitors<locus_point32>(false)) {
        contestants.push_back({competitor.peer, [&, competitor, first = true](Notes &notes) mutable {
                                   provide_memory(6 * live.size() * sizeof(locus_point32)); // growing arrays hold two
                                   const auto store = competitor.make(horizon);
                                   feed(*store, all.first(timed_from), batch);
                                   const bool checked = std::exchange(first, false);
                                   const double mean =
                                       time_batches(*store, all.subspan(timed_from), batch, checked ? &notes : nullptr);
                                   if (checked) {
                                       check_store<locus_point32>(row, competitor.peer, *store, live);
                                   }
                                   return mean;
                               }});
    }
    race(row, contestants);
    row.extras["live_records"] = static_cast<double>(live.size());
}

} // namespace

void add_pmq_window(Cases &cases) {
    cases.push_back({"pmq.window.10M8.b1000",
                     "us/batch",
                     {{"array", 12}, {"btree", 15}},
                     [](Row &row) {
                         const std::size_t horizon = row.quick ? 540 : 10'800, timed_batches = row.quick ? 600 : 5000;
                         const std::size_t warm = (horizon + horizon / 4) * 1000;
                         window_case(row, clustered<locus_point32>(warm + timed_batches * 1000, 1000), 1000, warm,
                                     static_cast<int64_t>(horizon) * second);
                     },
                     Pages::both});
    cases.push_back({"pmq.taxis.replay",
                     "us/batch",
                     {{"array", 8}, {"btree", 6}},
                     [](Row &row) {
                         const std::vector<locus_point32> records = taxis(row.quick ? 400'000 : SIZE_MAX);
                         window_case(row, records, 100, 0, 6 * 3600 * second);
                     },
                     Pages::both});
}

} // namespace bench
