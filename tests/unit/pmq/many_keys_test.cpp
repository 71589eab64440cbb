// Questions about many keys, by every instruction set, against the same questions key by key.
#include "pmq/query/many_keys.hpp"

#include "pmq/query/region.hpp"
#include "tests/unit/pmq/items.hpp"

#include <gtest/gtest.h>

#include <array>

namespace locus::test {
namespace {

using pmq::KeyMarks;
using pmq::many_keys;
using pmq::ManyKeys;
using pmq::Relation;

template <typename Ask>
void with_each(Ask &&ask) {
    for (const Simd target : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon}) {
        if (!simd_available(target))
            continue;
        SCOPED_TRACE(simd_name(target));
        ask(many_keys(target));
    }
}

std::vector<uint64_t> keys_near(Places &draw, const locus_box &box) {
    std::vector<uint64_t> keys(draw.below(pmq::most_keys + 1));
    const double south = key_of(box.south, box.west) % 2 ? box.south : box.north;
    for (uint64_t &key : keys) {
        const Item item = draw.place();
        const uint64_t corner = key_of(south, box.west);
        key = draw.chance(0.5) ? key_of(item.latitude, item.longitude) : (corner ^ draw.below(256)) % key_end;
    }
    return keys;
}

bool bit(const std::array<uint64_t, pmq::most_keys / 64> &bits, size_t i) { return bits[i / 64] >> i % 64 & 1; }

TEST(ManyKeys, AreMarkedAsEachIs) {
    Places draw(3);
    for (int i = 0; i < 500; ++i) {
        const locus_box box = draw.box();
        const pmq::BoxRegion region(box);
        const std::vector<uint64_t> keys = keys_near(draw, box);
        KeyRange range;
        if (draw.chance(0.5) && !keys.empty())
            range = {keys[draw.below(keys.size())], key_end};
        with_each([&](const ManyKeys &many) {
            KeyMarks marks;
            marks.inside.fill(UINT64_MAX);
            marks.edge.fill(UINT64_MAX);
            many.mark(region.among(range), keys.data(), keys.size(), marks);
            for (size_t k = 0; k < pmq::most_keys; ++k) {
                const bool there = k < keys.size() && range.contains(keys[k]);
                ASSERT_EQ(bit(marks.inside, k), there && region.relate(keys[k]) == Relation::inside) << k;
                ASSERT_EQ(bit(marks.edge, k), there && region.relate(keys[k]) == Relation::edge) << k;
            }
        });
    }
}

TEST(ManyKeys, AreCountedBelowABound) {
    Places draw(4);
    for (int i = 0; i < 500; ++i) {
        const std::vector<uint64_t> keys = keys_near(draw, draw.box());
        uint64_t bound = draw.chance(0.1) ? key_end : draw.below(key_end);
        if (!keys.empty() && draw.chance(0.7))
            bound = keys[draw.below(keys.size())] + draw.below(2);
        const auto below = std::count_if(keys.begin(), keys.end(), [&](uint64_t key) { return key < bound; });
        with_each([&](const ManyKeys &many) {
            ASSERT_EQ(many.count_below(bound, keys.data(), keys.size()), static_cast<size_t>(below));
        });
    }
}

TEST(ManyKeys, LieInTheBinsOfTheirTiles) {
    Places draw(5);
    for (int i = 0; i < 500; ++i) {
        const std::vector<uint64_t> keys = keys_near(draw, draw.box());
        const auto log2_bins = static_cast<unsigned>(draw.below(9));
        const auto zoom = static_cast<unsigned>(draw.below(key_levels - log2_bins + 1));
        const uint32_t mask = (1u << log2_bins) - 1;
        with_each([&](const ManyKeys &many) {
            std::vector<uint64_t> bins(keys.size() + 1, 77);
            many.bins(2 * (key_levels - zoom - log2_bins), log2_bins, keys.data(), keys.size(), bins.data());
            for (size_t k = 0; k < keys.size(); ++k) {
                const unsigned below = key_levels - zoom - log2_bins;
                const uint32_t x = morton_x(keys[k]) >> below & mask, y = morton_y(keys[k]) >> below & mask;
                ASSERT_EQ(bins[k], (y << log2_bins) + x);
            }
            ASSERT_EQ(bins.back(), 77u);
        });
    }
}

} // namespace
} // namespace locus::test
