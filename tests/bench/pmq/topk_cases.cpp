// pmq.topk.k100.r30km and thesis.fig3.10: top-k by the space-time score, K = 100, R = 30 km, T = 10,000 s, alpha = 0.2.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/live_window.hpp"

#include <cmath>
#include <numeric>

namespace bench {
namespace {

std::vector<TopK> topk_queries(const Window &window, std::size_t count) {
    std::mt19937_64 random(12);
    std::vector<TopK> queries;
    while (queries.size() < count) {
        const locus_point32 &centre = window.live[random() % window.live.size()];
        queries.push_back({centre.latitude, centre.longitude, window.records.back().time});
    }
    return queries;
}

/// The best scores by a plain scan.
std::vector<double> scan_topk(const Window &window, const TopK &query) {
    const locus_box box = box_around(query.latitude, query.longitude, 1.01e-3 * TopK::radius_m);
    std::vector<double> scores;
    for (const locus_point32 &record : window.live) {
        if (inside(box, record.latitude, record.longitude)) {
            const double score = query.score(record.latitude, record.longitude, record.time);
            if (std::isfinite(score)) {
                scores.push_back(score);
            }
        }
    }
    std::sort(scores.begin(), scores.end());
    scores.resize(std::min(scores.size(), TopK::k));
    return scores;
}

bool same(const std::vector<double> &a, const std::vector<double> &b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return std::abs(x - y) < 1e-9; });
}

void check_topk(Row &row, const Window &window, std::vector<Filled> &stores, const std::vector<TopK> &queries) {
    for (const TopK &query : queries) {
        const std::vector<double> want = scan_topk(window, query);
        for (Filled &filled : stores) {
            row.check(same(filled.store->topk(query), want), filled.peer + " ranks others than a scan");
        }
    }
}

void topk_case(Row &row) {
    const Window window(row.quick);
    std::vector<Filled> stores = fill(window);
    const std::vector<TopK> queries = topk_queries(window, row.quick ? 4 : 24);
    std::vector<Contestant> contestants;
    for (Filled &filled : stores) {
        contestants.push_back({filled.peer, [&](Notes &) {
                                   std::vector<uint64_t> found;
                                   return per_query(queries.size(), found, [&](std::size_t q) {
                                       return filled.store->topk(queries[q]).size();
                                   });
                               }});
    }
    race(row, contestants);
    check_topk(row, window, stores, queries);
}

/// The thesis asks 10,000 times, and prints how many are answered within a time.
void latencies_case(Row &row) {
    const Window window(row.quick);
    std::vector<Filled> stores = fill(window);
    std::erase_if(stores, [](const Filled &filled) { return filled.peer == "btree"; });
    const std::vector<TopK> queries = topk_queries(window, row.quick ? 100 : 10'000);
    std::vector<Contestant> contestants;
    for (Filled &filled : stores) {
        contestants.push_back({filled.peer, [&](Notes &notes) {
                                   std::vector<double> times;
                                   for (const TopK &query : queries) {
                                       times.push_back(1e3 * timed([&] { filled.store->topk(query); }));
                                   }
                                   for (int percent = 1; percent <= 100; ++percent) {
                                       notes.add(std::string("p").append(std::to_string(percent)).append("_ms"),
                                                 quantile(times, static_cast<double>(percent) / 100));
                                   }
                                   return std::accumulate(times.begin(), times.end(), 0.0) /
                                          static_cast<double>(times.size());
                               }});
    }
    race(row, contestants);
    check_topk(row, window, stores, {queries.begin(), queries.begin() + 10});
    row.extras["thesis_p90_ms"] = 4; // Intel i7-4790
}

} // namespace

void add_pmq_topk(Cases &cases) {
    cases.push_back({"pmq.topk.k100.r30km", "us", {{"array", 3.5}, {"btree", 18}}, topk_case});
    cases.push_back({"thesis.fig3.10", "ms", {}, latencies_case});
}

} // namespace bench
