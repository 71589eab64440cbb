// Pauses and the comparison with a plain scan.
#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

namespace bench {
namespace {

/// A hash of a record; the sum over a set of records does not depend on their order.
template <class Record>
uint64_t hash(const Record &record) {
    uint64_t mixed = 0x9E3779B97F4A7C15;
    const auto *bytes = reinterpret_cast<const unsigned char *>(&record);
    for (std::size_t i = 0; i < sizeof record; i += 4) {
        uint32_t word;
        std::memcpy(&word, bytes + i, sizeof word);
        mixed = (mixed ^ word) * 0xFF51AFD7ED558CCD;
        mixed ^= mixed >> 32;
    }
    return mixed;
}

struct Answer {
    uint64_t count = 0, sum = 0;
    bool operator==(const Answer &) const = default;
};

template <class Record>
Answer scan(std::span<const Record> records, const locus_box &box) {
    Answer answer;
    for (const Record &record : records) {
        if (inside(box, record.latitude, record.longitude)) {
            ++answer.count;
            answer.sum += hash(record);
        }
    }
    return answer;
}

} // namespace

double note_pauses(Notes &notes, const std::vector<double> &pauses) {
    notes.add("p99", 1e6 * quantile(pauses, 0.99));
    notes.add("p999", 1e6 * quantile(pauses, 0.999));
    notes.add("max_stall_ms", 1e3 * *std::max_element(pauses.begin(), pauses.end()));
    return 1e6 * std::accumulate(pauses.begin(), pauses.end(), 0.0) / static_cast<double>(pauses.size());
}

template <class Record>
std::vector<locus_box> sample_boxes(std::span<const Record> records, std::size_t count) {
    std::mt19937_64 random(3);
    std::vector<locus_box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const Record &centre = records[random() % records.size()];
        constexpr double radii[] = {1, 30, 400};
        boxes.push_back(box_around(centre.latitude, centre.longitude, radii[i % 3]));
    }
    return boxes;
}

template <class Record>
void check_store(Row &row, const std::string &peer, Store<Record> &store, std::span<const Record> live) {
    const std::string name = peer.empty() ? "ours" : peer;
    row.check(store.size() == live.size(),
              name + " holds " + std::to_string(store.size()) + " records, not " + std::to_string(live.size()));
    for (const locus_box &box : sample_boxes(live, 6)) {
        const Answer want = scan(live, box);
        const uint64_t counted = store.count(box);
        row.check(counted == want.count,
                  name + " counts " + std::to_string(counted) + " records, not " + std::to_string(want.count));
        std::vector<Record> found(std::max(counted, want.count));
        const std::size_t got = store.read(box, found);
        Answer read{got, 0};
        for (std::size_t i = 0; i < std::min(got, found.size()); ++i) {
            read.sum += hash(found[i]);
        }
        row.check(read == want, name + " reads other records than a scan finds");
    }
}

template std::vector<locus_box> sample_boxes(std::span<const locus_point32>, std::size_t);
template std::vector<locus_box> sample_boxes(std::span<const locus_text156>, std::size_t);
template void check_store(Row &, const std::string &, Store<locus_point32> &, std::span<const locus_point32>);
template void check_store(Row &, const std::string &, Store<locus_text156> &, std::span<const locus_text156>);

} // namespace bench
