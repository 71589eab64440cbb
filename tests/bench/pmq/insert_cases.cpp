// pmq.insert.*: growth from empty, in batches.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <utility>

namespace bench {
namespace {

template <class Record>
void insert_case(Row &row, std::size_t count, std::size_t batch, bool with_rtree) {
    const std::vector<Record> records = clustered<Record>(row.quick ? count / 20 : count, batch);
    std::vector<Contestant> contestants;
    for (const Competitor<Record> &competitor : competitors<Record>(with_rtree)) {
        contestants.push_back(
            {competitor.peer, [&row, &records, batch, competitor, first = true](Notes &notes) mutable {
                 provide_memory(6 * records.size() * sizeof(Record)); // growing arrays hold two
                 const std::size_t before = allocated_bytes();
                 const auto store = competitor.make(LOCUS_NO_HORIZON);
                 const bool checked = std::exchange(first, false);
                 const double mean = time_batches<Record>(*store, records, batch, checked ? &notes : nullptr);
                 const std::size_t own = store->bytes();
                 const std::size_t bytes = own > 0 ? own : allocated_bytes() - before;
                 notes.add("bytes_per_record", static_cast<double>(bytes) / static_cast<double>(records.size()));
                 if (checked) {
                     check_store<Record>(row, competitor.peer, *store, records);
                 }
                 return mean;
             }});
    }
    race(row, contestants);
}

} // namespace

void add_pmq_insert(Cases &cases) {
    cases.push_back({"pmq.insert.1M.b100",
                     "us/batch",
                     {{"array", 10}, {"btree", 8}, {"rtree", 9}},
                     [](Row &row) { insert_case<locus_point32>(row, 1'000'000, 100, true); },
                     Pages::both});
    cases.push_back({"pmq.insert.10M.b1000",
                     "us/batch",
                     {{"array", 12}, {"btree", 10}},
                     [](Row &row) { insert_case<locus_point32>(row, 10'000'000, 1000, false); },
                     Pages::both});
    cases.push_back({"pmq.insert.text156.5M.b1000",
                     "us/batch",
                     {{"array", 4}},
                     [](Row &row) { insert_case<locus_text156>(row, 5'000'000, 1000, false); },
                     Pages::both});
}

} // namespace bench
