// The part of the grid that a batch of sixteen queries works on, copied into dense arrays with a border that nothing
// crosses.
#pragma once

#include "core/pages.hpp"
#include "graph/weights/field.hpp"
#include "graph/weights/settle.hpp"

#include <vector>

namespace locus::graph {

// `box` and up to `margin` voxels around it, as far as the grid goes.
Box widen(const Grid &grid, const Box &box, uint64_t margin);

template <typename Word>
class Window {
public:
    // What a window of this box holds, and the bytes that takes.
    static uint64_t voxels(const Box &box);
    static uint64_t bytes(const Box &box);

    // Fill the window with the field's voxels in `box`. Throws std::bad_alloc; the window is then empty.
    void open(const Field &field, const Box &box);

    const Box &box() const { return box_; }
    bool holds(const Box &box) const;
    // The local number of a voxel of the box.
    size_t local(const std::array<uint64_t, 3> &place) const {
        return (place[0] - box_.origin[0] + 1) +
               sizes_[0] * ((place[1] - box_.origin[1] + 1) + sizes_[1] * (place[2] - box_.origin[2] + 1));
    }
    // From a voxel to the next one along each axis.
    std::array<size_t, 3> steps() const { return {1, sizes_[0], sizes_[0] * sizes_[1]}; }
    size_t voxels() const { return sizes_[0] * sizes_[1] * sizes_[2]; }
    // The voxel of the grid that a local number, not of the border, means.
    uint64_t voxel(const Grid &grid, size_t local) const {
        const size_t row = local / sizes_[0];
        return grid.index(box_.origin[0] + local % sizes_[0] - 1, box_.origin[1] + row % sizes_[1] - 1,
                          box_.origin[2] + row / sizes_[1] - 1);
    }

    Word nearest(size_t local) const { return nearest_[local]; }
    uint32_t label(size_t local) const { return label_[local]; }
    Word back(size_t local, unsigned number) const { return back_[local * backward_edges + number]; }
    const Word *reach(size_t local) const { return reach_[local].lane.data(); }
    uint16_t stolen(size_t local) const { return stolen_[local]; }

    // Where the words of all lanes start: at the distance to the nearest seed (after open()), or at a bound per lane.
    void bound(const std::array<Word, batch_lanes> &bounds);
    // Start lane `lane` at a voxel, which is reached at `distance`, unless its word is no larger already.
    void start(size_t local, unsigned lane, Word distance = 0);
    // Run all started lanes to their fixpoint; false where that takes more than about `most_pulls` visits of voxels.
    bool settle(const SettleKernels<Word> &kernels, uint64_t most_pulls = UINT64_MAX) {
        run_.most_pulls = most_pulls;
        kernels.settle(run_);
        return run_.fresh_rows.empty();
    }
    // Let stolen() say which lanes lie below the distance to the nearest seed.
    void mark(const SettleKernels<Word> &kernels) { kernels.mark(run_); }
    // The touched voxels reach the edge of the box where the grid goes on.
    bool too_small(const Grid &grid) const;
    // Forget the lanes.
    void restore(const SettleKernels<Word> &kernels);
    // visit(first, last) for the touched part of every row, widened by `margin` voxels and rows: local numbers.
    template <typename Visit>
    void for_touched(uint32_t margin, Visit &&visit) const;

private:
    void fill_row(const Field &field, uint64_t y, uint64_t z);

    Box box_{};
    std::array<size_t, 3> sizes_{};
    template <typename T>
    using Array = std::vector<T, PageAllocator<T>>;

    Array<Word> nearest_;
    Array<uint32_t> label_;
    Array<Word> back_;
    struct alignas(64) Batch {
        std::array<Word, batch_lanes> lane;
    };
    Array<Batch> reach_;
    Batch bounds_{};
    bool bounded_ = false;
    Array<uint16_t> stolen_;
    std::vector<Span> fresh_[2];
    std::vector<Span> touched_;
    Settle<Word> run_{};
};

template <typename Word>
template <typename Visit>
void Window<Word>::for_touched(uint32_t margin, Visit &&visit) const {
    const Hull &hull = run_.touched;
    if (hull.empty())
        return;
    const auto low = [&](uint32_t place) { return place - std::min(margin, place - 1); };
    const auto high = [&](uint32_t place, size_t size) {
        return std::min<uint32_t>(place + margin, static_cast<uint32_t>(size - 2));
    };
    for (size_t z = low(hull.z.first); z <= high(hull.z.last, sizes_[2]); ++z)
        for (size_t y = low(hull.y.first); y <= high(hull.y.last, sizes_[1]); ++y) {
            const size_t row = z * sizes_[1] + y;
            Span span = touched_[row];
            if (margin != 0)
                for (const size_t other : {row - 1, row + 1, row - sizes_[1], row + sizes_[1]})
                    span.add(touched_[other]);
            if (!span.empty())
                visit(row * sizes_[0] + low(span.first), row * sizes_[0] + high(span.last, sizes_[0]));
        }
}

extern template class Window<uint32_t>;
extern template class Window<uint64_t>;

} // namespace locus::graph
