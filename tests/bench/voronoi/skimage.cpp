// Runs scikit-image's MCP_Geometric in a process of its own and compares its distances with ours.
#include "tests/bench/voronoi/skimage.hpp"

#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/scratch.hpp"
#include "tests/bench/voronoi/solve.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

namespace bench {
namespace {

constexpr const char *python = "/usr/bin/python3"; // Debian's own, which has Debian's scikit-image

template <class Value>
void write_raw(const std::string &path, const std::vector<Value> &values) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char *>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

/// CPU milliseconds of find_costs, as the script prints them; the distances are left in costs.raw.
double run_script(const Scratch &scratch, uint64_t side) {
    const std::string command = std::string(python) + " tests/bench/voronoi/skimage_mcp.py " + scratch.path().string() +
                                " " + std::to_string(side);
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> pipe(popen(command.c_str(), "r"), pclose);
    double milliseconds = 0;
    if (!pipe || std::fscanf(pipe.get(), "%lf", &milliseconds) != 1) {
        throw std::runtime_error("skimage_mcp.py gave no time");
    }
    return milliseconds;
}

/// The largest relative difference of two distance fields.
double difference(const std::vector<float> &ours, const std::vector<double> &theirs) {
    double worst = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        worst = std::max(worst, std::abs(static_cast<double>(ours[i]) - theirs[i]) / std::max(theirs[i], 1e-9));
    }
    return worst;
}

} // namespace

void skimage_case(Row &row) {
    if (std::system((std::string(python) + " -c 'import skimage.graph' 2>/dev/null").c_str()) != 0) {
        throw Missing("scikit-image is not there (make bench-deps installs it)");
    }
    const uint64_t side = row.quick ? 32 : 128;
    const Volume volume = cube("gradient", side, 10);
    const Scratch scratch;
    write_raw(scratch.file("compliance.raw"), volume.compliance);
    std::vector<int64_t> starts;
    for (const locus_seed &seed : volume.seeds) {
        starts.insert(starts.end(),
                      {static_cast<int64_t>(seed.z), static_cast<int64_t>(seed.y), static_cast<int64_t>(seed.x)});
    }
    write_raw(scratch.file("starts.raw"), starts);

    Solver solver(volume, {"", LOCUS_ENGINE_AUTO, 2, LOCUS_WORD_32});
    race(row, {{"", [&](Notes &notes) { return solver.solve(notes); }},
               {"skimage", [&](Notes &) { return run_script(scratch, side); }}});
    row.threads = 2;
    row.target = simd_name(solver.info().simd);
    std::vector<double> theirs(volume.voxels());
    std::ifstream(scratch.file("costs.raw"), std::ios::binary)
        .read(reinterpret_cast<char *>(theirs.data()), static_cast<std::streamsize>(theirs.size() * sizeof(double)));
    const double worst = difference(solver.distances(), theirs);
    row.extras["distance_difference"] = worst;
    row.check(worst <= solver.info().weight_error + 1e-5,
              "distances differ from scikit-image's by " + std::to_string(worst));
}

} // namespace bench
