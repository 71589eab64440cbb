// The voxel graph: materials, the rule that turns them into integer edge weights, edges that were cut, and a journal of
// edits.
#pragma once

#include "core/simd.hpp"
#include "core/word.hpp"
#include "graph/grid.hpp"
#include "graph/quantize.hpp"

#include <locus/graph.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace locus::graph {

__extension__ typedef unsigned __int128 Wide; // sums of up to 2^40 weights

// The caller's weights, evaluated edge by edge.
struct CallerWeights {
    locus_weight_fn function;
    void *user;
    double scale;
    double most_steps; // a larger weight breaks the range the graph was made for
};

// The weights of a graph as the function object that computes them (see quantize.hpp).
using Weights =
    std::variant<HalfSum<uint32_t>, HalfSum<uint64_t>, Larger<uint32_t>, Larger<uint64_t>, MeanStiffness<uint32_t>,
                 MeanStiffness<uint64_t>, PowerStiffness<uint32_t>, PowerStiffness<uint64_t>, CallerWeights>;

class Graph {
public:
    // Checks the options and chooses word and scale; `material` as in locus_graph_create.
    Graph(const locus_graph_options &options, const float *material);

    // The same voxels and cuts with weights by length alone (LOCUS_WEIGHT_UNIFORM).
    Graph uniform() const;

    const Grid &grid() const { return grid_; }
    const WordLayout &layout() const { return layout_; }
    double scale() const { return scale_; }
    uint32_t threads() const { return threads_; }
    Simd simd() const { return simd_; }
    // LOCUS_BACKEND_CPU or LOCUS_BACKEND_CUDA, and whether it was asked for by name.
    uint32_t backend() const { return backend_; }
    bool backend_forced() const { return options_.backend != LOCUS_BACKEND_AUTO; }
    // Tell the caller's log.
    void log(int32_t level, const char *text) const {
        if (options_.log != nullptr)
            options_.log(level, text, options_.log_user);
    }
    uint32_t rule() const { return operand_.rule; }
    const Operand &operand() const { return operand_; }
    const Weights &weights() const { return weights_; }
    // The values given, NaN for every impassable voxel.
    const float *materials() const { return materials_.data(); }
    bool passable(uint64_t voxel) const { return materials_[voxel] == materials_[voxel]; }
    uint64_t passable_voxels() const { return passable_; }
    // No shortest path, from a start at distance 0, is longer than this many steps.
    Wide longest_path() const { return longest_path_; }
    // A scale at which every path of the graph as it is now would fit words of this layout; not positive where there is
    // none.
    double safe_scale() const;
    locus_graph_info info() const;

    // A weight that no edge of the graph is below; at least 1.
    uint64_t smallest_weight() const;
    // A weight that no edge of the graph is above.
    uint64_t largest_weight() const;

    // Edits: everything is checked first, so that a failure changes nothing.
    void set_box(const Box &box, const float *values);
    void fill_box(const Box &box, float value);
    void set_voxels(std::span<const uint64_t> voxels, const float *values);
    void get_box(const Box &box, float *values) const;

    // Cuts: edges that are disabled while both voxels stay. Of a voxel's 13 forward edges, bit n - 13 of its mask
    // stands for the neighbour with number n. Null while nothing was ever cut.
    const uint16_t *cuts() const { return cuts_.empty() ? nullptr : cuts_.data(); }
    void cut_edges(std::span<const uint64_t> voxels, std::span<const uint16_t> masks);
    // Undo the cuts of all edges with an end in the box; how many they were.
    uint64_t mend_edges(const Box &box);
    // The neighbour numbers from u, inside the grid and of its connectivity, whose edges are not cut. Ends may be
    // impassable.
    uint32_t open_edges(uint64_t voxel) const;

    // The weight in steps of the edge from voxel u to its neighbour `number`, which must lie inside the grid; 0 where
    // there is no edge. Works for every rule; engines use weights() where speed matters.
    uint64_t weight(uint64_t u, const Neighbour &to) const;
    uint64_t weight_between(uint64_t u, uint64_t v) const;

    // The journal: the version grows with every edit. edits_since(v) gives the boxes edited after version v, or nothing
    // where the journal no longer reaches back so far (everything may have changed).
    uint64_t version() const { return version_; }
    std::optional<std::span<const Box>> edits_since(uint64_t version) const;

private:
    // A range of compliances (for caller's weights: of weight divided by length); `low` is the least one above 0.
    struct Range {
        double low = std::numeric_limits<double>::infinity();
        double high = 0;
        bool zero = false;
        bool empty() const { return !(low <= high); }
        void add(double compliance);
    };

    double compliance(float value) const;
    double share(double compliance, double length) const;
    double largest_steps(double compliance) const;
    double smallest_steps(double compliance) const;
    double shares_per_edge() const;
    Range range_of_data() const;
    Range range_of_callers_weights() const;
    void add_declared(Range &range) const;
    void choose(bool given);
    void count_all();
    template <typename Word>
    void make_weights();
    uint64_t on_path(float value) const;
    void check_value(float value, uint64_t voxel) const;
    void write(uint64_t voxel, float value);
    void journal(const std::vector<Box> &boxes);

    locus_graph_options options_;
    Grid grid_;
    Operand operand_;
    WordLayout layout_{};
    double scale_ = 0;
    double tolerance_ = 0; // the relative rounding error that edits may come to
    uint32_t threads_;
    Simd simd_ = Simd::scalar;
    uint32_t backend_;
    Range range_; // of everything the graph holds or held, and of what was declared
    Weights weights_;
    std::unique_ptr<const InversePower<float>> power32_;
    std::unique_ptr<const InversePower<double>> power64_;
    std::vector<float> materials_;
    std::vector<uint16_t> cuts_;
    uint64_t passable_ = 0;
    Wide longest_path_ = 0;
    uint64_t version_ = 0;
    uint64_t journal_start_ = 0; // the version before the first box of the journal
    std::vector<Box> edited_;
    std::vector<uint64_t> edited_at_; // the version each box led to
};

} // namespace locus::graph
