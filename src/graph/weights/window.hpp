// The part of the grid that a batch of sixteen queries works on, copied into dense arrays with a border that nothing crosses.
#pragma once

#include "graph/weights/field.hpp"
#include "graph/weights/settle.hpp"

#include <vector>

namespace locus::graph {

template <typename Word>
class Window {
public:
    // Bytes a window of this box takes.
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
    const std::array<size_t, 3> &sizes() const { return sizes_; }

    Word nearest(size_t local) const { return nearest_[local]; }
    uint32_t label(size_t local) const { return label_[local]; }
    Word back(size_t local, unsigned number) const { return back_[local * backward_edges + number]; }
    const Word *reach(size_t local) const { return reach_[local].lane.data(); }
    uint16_t stolen(size_t local) const { return stolen_[local]; }

    // Start lane `lane` at a voxel: it is reached at distance 0.
    void start(size_t local, unsigned lane);
    // Run all started lanes to their fixpoint.
    void settle(const SettleKernels<Word> &kernels);
    // The rows y + sizes[1] * z that changed since the last restore, and the part of each.
    const Hull &touched() const { return run_.touched; }
    Span touched_in(size_t row) const { return touched_[row]; }
    // The touched voxels reach the edge of the box where the grid goes on.
    bool too_small(const Grid &grid) const;
    // Forget the lanes.
    void restore(const SettleKernels<Word> &kernels);

private:
    void fill_row(const Field &field, uint64_t y, uint64_t z);

    Box box_{};
    std::array<size_t, 3> sizes_{};
    std::vector<Word> nearest_;
    std::vector<uint32_t> label_;
    std::vector<Word> back_;
    struct alignas(64) Batch {
        std::array<Word, batch_lanes> lane;
    };
    std::vector<Batch> reach_;
    std::vector<uint16_t> stolen_;
    std::vector<Span> fresh_[2];
    std::vector<Span> touched_;
    Settle<Word> run_{};
};

extern template class Window<uint32_t>;
extern template class Window<uint64_t>;

} // namespace locus::graph
