// thesis.fig3.9: squares of 1 to 400 km around the heaviest city, counted and read, with every layout and a dense
// vector.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <algorithm>
#include <numeric>

namespace bench {
namespace {

using Point = locus_point32;

struct Held {
    std::string peer;
    std::unique_ptr<Store<Point>> store;
};

std::vector<Held> fill_all(const std::vector<Point> &records) {
    std::vector<Held> stores;
    stores.push_back({"", make_locus<Point>(Layout::ours, LOCUS_NO_HORIZON)});
    stores.push_back({"array", make_locus<Point>(Layout::array, LOCUS_NO_HORIZON)});
    stores.push_back({"array_explicit", make_locus<Point>(Layout::array_explicit, LOCUS_NO_HORIZON)});
    stores.push_back({"array_heads", make_locus<Point>(Layout::array_heads, LOCUS_NO_HORIZON)});
    for (Held &held : stores) {
        feed<Point>(*held.store, records, 1000);
    }
    stores.push_back({"vector_sort", make_vector(Sorting::std_sort, DenseIndex::implicit)});
    stores.back().store->load(records, records.back().time);
    return stores;
}

/// Times `ask` often enough for a short query: microseconds.
template <class Ask>
double microseconds(Ask ask) {
    ask();
    std::size_t runs = 0;
    double seconds = 0;
    while (runs < 3 || seconds < 0.01) {
        seconds += timed(ask);
        ++runs;
    }
    return 1e6 * seconds / static_cast<double>(runs);
}

void radius_case(Row &row) {
    const std::vector<Point> records = clustered<Point>(row.quick ? 300'000 : 10'000'000, 1000);
    std::vector<Held> stores = fill_all(records);
    double latitude, longitude;
    heaviest_city(latitude, longitude);
    constexpr int radii_km[] = {1, 2, 5, 10, 20, 50, 100, 200, 400};
    std::vector<Point> out(records.size());
    std::vector<Contestant> contestants;
    for (Held &held : stores) {
        contestants.push_back({held.peer, [&](Notes &notes) {
                                   double reading = 0;
                                   for (const int km : radii_km) {
                                       const locus_box box = box_around(latitude, longitude, km);
                                       const double count = microseconds([&] { held.store->count(box); });
                                       const double read = microseconds([&] { held.store->read(box, out); });
                                       notes.add("count_us_" + std::to_string(km) + "km", count);
                                       notes.add("read_us_" + std::to_string(km) + "km", read);
                                       reading += read;
                                   }
                                   return reading / static_cast<double>(std::size(radii_km));
                               }});
    }
    race(row, contestants);
    for (const int km : radii_km) {
        const locus_box box = box_around(latitude, longitude, km);
        const auto want = static_cast<uint64_t>(std::count_if(
            records.begin(), records.end(), [&](const Point &r) { return inside(box, r.latitude, r.longitude); }));
        row.extras["records_" + std::to_string(km) + "km"] = static_cast<double>(want);
        for (Held &held : stores) {
            row.check(held.store->count(box) == want && held.store->read(box, out) == want,
                      held.peer + " finds other numbers than a scan");
        }
    }
}

} // namespace

void add_thesis_queries(Cases &cases) { cases.push_back({"thesis.fig3.9", "us", {}, radius_case}); }

} // namespace bench
