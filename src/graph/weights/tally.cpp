#include "graph/weights/tally.hpp"

#include <bit>

namespace locus::graph {
namespace {

// Counts set bits by position: how often each of 16 lanes stole. Plain 16-bit counters, which compilers turn into two
// vector registers at every level of SIMD; emptied before they can overflow.
class LaneCounter {
public:
    void add(uint16_t lanes) {
        for (unsigned i = 0; i < batch_lanes; ++i)
            counts_[i] = static_cast<uint16_t>(counts_[i] + ((lanes & bit_[i]) != 0 ? 1 : 0));
        ++added_;
    }
    bool full() const { return added_ == UINT16_MAX; }
    void empty_into(std::array<uint64_t, batch_lanes> &totals) {
        for (unsigned i = 0; i < batch_lanes; ++i)
            totals[i] += counts_[i];
        counts_.fill(0);
        added_ = 0;
    }

private:
    static constexpr std::array<uint16_t, batch_lanes> bit_ = [] {
        std::array<uint16_t, batch_lanes> bits{};
        for (unsigned i = 0; i < batch_lanes; ++i)
            bits[i] = static_cast<uint16_t>(1u << i);
        return bits;
    }();
    std::array<uint16_t, batch_lanes> counts_{};
    uint32_t added_ = 0;
};

template <typename Visit>
void for_lanes(uint32_t lanes, Visit &&visit) {
    for (; lanes != 0; lanes &= lanes - 1)
        visit(static_cast<unsigned>(std::countr_zero(lanes)));
}

} // namespace

template <typename Word>
void SibsonTally::count(const Window<Word> &window) {
    stolen_.clear();
    window.for_touched(0, [&](size_t first, size_t last) {
        LaneCounter counter;
        uint32_t label = no_label;
        for (size_t v = first; v <= last; ++v) {
            const uint16_t lanes = window.stolen(v);
            if (lanes == 0)
                continue;
            if (window.label(v) != label || counter.full()) {
                if (label != no_label)
                    counter.empty_into(stolen_[label].voxels);
                label = window.label(v);
            }
            counter.add(lanes);
        }
        if (label != no_label)
            counter.empty_into(stolen_[label].voxels);
    });
}

template <typename Word>
void SibsonTally::count(const LoneSearch<Word> &search) {
    stolen_.clear();
    for (const auto &stolen : search.stolen())
        ++stolen_[search.field().label(stolen.voxel)].voxels[0];
}

void SibsonTally::row(unsigned lane, std::vector<RawShare> &row) const {
    stolen_.each([&](uint32_t label, const Stolen &stolen) {
        if (stolen.voxels[lane] != 0)
            row.push_back({label, static_cast<double>(stolen.voxels[lane])});
    });
}

LaplaceTally::LaplaceTally(const Grid &grid, uint64_t labels) : border_(labels) {
    const auto &spacing = grid.spacing();
    area_ = {spacing[1] * spacing[2], spacing[0] * spacing[2], spacing[0] * spacing[1]};
}

template <typename Word>
void LaplaceTally::count(const Window<Word> &window) {
    border_.clear();
    const std::array<size_t, 3> step = window.steps();
    window.for_touched(1, [&](size_t first, size_t last) {
        for (size_t v = first; v <= last; ++v)
            for (unsigned axis = 0; axis < 3; ++axis)
                face(window, v, v + step[axis], axis);
    });
}

// The face between two voxels, `high` being the next one along the axis.
template <typename Word>
void LaplaceTally::face(const Window<Word> &window, size_t low, size_t high, unsigned axis) {
    const uint32_t a = window.stolen(low), b = window.stolen(high);
    if (a == b)
        return;
    const Word weight = window.back(high, backward_face[axis]);
    if (weight == far_away<Word>)
        return;
    cross(window, low, high, weight, a & ~b, axis);
    cross(window, high, low, weight, b & ~a, axis);
}

template <typename Word>
void LaplaceTally::cross(const Window<Word> &window, size_t stolen, size_t kept, Word weight, uint32_t lanes,
                         unsigned axis) {
    if (lanes == 0)
        return;
    Border &border = border_[window.label(kept)];
    const uint64_t beyond = uint64_t{weight} + window.nearest(kept);
    const Word *reach = window.reach(stolen);
    for_lanes(lanes, [&](unsigned lane) {
        ++border.faces[axis][lane];
        border.shortest[lane] = std::min(border.shortest[lane], reach[lane] + beyond);
    });
}

template <typename Word>
void LaplaceTally::count(const LoneSearch<Word> &search) {
    border_.clear();
    const Field &field = search.field();
    for (const auto &stolen : search.stolen()) {
        const uint32_t open = field.graph().open_edges(stolen.voxel);
        for (unsigned axis = 0; axis < 3; ++axis)
            for (const unsigned number : {backward_face[axis], 25 - backward_face[axis]}) {
                if ((open >> number & 1) == 0)
                    continue;
                const Neighbour &to = field.grid().neighbour(number);
                const uint64_t other = stolen.voxel + static_cast<uint64_t>(to.step);
                const uint64_t weight = field.graph().weight(stolen.voxel, to);
                if (weight == 0 || !field.reached(other) || search.reach_beside(stolen, number) < field.distance(other))
                    continue;
                Border &border = border_[field.label(other)];
                ++border.faces[axis][0];
                border.shortest[0] = std::min(border.shortest[0], stolen.distance + weight + field.distance(other));
            }
    }
}

void LaplaceTally::row(unsigned lane, std::vector<RawShare> &row) const {
    border_.each([&](uint32_t label, const Border &border) {
        if (border.shortest[lane] == UINT64_MAX)
            return;
        double area = 0;
        for (unsigned axis = 0; axis < 3; ++axis)
            area += static_cast<double>(border.faces[axis][lane]) * area_[axis];
        row.push_back({label, area / static_cast<double>(border.shortest[lane])});
    });
}

template void SibsonTally::count(const Window<uint32_t> &);
template void SibsonTally::count(const Window<uint64_t> &);
template void SibsonTally::count(const LoneSearch<uint32_t> &);
template void SibsonTally::count(const LoneSearch<uint64_t> &);
template void LaplaceTally::count(const LoneSearch<uint32_t> &);
template void LaplaceTally::count(const LoneSearch<uint64_t> &);
template void LaplaceTally::count(const Window<uint32_t> &);
template void LaplaceTally::count(const Window<uint64_t> &);

} // namespace locus::graph
