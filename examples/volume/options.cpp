// CLI11 turns the words into Options.
#include "volume/options.hpp"

#include "volume/model.hpp"
#include "volume/text.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <map>
#include <stdexcept>

namespace volume {
namespace {

constexpr const char *description =
    "Voronoi diagram of a volume: which seed is nearest to every voxel, and how far, along paths through the "
    "material.\n"
    "\n"
    "Reads a volume (MetaImage .mhd .mha, NRRD .nrrd .nhdr, NIfTI .nii .nii.gz, or --raw numbers), turns its values "
    "into\n"
    "stiffness by a transfer table, places seeds, and writes pictures, labels.nrrd and distances.nrrd, which 3-D "
    "Slicer and\n"
    "ParaView open. A path is the longer, the softer what it crosses: its weight is length / stiffness.\n";

constexpr const char *footer =
    "Transfer table: one entry a line in a file, or separated by ';' with --map; '#' begins a comment.\n"
    "  point VALUE STIFFNESS     a point of a piecewise linear curve\n"
    "  label VALUE STIFFNESS     voxels of exactly this value\n"
    "  range FROM TO STIFFNESS   voxels with FROM <= value < TO; -inf and inf are numbers here\n"
    "  STIFFNESS is a number above 0 (Pa, say) or none, which is impassable. The first label or range that holds a "
    "value\n"
    "  decides, else the curve does; a value that nothing holds is impassable.\n"
    "Seeds file: lines 'x y z [id]', voxel indices from 0; '#' begins a comment.\n"
    "\n"
    "Examples:\n"
    "  volume head.nii.gz --map 'range -300 226 1e4; range 226 inf 1e9' --place 32 --anatomy --out head\n"
    "  volume parts.nrrd --table stiffness.txt --seeds frames.txt --out parts\n"
    "  volume parts.nrrd --table stiffness.txt --seeds frames.txt --weights --deform 2 -1.5 0 20 \\\n"
    "      --cut 30.5 -1 -1  30.5 20 -1  30.5 -1 9\n"
    "  volume ct.dat --raw 256 256 108 --raw-type int16 --raw-spacing 1 1 1.5 --map 'range -300 inf 1' --place 8\n";

const std::map<std::string, uint32_t> types{{"uint8", LOCUS_VOXEL_UINT8},     {"int8", LOCUS_VOXEL_INT8},
                                            {"uint16", LOCUS_VOXEL_UINT16},   {"int16", LOCUS_VOXEL_INT16},
                                            {"uint32", LOCUS_VOXEL_UINT32},   {"int32", LOCUS_VOXEL_INT32},
                                            {"uint64", LOCUS_VOXEL_UINT64},   {"int64", LOCUS_VOXEL_INT64},
                                            {"float32", LOCUS_VOXEL_FLOAT32}, {"float64", LOCUS_VOXEL_FLOAT64}};
const std::map<std::string, uint32_t> metrics{{"compliance", LOCUS_PLACE_COMPLIANCE}, {"uniform", LOCUS_PLACE_UNIFORM}};
const std::map<std::string, uint32_t> rules{{"mean-compliance", LOCUS_WEIGHT_MEAN_COMPLIANCE},
                                            {"max-compliance", LOCUS_WEIGHT_MAX_COMPLIANCE},
                                            {"mean-stiffness", LOCUS_WEIGHT_MEAN_STIFFNESS},
                                            {"uniform", LOCUS_WEIGHT_UNIFORM}};
const std::map<std::string, uint32_t> words_of_bits{
    {"auto", LOCUS_WORD_AUTO}, {"32", LOCUS_WORD_32}, {"64", LOCUS_WORD_64}};
const std::map<std::string, uint32_t> engines{{"auto", LOCUS_ENGINE_AUTO},
                                              {"heap", LOCUS_ENGINE_HEAP},
                                              {"bucket", LOCUS_ENGINE_BUCKET},
                                              {"relax", LOCUS_ENGINE_RELAX},
                                              {"bricks", LOCUS_ENGINE_BRICKS}};

// An option that takes one of the names; CLI11's help lists them.
CLI::Option *choice(CLI::App &app, const std::string &name, uint32_t &value, const std::string &text,
                    const std::map<std::string, uint32_t> &names) {
    return app
        .add_option_function<std::string>(
            name, [&value, &names](const std::string &word) { value = names.at(word); }, text)
        ->check(CLI::IsMember(names));
}

std::vector<Motion> motions_of(const std::vector<double> &numbers) {
    if (numbers.size() % 4 != 0)
        throw std::runtime_error("--deform takes four numbers a seed, not " + std::to_string(numbers.size()));
    std::vector<Motion> motions;
    for (size_t i = 0; i < numbers.size(); i += 4) {
        if (!(numbers[i] >= 0 && numbers[i] < LOCUS_NO_SEED) || numbers[i] != std::floor(numbers[i]))
            throw std::runtime_error("--deform: " + short_number(numbers[i]) + " is no seed's id");
        for (size_t k = 1; k < 4; ++k)
            if (!std::isfinite(numbers[i + k]))
                throw std::runtime_error("--deform: " + short_number(numbers[i + k]) + " is no length or angle");
        motions.push_back({static_cast<uint32_t>(numbers[i]), numbers[i + 1], numbers[i + 2], numbers[i + 3]});
    }
    return motions;
}

Blade blade_of(const std::vector<double> &numbers) {
    for (const double number : numbers)
        if (!std::isfinite(number))
            throw std::runtime_error("--cut: " + short_number(number) + " is no place");
    const auto corner = [&](size_t i) { return std::array{numbers[i], numbers[i + 1], numbers[i + 2]}; };
    return {corner(0), corner(3), corner(6)};
}

} // namespace

std::optional<int> parse_options(int count, char **words, Options &options) {
    if (locus_volume_read_options_init(&options.read, sizeof options.read) != LOCUS_OK)
        throw std::runtime_error(locus_io_last_error());
    CLI::App app(description, "volume");
    app.footer(footer);
    app.get_formatter()->column_width(36);

    std::vector<uint64_t> dims, slice;
    std::vector<double> spacing, window, motions, cut;
    std::string map, table, seeds_file;
    double memory_gib = 8;
    bool big_endian = false, no_trace = false;
    app.add_option("input", options.input, "the volume file")->required();
    app.add_option("-o,--out", options.out, "folder for the results, made if need be")->capture_default_str();
    app.add_option("--title", options.title, "heads the pictures; the file's name if not given");
    app.add_option("--memory", memory_gib, "most GiB the volume may take in memory")->capture_default_str();

    auto *raw = app.add_option("--raw", dims, "the input is raw numbers: voxels in x, y, z")->expected(3);
    choice(app, "--raw-type", options.read.raw_type, "type of the raw numbers", types)->needs(raw);
    app.add_option("--raw-spacing", spacing, "a raw voxel's edge lengths")->expected(3)->needs(raw);
    app.add_option("--raw-offset", options.read.raw_offset, "bytes before the raw numbers")->needs(raw);
    app.add_flag("--raw-big-endian", big_endian, "raw numbers have their high byte first")->needs(raw);
    app.add_option("--flip", options.flip,
                   "grid axes that run right, anterior or down instead of left, posterior, up: some of xyz")
        ->check([](const std::string &axes) {
            return axes.find_first_not_of("xyz") == std::string::npos ? "" : "only x, y and z are axes";
        });

    auto *file_option = app.add_option("-t,--table", table, "file with the transfer table from value to stiffness");
    auto *map_option = app.add_option("-m,--map", map, "the transfer table itself, entries separated by ';'");
    file_option->excludes(map_option);
    app.add_flag("--largest-part", options.largest_part,
                 "drop all parts of the material but the largest connected one");
    choice(app, "--rule", options.weight_rule, "weight of an edge (default mean-compliance)", rules);
    app.add_option("--neighbours", options.connectivity, "of a voxel: 6, 18 or 26")
        ->check(CLI::IsMember({6, 18, 26}))
        ->capture_default_str();
    choice(app, "--word", options.word_bits, "bits of a voxel's distance and label (default auto)", words_of_bits);

    app.add_option("-s,--seeds", seeds_file, "file with the seeds");
    app.add_option("-p,--place", options.place, "place so many (more) seeds: farthest points, then Lloyd's iterations");
    app.add_option("--lloyd", options.lloyd, "most iterations of Lloyd")->capture_default_str();
    choice(app, "--metric", options.metric, "distances used for placing (default compliance)", metrics);

    choice(app, "--engine", options.engine, "algorithm (default auto)", engines);
    app.add_option("--threads", options.threads, "most threads; 0: one per core")->capture_default_str();
    app.add_option("--slice", slice, "voxel through which the three slices go; default: the material's centre")
        ->expected(3);
    app.add_option("--window", window, "values shown black and white; default: the 1st and 99th percentile")
        ->expected(2);
    app.add_option("--width", options.width, "pixels across the three slices of a picture")
        ->check(CLI::Range(30, 20000))
        ->capture_default_str();
    app.add_flag("--anatomy", options.anatomy, "the volume is of a body: name the slices and their sides so");
    app.add_flag("--no-trace", no_trace, "skip the picture of active voxels per iteration");
    app.add_flag("-w,--weights", options.weights,
                 "also the seeds' interpolation weights: weights.png over the first slice, by three methods, and, of "
                 "Sibson's method and small volumes, weights.nrrd");
    app.add_option("--weight-seeds", options.weight_seeds, "ids of the seeds in weights.png; default: the first three");
    app.add_option("--deform", motions,
                   "also deform.png: the first slice moved by its seeds' frames. ID RIGHT DOWN DEGREES "
                   "shift and turn a seed's frame, once or for several seeds; the others stay")
        ->type_name("ID RIGHT DOWN DEGREES ...")
        ->expected(4, 400);
    app.add_flag(
        "--waves", options.waves,
        "also waves.png, animated, and waves-series.png: how distances spread through the first slice, iteration "
        "by iteration; slow on large volumes");
    auto *blade =
        app.add_option("--cut", cut,
                       "also cut.png and, animated, cutting.png: a blade cuts the object and the diagram "
                       "follows. Three corners of the blade, in voxels from 0: it enters with the edge from the "
                       "first to the third and stops when the first has come to the second. With --deform also "
                       "the deformation after the cut")
            ->type_name("X Y Z  X Y Z  X Y Z")
            ->expected(9);
    app.add_option("--cut-steps", options.cut_steps, "steps in which the blade moves")
        ->needs(blade)
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    try {
        app.parse(count, words);
        if (map.empty() && table.empty())
            throw CLI::RequiredError("--table or --map");
        if (seeds_file.empty() && options.place == 0)
            throw CLI::RequiredError("--seeds or --place");
        options.table = table.empty() ? TransferTable::parse(map, "--map") : TransferTable::read(table);
        if (!seeds_file.empty())
            options.seeds = read_seeds(seeds_file);
    } catch (const CLI::ParseError &error) {
        return app.exit(error);
    }
    if (!dims.empty()) {
        options.read.format = LOCUS_VOLUME_RAW;
        options.read.raw_big_endian = big_endian ? 1 : 0;
        std::ranges::copy(dims, options.read.raw_dims);
        std::ranges::copy(spacing, options.read.raw_spacing);
    }
    if (!(memory_gib > 0 && memory_gib < 1e6))
        throw std::runtime_error("--memory is not a size");
    options.read.memory_limit = static_cast<uint64_t>(memory_gib * 0x1p30);
    if (!slice.empty())
        options.slice = {slice[0], slice[1], slice[2]};
    if (!window.empty())
        options.window = {window[0], window[1]};
    options.trace = !no_trace;
    options.motions = motions_of(motions);
    if (!cut.empty())
        options.cut = blade_of(cut);
    if (options.title.empty())
        options.title = options.input.substr(options.input.rfind('/') + 1);
    return std::nullopt;
}

} // namespace volume
