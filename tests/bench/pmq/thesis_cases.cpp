// thesis.table3.1 and thesis.fig3.7: 10^6 records in batches of 100 into the packed array and into dense vectors.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <utility>

namespace bench {
namespace {

using Point = locus_point32;

/// A dense vector moves half of what it holds with every batch: only one batch in this many is timed.
constexpr std::size_t sample_every = 50;

struct Entrant {
    std::string peer;
    std::function<std::unique_ptr<Store<Point>>()> make;
    bool sampled = false;
};

void race_inserts(Row &row, const std::vector<Entrant> &entrants) {
    const std::vector<Point> records = clustered<Point>(row.quick ? 20'000 : 1'000'000, 100);
    std::vector<Contestant> contestants;
    for (const Entrant &entrant : entrants) {
        contestants.push_back({entrant.peer, [&row, &records, entrant, first = true](Notes &notes) mutable {
                                   const auto store = entrant.make();
                                   const std::vector<double> pauses =
                                       entrant.sampled ? feed_sampled<Point>(*store, records, 100, sample_every)
                                                       : feed<Point>(*store, records, 100);
                                   if (std::exchange(first, false)) {
                                       check_store<Point>(row, entrant.peer, *store, records);
                                   }
                                   return note_pauses(notes, pauses) / 1e3;
                               }});
    }
    race(row, contestants);
    row.extras["dense_batches_timed_one_in"] = static_cast<double>(sample_every);
}

void add_dense(std::vector<Entrant> &entrants, DenseIndex index) {
    const auto dense = [&](const char *peer, Sorting sorting) {
        entrants.push_back({peer, [=] { return make_vector(sorting, index); }, true});
    };
    if (have_adaptive_sort()) {
        dense("vector_sort", Sorting::adaptive);
    }
    dense("vector_std_sort", Sorting::std_sort);
    dense("vector_merge", Sorting::merge);
}

void implicit_case(Row &row) {
    std::vector<Entrant> entrants{{"", [] { return make_locus<Point>(Layout::ours, LOCUS_NO_HORIZON); }}};
    entrants.push_back({"array", [] { return make_locus<Point>(Layout::array, LOCUS_NO_HORIZON); }});
    add_dense(entrants, DenseIndex::implicit);
    race_inserts(row, entrants);
    // Table 3.1, Intel i7-4790, milliseconds a batch.
    row.extras["thesis_pmq_mean_ms"] = 0.154;
    row.extras["thesis_pmq_max_ms"] = 41.560;
    row.extras["thesis_timsort_mean_ms"] = 3.725;
    row.extras["thesis_std_sort_mean_ms"] = 30.320;
}

void explicit_case(Row &row) {
    std::vector<Entrant> entrants{{"", [] { return make_locus<Point>(Layout::array_explicit, LOCUS_NO_HORIZON); }},
                                  {"array", [] { return make_locus<Point>(Layout::array, LOCUS_NO_HORIZON); }}};
    add_dense(entrants, DenseIndex::explicit_quadtree);
    race_inserts(row, entrants);
    // What the explicit index adds to the packed array's own insertion.
    row.extras["index_update_ms"] = row.ours.median - row.peers["array"].median;
}

} // namespace

void add_thesis_chapter3(Cases &cases) {
    cases.push_back({"thesis.table3.1", "ms/batch", {}, implicit_case, Pages::both});
    cases.push_back({"thesis.fig3.7", "ms/batch", {}, explicit_case, Pages::any});
}

} // namespace bench
