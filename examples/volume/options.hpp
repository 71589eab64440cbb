// The command line of the volume program.
#pragma once

#include "volume/transfer.hpp"

#include <locus/diagram.h>
#include <locus/volume.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace volume {

// A seed's frame moved within the picture of the first slice: shifted (units of length) and turned (clockwise).
struct Motion {
    uint32_t id;
    double right, down, degrees;
};

// A blade that moves from the edge (from, side) until `from` has come to `to`; places in voxels from 0, whole ones at
// the voxels' centres.
struct Blade {
    std::array<double, 3> from, to, side;
};

struct Options {
    std::string input;
    std::string out = "volume-out";
    std::string title;
    locus_volume_read_options read{}; // of the input, raw files included
    std::string flip;                 // grid axes that run against the world's, among x, y, z
    std::optional<TransferTable> table;
    bool largest_part = false;     // all other parts of the material are dropped
    std::vector<locus_seed> seeds; // given ones, which stay where they are
    uint64_t place = 0;
    uint32_t lloyd = 100;
    uint32_t metric = LOCUS_PLACE_COMPLIANCE;
    uint32_t connectivity = 26;
    uint32_t weight_rule = LOCUS_WEIGHT_MEAN_COMPLIANCE;
    uint32_t word_bits = LOCUS_WORD_AUTO;
    uint32_t engine = LOCUS_ENGINE_AUTO;
    uint32_t threads = 0;
    std::optional<std::array<uint64_t, 3>> slice;
    std::optional<std::array<double, 2>> window; // values shown black and white
    int width = 1460;                            // of the three slices together, in pixels
    bool anatomy = false;
    bool trace = true;
    bool weights = false;               // draw and write them
    std::vector<uint32_t> weight_seeds; // those drawn; none: the first few
    std::vector<Motion> motions;        // of the deformation; none: it is left out
    bool waves = false;                 // draw how the distances spread
    std::optional<Blade> cut;           // through the object, and through the deformed one
    uint32_t cut_steps = 12;
};

// Parse the command line; prints the help or what is wrong and returns the exit status where the program must end.
std::optional<int> parse_options(int count, char **words, Options &options);

} // namespace volume
