// locus/weights.h
#include "capi/boundary.hpp"
#include "capi/handles.hpp"
#include "core/options.hpp"

#include <algorithm>

using namespace locus;

namespace {

// The size of the first release; fields are only ever appended.
constexpr size_t first_options_size = 40;
static_assert(sizeof(locus_weights_options) == first_options_size,
              "append only; then keep first_options_size a number");

locus_weights_options defaults() {
    return {sizeof(locus_weights_options), LOCUS_METHOD_SIBSON, LOCUS_ALL_SEEDS, uint64_t{1} << 30, nullptr, nullptr};
}

const graph::Interpolation &of(const locus_weights *weights) { return need(weights, "weights").weights; }

void check_rows(const graph::Interpolation &weights, uint64_t first, uint64_t count) {
    require(first <= weights.count(), "first is ", first, ": there are ", weights.count(), " rows");
    require(count <= weights.count() - first, "count is ", count, ": from row ", first, " on there are ",
            weights.count() - first);
}

// Room for count * columns numbers, and the memory itself.
void check_room(const float *out, const char *name, size_t capacity, uint64_t count, uint64_t columns) {
    need(out, name);
    if (columns != 0 && count > capacity / columns)
        fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ": ", count, " rows of ", columns, " numbers need room");
}

} // namespace

locus_status locus_weights_options_init(locus_weights_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, defaults(), first_options_size); });
}

locus_status locus_weights_create(locus_diagram *diagram, const locus_weights_options *options,
                                  const locus_voxel_box *box, locus_weights **weights) noexcept {
    return boundary(__func__, [&] {
        need(weights, "weights");
        *weights = nullptr;
        const locus_weights_options whole = read_options(options, defaults(), first_options_size);
        const auto &source = need(diagram, "diagram").diagram;
        *weights = new locus_weights{
            graph::Interpolation(source, whole, box != nullptr ? *box : source->graph().grid().whole())};
    });
}

locus_status locus_weights_create_for(locus_diagram *diagram, const locus_weights_options *options,
                                      const uint64_t *voxels, size_t count, locus_weights **weights) noexcept {
    return boundary(__func__, [&] {
        need(weights, "weights");
        *weights = nullptr;
        const locus_weights_options whole = read_options(options, defaults(), first_options_size);
        const auto &source = need(diagram, "diagram").diagram;
        need(voxels, "voxels");
        *weights = new locus_weights{graph::Interpolation(source, whole, std::span(voxels, count))};
    });
}

void locus_weights_destroy(locus_weights *weights) noexcept { delete weights; }

locus_status locus_weights_size(const locus_weights *weights, uint64_t *rows, uint64_t *entries) noexcept {
    return boundary(__func__, [&] {
        const graph::Interpolation &source = of(weights);
        if (rows != nullptr)
            *rows = source.count();
        if (entries != nullptr)
            *entries = source.entries();
    });
}

locus_status locus_weights_rows(const locus_weights *weights, uint64_t first, uint64_t count, uint64_t *offsets,
                                uint32_t *ids, float *values, size_t capacity, uint64_t *entries) noexcept {
    return boundary(__func__, [&] {
        const graph::Interpolation &source = of(weights);
        check_rows(source, first, count);
        need(offsets, "offsets");
        const graph::Rows &rows = source.rows();
        const uint64_t start = rows.offsets[first], all = rows.offsets[first + count] - start;
        if (entries != nullptr)
            *entries = all;
        for (uint64_t i = 0; i <= count; ++i)
            offsets[i] = rows.offsets[first + i] - start;
        if (capacity < all)
            fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ": the rows have ", all, " entries");
        if (all == 0)
            return;
        need(ids, "ids");
        need(values, "values");
        for (uint64_t i = 0; i < all; ++i) {
            ids[i] = source.ids()[rows.shares[start + i].label];
            values[i] = rows.shares[start + i].weight;
        }
    });
}

locus_status locus_weights_dense(const locus_weights *weights, uint64_t first, uint64_t count, const uint32_t *ids,
                                 size_t seeds, float *dense, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Interpolation &source = of(weights);
        check_rows(source, first, count);
        need(ids, "ids");
        check_room(dense, "dense", capacity, count, seeds);
        source.dense(first, count, std::span(ids, seeds), dense);
    });
}

locus_status locus_weights_interpolate(const locus_weights *weights, uint64_t first, uint64_t count,
                                       const float *values, uint32_t components, float *out, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Interpolation &source = of(weights);
        check_rows(source, first, count);
        need(values, "values");
        check_room(out, "out", capacity, count, components);
        source.interpolate(first, count, values, components, out);
    });
}

locus_status locus_weights_gradients(const locus_weights *weights, uint64_t first, uint64_t count, uint32_t id,
                                     float *gradients, size_t capacity) noexcept {
    return boundary(__func__, [&] {
        const graph::Interpolation &source = of(weights);
        check_rows(source, first, count);
        check_room(gradients, "gradients", capacity, count, 3);
        source.gradients(first, count, id, gradients);
    });
}

locus_status locus_weights_update(locus_weights *weights, uint64_t *changed, size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] {
        graph::Interpolation &updated = need(weights, "weights").weights;
        require(changed != nullptr || capacity == 0, "changed is NULL, capacity ", capacity);
        const std::vector<uint64_t> rows = updated.update();
        if (count != nullptr)
            *count = rows.size();
        if (changed == nullptr)
            return;
        std::copy_n(rows.begin(), std::min(rows.size(), capacity), changed);
        if (capacity < rows.size())
            fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ": ", rows.size(), " rows changed");
    });
}
