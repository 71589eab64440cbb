// Windows: filled from the field row by row.
#include "graph/weights/window.hpp"

#include "graph/weights/edges.hpp"

namespace locus::graph {
namespace {

std::array<size_t, 3> padded(const Box &box) { return {box.extent[0] + 2, box.extent[1] + 2, box.extent[2] + 2}; }

} // namespace

Box widen(const Grid &grid, const Box &box, uint64_t margin) {
    Box wide;
    for (unsigned a = 0; a < 3; ++a) {
        wide.origin[a] = box.origin[a] - std::min(margin, box.origin[a]);
        wide.extent[a] = std::min(grid.dims()[a], box.origin[a] + box.extent[a] + margin) - wide.origin[a];
    }
    return wide;
}

template <typename Word>
uint64_t Window<Word>::voxels(const Box &box) {
    const auto sizes = padded(box);
    return sizes[0] * sizes[1] * sizes[2];
}

template <typename Word>
uint64_t Window<Word>::bytes(const Box &box) {
    const auto sizes = padded(box);
    const uint64_t rows = sizes[1] * sizes[2];
    return voxels(box) * (sizeof(Word) * (1 + backward_edges + batch_lanes) + sizeof(uint32_t) + sizeof(uint16_t)) +
           3 * rows * sizeof(Span);
}

template <typename Word>
void Window<Word>::open(const Field &field, const Box &box) {
    box_ = Box{};
    bounded_ = false;
    sizes_ = padded(box);
    const size_t rows = sizes_[1] * sizes_[2], voxels = rows * sizes_[0];
    nearest_.assign(voxels, far_away<Word>);
    label_.assign(voxels, no_label);
    back_.assign(voxels * backward_edges, far_away<Word>);
    reach_.clear(); // nothing to copy where it grows
    reach_.resize(voxels);
    stolen_.assign(voxels, 0);
    for (std::vector<Span> *spans : {&fresh_[0], &fresh_[1], &touched_})
        spans->assign(rows, Span{});
    box_ = box;
    run_ = Settle<Word>{};
    run_.sizes = sizes_;
    for (unsigned n = 0; n < backward_edges; ++n) {
        const Neighbour &to = field.grid().neighbour(n);
        run_.step[n] = to.dx + static_cast<ptrdiff_t>(sizes_[0]) * (to.dy + static_cast<ptrdiff_t>(sizes_[1]) * to.dz);
    }
    for (uint64_t z = 0; z < box.extent[2]; ++z)
        for (uint64_t y = 0; y < box.extent[1]; ++y)
            fill_row(field, y, z);
    for (size_t v = 0; v < voxels; ++v)
        reach_[v].lane.fill(nearest_[v]);

    run_.nearest = nearest_.data();
    run_.back = back_.data();
    run_.reach = reach_.data()->lane.data();
    run_.stolen = stolen_.data();
    run_.fresh = fresh_[0].data();
    run_.changed = fresh_[1].data();
    run_.touched_spans = touched_.data();
}

template <typename Word>
void Window<Word>::fill_row(const Field &field, uint64_t y, uint64_t z) {
    const std::array<uint64_t, 3> start = {box_.origin[0], box_.origin[1] + y, box_.origin[2] + z};
    const size_t first = local(start);
    const uint64_t voxel = field.grid().index(start[0], start[1], start[2]);
    for (uint64_t x = 0; x < box_.extent[0]; ++x) {
        if (!field.reached(voxel + x))
            continue;
        nearest_[first + x] = static_cast<Word>(field.distance(voxel + x));
        label_[first + x] = field.label(voxel + x);
        // Neighbours behind are filled already: those that are not reached, or not in the box or the grid, are far
        // away.
        uint32_t joined = 0;
        const uint32_t open =
            field.graph().cuts() == nullptr ? field.grid().neighbour_mask() : field.graph().open_edges(voxel + x);
        for (unsigned n = 0; n < backward_edges; ++n)
            if ((open >> n & 1) != 0 && nearest_[first + x + static_cast<size_t>(run_.step[n])] < far_away<Word>)
                joined |= 1u << n;
        for_weights(field.graph(), voxel + x, joined, [&](unsigned n, uint64_t weight) {
            if (weight != 0)
                back_[(first + x) * backward_edges + n] = static_cast<Word>(std::min<uint64_t>(weight, far_away<Word>));
        });
    }
}

template <typename Word>
bool Window<Word>::holds(const Box &box) const {
    for (unsigned a = 0; a < 3; ++a)
        if (box.origin[a] < box_.origin[a] || box.origin[a] + box.extent[a] > box_.origin[a] + box_.extent[a])
            return false;
    return true;
}

template <typename Word>
void Window<Word>::bound(const std::array<Word, batch_lanes> &bounds) {
    bounds_.lane = bounds;
    bounded_ = true;
    run_.bound = bounds_.lane.data();
    std::fill(reach_.begin(), reach_.end(), bounds_);
}

template <typename Word>
void Window<Word>::start(size_t local, unsigned lane, Word distance) {
    Word &word = reach_[local].lane[lane];
    if (distance >= word)
        return;
    word = distance;
    const size_t row = local / sizes_[0];
    const auto x = static_cast<uint32_t>(local % sizes_[0]);
    for (Span *spans : {run_.fresh, run_.changed})
        spans[row].add(x);
    run_.fresh_rows.add(row % sizes_[1], row / sizes_[1]);
}

template <typename Word>
bool Window<Word>::too_small(const Grid &grid) const {
    const Hull &hull = run_.touched;
    if (hull.empty())
        return false;
    const auto beyond = [&](unsigned axis, uint64_t low, uint64_t high) {
        return (low <= 1 && box_.origin[axis] > 0) ||
               (high >= box_.extent[axis] && box_.origin[axis] + box_.extent[axis] < grid.dims()[axis]);
    };
    if (beyond(1, hull.y.first, hull.y.last) || beyond(2, hull.z.first, hull.z.last))
        return true;
    for (size_t z = hull.z.first; z <= hull.z.last; ++z)
        for (size_t y = hull.y.first; y <= hull.y.last; ++y) {
            const Span &span = touched_[z * sizes_[1] + y];
            if (!span.empty() && beyond(0, span.first, span.last))
                return true;
        }
    return false;
}

template <typename Word>
void Window<Word>::restore(const SettleKernels<Word> &kernels) {
    bounded_ ? kernels.restore_bound(run_) : kernels.restore_nearest(run_);
    if (run_.fresh_rows.empty())
        return;
    // The sweeps ended before the fixpoint.
    std::fill_n(run_.fresh, sizes_[1] * sizes_[2], Span{});
    run_.fresh_rows = Hull{};
}

template class Window<uint32_t>;
template class Window<uint64_t>;

} // namespace locus::graph
