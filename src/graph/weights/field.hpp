// What the interpolants see of a solved diagram: the nearest seed and its distance per voxel, and the edges between
// voxels.
#pragma once

#include "graph/engine.hpp"

#include <cstdint>
#include <variant>

namespace locus::graph {

constexpr uint32_t no_label = UINT32_MAX;

// A voxel that no seed reaches is treated as impassable: no weight can come from there, and nothing is stolen there.
class Field {
public:
    Field(const Graph &graph, const Words &words)
        : graph_(graph), words_(words), layout_(graph.layout()), narrow_(data<uint32_t>(words)),
          wide_(data<uint64_t>(words)) {}

    const Graph &graph() const { return graph_; }
    const Grid &grid() const { return graph_.grid(); }
    const Words &words() const { return words_; }

    bool reached(uint64_t voxel) const { return layout_.reached(word(voxel)); }
    uint64_t distance(uint64_t voxel) const { return layout_.distance(word(voxel)); }
    uint32_t label(uint64_t voxel) const { return layout_.label(word(voxel)); }
    // The largest distance of a reached voxel.
    uint64_t farthest() const {
        uint64_t farthest = 0;
        for (uint64_t v = 0; v < grid().voxels(); ++v)
            if (reached(v))
                farthest = std::max(farthest, distance(v));
        return farthest;
    }

private:
    uint64_t word(uint64_t voxel) const { return narrow_ != nullptr ? narrow_[voxel] : wide_[voxel]; }
    template <typename Word>
    static const Word *data(const Words &words) {
        const auto *held = std::get_if<std::vector<Word>>(&words);
        return held != nullptr ? held->data() : nullptr;
    }

    const Graph &graph_;
    const Words &words_;
    WordLayout layout_;
    const uint32_t *narrow_; // one of the two is null
    const uint64_t *wide_;
};

} // namespace locus::graph
