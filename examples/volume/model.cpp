// Reading, solving and writing with liblocus and liblocus_io.
#include "volume/model.hpp"

#include "common/canvas.hpp"
#include "volume/call.hpp"
#include "volume/text.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace volume {
namespace {

Diagram make_diagram(locus_graph *graph, uint32_t engine, bool record_trace) {
    locus_diagram_options wanted;
    check(locus_diagram_options_init(&wanted, sizeof wanted));
    wanted.engine = engine;
    wanted.record_trace = record_trace ? 1 : 0;
    locus_diagram *diagram = nullptr;
    check(locus_diagram_create(graph, &wanted, &diagram));
    return Diagram(diagram);
}

void place(const Options &options, locus_diagram *diagram, uint32_t first_id) {
    Call call("placing seeds");
    locus_place_options wanted;
    check(locus_place_options_init(&wanted, sizeof wanted));
    wanted.count = options.place;
    wanted.first_id = first_id;
    wanted.lloyd_iterations = options.lloyd;
    wanted.metric = options.metric;
    wanted.progress = Call::at;
    wanted.progress_user = &call;
    check(locus_diagram_place_seeds(diagram, &wanted));
}

void copy_out(const Input &input, const locus_diagram *diagram, Result &result) {
    const size_t voxels = static_cast<size_t>(input.voxels());
    result.labels.resize(voxels);
    result.distances.resize(voxels);
    check(locus_diagram_labels(diagram, nullptr, result.labels.data(), voxels));
    check(locus_diagram_distances(diagram, nullptr, result.distances.data(), voxels));
    size_t count = 0;
    check(locus_diagram_get_seeds(diagram, nullptr, 0, &count));
    result.seeds.resize(count);
    check(locus_diagram_get_seeds(diagram, result.seeds.data(), count, &count));
    result.cell_sizes.resize(count);
    check(locus_diagram_cell_sizes(diagram, result.cell_sizes.data(), count, &count));
    const locus_status asked = locus_diagram_cell_pairs(diagram, nullptr, 0, &count);
    if (asked != LOCUS_OK && asked != LOCUS_E_CAPACITY)
        check(asked);
    result.pairs.resize(count);
    if (count > 0)
        check(locus_diagram_cell_pairs(diagram, result.pairs.data(), count, &count));
    result.stats.struct_size = sizeof result.stats;
    check(locus_diagram_get_stats(diagram, &result.stats));
}

} // namespace

void check(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_last_error());
}

void check_io(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_io_last_error());
}

Input read_input(const Options &options) {
    Input input;
    locus_volume *volume = nullptr;
    check_io(locus_volume_read(options.input.c_str(), &options.read, &volume));
    input.volume.reset(volume);
    input.info.struct_size = sizeof input.info;
    check_io(locus_volume_get_info(volume, &input.info));
    if (input.info.components != 1)
        throw std::runtime_error(options.input + ": " + std::to_string(input.info.components) +
                                 " numbers per voxel; the transfer table takes one");
    for (size_t axis = 0; options.slice && axis < 3; ++axis)
        if ((*options.slice)[axis] >= input.info.dims[axis])
            throw std::runtime_error("--slice: index " + std::to_string((*options.slice)[axis]) + " of axis " +
                                     "xyz"[axis] + " lies outside the volume");
    for (const char axis : options.flip) {
        double *direction = input.info.direction + 3 * (axis - 'x');
        for (int i = 0; i < 3; ++i)
            direction[i] *= -1;
    }
    return input;
}

Material make_material(const Options &options, const Input &input) {
    std::vector<float> stiffness(static_cast<size_t>(input.voxels()));
    const float *values = input.values();
    for (size_t i = 0; i < stiffness.size(); ++i)
        stiffness[i] = options.table->stiffness(values[i]);
    Material material;
    if (options.largest_part)
        material.dropped = keep_largest_part(stiffness, input.info.dims, options.connectivity);
    for (const float value : stiffness) {
        if (std::isnan(value))
            continue;
        ++material.passable;
        material.softest = std::min(material.softest, double{value});
        material.stiffest = std::max(material.stiffest, double{value});
    }
    if (material.passable == 0)
        throw std::runtime_error(options.input + ": the transfer table makes every voxel impassable");
    locus_graph_options wanted;
    check(locus_graph_options_init(&wanted, sizeof wanted));
    for (int axis = 0; axis < 3; ++axis) {
        wanted.dims[axis] = input.info.dims[axis];
        wanted.spacing[axis] = input.info.spacing[axis];
    }
    wanted.connectivity = options.connectivity;
    wanted.weight_rule = options.weight_rule;
    wanted.material = LOCUS_MATERIAL_STIFFNESS;
    wanted.word_bits = options.word_bits;
    wanted.threads = options.threads;
    const uint64_t seeds = options.seeds.size() + options.place;
    if (seeds > (options.word_bits == LOCUS_WORD_32 ? 256 : wanted.max_seeds))
        wanted.max_seeds = seeds;
    locus_graph *graph = nullptr;
    check(locus_graph_create(&wanted, stiffness.data(), &graph));
    material.graph.reset(graph);
    return material;
}

std::vector<locus_seed> read_seeds(const std::string &path) {
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error(path + ": cannot read the seeds");
    std::vector<locus_seed> seeds;
    std::string line;
    for (int count = 1; std::getline(file, line); ++count) {
        const std::vector<std::string> row = words(line);
        if (row.empty())
            continue;
        std::vector<uint64_t> numbers;
        for (const std::string &word : row)
            if (const auto index = number<uint64_t>(word))
                numbers.push_back(*index);
        if (numbers.size() == 3 && row.size() == 3)
            numbers.push_back(seeds.size());
        if (numbers.size() != 4 || row.size() > 4 || numbers[3] >= LOCUS_NO_SEED)
            throw std::runtime_error(path + ", line " + std::to_string(count) + ": \"" + line +
                                     "\" is not of the form 'x y z [id]' with whole numbers from 0");
        locus_seed seed{};
        seed.x = numbers[0];
        seed.y = numbers[1];
        seed.z = numbers[2];
        seed.id = static_cast<uint32_t>(numbers[3]);
        seed.fixed = 1;
        seeds.push_back(seed);
    }
    if (seeds.empty())
        throw std::runtime_error(path + ": there is no seed in the file");
    return seeds;
}

void write_seeds(const std::string &path, const std::vector<locus_seed> &seeds) {
    std::string text = "# x y z id (voxel indices from 0)\n";
    for (const locus_seed &seed : seeds) {
        for (const uint64_t index : {seed.x, seed.y, seed.z})
            text += std::to_string(index) + ' ';
        text += std::to_string(seed.id) + '\n';
    }
    demo::write_file(path, text.data(), text.size());
}

Result solve(const Options &options, const Input &input, locus_graph *graph) {
    const Diagram diagram = make_diagram(graph, options.engine, false);
    uint32_t next_id = 0;
    check(locus_diagram_add_seeds(diagram.get(), options.seeds.data(), options.seeds.size()));
    for (const locus_seed &seed : options.seeds)
        next_id = std::max(next_id, seed.id + 1);
    Result result;
    const auto begin = std::chrono::steady_clock::now();
    if (options.place > 0)
        place(options, diagram.get(), next_id);
    result.seconds_place = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    Call call("solving");
    check(locus_diagram_solve(diagram.get(), Call::at, &call));
    copy_out(input, diagram.get(), result);
    return result;
}

Diagram solve_again(const Options &options, locus_graph *graph, const std::vector<locus_seed> &seeds) {
    Diagram diagram = make_diagram(graph, options.engine, false);
    check(locus_diagram_add_seeds(diagram.get(), seeds.data(), seeds.size()));
    Call call("solving");
    check(locus_diagram_solve(diagram.get(), Call::at, &call));
    return diagram;
}

Trace trace(const Input &input, locus_graph *graph, const Result &result) {
    const Diagram diagram = make_diagram(graph, LOCUS_ENGINE_RELAX, true);
    check(locus_diagram_add_seeds(diagram.get(), result.seeds.data(), result.seeds.size()));
    Call call("tracing the relaxation");
    check(locus_diagram_solve(diagram.get(), Call::at, &call));
    Trace trace;
    size_t count = 0;
    const locus_status asked = locus_diagram_trace(diagram.get(), nullptr, 0, &count);
    if (asked != LOCUS_OK && asked != LOCUS_E_CAPACITY)
        check(asked);
    trace.active.resize(count);
    check(locus_diagram_trace(diagram.get(), trace.active.data(), count, &count));
    std::vector<uint32_t> labels(static_cast<size_t>(input.voxels()));
    check(locus_diagram_labels(diagram.get(), nullptr, labels.data(), labels.size()));
    trace.same_labels = labels == result.labels;
    return trace;
}

void write_volumes(const std::string &folder, const Input &input, const Result &result) {
    locus_volume_info info = input.info;
    locus_volume_write_options options;
    check_io(locus_volume_write_options_init(&options, sizeof options));
    options.compression = 1;
    std::vector<uint32_t> labels = result.labels;
    for (uint32_t &label : labels)
        label = label == LOCUS_NO_SEED ? 0 : label + 1;
    std::vector<float> distances = result.distances;
    for (float &distance : distances)
        if (std::isinf(distance))
            distance = -1;
    info.type = LOCUS_VOXEL_UINT32;
    check_io(locus_volume_write((folder + "/labels.nrrd").c_str(), &info, labels.data(), &options));
    info.type = LOCUS_VOXEL_FLOAT32;
    check_io(locus_volume_write((folder + "/distances.nrrd").c_str(), &info, distances.data(), &options));
}

} // namespace volume
