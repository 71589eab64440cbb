#include "graph/weights/interpolation.hpp"

#include "graph/weights/affected.hpp"
#include "graph/weights/concerned.hpp"
#include "graph/weights/natural.hpp"
#include "graph/weights/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace locus::graph {
namespace {

constexpr uint64_t smallest_budget = uint64_t{1} << 20;

std::vector<uint64_t> voxels_of(const Grid &grid, const Box &box) {
    std::vector<uint64_t> voxels;
    voxels.reserve(box.extent[0] * box.extent[1] * box.extent[2]);
    for (uint64_t z = 0; z < box.extent[2]; ++z)
        for (uint64_t y = 0; y < box.extent[1]; ++y)
            for (uint64_t x = 0; x < box.extent[0]; ++x)
                voxels.push_back(grid.index(box.origin[0] + x, box.origin[1] + y, box.origin[2] + z));
    return voxels;
}

// Where the seeds start, by slot.
std::vector<Source> sources_of(const Diagram &diagram) {
    std::vector<Source> sources;
    for (const Seed &seed : diagram.solved_seeds())
        sources.push_back({seed.voxel, seed.steps, seed.slot});
    return sources;
}

std::vector<uint32_t> ids_by_slot(const Diagram &diagram) {
    std::vector<uint32_t> ids(diagram.position_of_slot().size(), LOCUS_NO_SEED);
    for (const Seed &seed : diagram.solved_seeds())
        ids[seed.slot] = seed.id;
    return ids;
}

} // namespace

Interpolation::Interpolation(std::shared_ptr<const Diagram> diagram, const locus_weights_options &options,
                             const Box &box)
    : diagram_(std::move(diagram)), box_(box) {
    take_options(options);
    diagram_->graph().grid().check(box);
    voxels_ = voxels_of(diagram_->graph().grid(), box);
    compute_all();
}

Interpolation::Interpolation(std::shared_ptr<const Diagram> diagram, const locus_weights_options &options,
                             std::span<const uint64_t> voxels)
    : diagram_(std::move(diagram)), voxels_(voxels.begin(), voxels.end()) {
    take_options(options);
    const uint64_t all = diagram_->graph().grid().voxels();
    for (size_t i = 0; i < voxels_.size(); ++i)
        require(voxels_[i] < all, "voxels[", i, "] is ", voxels_[i], ", outside the grid of ", all, " voxels");
    compute_all();
}

void Interpolation::take_options(const locus_weights_options &options) {
    require(options.method <= LOCUS_METHOD_DISTANCE_RATIO, "method is ", options.method, ", none of LOCUS_METHOD_");
    require(options.batch_bytes >= smallest_budget, "batch_bytes is ", options.batch_bytes, ", less than ",
            smallest_budget);
    options_ = options;
}

void Interpolation::check_diagram() const {
    diagram_->check_unchanged();
    if (diagram_->seeds_changed())
        fail(LOCUS_E_STATE, "the seeds changed since the diagram was solved: solve it again");
}

void Interpolation::compute_all() {
    check_diagram();
    if (options_.method != LOCUS_METHOD_DISTANCE_RATIO)
        return adopt(natural({}, nullptr), {});
    Rows parts = ratio_parts(survey_cells(Field(diagram_->graph(), diagram_->words())), nullptr);
    Rows rows = ratio_rows(parts, options_.max_per_row);
    adopt(std::move(rows), std::move(parts));
}

// Some rows (all where empty), the others from `base`.
Rows Interpolation::natural(std::span<const uint64_t> rows, const Rows *base) const {
    Progress progress(options_.progress, options_.progress_user);
    const Graph &graph = diagram_->graph();
    const Field field(graph, diagram_->words());
    const NaturalJob job{
        field, options_.method,    options_.max_per_row, options_.batch_bytes, graph.threads(), graph.simd(), voxels_,
        rows,  diagram_->stream(), &diagram_->engine()};
    return assemble(voxels_.size(), natural_rows_on_backend(job, progress), base);
}

// What the concerned seeds (null: all) weigh everywhere.
Rows Interpolation::ratio_parts(const std::vector<Cell> &cells, const std::vector<bool> *concerned) const {
    Progress progress(options_.progress, options_.progress_user);
    const Graph &graph = diagram_->graph();
    const Field field(graph, diagram_->words());
    std::vector<Source> seeds = sources_of(*diagram_);
    if (concerned != nullptr)
        std::erase_if(seeds, [&](const Source &seed) { return !(*concerned)[seed.label]; });
    return graph::ratio_parts({field, cells, seeds, options_.batch_bytes, graph.threads(), graph.simd(), voxels_},
                              progress);
}

// Keep rows, and the diagram they belong to. Nothing is changed when memory runs out.
void Interpolation::adopt(Rows rows, Rows parts) {
    Words words = diagram_->words();
    std::vector<uint32_t> ids, id_of_slot = ids_by_slot(*diagram_);
    for (const Seed &seed : diagram_->solved_seeds())
        ids.push_back(seed.id);
    for (Share &share : rows.shares)
        share.label = diagram_->position_of_slot()[share.label];
    rows_ = std::move(rows);
    parts_ = std::move(parts);
    words_ = std::move(words);
    ids_ = std::move(ids);
    id_of_slot_ = std::move(id_of_slot);
    version_ = diagram_->graph().version();
}

// No slot has been given to another seed since the rows were made.
bool Interpolation::same_slots() const {
    const std::vector<uint32_t> now = ids_by_slot(*diagram_);
    for (size_t slot = 0; slot < std::min(now.size(), id_of_slot_.size()); ++slot)
        if (now[slot] != id_of_slot_[slot] && now[slot] != LOCUS_NO_SEED && id_of_slot_[slot] != LOCUS_NO_SEED)
            return false;
    return true;
}

// From the rows as they are, with seeds by slot; those that were computed anew.
std::vector<uint64_t> Interpolation::update_natural(Rows rows) {
    const auto voxels = affected_voxels(diagram_->graph(), words_, version_, diagram_->words());
    std::vector<uint64_t> affected;
    for (uint64_t row = 0; row < voxels_.size(); ++row)
        if (voxels[voxels_[row]])
            affected.push_back(row);
    if (!affected.empty())
        rows = natural(affected, &rows);
    adopt(std::move(rows), {});
    return affected;
}

std::vector<uint64_t> Interpolation::update_ratio(const Rows &rows) {
    const Graph &graph = diagram_->graph();
    const Field now(graph, diagram_->words()), before(graph, words_);
    const std::vector<Cell> cells = survey_cells(now);
    const std::vector<bool> concerned =
        concerned_labels(now, before, sources_of(*diagram_), cells, edited_voxels(graph, version_));
    Renewed renewed = renew_rows(parts_, rows, ratio_parts(cells, &concerned), concerned, options_.max_per_row);
    adopt(std::move(renewed.rows), std::move(renewed.parts));
    return std::move(renewed.changed);
}

std::vector<uint64_t> Interpolation::update() {
    check_diagram();
    if (!same_slots()) {
        std::vector<uint64_t> all(voxels_.size());
        std::iota(all.begin(), all.end(), 0);
        compute_all();
        return all;
    }
    Rows rows = rows_;
    std::unordered_map<uint32_t, uint32_t> slot_of_id;
    for (uint32_t slot = 0; slot < id_of_slot_.size(); ++slot)
        slot_of_id[id_of_slot_[slot]] = slot;
    for (Share &share : rows.shares)
        share.label = slot_of_id[ids_[share.label]];
    return options_.method == LOCUS_METHOD_DISTANCE_RATIO ? update_ratio(rows) : update_natural(std::move(rows));
}

uint32_t Interpolation::position(uint32_t id) const {
    const auto found = std::find(ids_.begin(), ids_.end(), id);
    require(found != ids_.end(), "no seed has the id ", id);
    return static_cast<uint32_t>(found - ids_.begin());
}

void Interpolation::dense(uint64_t first, uint64_t count, std::span<const uint32_t> ids, float *out) const {
    constexpr size_t none = std::numeric_limits<size_t>::max();
    std::vector<size_t> column(ids_.size(), none);
    for (size_t j = 0; j < ids.size(); ++j) {
        size_t &place = column[position(ids[j])];
        require(place == none, "ids[", j, "] is ", ids[j], ", which stands there twice");
        place = j;
    }
    std::fill_n(out, count * ids.size(), 0.0f);
    for (uint64_t i = 0; i < count; ++i)
        for (const Share &share : rows_.row(first + i))
            if (column[share.label] != none)
                out[i * ids.size() + column[share.label]] = share.weight;
}

void Interpolation::interpolate(uint64_t first, uint64_t count, const float *values, uint32_t components,
                                float *out) const {
    std::vector<double> sum(components);
    for (uint64_t i = 0; i < count; ++i) {
        const auto row = rows_.row(first + i);
        std::fill(sum.begin(), sum.end(), row.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0);
        for (const Share &share : row)
            for (uint32_t c = 0; c < components; ++c)
                sum[c] += double{share.weight} * double{values[size_t{share.label} * components + c]};
        for (uint32_t c = 0; c < components; ++c)
            out[i * components + c] = static_cast<float>(sum[c]);
    }
}

void Interpolation::gradients(uint64_t first, uint64_t count, uint32_t id, float *out) const {
    if (!box_)
        fail(LOCUS_E_STATE, "the weights are those of a list of voxels, not of a box");
    if (diagram_->graph().version() != version_)
        fail(LOCUS_E_STATE, "the graph was edited since the weights were made: update them first");
    const uint32_t seed = position(id);
    const Grid &grid = diagram_->graph().grid();
    const auto weight = [&](uint64_t row) {
        const auto shares = rows_.row(row);
        const auto found = std::ranges::find(shares, seed, &Share::label);
        return found == shares.end() ? 0.0 : double{found->weight};
    };
    const std::array<uint64_t, 3> step = {1, box_->extent[0], box_->extent[0] * box_->extent[1]};
    for (uint64_t i = 0; i < count; ++i) {
        const uint64_t row = first + i;
        const std::array<uint64_t, 3> place = {row % box_->extent[0], row / step[1] % box_->extent[1], row / step[2]};
        for (unsigned a = 0; a < 3; ++a) {
            // What lies on the one and on the other side, as far as it is joined to the voxel.
            double low = weight(row), high = low, length = 0;
            const auto joined = [&](uint64_t other) {
                return !rows_.row(other).empty() && diagram_->graph().weight_between(voxels_[row], voxels_[other]) != 0;
            };
            if (place[a] > 0 && joined(row - step[a])) {
                low = weight(row - step[a]);
                length += grid.spacing()[a];
            }
            if (place[a] + 1 < box_->extent[a] && joined(row + step[a])) {
                high = weight(row + step[a]);
                length += grid.spacing()[a];
            }
            out[i * 3 + a] = length > 0 ? static_cast<float>((high - low) / length) : 0.0f;
        }
    }
}

} // namespace locus::graph
