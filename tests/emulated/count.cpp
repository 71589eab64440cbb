// Counts what the brick solver of the CUDA backend does on the inputs of the gpu.* benchmarks, by the emulated device:
// rounds, visits of bricks, passes within them, the memory they move, and how long an H200 would take to move it.
// count [side]: up to which cubes, default 64.
#include "graph/device/field.hpp"
#include "tests/bench/data/volumes.hpp"
#include "tests/bench/harness/cases.hpp"
#include "tests/emulated/device.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace bench {

std::string data_file(const std::string &path) {
    const char *folder = std::getenv("LOCUS_DATA");
    const std::filesystem::path file = std::filesystem::path(folder != nullptr ? folder : "../shared/data") / path;
    if (!std::filesystem::exists(file))
        throw std::runtime_error(file.string() + " is not there (set LOCUS_DATA to the data folder)");
    return file.string();
}

} // namespace bench

namespace {

using namespace locus;

constexpr uint32_t h200_blocks = 132 * 10;      // visits at the same time: multiprocessors, blocks by their registers
constexpr double floor_bytes = 12;              // a voxel's operand read, its word written and read once
constexpr double slow = 3.35e12, fast = 4.8e12; // bytes a second of an H100's and an H200's memory, nominal

locus_graph_options options_for(const bench::Volume &volume, uint32_t words) {
    locus_graph_options options{};
    options.struct_size = sizeof options;
    for (size_t a = 0; a < 3; ++a) {
        options.dims[a] = volume.dims[a];
        options.spacing[a] = volume.spacing[a];
    }
    options.connectivity = 26;
    options.stiffness_exponent = 1;
    options.max_seeds = 256;
    options.precision = 1.0 / 256;
    options.material_min = options.material_max = std::numeric_limits<double>::quiet_NaN();
    options.word_bits = words;
    options.backend = LOCUS_BACKEND_CPU;
    return options;
}

template <typename Word>
void count(const std::string &name, const bench::Volume &volume, const graph::Graph &graph) {
    std::vector<graph::Source> sources;
    for (const locus_seed &seed : volume.seeds)
        sources.push_back({graph.grid().index(seed.x, seed.y, seed.z), 0, static_cast<uint32_t>(sources.size())});
    device::Device device(device::emulated::table());
    device::Field<Word> field(device, graph);
    graph::Words words;
    Progress progress;
    field.solve({graph, sources}, &words, progress);
    const device::Work &work = field.work();
    // A visit reads words and operands of 10 x 10 x 10 cells, in sectors of 32 bytes, and writes at most its own words.
    const double word_sectors = sizeof(Word) == 4 ? 3 : 4, operand_sectors = 3;
    const double read =
        static_cast<double>(work.visits) * device::kHalo * device::kHalo * 32 * (word_sectors + operand_sectors);
    const double written = static_cast<double>(work.visits - work.vain) * device::kVoxels * sizeof(Word);
    const auto bricks = static_cast<double>(field.bricks_in_grid());
    const double moved = read + written, voxels = static_cast<double>(volume.voxels());
    std::printf("| %s | %u | %llu | %llu | %.0f | %.2f | %.2f | %.1f | %.0f | %.0f | %.1f | %.3f to %.3f | %.3f |\n",
                name.c_str(), graph.layout().bits, static_cast<unsigned long long>(work.rounds),
                static_cast<unsigned long long>(work.launched), bricks, static_cast<double>(work.visits) / bricks,
                static_cast<double>(work.vain) / bricks,
                static_cast<double>(work.passes) / static_cast<double>(work.visits), moved / 1e6, moved / voxels,
                moved / voxels / floor_bytes, 1e3 * moved / fast, 1e3 * moved / slow,
                1e3 * floor_bytes * voxels / fast);
    std::fflush(stdout);
}

void count(const std::string &name, const bench::Volume &volume, uint32_t words) {
    const graph::Graph graph(options_for(volume, words), volume.compliance.data());
    graph.layout().bits == 32 ? count<uint32_t>(name, volume, graph) : count<uint64_t>(name, volume, graph);
}

} // namespace

int main(int argc, char **argv) {
    device::emulated::settings().blocks = h200_blocks;
    const uint64_t most = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 64;
    std::printf(
        "| input | word | rounds | launched | bricks | visits a brick | in vain | passes a visit | MB moved | bytes "
        "a voxel | times the floor | ms, moved | ms, floor |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (uint64_t side = 32; side <= most; side *= 2)
        for (const std::string topology : {"constant", "gradient", "noise", "maze"})
            count("cube" + std::to_string(side) + "." + topology + ".s10", bench::cube(topology, side, 10),
                  LOCUS_WORD_32);
    count("plate.constant.s20", bench::plate("constant", 20), LOCUS_WORD_32);
    try {
        count("steak.s10", bench::steak(10), LOCUS_WORD_AUTO);
    } catch (const std::exception &reason) {
        std::printf("steak.s10 left out: %s\n", reason.what());
    }
}
