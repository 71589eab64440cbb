// One row of the benchmark table: what a case measured, as a JSON line and as a line on the terminal.
#ifndef LOCUS_BENCH_ROW_HPP
#define LOCUS_BENCH_ROW_HPP

#include <map>
#include <string>
#include <vector>

namespace bench {

struct Spread {
    double median = 0, min = 0, max = 0;
    std::size_t runs = 0;
};

/// Median, least and largest of `values` (not empty).
Spread spread(std::vector<double> values);

struct Row {
    std::string name, unit;
    unsigned threads = 1;
    bool quick = false;
    bool huge_pages = false;
    std::string target, backend = "cpu";
    Spread ours;
    std::map<std::string, Spread> peers;
    std::map<std::string, double> goals;  ///< the ratio a case aims at, by peer
    std::map<std::string, double> extras; ///< further numbers: p99, import_ms, ...
    std::vector<std::string> failures;    ///< checks against the oracle that did not hold
    unsigned checks = 0;                  ///< checks made

    /// Compare with the oracle: remember that it was done, and what failed.
    void check(bool holds, const std::string &what);
    bool checked() const { return checks > 0 && failures.empty(); }
    /// How many times longer a peer takes.
    double ratio(const std::string &peer) const { return peers.at(peer).median / ours.median; }

    std::string json() const;
    std::string line() const;
    static std::string heading();
};

} // namespace bench
#endif
