// How much arrives where: a quadtree whose nodes (regions) hold two sums over their records, decaying with the records'
// age, the present with a short half life and the past with a long one.
//
// Decay is forward in time (Cormode et al. 2009): a record is added with a weight that grows with its time, so that
// nothing has to be touched when time goes on; values are scaled back when they are read. The nodes for a place are
// made when something comes there, down to the finest level. Nodes with next to no past are given up a few per batch;
// within the bound on memory, more of them.
#pragma once

#include "core/zcurve.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::pmq {

class Activity {
public:
    using Node = uint32_t;
    static constexpr Node none = UINT32_MAX;
    static constexpr Node root = 0;

    Activity(unsigned finest_level, int64_t half_life, int64_t history, uint64_t max_bytes);

    // Before the records of a batch: the clock has come to `now`.
    void begin(int64_t now);
    void add(uint64_t key, int64_t time) noexcept;
    // After them: give up nodes that hold next to nothing.
    void tend(size_t records) noexcept;

    // The nodes that the batch came to.
    const std::vector<Node> &touched() const noexcept { return touched_; }
    Quadrant quadrant(Node node) const noexcept;
    unsigned level(Node node) const noexcept { return nodes_[node].level; }
    const std::array<Node, 4> &children(Node node) const noexcept { return nodes_[node].children; }
    Node find(const Quadrant &quadrant) const noexcept; // or none

    // Records that came lately: as decayed at the clock.
    double present(Node node) const noexcept { return nodes_[node].present * present_scale_; }
    // What the present would be by the node's history, or by its part of the root's; and that with three standard
    // deviations of the estimate added.
    struct Expected {
        double mean, most;
    };
    Expected expected(Node node) const noexcept;
    // The present of one record a second.
    double seconds() const noexcept { return seconds_; }

    size_t size() const noexcept { return nodes_.size() - free_count_; }
    uint64_t bytes() const noexcept;

private:
    struct Region {
        double present, past;   // scaled
        int64_t known;          // since then all that came here is in the sums,
        int64_t children_known; // and in those of children made from now on
        std::array<Node, 4> children;
        Node parent;    // or the next free node
        uint32_t batch; // that came here last
        uint8_t level;  // `unused`: free
        uint8_t number; // of the parent's children
    };
    static constexpr uint8_t unused = 0xFF;

    void restart(int64_t now);
    void rescale(int64_t now) noexcept;
    Node make(Node parent, unsigned number) noexcept;
    Node take() noexcept;
    void give_up(Node node) noexcept;
    double past(Node node) const noexcept { return nodes_[node].past * past_scale_; }
    double weight_sum(double half_life, int64_t since) const noexcept;

    const unsigned finest_level_;
    const double half_life_, history_; // microseconds
    const size_t most_nodes_;
    std::vector<Region> nodes_;
    Node free_ = none;
    size_t free_count_ = 0;
    std::vector<Node> touched_;
    uint32_t batch_ = 0;
    int64_t origin_ = 0; // where weights are 1
    int64_t now_ = INT64_MIN;
    double present_scale_ = 1, past_scale_ = 1, seconds_ = 0;
    int64_t weighed_time_ = 0; // of the latest weights
    double present_weight_ = 1, past_weight_ = 1;
    Node cursor_ = 1;   // the node that tend comes to next
    double negligible_; // a past below is given up
};

} // namespace locus::pmq
