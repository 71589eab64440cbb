// pmq.readers.1: how fast the writer is beside a reader that scans all the time, on a core of its own; for comparison,
// alone, and beside a thread that copies memory of its own.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <utility>

namespace bench {
namespace {

constexpr std::size_t batch = 1000;
constexpr locus_box world{-90, -180, 90, 180};

/// A thread that calls `work`, which returns how many records it went through, again and again.
class Beside {
public:
    explicit Beside(std::function<std::size_t()> work)
        : thread_([this, work = std::move(work)](std::stop_token stop) {
              while (!stop.stop_requested()) {
                  read_ += work();
              }
          }) {}
    uint64_t read() const { return read_; }

private:
    std::atomic<uint64_t> read_ = 0;
    std::jthread thread_; // the last member: it ends first
};

/// Microseconds of wall time a batch, at a steady horizon.
double write(Store<locus_point32> &store, std::span<const locus_point32> records, Notes &notes) {
    std::vector<double> pauses;
    for (std::size_t i = 0; i < records.size(); i += batch) {
        const auto part = records.subspan(i, std::min(batch, records.size() - i));
        pauses.push_back(timed_wall([&] { store.insert(part, part.back().time); }));
    }
    return note_pauses(notes, pauses);
}

void readers_case(Row &row) {
    row.threads = 2;
    const std::size_t horizon = row.quick ? 540 : 10'800, timed_batches = row.quick ? 600 : 5000; // seconds
    const std::size_t warm = (horizon + horizon / 4) * batch;
    const std::vector<locus_point32> records = clustered<locus_point32>(warm + timed_batches * batch, batch);
    const std::span<const locus_point32> all(records);
    const int64_t oldest = records.back().time - static_cast<int64_t>(horizon) * second;
    const auto live = all.subspan(static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const auto &record) { return record.time >= oldest; }) - all.begin()));
    std::vector<locus_point32> out(2 * live.size());
    const auto contestant = [&](const std::string &peer, std::function<std::size_t(Store<locus_point32> &)> beside) {
        return Contestant{peer, [&, peer, beside, first = true](Notes &notes) mutable {
                              provide_memory(4 * live.size() * sizeof(locus_point32));
                              const auto store = make_locus<locus_point32>(Layout::ours, int64_t(horizon) * second);
                              feed<locus_point32>(*store, all.first(warm), batch);
                              const double start = wall_seconds();
                              double mean = 0;
                              if (beside) {
                                  const Beside other([&] { return beside(*store); });
                                  mean = write(*store, all.subspan(warm), notes);
                                  notes.add("read_per_s", static_cast<double>(other.read()) / (wall_seconds() - start));
                              } else {
                                  mean = write(*store, all.subspan(warm), notes);
                              }
                              if (std::exchange(first, false)) {
                                  check_store<locus_point32>(row, peer, *store, live);
                              }
                              return mean;
                          }};
    };
    // What a reader costs without touching the store: the memory's bandwidth.
    const auto copy = [&](Store<locus_point32> &) {
        std::copy(live.begin(), live.end(), out.begin());
        return live.size();
    };
    race(row, {contestant("", [&](Store<locus_point32> &store) { return store.read(world, out); }),
               contestant("no_reader", nullptr), contestant("beside_copy", copy)});
}

} // namespace

void add_pmq_readers(Cases &cases) {
    cases.push_back({"pmq.readers.1", "us/batch", {{"no_reader", 0.85}}, readers_case});
}

} // namespace bench
