// pmq.count.*, pmq.read.* and pmq.tile.*: queries of 10 M records under a live horizon. Reads are in whichever order is
// quickest; `.sorted`: in that of the keys.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/cover.hpp"
#include "tests/bench/pmq/live_window.hpp"

namespace bench {
namespace {

uint64_t scan_count(const Window &window, const locus_box &box) {
    return static_cast<uint64_t>(std::count_if(window.live.begin(), window.live.end(), [&](const locus_point32 &r) {
        return inside(box, r.latitude, r.longitude);
    }));
}

enum class Asking { count, read, read_sorted };

uint64_t ask(TileStore<locus_point32> &store, Asking asking, const locus_box &box, std::span<locus_point32> out) {
    switch (asking) {
    case Asking::count:
        return store.count(box);
    case Asking::read:
        return store.read(box, out);
    default:
        return store.read_sorted(box, out);
    }
}

void box_case(Row &row, double radius_km, Asking asking) {
    const Window window(row.quick);
    std::vector<Filled> stores = fill(window);
    const std::vector<locus_box> queries = boxes(window, radius_km, row.quick ? 4 : 24);
    std::vector<uint64_t> want;
    for (const locus_box &box : queries) {
        want.push_back(scan_count(window, box));
    }
    std::vector<locus_point32> out(*std::max_element(want.begin(), want.end()));
    std::vector<Contestant> contestants;
    for (Filled &filled : stores) {
        contestants.push_back({filled.peer, [&](Notes &) {
                                   std::vector<uint64_t> found;
                                   const double time = per_query(queries.size(), found, [&](std::size_t q) {
                                       return ask(*filled.store, asking, queries[q], out);
                                   });
                                   row.check(found == want, filled.peer + " finds other numbers than a scan");
                                   return time;
                               }});
    }
    race(row, contestants);
    for (Filled &filled : stores) {
        check_store<locus_point32>(row, filled.peer, *filled.store, window.live);
    }
    double sum = 0;
    for (const uint64_t records : want) {
        sum += static_cast<double>(records);
    }
    row.extras["records_per_query"] = sum / static_cast<double>(want.size());
}

/// The bins of a tile by a plain scan.
std::vector<uint32_t> scan_tile(const Window &window, const TileId &tile) {
    std::vector<uint32_t> bins(tile_bins);
    for (const locus_point32 &record : window.live) {
        const TilePlace place = place_of(record.latitude, record.longitude);
        const unsigned below = key_levels - tile.zoom;
        if (place.x >> below == tile.x && place.y >> below == tile.y) {
            const uint32_t x = place.x >> (below - 8) & 255, y = place.y >> (below - 8) & 255;
            ++bins[y * 256 + x];
        }
    }
    return bins;
}

/// The 256x256 tile over the heaviest city, where there is most to count.
void tile_case(Row &row, unsigned zoom) {
    const Window window(row.quick);
    std::vector<Filled> stores = fill(window);
    double latitude, longitude;
    heaviest_city(latitude, longitude);
    const TilePlace place = place_of(latitude, longitude);
    const TileId tile{zoom, place.x >> (key_levels - zoom), place.y >> (key_levels - zoom)};
    const std::vector<uint32_t> want = scan_tile(window, tile);
    std::vector<uint32_t> bins(tile_bins);
    std::vector<Contestant> contestants;
    for (Filled &filled : stores) {
        contestants.push_back({filled.peer, [&](Notes &) {
                                   const double seconds = timed_rounds([&] { filled.store->tile(tile, bins); });
                                   row.check(bins == want, filled.peer + " counts other bins than a scan");
                                   return 1e6 * seconds;
                               }});
    }
    race(row, contestants);
}

} // namespace

void add_pmq_queries(Cases &cases) {
    struct Radius {
        double km;
        std::map<std::string, double> count_goals, read_goals;
    };
    const Radius radii[] = {{1, {{"array", 4}, {"btree", 10}}, {{"array", 1.6}, {"btree", 4}}},
                            {30, {{"array", 4}, {"btree", 100}}, {{"array", 1.8}, {"btree", 15}}},
                            {400, {{"array", 7}, {"btree", 100}}, {{"array", 2.2}, {"btree", 15}}}};
    for (const Radius &radius : radii) {
        const auto add = [&](const char *prefix, const char *suffix, Asking asking, const auto &goals) {
            cases.push_back({prefix + std::to_string(static_cast<int>(radius.km)) + "km" + suffix, "us", goals,
                             [km = radius.km, asking](Row &row) { box_case(row, km, asking); }});
        };
        add("pmq.count.", "", Asking::count, radius.count_goals);
        add("pmq.read.", "", Asking::read, radius.read_goals);
        add("pmq.read.", ".sorted", Asking::read_sorted, std::map<std::string, double>());
    }
    const std::pair<unsigned, double> zooms[] = {{2, 1.6}, {4, 3.5}, {6, 5}, {8, 5}, {10, 10}, {12, 8}};
    for (const auto &[zoom, goal] : zooms) {
        cases.push_back({"pmq.tile.z" + std::to_string(zoom), "us", {{"array", goal}}, [level = zoom](Row &row) {
                             tile_case(row, level);
                         }});
    }
}

} // namespace bench
