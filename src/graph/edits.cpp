// Edits of a graph, the journal they leave, and the weight of a single edge.
#include "core/error.hpp"
#include "graph/graph.hpp"
#include "graph/scaling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace locus::graph {
namespace {

constexpr size_t most_boxes = size_t{1} << 16; // a longer journal costs more than a fresh solve

// Boxes around voxels and all their neighbours, one for each block of 16 x 16 x 16 that has any of the voxels.
std::vector<Box> boxes_around(const Grid &grid, std::span<const uint64_t> voxels) {
    constexpr uint64_t block = 16;
    struct Extent {
        std::array<uint64_t, 3> first, last;
    };
    std::unordered_map<uint64_t, Extent> extents;
    for (const uint64_t voxel : voxels) {
        const auto place = grid.place(voxel);
        const uint64_t key = grid.index(place[0] / block, place[1] / block, place[2] / block);
        Extent &extent = extents.try_emplace(key, Extent{place, place}).first->second;
        for (size_t axis = 0; axis < 3; ++axis) {
            extent.first[axis] = std::min(extent.first[axis], place[axis]);
            extent.last[axis] = std::max(extent.last[axis], place[axis]);
        }
    }
    std::vector<Box> boxes;
    for (const auto &[key, extent] : extents) {
        Box &box = boxes.emplace_back();
        for (size_t axis = 0; axis < 3; ++axis) {
            box.origin[axis] = extent.first[axis] - (extent.first[axis] > 0 ? 1 : 0);
            box.extent[axis] = std::min(grid.dims()[axis], extent.last[axis] + 2) - box.origin[axis];
        }
    }
    return boxes;
}

} // namespace

// Throws LOCUS_E_RANGE unless the value's weights fit the words and keep the rounding error promised.
void Graph::check_value(float value, uint64_t voxel) const {
    if (!operand_.passable(value))
        return;
    const double c = compliance(value);
    if (c == 0 || operand_.rule == LOCUS_WEIGHT_UNIFORM || operand_.rule == LOCUS_WEIGHT_CALLER)
        return;
    const double largest = largest_steps(c);
    if (!(largest <= static_cast<double>(layout_.weight_limit()) &&
          largest * shares_per_edge() <= static_cast<double>(layout_.max_exact())))
        fail(LOCUS_E_RANGE, "the material ", value, " of voxel ", voxel, " needs weights of up to ",
             largest * shares_per_edge(), " steps: more than words of ", layout_.bits, " bits hold at the scale ",
             scale_, "; create the graph with this value inside options->material_min and material_max");
    const double error = rounding_error(smallest_steps(c));
    if (!(error <= tolerance_ * (1 + 1e-9)))
        fail(LOCUS_E_RANGE, "the material ", value, " of voxel ", voxel, " is too small for the scale ", scale_,
             ": its weights would be off by ", error, " of their size, more than ", tolerance_,
             "; create the graph with this value inside options->material_min and material_max");
}

void Graph::write(uint64_t voxel, float value) {
    float &place = materials_[voxel];
    passable_ -= place == place ? 1 : 0;
    longest_path_ -= on_path(place);
    place = operand_.passable(value) ? value : std::numeric_limits<float>::quiet_NaN();
    passable_ += place == place ? 1 : 0;
    longest_path_ += on_path(place);
    if (place == place && operand_.rule != LOCUS_WEIGHT_CALLER)
        range_.add(compliance(place));
}

// Make room first, so that what follows a change cannot fail; then the caller changes the materials.
void Graph::journal(const std::vector<Box> &boxes) {
    if (boxes.size() > most_boxes || edited_.size() + boxes.size() > most_boxes) {
        edited_.clear();
        edited_at_.clear();
        journal_start_ = ++version_;
        return;
    }
    edited_.reserve(edited_.size() + boxes.size());
    edited_at_.reserve(edited_.size() + boxes.size());
    ++version_;
    edited_.insert(edited_.end(), boxes.begin(), boxes.end());
    edited_at_.insert(edited_at_.end(), boxes.size(), version_);
}

std::optional<std::span<const Box>> Graph::edits_since(uint64_t version) const {
    if (version < journal_start_)
        return std::nullopt;
    const auto first = std::upper_bound(edited_at_.begin(), edited_at_.end(), version) - edited_at_.begin();
    return std::span<const Box>(edited_).subspan(static_cast<size_t>(first));
}

void Graph::set_box(const Box &box, const float *values) {
    grid_.check(box);
    for_each_voxel(grid_, box, [&](uint64_t voxel, uint64_t i) { check_value(values[i], voxel); });
    journal({box});
    for_each_voxel(grid_, box, [&](uint64_t voxel, uint64_t i) { write(voxel, values[i]); });
}

void Graph::fill_box(const Box &box, float value) {
    grid_.check(box);
    check_value(value, grid_.index(box.origin[0], box.origin[1], box.origin[2]));
    journal({box});
    for_each_voxel(grid_, box, [&](uint64_t voxel, uint64_t) { write(voxel, value); });
}

void Graph::set_voxels(std::span<const uint64_t> voxels, const float *values) {
    if (voxels.empty())
        return;
    for (size_t i = 0; i < voxels.size(); ++i) {
        require(voxels[i] < grid_.voxels(), "voxels[", i, "] is ", voxels[i], ": the grid has ", grid_.voxels(),
                " voxels");
        check_value(values[i], voxels[i]);
    }
    std::vector<Box> runs; // consecutive voxels of a row make one box
    for (size_t i = 0; i < voxels.size() && runs.size() <= most_boxes; ++i) {
        const auto [x, y, z] = grid_.place(voxels[i]);
        if (!runs.empty() && x > 0 && voxels[i - 1] + 1 == voxels[i])
            ++runs.back().extent[0];
        else
            runs.push_back({{x, y, z}, {1, 1, 1}});
    }
    journal(runs);
    for (size_t i = 0; i < voxels.size(); ++i)
        write(voxels[i], values[i]);
}

void Graph::get_box(const Box &box, float *values) const {
    grid_.check(box);
    for_each_voxel(grid_, box, [&](uint64_t voxel, uint64_t i) { values[i] = materials_[voxel]; });
}

void Graph::cut_edges(std::span<const uint64_t> voxels, std::span<const uint16_t> masks) {
    if (voxels.empty())
        return;
    if (cuts_.empty())
        cuts_.assign(grid_.voxels(), 0);
    journal(boxes_around(grid_, voxels));
    for (size_t i = 0; i < voxels.size(); ++i)
        cuts_[voxels[i]] = static_cast<uint16_t>(cuts_[voxels[i]] | masks[i]);
}

uint64_t Graph::mend_edges(const Box &box) {
    grid_.check(box);
    if (cuts_.empty())
        return 0;
    std::vector<uint64_t> voxels;
    std::vector<uint16_t> masks;
    uint64_t mended = 0;
    Box wide{};
    for (size_t axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = box.origin[axis] - (box.origin[axis] > 0 ? 1 : 0);
        wide.extent[axis] = std::min(grid_.dims()[axis], box.origin[axis] + box.extent[axis] + 1) - wide.origin[axis];
    }
    const auto in_box = [&](const std::array<uint64_t, 3> &place) {
        return place[0] - box.origin[0] < box.extent[0] && place[1] - box.origin[1] < box.extent[1] &&
               place[2] - box.origin[2] < box.extent[2];
    };
    for_each_voxel(grid_, wide, [&](uint64_t voxel, uint64_t) {
        if (cuts_[voxel] == 0)
            return;
        const uint32_t inside = grid_.inside(grid_.place(voxel));
        uint16_t mask = 0;
        for (unsigned bit = 0; bit < 13; ++bit) {
            const Neighbour &to = grid_.neighbour(first_forward + bit);
            if ((cuts_[voxel] >> bit & 1) != 0 && (inside >> to.number & 1) != 0 &&
                (in_box(grid_.place(voxel)) || in_box(grid_.place(voxel + static_cast<uint64_t>(to.step)))))
                mask = static_cast<uint16_t>(mask | 1u << bit);
        }
        if (mask == 0)
            return;
        voxels.push_back(voxel);
        masks.push_back(mask);
        mended += static_cast<uint64_t>(std::popcount(mask));
    });
    if (mended > 0)
        journal(boxes_around(grid_, voxels));
    for (size_t i = 0; i < voxels.size(); ++i)
        cuts_[voxels[i]] = static_cast<uint16_t>(cuts_[voxels[i]] & ~masks[i]);
    return mended;
}

uint32_t Graph::open_edges(uint64_t voxel) const {
    uint32_t open = grid_.inside(grid_.place(voxel));
    if (cuts_.empty())
        return open;
    open &= ~(uint32_t{cuts_[voxel]} << first_forward);
    for (const Neighbour &to : grid_.neighbours()) {
        if (to.number >= first_forward || (open >> to.number & 1) == 0)
            continue;
        const uint64_t v = voxel + static_cast<uint64_t>(to.step);
        if ((cuts_[v] >> (25 - to.number - first_forward) & 1) != 0)
            open &= ~(1u << to.number);
    }
    return open;
}

namespace {

struct EdgeWeight {
    const Graph &graph;
    uint64_t u, v;
    unsigned kind;

    template <typename Rule>
    uint64_t operator()(const Rule &rule) const {
        using R = std::remove_cvref_t<decltype(rule.factor[0])>;
        const Operand &operand = graph.operand();
        return rule(operand.of<R>(graph.materials()[u]), operand.of<R>(graph.materials()[v]), kind);
    }

    // The caller's function is asked with the lower index first, so that it need not be symmetric to the last bit.
    uint64_t operator()(const CallerWeights &rule) const {
        const double length = graph.grid().length(kind);
        const double weight = rule.function(std::min(u, v), std::max(u, v), length, rule.user);
        if (!(weight >= 0) || !std::isfinite(weight))
            return 0;
        if (!(weight * rule.scale <= rule.most_steps))
            fail(LOCUS_E_RANGE, "the weight function gives ", weight, " for the voxels ", u, " and ", v, ", ", length,
                 " apart: more than the range the graph was made for; create it with a larger options->material_max");
        return steps<uint64_t>(weight * rule.scale);
    }
};

} // namespace

uint64_t Graph::weight(uint64_t u, const Neighbour &to) const {
    const uint64_t v = u + static_cast<uint64_t>(to.step);
    if (!passable(u) || !passable(v))
        return 0;
    if (!cuts_.empty()) {
        const bool forward = to.number >= first_forward;
        const unsigned bit = (forward ? to.number : 25 - to.number) - first_forward;
        if ((cuts_[forward ? u : v] >> bit & 1) != 0)
            return 0;
    }
    return std::visit(EdgeWeight{*this, u, v, to.kind}, weights_);
}

uint64_t Graph::weight_between(uint64_t u, uint64_t v) const {
    const unsigned number = grid_.number_between(u, v);
    return number < 26 ? weight(u, grid_.neighbour(number)) : 0;
}

} // namespace locus::graph
