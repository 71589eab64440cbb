// Runs ours and the peers in turns on the same input and gathers their times.
#ifndef LOCUS_BENCH_RACE_HPP
#define LOCUS_BENCH_RACE_HPP

#include "tests/bench/harness/row.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace bench {

/// Numbers that one contestant notes beside its time in each of its runs; the row gets their medians.
class Notes {
public:
    void add(const std::string &name, double value) { values_[name].push_back(value); }
    const std::map<std::string, std::vector<double>> &all() const { return values_; }

private:
    std::map<std::string, std::vector<double>> values_;
};

struct Contestant {
    std::string peer;                    ///< the peer's name; empty for ours
    std::function<double(Notes &)> once; ///< does the work once and returns its time in the row's unit
};

/// Run all contestants in turns, at least 5 times each, 3 times where a run takes more than 5 s, twice where the row is
/// quick, or `runs` times if that is not 0. Ours fills row.ours, the others row.peers; their notes become extras, those
/// of a peer with its name in front.
void race(Row &row, const std::vector<Contestant> &contestants, std::size_t runs = 0);

/// The q-quantile (0..1) of `values` (not empty).
double quantile(std::vector<double> values, double q);

} // namespace bench
#endif
