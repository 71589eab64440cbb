// Options of a store.
#include "pmq/options.hpp"

#include "core/error.hpp"
#include "pmq/layout/packed_array.hpp"
#include "pmq/layout/ring_leaves.hpp"

#include <bit>

namespace locus::pmq {

locus_pmq_options default_options() noexcept {
    locus_pmq_options options{};
    options.struct_size = sizeof options;
    options.record = LOCUS_RECORD_POINT32;
    options.layout = LOCUS_LAYOUT_RING_LEAVES;
    options.index = LOCUS_INDEX_IMPLICIT;
    options.future = LOCUS_FUTURE_REFUSE;
    options.horizon = LOCUS_NO_HORIZON;
    options.max_records = LOCUS_NO_LIMIT;
    options.max_bytes = LOCUS_NO_LIMIT;
    const Densities densities;
    options.segment_slots = densities.segment_slots;
    options.rho_leaf = densities.rho_leaf;
    options.tau_leaf = densities.tau_leaf;
    options.rho_root = densities.rho_root;
    options.tau_root = densities.tau_root;
    options.snapshot_bytes = uint64_t{1} << 30;
    return options;
}

namespace {

Densities densities_of(const locus_pmq_options &o) noexcept {
    return {o.segment_slots, o.rho_leaf, o.tau_leaf, o.rho_root, o.tau_root};
}

PackedIndex index_of(const locus_pmq_options &o) noexcept {
    switch (o.index) {
    case LOCUS_INDEX_EXPLICIT:
        return PackedIndex::quadtree;
    case LOCUS_INDEX_HEADS:
        return PackedIndex::heads;
    default:
        return PackedIndex::implicit;
    }
}

void check_packed_array(const locus_pmq_options &o) {
    require(o.index <= LOCUS_INDEX_HEADS, "options.index is ", o.index, ", not a LOCUS_INDEX_");
    require(std::has_single_bit(o.segment_slots) && o.segment_slots >= 4 && o.segment_slots <= 4096,
            "options.segment_slots is ", o.segment_slots, ", not a power of two in 4..4096");
    require(0 <= o.rho_leaf && o.rho_leaf < o.rho_root && o.rho_root < o.tau_root && o.tau_root < o.tau_leaf &&
                o.tau_leaf <= 1,
            "options.rho_leaf ", o.rho_leaf, ", rho_root ", o.rho_root, ", tau_root ", o.tau_root, ", tau_leaf ",
            o.tau_leaf, " are not 0 <= rho_leaf < rho_root < tau_root < tau_leaf <= 1");
    require(2 * o.rho_root < o.tau_root, "options.rho_root ", o.rho_root, " is not below half of tau_root ",
            o.tau_root);
    if (o.layout != LOCUS_LAYOUT_PACKED_ARRAY)
        return;
    const uint64_t smallest = PackedArray::smallest_bytes(record_format(o), densities_of(o), index_of(o));
    require(o.max_bytes >= smallest, "options.max_bytes is ", o.max_bytes,
            ", too little for one record with segments of ", o.segment_slots, " slots: at least ", smallest);
}

} // namespace

void check_options(const locus_pmq_options &o) {
    require(o.record == LOCUS_RECORD_POINT32 || o.record == LOCUS_RECORD_TEXT156, "options.record is ", o.record,
            ", not a LOCUS_RECORD_");
    require(o.layout == LOCUS_LAYOUT_RING_LEAVES || o.layout == LOCUS_LAYOUT_PACKED_ARRAY, "options.layout is ",
            o.layout, ", not a LOCUS_LAYOUT_");
    require(o.future == LOCUS_FUTURE_REFUSE || o.future == LOCUS_FUTURE_CLAMP, "options.future is ", o.future,
            ", not a LOCUS_FUTURE_");
    require(o.horizon > 0, "options.horizon is ", o.horizon, ", not positive");
    require(o.max_records >= 1, "options.max_records is 0");
    require(o.max_bytes >= 65536, "options.max_bytes is ", o.max_bytes, ", below 65536");
    require(o.reserved0 == 0, "options.reserved0 is ", o.reserved0, ", not 0");
    check_packed_array(o);
}

const RecordFormat &record_format(const locus_pmq_options &options) noexcept {
    return options.record == LOCUS_RECORD_POINT32 ? point32 : text156;
}

std::unique_ptr<Layout> make_layout(const locus_pmq_options &options) {
    const Limits limits{options.max_records, options.max_bytes, options.snapshot_bytes};
    if (options.layout == LOCUS_LAYOUT_RING_LEAVES)
        return std::make_unique<RingLeaves>(record_format(options), limits);
    return std::make_unique<PackedArray>(record_format(options), densities_of(options), limits, index_of(options));
}

} // namespace locus::pmq
