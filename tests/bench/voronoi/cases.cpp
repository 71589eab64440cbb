// voronoi.*: cubes, plate, steak and head CT against heap and bucket queue, one thread and two, and scikit-image.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/machine.hpp"
#include "tests/bench/voronoi/skimage.hpp"
#include "tests/bench/voronoi/solve.hpp"

namespace bench {
namespace {

using Goals = std::map<std::string, double>;
using Make = std::function<Volume(bool quick)>;

void solve_case(Row &row, const Volume &volume, uint32_t threads, uint32_t words) {
    race_engines(row, volume,
                 {{"", LOCUS_ENGINE_AUTO, threads, words},
                  {"heap", LOCUS_ENGINE_HEAP, 1, words},
                  {"dial", LOCUS_ENGINE_BUCKET, 1, words}});
    // The memory floor: 12 bytes a voxel at the speed at which this machine copies, in this very run.
    const double bandwidth = copy_bandwidth(threads);
    row.extras["floor_ratio"] = row.ours.median * bandwidth / (1e3 * 12 * static_cast<double>(volume.voxels()));
    row.extras["copy_gb_per_s"] = bandwidth / 1e9;
}

/// The case with two threads, and its twin .t1 with one, for the record.
void add_pair(Cases &cases, const std::string &name, const Goals &goals, const Make &make,
              uint32_t words = LOCUS_WORD_32) {
    for (const uint32_t threads : {2U, 1U}) {
        cases.push_back({name + (threads == 1 ? ".t1" : ""), "ms", threads == 1 ? Goals{} : goals,
                         [=](Row &row) { solve_case(row, make(row.quick), threads, words); }});
    }
}

/// 64-bit words beside 32-bit ones of the same engine.
void word_case(Row &row) {
    const Volume volume = cube("gradient", row.quick ? 32 : 128, 10);
    race_engines(row, volume,
                 {{"", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_64}, {"word32", LOCUS_ENGINE_AUTO, 1, LOCUS_WORD_32}});
}

void add_cubes(Cases &cases) {
    struct Cube {
        uint64_t side;
        const char *topology;
        Goals goals;
    };
    const Cube cubes[] = {{256, "constant", {{"heap", 50}, {"dial", 22}}},
                          {256, "gradient", {{"heap", 50}, {"dial", 18}}},
                          {256, "noise", {{"heap", 32}, {"dial", 16}}},
                          {256, "maze", {{"dial", 17}}},
                          {128, "constant", {{"heap", 28}}},
                          {128, "gradient", {{"heap", 40}}},
                          {128, "noise", {{"heap", 20}}},
                          {128, "maze", {{"heap", 16}}}};
    for (const Cube &entry : cubes) {
        add_pair(cases, "voronoi.cube" + std::to_string(entry.side) + "." + entry.topology + ".s10", entry.goals,
                 [side = entry.side, topology = std::string(entry.topology)](bool quick) {
                     return cube(topology, quick ? side / 4 : side, 10);
                 });
    }
}

} // namespace

void add_voronoi(Cases &cases) {
    add_cubes(cases);
    add_pair(cases, "voronoi.plate.s20", {{"heap", 15}}, [](bool) { return plate("gradient", 20); });
    // From bone to fat the compliances of the steak differ by six orders of magnitude: words of 64 bits.
    add_pair(
        cases, "voronoi.steak.s3", {{"heap", 12}}, [](bool) { return steak(3); }, LOCUS_WORD_AUTO);
    add_pair(
        cases, "voronoi.steak.s10", {{"heap", 12}}, [](bool) { return steak(10); }, LOCUS_WORD_AUTO);
    add_pair(cases, "voronoi.ct.s32", {{"heap", 15}}, [](bool) { return head_ct(32); });
    cases.push_back({"voronoi.cube128.gradient.s10.w64", "ms", {{"word32", 1 / 1.8}}, word_case});
    cases.push_back({"voronoi.cube128.gradient.skimage", "ms", {{"skimage", 40}}, skimage_case});
}

} // namespace bench
