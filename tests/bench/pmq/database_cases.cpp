// thesis.fig3.6: 100,000 records in batches of 100 into stores and spatial databases, everything read after batches.
#include "tests/bench/data/records.hpp"
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/pmq/databases.hpp"
#include "tests/bench/pmq/store.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace bench {
namespace {

using Point = locus_point32;
constexpr std::size_t batch = 100;
constexpr std::size_t read_every = 20; // batches between two timed reads of everything

/// A store of the other cases asked for everything.
class WholeStore final : public Database {
public:
    explicit WholeStore(std::unique_ptr<Store<Point>> store) : store_(std::move(store)) {}
    void insert(std::span<const Point> records) override { store_->insert(records, records.back().time); }
    std::size_t read_all(std::span<Point> out) override { return store_->read({-90, -180, 90, 180}, out); }

private:
    std::unique_ptr<Store<Point>> store_;
};

using Make = std::function<std::unique_ptr<Database>()>;

bool less_bytes(const Point &a, const Point &b) { return std::memcmp(&a, &b, sizeof a) < 0; }
bool same_bytes(const Point &a, const Point &b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Wall time, as the servers work in processes of their own: mean milliseconds of a batch; notes those of a read.
double run_database(Row &row, const std::string &peer, const Make &make, const std::vector<Point> &records,
                    Notes &notes) {
    const std::unique_ptr<Database> database = make();
    std::vector<Point> out(records.size());
    double inserting = 0, reading = 0;
    std::size_t found = 0, reads = 0;
    const std::size_t batches = records.size() / batch;
    for (std::size_t i = 0; i < batches; ++i) {
        const std::span<const Point> part(records.data() + i * batch, batch);
        inserting += timed_wall([&] { database->insert(part); });
        if ((i + 1) % read_every == 0) {
            reading += timed_wall([&] { found = database->read_all(out); });
            ++reads;
        }
    }
    std::vector<Point> want = records;
    std::sort(want.begin(), want.end(), less_bytes);
    std::sort(out.begin(), out.end(), less_bytes);
    row.check(found == want.size() && std::equal(out.begin(), out.end(), want.begin(), want.end(), same_bytes),
              (peer.empty() ? "ours" : peer) + " does not return what was inserted");
    notes.add("read_ms", 1e3 * reading / static_cast<double>(reads));
    return 1e3 * inserting / static_cast<double>(batches);
}

void databases_case(Row &row) {
    const std::vector<Point> records = clustered<Point>(row.quick ? 10'000 : 100'000, batch);
    const auto whole = [](auto make) -> Make { return [make] { return std::make_unique<WholeStore>(make()); }; };
    std::vector<std::pair<std::string, Make>> entrants{
        {"", whole([] { return make_locus<Point>(Layout::ours, LOCUS_NO_HORIZON); })},
        {"array_explicit", whole([] { return make_locus<Point>(Layout::array_explicit, LOCUS_NO_HORIZON); })},
        {"vector_merge", whole([] { return make_vector(Sorting::merge, DenseIndex::implicit); })},
        {"spatialite", make_spatialite},
        {"sqlite_rtree", make_sqlite_rtree},
        {"postgis", make_postgis},
        {"redis_geo", make_redis_geo}};
    entrants.push_back({"array", whole([] { return make_locus<Point>(Layout::array, LOCUS_NO_HORIZON); })});
    if (have_adaptive_sort()) {
        entrants.push_back({"vector_sort", whole([] { return make_vector(Sorting::adaptive, DenseIndex::implicit); })});
    }
    std::vector<Contestant> contestants;
    for (const auto &[peer, make] : entrants) {
        try {
            make(); // does it run here?
        } catch (const Missing &reason) {
            std::fprintf(stderr, "%s without the peer %s: %s\n", row.name.c_str(), peer.c_str(), reason.what());
            continue;
        }
        contestants.push_back({peer, [&row, &records, name = peer, maker = make](Notes &notes) {
                                   return run_database(row, name, maker, records, notes);
                               }});
    }
    race(row, contestants);
    row.extras["reads_every_batches"] = static_cast<double>(read_every);
}

} // namespace

void add_thesis_databases(Cases &cases) { cases.push_back({"thesis.fig3.6", "ms/batch", {}, databases_case}); }

} // namespace bench
