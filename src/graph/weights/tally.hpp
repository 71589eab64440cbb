// What sixteen settled lanes say: per lane the weights of the seeds they stole from. A query searched alone counts as
// lane 0.
#pragma once

#include "graph/weights/lone.hpp"
#include "graph/weights/rows.hpp"
#include "graph/weights/window.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace locus::graph {

// One entry per label met in a batch.
template <typename Entry>
class ByLabel {
public:
    explicit ByLabel(uint64_t labels) : place_(labels, none) {}

    Entry &operator[](uint32_t label) {
        if (place_[label] == none) {
            place_[label] = static_cast<uint32_t>(entries_.size());
            entries_.push_back(Entry{});
            labels_.push_back(label);
        }
        return entries_[place_[label]];
    }
    void clear() {
        for (const uint32_t label : labels_)
            place_[label] = none;
        labels_.clear();
        entries_.clear();
    }
    template <typename Visit>
    void each(Visit &&visit) const {
        for (size_t i = 0; i < labels_.size(); ++i)
            visit(labels_[i], entries_[i]);
    }

private:
    static constexpr uint32_t none = UINT32_MAX;
    std::vector<uint32_t> place_;
    std::vector<uint32_t> labels_;
    std::vector<Entry> entries_;
};

// Sibson: the voxels stolen per label.
class SibsonTally {
public:
    SibsonTally(const Grid &, uint64_t labels) : stolen_(labels) {}

    template <typename Word>
    void count(const Window<Word> &window);
    template <typename Word>
    void count(const LoneSearch<Word> &search);
    // The weights of one lane, not normalised: its stolen voxels.
    void row(unsigned lane, std::vector<RawShare> &row) const;

private:
    struct Stolen {
        std::array<uint64_t, batch_lanes> voxels{};
    };
    ByLabel<Stolen> stolen_;
};

// Laplace: the faces between what was stolen and what remains of each cell, and the shortest path across them.
class LaplaceTally {
public:
    LaplaceTally(const Grid &grid, uint64_t labels);

    template <typename Word>
    void count(const Window<Word> &window);
    template <typename Word>
    void count(const LoneSearch<Word> &search);
    void row(unsigned lane, std::vector<RawShare> &row) const;

private:
    struct Border {
        std::array<std::array<uint64_t, batch_lanes>, 3> faces{}; // by the axis they are square to
        std::array<uint64_t, batch_lanes> shortest;
        Border() { shortest.fill(UINT64_MAX); }
    };
    template <typename Word>
    void face(const Window<Word> &window, size_t low, size_t high, unsigned axis);
    template <typename Word>
    void cross(const Window<Word> &window, size_t stolen, size_t kept, Word weight, uint32_t lanes, unsigned axis);

    ByLabel<Border> border_;
    std::array<double, 3> area_;
};

} // namespace locus::graph
