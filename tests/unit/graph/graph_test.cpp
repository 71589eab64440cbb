// Graphs through the C interface: options, the choice of words, weights against their formulas, edits.
#include "tests/unit/graph/api.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <random>

namespace {

using namespace api;

constexpr float air = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

uint64_t weight(const Graph &graph, uint64_t u, uint64_t v) {
    uint64_t steps = 12345;
    EXPECT_EQ(locus_graph_edge_weight(graph.get(), u, v, &steps), LOCUS_OK) << locus_last_error();
    return steps;
}

TEST(GraphOptions, AreChecked) {
    const std::vector<float> material(8, 1);
    const auto refused = [&](const std::function<void(locus_graph_options &)> &change, const char *part) {
        auto o = options(2, 2, 2);
        change(o);
        auto *made = reinterpret_cast<locus_graph *>(1);
        EXPECT_FAILS(locus_graph_create(&o, material.data(), &made), LOCUS_E_ARGUMENT, part);
        EXPECT_EQ(made, nullptr);
    };
    refused([](auto &o) { o.dims[1] = 0; }, "dims[1] is 0");
    refused([](auto &o) { o.dims[0] = o.dims[1] = 1 << 20, o.dims[2] = 1; },
            "1048576 x 1048576 x 1: more than 2^40 - 1");
    refused([](auto &o) { o.dims[0] = uint64_t{1} << 63, o.dims[1] = 2; }, "9223372036854775808 x 2 x 2");
    refused([](auto &o) { o.dims[0] = o.dims[1] = o.dims[2] = UINT64_MAX; }, "more than 2^40 - 1");
    refused([](auto &o) { o.spacing[2] = 0; }, "spacing[2] is 0");
    refused([](auto &o) { o.spacing[0] = std::nan(""); }, "spacing[0] is nan");
    refused([](auto &o) { o.spacing[1] = std::numeric_limits<double>::infinity(); }, "spacing[1] is inf");
    refused([](auto &o) { o.spacing[1] = 1e300; }, "too extreme");
    refused([](auto &o) { o.connectivity = 7; }, "connectivity is 7");
    refused([](auto &o) { o.weight_rule = 5; }, "weight_rule is 5");
    refused([](auto &o) { o.weight_rule = LOCUS_WEIGHT_CALLER; }, "weight is NULL");
    refused([](auto &o) { o.material = 2; }, "material is 2");
    refused([](auto &o) { o.word_bits = 16; }, "word_bits is 16");
    refused([](auto &o) { o.stiffness_exponent = 0; }, "stiffness_exponent is 0");
    refused([](auto &o) { o.stiffness_exponent = std::nan(""); }, "stiffness_exponent is nan");
    refused([](auto &o) { o.max_seeds = 0; }, "max_seeds is 0");
    refused([](auto &o) { o.max_seeds = (1 << 24) + 1; }, "max_seeds is 16777217");
    refused([](auto &o) { o.scale = -1; }, "scale is -1");
    refused([](auto &o) { o.precision = 0; }, "precision is 0");
    refused([](auto &o) { o.precision = 0.75; }, "precision is 0.75");
    refused([](auto &o) { o.material_min = 2, o.material_max = 1; },
            "material_min is 2, above options->material_max 1");
    refused([](auto &o) { o.material_min = -2; }, "material_min is -2");
    refused([](auto &o) { o.backend = 3; }, "backend is 3");
    refused([](auto &o) { o.simd = 99; }, "simd is 99");
    refused([](auto &o) { o.reserved0 = 1; }, "reserved0 is 1");
    refused([](auto &o) { o.struct_size = 8; }, "struct_size is 8");
    locus_graph *made = nullptr;
    auto o = options(2, 2, 2);
    EXPECT_FAILS(locus_graph_create(&o, material.data(), nullptr), LOCUS_E_ARGUMENT, "graph is NULL");
    EXPECT_FAILS(locus_graph_create(nullptr, material.data(), &made), LOCUS_E_ARGUMENT, "options is NULL");
    EXPECT_FAILS(locus_graph_create(&o, nullptr, &made), LOCUS_E_ARGUMENT, "material is NULL");
    locus_graph_destroy(nullptr);
}

TEST(Materials, DecideWhatIsPassable) {
    auto o = options(8, 1, 1);
    o.connectivity = 6;
    const Graph c = graph(o, {1, air, infinite, -1, 0, 0, -0.0f, 2});
    EXPECT_EQ(info(c).passable, 5u);
    std::vector<float> back(8);
    EXPECT_STATUS(locus_graph_get_box(c.get(), nullptr, back.data(), 8), LOCUS_OK);
    EXPECT_EQ(back[0], 1);
    for (int i = 1; i < 4; ++i)
        EXPECT_TRUE(std::isnan(back[static_cast<size_t>(i)]));
    EXPECT_EQ(back[4], 0);
    EXPECT_EQ(weight(c, 4, 5), 2u); // the smallest step, never a free one: one per half edge
    EXPECT_EQ(weight(c, 0, 1), 0u);
    EXPECT_EQ(weight(c, 3, 4), 0u);
    o.material = LOCUS_MATERIAL_STIFFNESS;
    const Graph k = graph(o, {1, air, infinite, -1, 0, -0.0f, infinite, 2});
    EXPECT_EQ(info(k).passable, 4u);
    EXPECT_EQ(weight(k, 2, 3), 0u);
}

TEST(Materials, MayAllBeImpassable) {
    for (uint32_t rule = LOCUS_WEIGHT_MEAN_COMPLIANCE; rule < LOCUS_WEIGHT_CALLER; ++rule) {
        auto o = options(3, 3, 3);
        o.weight_rule = rule;
        const Graph g = graph(o, std::vector<float>(27, air));
        EXPECT_EQ(info(g).passable, 0u);
        const Diagram d = diagram(g, {});
        const locus_seed seed{1, 1, 1, 0, 0, 0};
        EXPECT_FAILS(locus_diagram_add_seeds(d.get(), &seed, 1), LOCUS_E_ARGUMENT, "impassable");
        locus_place_options place;
        EXPECT_STATUS(locus_place_options_init(&place, sizeof place), LOCUS_OK);
        place.count = 1;
        EXPECT_FAILS(locus_diagram_place_seeds(d.get(), &place), LOCUS_E_STATE, "no passable voxel");
    }
}

// A weight from the header's formula, unrounded, in steps.
long double formula(uint32_t rule, long double a, long double b, long double length, long double p) {
    if (rule == LOCUS_WEIGHT_MEAN_COMPLIANCE)
        return length * (a + b) / 2;
    if (rule == LOCUS_WEIGHT_MAX_COMPLIANCE)
        return length * std::max(a, b);
    if (rule == LOCUS_WEIGHT_MEAN_STIFFNESS)
        return length / std::pow((1 / a + 1 / b) / 2, p);
    return length;
}

TEST(Weights, FollowTheirFormulaWithinTheErrorBound) {
    std::mt19937 random(11);
    for (const uint32_t word : {32u, 64u})
        for (uint32_t rule = LOCUS_WEIGHT_MEAN_COMPLIANCE; rule < LOCUS_WEIGHT_CALLER; ++rule)
            for (const uint32_t material :
                 std::initializer_list<uint32_t>{LOCUS_MATERIAL_COMPLIANCE, LOCUS_MATERIAL_STIFFNESS})
                for (const double p : {0.5, 1.0, 3.0})
                    for (const bool even : {true, false}) {
                        if (p != 1 && rule != LOCUS_WEIGHT_MEAN_STIFFNESS)
                            continue;
                        auto o = options(5, 4, 3);
                        o.weight_rule = rule;
                        o.word_bits = word;
                        o.material = material;
                        o.stiffness_exponent = p;
                        const double spacing[3] = {0.7, even ? 0.7 : 1.1, even ? 0.7 : 0.3};
                        std::copy(spacing, spacing + 3, o.spacing);
                        std::vector<float> values(60);
                        for (float &value : values)
                            value = std::exp(std::uniform_real_distribution<float>(-1, 1)(random));
                        const Graph g = graph(o, values);
                        const auto about = info(g);
                        EXPECT_LE(about.weight_error, o.precision + 1e-6);
                        uint64_t smallest = UINT64_MAX;
                        for (uint64_t u = 0; u < 60; ++u)
                            for (uint64_t v = 0; v < 60; ++v) {
                                const std::array<int, 3> d = {static_cast<int>(v % 5) - static_cast<int>(u % 5),
                                                              static_cast<int>(v / 5 % 4) - static_cast<int>(u / 5 % 4),
                                                              static_cast<int>(v / 20) - static_cast<int>(u / 20)};
                                const uint64_t steps = weight(g, u, v);
                                EXPECT_EQ(steps, weight(g, v, u));
                                if (u == v || std::abs(d[0]) > 1 || std::abs(d[1]) > 1 || std::abs(d[2]) > 1) {
                                    EXPECT_EQ(steps, 0u);
                                    continue;
                                }
                                const long double length = std::sqrt(static_cast<long double>(
                                    d[0] * d[0] * spacing[0] * spacing[0] + d[1] * d[1] * spacing[1] * spacing[1] +
                                    d[2] * d[2] * spacing[2] * spacing[2]));
                                const bool inverse = material == LOCUS_MATERIAL_STIFFNESS;
                                const long double a = inverse ? 1 / static_cast<long double>(values[u]) : values[u];
                                const long double b = inverse ? 1 / static_cast<long double>(values[v]) : values[v];
                                const long double expected = formula(rule, a, b, length, p) * about.scale;
                                EXPECT_LE(std::abs(static_cast<long double>(steps) - expected) / expected,
                                          about.weight_error)
                                    << "rule " << rule << " word " << word << " p " << p;
                                smallest = std::min(smallest, steps);
                            }
                        EXPECT_LE(about.smallest_step * about.scale, static_cast<double>(smallest));
                    }
}

TEST(Words, AreNarrowOnlyWhereNothingCanOverflow) {
    auto o = options(4, 4, 4);
    o.max_seeds = 16;
    const auto small = info(uniform_graph(o));
    EXPECT_EQ(small.word_bits, 32u);
    EXPECT_EQ(small.label_bits, 4u);
    EXPECT_EQ(small.max_exact, (uint64_t{1} << 26) - 1);
    EXPECT_EQ(small.overflow_free, 1u);
    o = options(64, 64, 64);
    const auto large = info(uniform_graph(o));
    EXPECT_EQ(large.word_bits, 64u);
    EXPECT_EQ(large.label_bits, 16u);
    EXPECT_EQ(large.overflow_free, 1u);
    EXPECT_EQ(std::log2(large.scale), std::floor(std::log2(large.scale)));
    o.word_bits = LOCUS_WORD_32;
    const auto forced = info(uniform_graph(o));
    EXPECT_EQ(forced.word_bits, 32u);
    EXPECT_EQ(forced.label_bits, 8u); // the split of the thesis
    EXPECT_EQ(forced.overflow_free, 0u);
    EXPECT_EQ(forced.max_exact, (uint64_t{1} << 22) - 1);
    o.max_seeds = 1;
    EXPECT_EQ(info(uniform_graph(o)).label_bits, 0u);
}

TEST(Words, HoldTheLongestPathTheyPromiseToHold) {
    // A comb of walls makes one long corridor; all of it is reached.
    for (const uint64_t max_seeds : {2u, 65535u}) {
        auto o = options(31, 31, 1);
        o.max_seeds = max_seeds;
        o.connectivity = 6;
        std::vector<float> material(961, 3);
        for (size_t y = 1; y < 31; y += 2)
            for (size_t x = 0; x < 31; ++x)
                if (x != (y % 4 == 1 ? 30 : 0))
                    material[x + 31 * y] = air;
        const Graph g = graph(o, material);
        EXPECT_EQ(info(g).overflow_free, 1u);
        const Diagram d = diagram(g, {{0, 0, 0, 0, 1, 0}});
        solve(d);
        const auto found = distances(d, 961);
        EXPECT_NEAR(found[930], 3.0 * (16 * 30 + 15 * 2), 1.0);
    }
}

TEST(Words, RefuseWhatTheyCannotHold) {
    auto o = options(2, 1, 1);
    locus_graph *made = nullptr;
    const float wide[2] = {1e-7f, 1};
    o.word_bits = LOCUS_WORD_32;
    EXPECT_FAILS(locus_graph_create(&o, wide, &made), LOCUS_E_RANGE, "words of 32 bits");
    o.scale = 1e6;
    EXPECT_STATUS(locus_graph_create(&o, wide, &made), LOCUS_OK); // a scale of one's own may round as it likes
    locus_graph_info coarse{};
    coarse.struct_size = sizeof coarse;
    EXPECT_STATUS(locus_graph_get_info(made, &coarse), LOCUS_OK);
    EXPECT_GT(coarse.weight_error, 10);
    locus_graph_destroy(made);
    o.scale = 1e8;
    EXPECT_FAILS(locus_graph_create(&o, wide, &made), LOCUS_E_RANGE, "scale is 100000000");
    o.word_bits = LOCUS_WORD_AUTO;
    const Graph fits = graph(o, {1e-7f, 1});
    EXPECT_EQ(info(fits).word_bits, 64u);
    const float extreme[2] = {1e-30f, 1};
    o.scale = 0;
    EXPECT_FAILS(locus_graph_create(&o, extreme, &made), LOCUS_E_RANGE, "words of 64 bits");
}

TEST(Edits, AreReadBackAndRefusedWhole) {
    auto o = options(5, 4, 3);
    o.material_min = 0.5;
    o.material_max = 8;
    const Graph g = uniform_graph(o);
    const auto scale = info(g).scale;
    const locus_voxel_box box{{1, 1, 1}, {3, 2, 2}};
    std::vector<float> values(12);
    for (size_t i = 0; i < 12; ++i)
        values[i] = i % 3 == 0 ? air : static_cast<float>(0.5 + 0.5 * static_cast<double>(i));
    EXPECT_STATUS(locus_graph_set_box(g.get(), &box, values.data()), LOCUS_OK);
    std::vector<float> back(60);
    EXPECT_STATUS(locus_graph_get_box(g.get(), &box, back.data(), 12), LOCUS_OK);
    for (size_t i = 0; i < 12; ++i)
        EXPECT_TRUE(i % 3 == 0 ? std::isnan(back[i]) : back[i] == values[i]) << i;
    EXPECT_EQ(info(g).passable, 56u);
    EXPECT_FAILS(locus_graph_get_box(g.get(), &box, back.data(), 11), LOCUS_E_CAPACITY, "12 voxels");

    const auto whole = [&] {
        std::vector<float> all(60);
        EXPECT_STATUS(locus_graph_get_box(g.get(), nullptr, all.data(), 60), LOCUS_OK);
        for (float &value : all)
            if (std::isnan(value))
                value = -1;
        return all;
    };
    const auto before = whole();
    values[11] = 1e20f;
    EXPECT_FAILS(locus_graph_set_box(g.get(), &box, values.data()), LOCUS_E_RANGE,
                 "of voxel 53 needs weights of up to");
    EXPECT_FAILS(locus_graph_fill_box(g.get(), &box, 1e-20f), LOCUS_E_RANGE, "too small for the scale");
    const uint64_t places[3] = {0, 7, 60};
    EXPECT_FAILS(locus_graph_set_voxels(g.get(), places, values.data(), 3), LOCUS_E_ARGUMENT, "voxels[2] is 60");
    const locus_voxel_box outside{{1, 1, 1}, {5, 2, 2}};
    EXPECT_FAILS(locus_graph_fill_box(g.get(), &outside, 1), LOCUS_E_ARGUMENT, "extent[0] is 5");
    const locus_voxel_box wrapping{{1, 1, 1}, {UINT64_MAX, 2, 2}};
    EXPECT_FAILS(locus_graph_fill_box(g.get(), &wrapping, 1), LOCUS_E_ARGUMENT, "extent[0]");
    const locus_voxel_box none{{1, 1, 1}, {1, 0, 2}};
    EXPECT_FAILS(locus_graph_fill_box(g.get(), &none, 1), LOCUS_E_ARGUMENT, "extent[1] is 0");
    EXPECT_EQ(whole(), before);

    const uint64_t twice[3] = {4, 9, 4};
    const float later[3] = {2, air, 3};
    EXPECT_STATUS(locus_graph_set_voxels(g.get(), twice, later, 3), LOCUS_OK);
    EXPECT_EQ(whole()[4], 3);
    EXPECT_EQ(whole()[9], -1);
    EXPECT_STATUS(locus_graph_set_voxels(g.get(), nullptr, nullptr, 0), LOCUS_OK);
    EXPECT_EQ(info(g).scale, scale);
    EXPECT_FAILS(locus_graph_set_box(g.get(), nullptr, later), LOCUS_E_ARGUMENT, "box is NULL");
    EXPECT_FAILS(locus_graph_set_box(g.get(), &box, nullptr), LOCUS_E_ARGUMENT, "values is NULL");
    uint64_t steps = 0;
    EXPECT_FAILS(locus_graph_edge_weight(g.get(), 0, 60, &steps), LOCUS_E_ARGUMENT, "v is 60");
}

TEST(Edits, BoxByBoxFillAnEmptyGraph) {
    auto o = options(6, 5, 4);
    std::mt19937 random(5);
    std::vector<float> material(120);
    for (float &value : material)
        value = random() % 6 == 0 ? air : static_cast<float>(1 + random() % 100) / 10;
    o.material_min = 0.1;
    o.material_max = 10;
    const Graph whole = graph(o, material);
    const Graph parts = graph(o, {});
    EXPECT_EQ(info(parts).passable, 0u);
    for (uint64_t z = 0; z < 4; ++z) {
        const locus_voxel_box slice{{0, 0, z}, {6, 5, 1}};
        EXPECT_STATUS(locus_graph_set_box(parts.get(), &slice, material.data() + 30 * z), LOCUS_OK);
    }
    EXPECT_EQ(info(parts).scale, info(whole).scale);
    EXPECT_EQ(info(parts).word_bits, info(whole).word_bits);
    EXPECT_EQ(info(parts).passable, info(whole).passable);
    EXPECT_EQ(info(parts).overflow_free, 1u);
    for (uint64_t u = 0; u < 120; ++u)
        for (uint64_t v = u; v < 120; ++v)
            ASSERT_EQ(weight(whole, u, v), weight(parts, u, v));
}

TEST(CallersWeights, AreAskedOncePerPairLowerIndexFirst) {
    struct Seen {
        bool ordered = true;
        double factor = 1;
    } seen;
    auto o = options(5, 5, 1);
    o.weight_rule = LOCUS_WEIGHT_CALLER;
    o.weight = [](uint64_t u, uint64_t v, double length, void *user) {
        auto &s = *static_cast<Seen *>(user);
        s.ordered = s.ordered && u < v;
        if (u == 6 || v == 6)
            return -1.0; // no edge
        if (u == 0 && v == 1)
            return std::nan("");
        return s.factor * length * static_cast<double>(1 + v);
    };
    o.weight_user = &seen;
    const Graph g = uniform_graph(o, 5);
    EXPECT_TRUE(seen.ordered);
    EXPECT_EQ(weight(g, 6, 7), 0u);
    EXPECT_EQ(weight(g, 1, 0), 0u);
    const auto about = info(g);
    EXPECT_NEAR(static_cast<double>(weight(g, 8, 9)), about.scale * 10, 0.5 + about.scale * 10 * about.weight_error);
    EXPECT_EQ(weight(g, 9, 8), weight(g, 8, 9));
    const Diagram d = diagram(g, {{0, 0, 0, 0, 4, 0}});
    solve(d);
    EXPECT_TRUE(seen.ordered);
    EXPECT_EQ(labels(d, 25)[6], LOCUS_NO_SEED);
    seen.factor = 1e9; // beyond the range the graph was made for
    EXPECT_FAILS(locus_diagram_solve(d.get(), nullptr, nullptr), LOCUS_E_RANGE, "the weight function gives");
    uint32_t label = 0;
    const locus_voxel_box one{{0, 0, 0}, {1, 1, 1}};
    EXPECT_STATUS(locus_diagram_labels(d.get(), &one, &label, 1), LOCUS_E_STATE);
    seen.factor = 1;
    solve(d);
}

} // namespace
