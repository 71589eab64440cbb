// Relaxing all active voxels at once, over and over.
#include "volume/waves.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <utility>

namespace volume {
namespace {

using Word = std::pair<uint64_t, uint32_t>; // exact distance, then the seed's place in the order of addition
constexpr Word unreached{UINT64_MAX, UINT32_MAX};

class Relaxation {
public:
    Relaxation(const Input &input, const locus_graph *graph, const std::vector<locus_seed> &seeds)
        : graph_(graph), settled_(static_cast<size_t>(input.voxels()), unreached) {
        std::copy_n(input.info.dims, 3, dims_.begin());
        for (uint32_t i = 0; i < seeds.size(); ++i)
            lower(index_of(input, {seeds[i].x, seeds[i].y, seeds[i].z}), {0, i});
        advance();
    }

    const std::vector<uint64_t> &active() const { return active_; }
    const std::vector<Word> &words() const { return settled_; }

    // One iteration: the active voxels lower their neighbours' estimates, and those that were lowered are active next.
    void step() {
        std::vector<std::pair<uint64_t, Word>> offers;
        for (const uint64_t voxel : active_)
            for_neighbours(voxel, [&](uint64_t next) {
                uint64_t weight = 0;
                check(locus_graph_edge_weight(graph_, voxel, next, &weight));
                if (weight > 0)
                    offers.push_back({next, {settled_[voxel].first + weight, settled_[voxel].second}});
            });
        for (const auto &[voxel, word] : offers)
            lower(voxel, word);
        advance();
    }

private:
    void advance() {
        std::ranges::sort(lowered_);
        lowered_.erase(std::unique(lowered_.begin(), lowered_.end()), lowered_.end());
        active_.swap(lowered_);
        lowered_.clear();
    }
    void lower(uint64_t voxel, const Word &word) {
        if (!(word < settled_[voxel]))
            return;
        settled_[voxel] = word;
        lowered_.push_back(voxel);
    }
    void for_neighbours(uint64_t voxel, auto use) const {
        const uint64_t x = voxel % dims_[0], y = voxel / dims_[0] % dims_[1], z = voxel / dims_[0] / dims_[1];
        const auto low = [](uint64_t i) { return i > 0 ? i - 1 : 0; };
        for (uint64_t k = low(z); k <= std::min(z + 1, dims_[2] - 1); ++k)
            for (uint64_t j = low(y); j <= std::min(y + 1, dims_[1] - 1); ++j)
                for (uint64_t i = low(x); i <= std::min(x + 1, dims_[0] - 1); ++i)
                    if (const uint64_t next = i + dims_[0] * (j + dims_[1] * k); next != voxel)
                        use(next);
    }

    const locus_graph *graph_;
    std::array<uint64_t, 3> dims_{};
    std::vector<Word> settled_;
    std::vector<uint64_t> active_, lowered_;
};

} // namespace

Waves propagate(const Input &input, const Material &material, const Result &result, const Slicer &slicer) {
    const Plane plane(slicer.slices()[0], input);
    Relaxation relaxation(input, material.graph.get(), result.seeds);
    const auto label = [&](const Word &word) {
        return word == unreached ? LOCUS_NO_SEED : result.seeds[word.second].id;
    };
    Waves waves;
    demo::Progress bar("waves");
    std::vector<bool> front(static_cast<size_t>(input.voxels()));
    for (; !relaxation.active().empty(); relaxation.step()) {
        for (const uint64_t voxel : relaxation.active())
            front[static_cast<size_t>(voxel)] = true;
        Wave &wave = waves.waves.emplace_back();
        wave.active = relaxation.active().size();
        waves.activations += wave.active;
        for (size_t row = 0; row < plane.rows(); ++row) {
            const size_t voxel = index_of(input, plane.at(row));
            wave.labels.push_back(label(relaxation.words()[voxel]));
            wave.front.push_back(front[voxel]);
        }
        for (const uint64_t voxel : relaxation.active())
            front[static_cast<size_t>(voxel)] = false;
        bar.at(-1, "iteration " + std::to_string(waves.waves.size()));
    }
    waves.same = std::ranges::equal(relaxation.words(), result.labels, {}, label);
    return waves;
}

} // namespace volume
