// Weights by the C interface, and the file of all of them.
#include "volume/weights.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace volume {
namespace {

constexpr uint64_t most_bytes = uint64_t{256} << 20; // of weights.nrrd before compression
constexpr size_t shown = 3;                          // seeds, where none are asked for

} // namespace

Weights make_weights(locus_diagram *diagram, uint32_t method, const locus_voxel_box *box, Call *call) {
    locus_weights_options wanted;
    check(locus_weights_options_init(&wanted, sizeof wanted));
    wanted.method = method;
    if (call != nullptr) {
        wanted.progress = Call::at;
        wanted.progress_user = call;
    }
    locus_weights *weights = nullptr;
    check(locus_weights_create(diagram, &wanted, box, &weights));
    return Weights(weights);
}

Plane::Plane(const Slice &slice, const Input &input) : across(slice.across), down(slice.down) {
    for (size_t axis = 0; axis < 3; ++axis)
        dims[axis] = box.extent[axis] = input.info.dims[axis];
    box.origin[slice.through] = slice.at;
    box.extent[slice.through] = 1;
}

size_t Plane::row(size_t voxel) const {
    const uint64_t x = voxel % dims[0], y = voxel / dims[0] % dims[1], z = voxel / dims[0] / dims[1];
    return static_cast<size_t>((x - box.origin[0]) +
                               box.extent[0] * ((y - box.origin[1]) + box.extent[1] * (z - box.origin[2])));
}

std::array<uint64_t, 3> Plane::at(size_t row) const {
    return {box.origin[0] + row % box.extent[0], box.origin[1] + row / box.extent[0] % box.extent[1],
            box.origin[2] + row / box.extent[0] / box.extent[1]};
}

std::optional<size_t> Plane::beside(size_t row, int across_steps, int down_steps) const {
    std::array<uint64_t, 3> voxel = at(row);
    voxel[across] += static_cast<uint64_t>(across_steps); // below 0 it wraps around, out of the grid
    voxel[down] += static_cast<uint64_t>(down_steps);
    if (voxel[across] >= dims[across] || voxel[down] >= dims[down])
        return std::nullopt;
    return this->row(static_cast<size_t>(voxel[0] + dims[0] * (voxel[1] + dims[1] * voxel[2])));
}

std::vector<float> dense(const locus_weights *weights, const std::vector<uint32_t> &ids) {
    uint64_t rows = 0;
    check(locus_weights_size(weights, &rows, nullptr));
    std::vector<float> numbers(static_cast<size_t>(rows) * ids.size());
    check(locus_weights_dense(weights, 0, rows, ids.data(), ids.size(), numbers.data(), numbers.size()));
    return numbers;
}

std::vector<uint32_t> weight_seeds(const Options &options, const Result &result) {
    std::vector<uint32_t> ids = options.weight_seeds;
    for (const uint32_t id : ids)
        if (std::ranges::find(result.seeds, id, &locus_seed::id) == result.seeds.end())
            throw std::runtime_error("--weight-seeds: no seed has the id " + std::to_string(id));
    for (size_t i = 0; options.weight_seeds.empty() && i < std::min(shown, result.seeds.size()); ++i)
        ids.push_back(result.seeds[i].id);
    return ids;
}

std::string write_weights(const std::string &folder, const Input &input, const Result &result, locus_diagram *diagram) {
    const uint64_t bytes = input.voxels() * result.seeds.size() * sizeof(float);
    if (bytes > most_bytes)
        return "weights.nrrd left out: " + demo::bytes_text(bytes) + ", more than " + demo::bytes_text(most_bytes);
    Call call("weights of all voxels");
    const auto begin = std::chrono::steady_clock::now();
    const Weights weights = make_weights(diagram, LOCUS_METHOD_SIBSON, nullptr, &call);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::vector<float> components; // one seed's volume after the other
    for (const locus_seed &seed : result.seeds) {
        const std::vector<float> one = dense(weights.get(), {seed.id});
        components.insert(components.end(), one.begin(), one.end());
    }
    locus_volume_info info = input.info;
    info.components = result.seeds.size();
    info.type = LOCUS_VOXEL_FLOAT32;
    locus_volume_write_options options;
    check_io(locus_volume_write_options_init(&options, sizeof options));
    options.compression = 1;
    check_io(locus_volume_write((folder + "/weights.nrrd").c_str(), &info, components.data(), &options));
    return "weights.nrrd, Sibson's of all voxels in " + demo::duration_text(seconds);
}

} // namespace volume
