// Drives a store: feeds a stream in batches, timing each, and compares its answers with a plain scan of the records.
#ifndef LOCUS_BENCH_DRIVE_HPP
#define LOCUS_BENCH_DRIVE_HPP

#include "tests/bench/data/records.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/harness/race.hpp"
#include "tests/bench/pmq/store.hpp"

#include <span>
#include <vector>

namespace bench {

/// Insert `records` batch by batch, the clock at each batch's last time, and call `after` after every batch.
template <class Record, class After>
void insert_all(Store<Record> &store, std::span<const Record> records, std::size_t batch, After &&after) {
    for (std::size_t i = 0; i < records.size(); i += batch) {
        const std::span<const Record> part = records.subspan(i, std::min(batch, records.size() - i));
        store.insert(part, part.back().time);
        after();
    }
}

/// Insert `records` batch by batch; the thread-CPU seconds of every batch.
template <class Record>
std::vector<double> feed(Store<Record> &store, std::span<const Record> records, std::size_t batch) {
    std::vector<double> pauses;
    pauses.reserve(records.size() / batch + 1);
    double last = cpu_seconds();
    insert_all(store, records, batch, [&] {
        const double now = cpu_seconds();
        pauses.push_back(now - last);
        last = now;
    });
    return pauses;
}

/// Insert all of `records`, but time one batch in every `every` only, the others arriving in bulk between them.
template <class Record>
std::vector<double> feed_sampled(Store<Record> &store, std::span<const Record> records, std::size_t batch,
                                 std::size_t every) {
    std::vector<double> pauses;
    for (std::size_t i = 0; i < records.size();) {
        const std::span<const Record> part = records.subspan(i, std::min(batch, records.size() - i));
        pauses.push_back(timed([&] { store.insert(part, part.back().time); }));
        i += part.size();
        const std::span<const Record> rest = records.subspan(i, std::min(batch * (every - 1), records.size() - i));
        if (!rest.empty()) {
            store.load(rest, rest.back().time);
        }
        i += rest.size();
    }
    return pauses;
}

/// Mean of the pauses in microseconds; notes p99, p999 (microseconds) and max_stall_ms.
double note_pauses(Notes &notes, const std::vector<double> &pauses);

/// Insert `records` batch by batch; mean microseconds of thread-CPU time a batch. The pauses are noted if asked for:
/// then the clock is read after every batch, which in a virtual machine takes as long as inserting 15 records.
template <class Record>
double time_batches(Store<Record> &store, std::span<const Record> records, std::size_t batch, Notes *pauses) {
    if (pauses != nullptr) {
        return note_pauses(*pauses, feed(store, records, batch));
    }
    std::size_t batches = 0;
    const double seconds = timed([&] { insert_all(store, records, batch, [&] { ++batches; }); });
    return 1e6 * seconds / static_cast<double>(batches);
}

/// Boxes of 1, 30 and 400 km around some of the records.
template <class Record>
std::vector<locus_box> sample_boxes(std::span<const Record> records, std::size_t count);

/// The size of the store and the records in some boxes, against a plain scan of the `live` records.
template <class Record>
void check_store(Row &row, const std::string &peer, Store<Record> &store, std::span<const Record> live);

} // namespace bench
#endif
