// Questions about many keys, for every instruction set: Highway compiles this file once per target.
#include "pmq/query/many_keys.hpp"

#include <algorithm>

#ifndef LOCUS_SIMD_SCALAR_ONLY

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pmq/query/many_keys.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_NEON
HWY_BEFORE_NAMESPACE();
namespace locus::pmq::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::ScalableTag<int64_t>; // keys are far below the sign
using Word = hn::Vec<Words>;
using Yes = hn::Mask<Words>;
constexpr size_t most_lanes = 8;

HWY_INLINE Word set(uint64_t value) { return hn::Set(Words(), static_cast<int64_t>(value)); }
HWY_INLINE Word load(const uint64_t *keys) { return hn::LoadU(Words(), reinterpret_cast<const int64_t *>(keys)); }
// The first bits of a mask, one per lane.
HWY_INLINE uint64_t bits(Yes mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(Words(), mask, bytes);
    return bytes[0];
}

// From `first` to `last`, moved up by some bits.
struct Between {
    Word before, behind;
    HWY_INLINE Between(uint64_t first, uint64_t last, unsigned up)
        : before(set((first << up) - 1)), behind(set((last << up) + 1)) {}
    HWY_INLINE Yes operator()(Word value) const { return hn::And(hn::Gt(value, before), hn::Lt(value, behind)); }
};

// Cells are compared where they stand in keys: columns, and rows one bit up.
struct Cells {
    Between outer, inner;
    HWY_INLINE Cells(const MapCells &cells, unsigned up)
        : outer(cells.outer_first, cells.outer_last, up), inner(cells.inner_first, cells.inner_last, up) {}
};

void mark(const KeysOfBox &box, const uint64_t *keys, size_t count, KeyMarks &marks) noexcept {
    const Cells rows(box.rows, 1), west(box.columns[0], 0), east(box.columns[1], 0);
    const Between range(box.range.lo, box.range.hi - 1, 0);
    marks = {};
    const size_t lanes = hn::Lanes(Words()), whole = count / lanes * lanes;
    for (size_t i = 0; i < whole; i += lanes) {
        const Word key = load(keys + i), x = hn::And(key, set(key_x_mask)), y = hn::And(key, set(key_y_mask));
        const Yes outer = hn::And(hn::And(range(key), rows.outer(y)), hn::Or(west.outer(x), east.outer(x)));
        const Yes inner = hn::And(outer, hn::And(rows.inner(y), hn::Or(west.inner(x), east.inner(x))));
        marks.inside[i / 64] |= bits(inner) << i % 64;
        marks.edge[i / 64] |= bits(hn::AndNot(inner, outer)) << i % 64;
    }
    if (whole == count)
        return;
    uint64_t rest[most_lanes];
    std::fill_n(rest, lanes, key_end); // they are in no range
    std::copy(keys + whole, keys + count, rest);
    KeyMarks of_rest;
    mark(box, rest, lanes, of_rest);
    marks.inside[whole / 64] |= of_rest.inside[0] << whole % 64;
    marks.edge[whole / 64] |= of_rest.edge[0] << whole % 64;
}

size_t count_below(uint64_t bound, const uint64_t *keys, size_t count) noexcept {
    const size_t lanes = hn::Lanes(Words());
    Word below = hn::Zero(Words()), too = below;
    size_t i = 0;
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
        below = hn::Sub(below, hn::VecFromMask(Words(), hn::Lt(load(keys + i), set(bound))));
        too = hn::Sub(too, hn::VecFromMask(Words(), hn::Lt(load(keys + i + lanes), set(bound))));
    }
    auto total = static_cast<size_t>(hn::GetLane(hn::SumOfLanes(Words(), hn::Add(below, too))));
    for (; i < count; ++i)
        total += keys[i] < bound;
    return total;
}

// Column and row are gathered side by side, in the halves of a word.
HWY_INLINE Word bin_of(Word code, unsigned log2_bins) {
    const auto step = [](Word v, Word shifted, uint64_t mask)
                          HWY_ATTR { return hn::And(hn::Or(v, shifted), set(mask)); };
    Word v = hn::Or(hn::And(code, set(0x5555)), hn::And(hn::ShiftLeft<31>(code), set(uint64_t{0x5555} << 32)));
    v = step(v, hn::ShiftRight<1>(v), 0x0000333300003333);
    v = step(v, hn::ShiftRight<2>(v), 0x00000F0F00000F0F);
    v = step(v, hn::ShiftRight<4>(v), 0x000000FF000000FF);
    return hn::Or(hn::And(v, set(0xFF)), hn::ShiftRightSame(v, static_cast<int>(32 - log2_bins)));
}

void bins(unsigned shift, unsigned log2_bins, const uint64_t *keys, size_t count, uint64_t *bins) noexcept {
    const Word mask = set((uint64_t{1} << 2 * log2_bins) - 1);
    const auto find = [&](const uint64_t *from, uint64_t *to) HWY_ATTR {
        const Word code = hn::And(hn::ShiftRightSame(load(from), static_cast<int>(shift)), mask);
        hn::StoreU(bin_of(code, log2_bins), Words(), reinterpret_cast<int64_t *>(to));
    };
    const size_t lanes = hn::Lanes(Words()), whole = count / lanes * lanes;
    for (size_t i = 0; i < whole; i += lanes)
        find(keys + i, bins + i);
    uint64_t rest[most_lanes] = {}, of_rest[most_lanes];
    std::copy(keys + whole, keys + count, rest);
    find(rest, of_rest);
    std::copy_n(of_rest, count - whole, bins + whole);
}

constexpr ManyKeys answers{mark, count_below, bins};

} // namespace locus::pmq::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#endif

#if defined(LOCUS_SIMD_SCALAR_ONLY) || HWY_ONCE
namespace locus::pmq {
namespace {

// 1 or 0: without branches.
uint64_t between(uint64_t value, uint64_t first, uint64_t last) noexcept {
    return uint64_t{value >= first} & uint64_t{value <= last};
}

void scalar_mark(const KeysOfBox &box, const uint64_t *keys, size_t count, KeyMarks &marks) noexcept {
    const MapCells &rows = box.rows, &west = box.columns[0], &east = box.columns[1];
    marks = {};
    for (size_t i = 0; i < count; ++i) {
        const uint64_t x = keys[i] & key_x_mask, y = (keys[i] & key_y_mask) >> 1;
        const uint64_t outer =
            uint64_t{box.range.contains(keys[i])} & between(y, rows.outer_first, rows.outer_last) &
            (between(x, west.outer_first, west.outer_last) | between(x, east.outer_first, east.outer_last));
        const uint64_t inner =
            outer & between(y, rows.inner_first, rows.inner_last) &
            (between(x, west.inner_first, west.inner_last) | between(x, east.inner_first, east.inner_last));
        marks.inside[i / 64] |= inner << i % 64;
        marks.edge[i / 64] |= (outer & ~inner) << i % 64;
    }
}

size_t scalar_count_below(uint64_t bound, const uint64_t *keys, size_t count) noexcept {
    return static_cast<size_t>(std::count_if(keys, keys + count, [bound](uint64_t key) { return key < bound; }));
}

void scalar_bins(unsigned shift, unsigned log2_bins, const uint64_t *keys, size_t count, uint64_t *bins) noexcept {
    const uint64_t mask = (uint64_t{1} << 2 * log2_bins) - 1;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t code = keys[i] >> shift & mask;
        bins[i] = uint64_t{morton_y(code)} << log2_bins | morton_x(code);
    }
}

constexpr ManyKeys scalar{scalar_mark, scalar_count_below, scalar_bins};

} // namespace

const ManyKeys &many_keys(Simd target) noexcept {
    switch (target) {
#ifndef LOCUS_SIMD_SCALAR_ONLY
#if (HWY_TARGETS & HWY_SSE4)
    case Simd::sse4:
        return N_SSE4::answers;
#endif
#if (HWY_TARGETS & HWY_AVX2)
    case Simd::avx2:
        return N_AVX2::answers;
#endif
#if (HWY_TARGETS & HWY_AVX3)
    case Simd::avx512:
        return N_AVX3::answers;
#endif
#if (HWY_TARGETS & HWY_NEON)
    case Simd::neon:
        return N_NEON::answers;
#endif
#endif
    default:
        return scalar;
    }
}

const ManyKeys &many_keys() noexcept {
    static const ManyKeys &widest = many_keys(simd_best());
    return widest;
}

} // namespace locus::pmq
#endif
