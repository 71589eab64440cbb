// Real material maps: the T-bone steak and the head CT.
#include "tests/bench/data/volumes.hpp"
#include "tests/bench/harness/cases.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>

namespace bench {
namespace {

constexpr float outside = std::numeric_limits<float>::quiet_NaN();

/// Young's modulus of a grey value: 255 is bone, the others meat and fat, lighter is softer.
double steak_modulus(unsigned char grey) { return grey == 255 ? 1.5e10 : 20000 - 15000 * (grey - 1) / 253.0; }

} // namespace

Volume steak(std::size_t seeds) {
    Volume out;
    out.dims = {64, 64, 15};
    out.spacing = {0.15, 0.15, 0.15};
    std::vector<unsigned char> grey(64 * 64 * 15);
    std::ifstream raw(data_file("steak/steak_64x64x15.raw"), std::ios::binary);
    if (!raw.read(reinterpret_cast<char *>(grey.data()), static_cast<std::streamsize>(grey.size()))) {
        throw std::runtime_error("the steak's file is too short");
    }
    for (const unsigned char value : grey) {
        out.compliance.push_back(value == 0 ? outside : static_cast<float>(5000 / steak_modulus(value)));
    }
    std::ifstream places(data_file("steak/seeds_" + std::to_string(seeds) + ".txt"));
    for (std::string line; std::getline(places, line);) {
        locus_seed seed{};
        if (std::istringstream words(line); line[0] != '#' && words >> seed.x >> seed.y >> seed.z) {
            seed.id = static_cast<uint32_t>(out.seeds.size());
            out.seeds.push_back(seed);
        }
    }
    return out;
}

Volume head_ct(std::size_t seeds) {
    const std::string archive = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";
    if (!std::filesystem::exists(archive)) {
        throw Missing(archive + " is not there (Debian package invesalius-examples)");
    }
    Volume out;
    out.dims = {256, 256, 108};
    out.spacing = {0.957, 0.957, 1.5};
    std::vector<int16_t> hounsfield(256 * 256 * 108);
    const std::string command = "tar -xzOf " + archive + " --wildcards '*/matrix.dat'";
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> pipe(popen(command.c_str(), "r"), pclose);
    if (!pipe || std::fread(hounsfield.data(), sizeof(int16_t), hounsfield.size(), pipe.get()) != hounsfield.size()) {
        throw std::runtime_error("cannot read the head CT from " + archive);
    }
    for (const int16_t value : hounsfield) {
        out.compliance.push_back(value < -300 ? outside : value < 226 ? 10.0F : 1.0F);
    }
    scatter_seeds(out, seeds, 1);
    return out;
}

} // namespace bench
