// Updates on the emulated device against fresh solves by the heap engine, after random edits of materials, cuts and
// seeds; and what is left after failures.
#include "graph/device/engine.hpp"
#include "tests/emulated/device.hpp"
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;
namespace device = locus::device;
namespace emulated = locus::device::emulated;

// A graph, its sources and an engine on the device that follows them.
class Edited {
public:
    Edited(const locus_graph_options &options, uint32_t seed, uint64_t cutoff_steps)
        : random_(seed),
          graph_(options,
                 random_materials(options.dims[0] * options.dims[1] * options.dims[2], 0.3, 5.5, 0.15, seed).data()),
          engine_(device::make_engine(emulated::table(), LOCUS_ENGINE_BRICKS, {}, nullptr)) {
        if (cutoff_steps > 0)
            cutoff_ = cutoff_steps * graph_.smallest_weight();
        for (uint32_t label = 0; label < 6; ++label)
            add_source(label);
        engine_->solve(problem(), words_, progress_);
    }

    Problem problem() const { return {graph_, sources_, cutoff_}; }
    Engine &engine() { return *engine_; }
    Words &words() { return words_; }
    locus::Progress &progress() { return progress_; }

    // One to three random edits, then an update.
    void step(const std::string &what) {
        for (uint32_t edits = 1 + draw(3); edits > 0; --edits)
            edit();
        const std::vector<uint64_t> before = wide(words_);
        const uint64_t moved = emulated::counters().downloaded;
        Change change;
        engine_->update(problem(), words_, progress_, change);
        downloaded_ = emulated::counters().downloaded - moved;
        const std::vector<uint64_t> expected = solve(LOCUS_ENGINE_HEAP, problem());
        ASSERT_EQ(wide(words_), expected) << what;
        expect_change(graph_, change, before, expected, what);
    }
    uint64_t downloaded() const { return downloaded_; }

    void edit() {
        switch (draw(5)) {
        case 0: { // cut out, stiffen, soften or refill a box
            const float fillings[] = {impassable, 0.3f, 1.0f, 5.5f};
            Box box{};
            for (size_t a = 0; a < 3; ++a) {
                box.origin[a] = draw(graph_.grid().dims()[a]);
                box.extent[a] = 1 + draw(std::min<uint64_t>(10, graph_.grid().dims()[a] - box.origin[a]));
            }
            graph_.fill_box(box, fillings[draw(4)]);
            break;
        }
        case 1: { // single voxels
            for (int i = 0; i < 20; ++i) {
                const uint64_t voxel = random_() % graph_.grid().voxels();
                const float value = draw(3) == 0 ? impassable : 0.3f + static_cast<float>(draw(5));
                graph_.set_voxels({&voxel, 1}, &value);
            }
            break;
        }
        case 2: { // cut edges
            std::vector<uint64_t> voxels;
            std::vector<uint16_t> masks;
            for (int i = 0; i < 30; ++i) {
                voxels.push_back(random_() % graph_.grid().voxels());
                masks.push_back(static_cast<uint16_t>(random_() & 0x1FFF));
            }
            graph_.cut_edges(voxels, masks);
            break;
        }
        case 3: // move a seed
            sources_.erase(sources_.begin() + draw(sources_.size()));
            add_source(draw(60));
            break;
        default: // mend what was cut, and lose a seed
            graph_.mend_edges(graph_.grid().whole());
            if (sources_.size() > 3)
                sources_.pop_back();
        }
        std::erase_if(sources_, [&](const Source &source) { return !graph_.passable(source.voxel); });
        if (sources_.empty())
            add_source(1);
    }

private:
    uint32_t draw(uint64_t below) { return static_cast<uint32_t>(random_() % below); }
    void add_source(uint32_t label) {
        for (uint32_t tries = 0; tries < 1000; ++tries) {
            const uint64_t voxel = random_() % graph_.grid().voxels();
            if (!graph_.passable(voxel))
                continue;
            sources_.push_back({voxel, label % 2 == 0 ? 0 : random_() % (4 * graph_.smallest_weight()), label});
            return;
        }
    }

    std::mt19937_64 random_;
    Graph graph_;
    std::unique_ptr<Engine> engine_;
    std::vector<Source> sources_;
    uint64_t cutoff_ = UINT64_MAX;
    Words words_;
    locus::Progress progress_;
    uint64_t downloaded_ = 0;
};

locus_graph_options editable(uint64_t nx, uint64_t ny, uint64_t nz, uint32_t word) {
    auto options = options_for(nx, ny, nz);
    options.word_bits = word;
    options.max_seeds = 64;
    options.precision = 1.0 / 2;
    options.material_min = 0.25;
    options.material_max = 6;
    options.threads = 1;
    return options;
}

TEST(CudaUpdate, EqualsAFreshSolveAfterRandomEdits) {
    uint32_t seed = 0;
    for (const uint32_t word : {32u, 64u})
        for (uint32_t rule = 0; rule < LOCUS_WEIGHT_CALLER; ++rule)
            for (const uint64_t cutoff : {0u, 9u}) {
                auto options = editable(31, 18, 17, word);
                options.weight_rule = rule;
                options.spacing[2] = ++seed % 2 == 0 ? 1.7 : 1;
                options.connectivity = seed % 3 == 0 ? 6 : seed % 3 == 1 ? 18 : 26;
                ++emulated::settings().seed;
                Edited edited(options, seed, cutoff);
                for (int step = 0; step < 8 && !testing::Test::HasFailure(); ++step)
                    edited.step("seed " + std::to_string(seed) + ", step " + std::to_string(step));
            }
}

TEST(CudaUpdate, EqualsAFreshSolveWithBlocksAtTheSameTime) {
    emulated::settings().threads = 3;
    Edited edited(editable(40, 33, 20, 32), 5, 0);
    for (int step = 0; step < 8 && !testing::Test::HasFailure(); ++step)
        edited.step("step " + std::to_string(step));
    emulated::settings().threads = 1;
}

TEST(CudaUpdate, EqualsAFreshSolveWithThreadsAtTheSameTime) {
    const emulated::KeepSettings keep;
    emulated::settings().lanes = 5;
    emulated::settings().threads = emulated::settings().blocks = 2;
    for (const uint32_t word : {32u, 64u}) {
        Edited edited(editable(17, 9, 8, word), word, 0);
        for (int step = 0; step < 3 && !testing::Test::HasFailure(); ++step)
            edited.step(std::to_string(word) + " bits, step " + std::to_string(step));
    }
}

TEST(CudaUpdate, BringsBackOnlyWhatChanged) {
    auto options = editable(64, 64, 64, 32);
    const std::vector<float> materials(64 * 64 * 64, 1.0f);
    Graph graph(options, materials.data());
    const std::vector<Source> sources = {{0, 0, 0}, {64 * 64 * 64 - 1, 0, 1}};
    const auto engine = device::make_engine(emulated::table(), LOCUS_ENGINE_BRICKS, {}, nullptr);
    Words words;
    locus::Progress progress;
    engine->solve({graph, sources}, words, progress);
    const Box box = {{40, 3, 40}, {2, 2, 2}};
    graph.fill_box(box, impassable);
    emulated::counters().downloaded = emulated::counters().uploaded = 0;
    Change change;
    engine->update({graph, sources}, words, progress, change);
    EXPECT_EQ(wide(words), solve(LOCUS_ENGINE_HEAP, {graph, sources}));
    EXPECT_GT(change.voxels, 7u);
    EXPECT_LT(emulated::counters().downloaded, 64u * 64 * 64 * 4 / 5);
    EXPECT_LT(emulated::counters().uploaded, 64u * 64 * 64 * 4 / 5);
}

// Every call that may fail does, one after the other: the words stay, nothing is kept on the device, and the engine
// works again.
TEST(CudaFailures, LeaveTheWordsAndTheEngineUsable) {
    for (const int32_t failure : {LOCUS_E_DEVICE, LOCUS_E_MEMORY}) {
        emulated::settings().failure = failure;
        bool failed = true;
        for (int64_t calls = 0; failed; calls += 1 + calls / 4) {
            Edited edited(editable(17, 9, 10, 32), 3, 0);
            edited.edit();
            const std::vector<uint64_t> before = wide(edited.words());
            emulated::settings().calls_left = calls;
            failed = false;
            Change change;
            try {
                edited.engine().update(edited.problem(), edited.words(), edited.progress(), change);
            } catch (const locus::Error &error) {
                failed = true;
                EXPECT_EQ(error.status(), failure);
                EXPECT_NE(std::string(error.what()).find("told to fail"), std::string::npos);
            }
            emulated::settings().calls_left = -1;
            if (failed) {
                EXPECT_EQ(wide(edited.words()), before) << calls;
                EXPECT_EQ(emulated::counters().allocated, 0u);
            }
            Words again;
            edited.engine().solve(edited.problem(), again, edited.progress());
            ASSERT_EQ(wide(again), solve(LOCUS_ENGINE_HEAP, edited.problem())) << calls;
        }
    }
    EXPECT_EQ(emulated::counters().allocated, 0u);
}

// A solve writes into the memory of the words that were there, once all else has been got.
TEST(CudaFailures, OfASolveLeaveTheWordsOrNone) {
    const emulated::KeepSettings keep;
    const Graph graph(editable(17, 9, 10, 32), random_materials(17 * 9 * 10, 0.3, 5, 0.1, 2).data());
    const std::vector<Source> one = {{0, 0, 0}}, two = {{0, 0, 0}, {1000, 0, 1}};
    for (const uint32_t kind : {LOCUS_ENGINE_BRICKS, LOCUS_ENGINE_RELAX}) {
        bool failed = true;
        for (int64_t calls = 0; failed; ++calls) {
            const auto engine = device::make_engine(emulated::table(), static_cast<uint32_t>(kind), {}, nullptr);
            Words words;
            locus::Progress progress;
            engine->solve({graph, one}, words, progress);
            const std::vector<uint64_t> before = wide(words);
            const auto *memory = std::get<std::vector<uint32_t>>(words).data();
            emulated::settings().calls_left = calls;
            failed = false;
            try {
                engine->solve({graph, two}, words, progress);
            } catch (const locus::Error &) {
                failed = true;
            }
            emulated::settings().calls_left = -1;
            if (failed) {
                EXPECT_TRUE(has_memory_gone(words) || wide(words) == before) << calls;
                continue;
            }
            EXPECT_EQ(std::get<std::vector<uint32_t>>(words).data(), memory);
            EXPECT_EQ(wide(words), solve(LOCUS_ENGINE_HEAP, {graph, two}));
        }
    }
}

TEST(CudaTransfers, LargeOnesAreCopiedBySeveralThreads) {
    device::Device device(emulated::table());
    for (const size_t count : {size_t{100}, (size_t{9} << 20) / 8 + 1, size_t{3} << 20}) {
        std::vector<uint64_t> values(count), back(count);
        for (size_t i = 0; i < count; ++i)
            values[i] = i * 0x9E3779B97F4A7C15u;
        const auto memory = device.allocate<uint64_t>(count);
        device.upload(memory.get(), std::span<const uint64_t>(values), 3);
        device.download(std::span<uint64_t>(back), memory.get(), 3);
        EXPECT_EQ(values, back);
    }
}

TEST(CudaFailures, OutOfMemoryIsSaid) {
    emulated::settings().memory = 100000;
    const Graph graph(editable(40, 40, 40, 32), std::vector<float>(64000, 1.0f).data());
    const Source source = {0, 0, 0};
    for (const uint32_t kind : {LOCUS_ENGINE_BRICKS, LOCUS_ENGINE_RELAX, LOCUS_ENGINE_COMPACT}) {
        Words words;
        locus::Progress progress;
        const auto engine = device::make_engine(emulated::table(), static_cast<uint32_t>(kind), {8, 1, 1}, nullptr);
        try {
            engine->solve({graph, {&source, 1}}, words, progress);
            FAIL() << "solved without memory";
        } catch (const locus::Error &error) {
            EXPECT_EQ(error.status(), LOCUS_E_MEMORY);
        }
        EXPECT_EQ(emulated::counters().allocated, 0u);
    }
    emulated::settings().memory = UINT64_MAX;
}

TEST(CudaFailures, ASolveThatIsStoppedCanBeginAnew) {
    Edited edited(editable(40, 30, 30, 32), 9, 0);
    locus::Progress stop([](double, void *) -> int32_t { return 1; }, nullptr);
    Words words;
    EXPECT_THROW(edited.engine().solve(edited.problem(), words, stop), locus::Error);
    edited.step("after a stop");
}

} // namespace
