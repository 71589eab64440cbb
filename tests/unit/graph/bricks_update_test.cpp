// Updates against fresh solves: after any sequence of edits of materials, cuts and seeds the words must be the same,
// bit for bit, and the reported change exact.
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;

// A graph, its sources and an engine that follows them.
class Edited {
public:
    Edited(locus_graph_options options, const std::vector<float> &materials, uint32_t seed, uint32_t engine,
           double cutoff_steps)
        : random_(seed), graph_(options, materials.data()), engine_(make_engine(engine)) {
        if (cutoff_steps > 0)
            cutoff_ = static_cast<uint64_t>(cutoff_steps * static_cast<double>(graph_.smallest_weight()));
        for (uint32_t label = 0; label < 6; ++label)
            add_source(label);
        engine_->solve(problem(), words_, progress_);
    }

    // One to three random edits, then an update.
    void step(const std::string &what) {
        for (uint32_t edits = 1 + draw(3); edits > 0; --edits)
            edit();
        const std::vector<uint64_t> before = wide(words_);
        Change change;
        engine_->update(problem(), words_, progress_, change);
        const std::vector<uint64_t> expected = solve(LOCUS_ENGINE_HEAP, problem());
        ASSERT_EQ(wide(words_), expected) << what;
        expect_change(graph_, change, before, expected, what);
    }

private:
    uint32_t draw(uint64_t below) { return static_cast<uint32_t>(random_() % below); }
    Problem problem() const { return {graph_, sources_, cutoff_}; }

    void add_source(uint32_t label) {
        for (uint32_t tries = 0; tries < 1000; ++tries) {
            const uint64_t voxel = random_() % graph_.grid().voxels();
            if (!graph_.passable(voxel))
                continue;
            sources_.push_back({voxel, label % 2 == 0 ? 0 : random_() % (4 * graph_.smallest_weight()), label});
            return;
        }
    }

    Box random_box(uint64_t most) {
        Box box{};
        for (size_t axis = 0; axis < 3; ++axis) {
            box.origin[axis] = draw(graph_.grid().dims()[axis]);
            box.extent[axis] = 1 + draw(std::min(most, graph_.grid().dims()[axis] - box.origin[axis]));
        }
        return box;
    }

    void edit() {
        switch (draw(6)) {
        case 0: // cut out, stiffen, soften or refill a box
        case 1: {
            const float fillings[] = {impassable, 0.3f, 1.0f, 5.5f};
            graph_.fill_box(random_box(10), fillings[draw(4)]);
            break;
        }
        case 2: { // single voxels
            std::vector<uint64_t> voxels;
            std::vector<float> values;
            for (int i = 0; i < 20; ++i) {
                voxels.push_back(random_() % graph_.grid().voxels());
                values.push_back(draw(3) == 0 ? impassable : 0.3f + static_cast<float>(draw(5)));
            }
            graph_.set_voxels(voxels, values.data());
            break;
        }
        case 3: { // cut edges
            std::vector<uint64_t> voxels;
            std::vector<uint16_t> masks;
            for (int i = 0; i < 30; ++i) {
                voxels.push_back(random_() % graph_.grid().voxels());
                masks.push_back(static_cast<uint16_t>(random_() & 0x1FFF));
            }
            graph_.cut_edges(voxels, masks);
            break;
        }
        case 4: // move a seed, or take one away and let another come
            if (sources_.size() > 1)
                sources_.erase(sources_.begin() + draw(sources_.size()));
            add_source(draw(60));
            break;
        case 5:
            if (sources_.size() > 3)
                sources_.pop_back();
            break;
        }
        std::erase_if(sources_, [&](const Source &source) { return !graph_.passable(source.voxel); });
        if (sources_.empty())
            add_source(1);
    }

    std::mt19937_64 random_;
    Graph graph_;
    std::unique_ptr<Engine> engine_;
    std::vector<Source> sources_;
    uint64_t cutoff_ = UINT64_MAX;
    Words words_;
    locus::Progress progress_;
};

locus_graph_options editable(uint64_t nx, uint64_t ny, uint64_t nz, uint32_t word) {
    auto options = options_for(nx, ny, nz);
    options.word_bits = word;
    options.max_seeds = 64;
    options.precision = 1.0 / 2;
    options.material_min = 0.25;
    options.material_max = 6;
    return options;
}

void follow(const locus_graph_options &options, uint32_t seed, uint32_t engine, double cutoff_steps, int steps) {
    const std::string what = "seed " + std::to_string(seed) + ", rule " + std::to_string(options.weight_rule) +
                             ", simd " + std::to_string(options.simd);
    const uint64_t voxels = options.dims[0] * options.dims[1] * options.dims[2];
    Edited edited(options, random_materials(voxels, 0.3, 5.5, 0.15, seed), seed, engine, cutoff_steps);
    for (int step = 0; step < steps && !testing::Test::HasFailure(); ++step)
        edited.step(what + ", step " + std::to_string(step));
}

TEST(BricksUpdate, EqualsAFreshSolveAfterRandomEdits) {
    uint32_t seed = 0;
    for (const uint32_t word : {32u, 64u})
        for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule)
            for (const uint32_t simd : {1u, 2u, 3u, 4u, 5u}) {
                if (!locus::simd_available(static_cast<locus::Simd>(simd)))
                    continue;
                auto options = editable(31, 18, 17, word);
                options.weight_rule = rule;
                options.simd = simd;
                options.threads = 1 + ++seed % 3;
                if (seed % 2 == 0)
                    options.spacing[2] = 1.7;
                options.connectivity = seed % 3 == 0 ? 6 : seed % 3 == 1 ? 18 : 26;
                follow(options, seed, LOCUS_ENGINE_BRICKS, 0, 12);
            }
}

TEST(BricksUpdate, EqualsAFreshSolveOnThinGridsAndWithACutoff) {
    uint32_t seed = 100;
    for (const auto &shape :
         {std::array{1, 60, 50}, std::array{70, 1, 30}, std::array{60, 40, 1}, std::array{15, 9, 9}})
        for (const double cutoff : {0.0, 9.0}) {
            auto options = editable(static_cast<uint64_t>(shape[0]), static_cast<uint64_t>(shape[1]),
                                    static_cast<uint64_t>(shape[2]), ++seed % 2 == 0 ? 32 : 64);
            options.threads = 2;
            follow(options, seed, LOCUS_ENGINE_BRICKS, cutoff, 25);
        }
}

TEST(BricksUpdate, EqualsAFreshSolveOnManyBricksAndThreads) {
    auto options = editable(90, 60, 60, 32);
    options.threads = 3;
    follow(options, 7, LOCUS_ENGINE_BRICKS, 0, 8);
}

TEST(EngineUpdate, OfEveryOtherEngineSolvesAndCompares) {
    for (const uint32_t engine : {LOCUS_ENGINE_HEAP, LOCUS_ENGINE_BUCKET, LOCUS_ENGINE_RELAX})
        follow(editable(11, 9, 8, 32), engine, engine, 0, 5);
}

} // namespace
