// The list of benchmark cases and what a case is given.
#ifndef LOCUS_BENCH_CASES_HPP
#define LOCUS_BENCH_CASES_HPP

#include "tests/bench/harness/race.hpp"
#include "tests/bench/harness/row.hpp"

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

/// Thrown by a case whose data or outside program is not there: it is left out, with this text on stderr.
struct Missing : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class Pages { any, both }; ///< both: a second row, NAME.4k, is measured without huge pages

struct Case {
    std::string name, unit;
    std::map<std::string, double> goals;
    std::function<void(Row &)> run;
    Pages pages = Pages::any;
};

using Cases = std::vector<Case>;

/// The folder of the outside data, $LOCUS_DATA, joined with `path`; throws Missing where there is no such file.
std::string data_file(const std::string &path);

void add_pmq_insert(Cases &cases);
void add_pmq_window(Cases &cases);
void add_pmq_readers(Cases &cases);
void add_pmq_queries(Cases &cases);
void add_pmq_storage(Cases &cases);
void add_pmq_topk(Cases &cases);
void add_pmq_cold(Cases &cases);
void add_voronoi(Cases &cases);
void add_voronoi_large(Cases &cases);
void add_updates(Cases &cases);
void add_weights(Cases &cases);
void add_thesis_chapter2(Cases &cases);
void add_thesis_weights(Cases &cases);
void add_gpu(Cases &cases);
void add_thesis_chapter3(Cases &cases);
void add_thesis_steady(Cases &cases);
void add_thesis_queries(Cases &cases);
void add_thesis_databases(Cases &cases);

} // namespace bench
#endif
