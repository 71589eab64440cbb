// Results that stay on the emulated device: what an update changed, fetching them, reading them into the device's
// memory, and what is left after failures.
#include "graph/device/engine.hpp"
#include "tests/emulated/device.hpp"
#include "tests/unit/graph/support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace locus::graph;
using namespace locus::graph::test;
namespace device = locus::device;
namespace emulated = locus::device::emulated;

class Kept {
public:
    Kept(uint32_t word, uint32_t seed) : random_(seed), graph_(options(word, seed), materials(seed).data()) {
        for (uint32_t label = 0; label < 5; ++label)
            add_source(label);
    }

    Problem problem() const { return {graph_, sources_, cutoff_, false, anew_}; }
    Engine &engine() { return *engine_; }
    const Graph &graph() const { return graph_; }
    std::vector<uint64_t> expected() const { return ::locus::graph::test::solve(LOCUS_ENGINE_HEAP, problem()); }
    std::vector<uint64_t> fetched() {
        Words words;
        engine_->fetch(words);
        return wide(words);
    }

    Report solve() {
        Words words;
        const Report report = engine_->solve(problem(), words, progress_);
        EXPECT_TRUE(has_memory_gone(words));
        anew_ = false;
        return report;
    }
    Report update(Change &change) {
        Words words;
        const Report report = engine_->update(problem(), words, progress_, change);
        EXPECT_TRUE(has_memory_gone(words));
        anew_ = false;
        return report;
    }
    void be_anew() { anew_ = true; }

    void edit() {
        Box box{};
        for (size_t a = 0; a < 3; ++a) {
            box.origin[a] = random_() % graph_.grid().dims()[a];
            box.extent[a] = 1 + random_() % std::min<uint64_t>(7, graph_.grid().dims()[a] - box.origin[a]);
        }
        graph_.fill_box(box, random_() % 3 == 0 ? impassable : 0.5f + static_cast<float>(random_() % 5));
        if (random_() % 3 == 0) {
            sources_.erase(sources_.begin());
            add_source(static_cast<uint32_t>(5 + random_() % 50));
        }
        std::erase_if(sources_, [&](const Source &source) { return !graph_.passable(source.voxel); });
        if (sources_.empty())
            add_source(1);
    }
    // So much that no journal holds it.
    void edit_beyond_the_journal() {
        std::vector<uint64_t> voxels;
        std::vector<float> values;
        for (uint64_t i = 0; i < 66000; ++i) { // runs of two are one box, so none are
            voxels.push_back(i * 2 % graph_.grid().voxels());
            values.push_back(2);
        }
        graph_.set_voxels(voxels, values.data());
    }

private:
    static locus_graph_options options(uint32_t word, uint32_t seed) {
        auto options = options_for(23, 17, 18);
        options.word_bits = word;
        options.max_seeds = 64;
        options.precision = 1.0 / 2;
        options.material_min = 0.25;
        options.material_max = 6;
        options.threads = 1;
        options.weight_rule = seed % 4;
        return options;
    }
    static std::vector<float> materials(uint32_t seed) { return random_materials(23 * 17 * 18, 0.5, 5.5, 0.2, seed); }
    void add_source(uint32_t label) {
        for (;;) {
            const uint64_t voxel = random_() % graph_.grid().voxels();
            if (graph_.passable(voxel))
                return sources_.push_back({voxel, label % 2, label});
        }
    }

    std::mt19937_64 random_;
    Graph graph_;
    std::unique_ptr<Engine> engine_ = device::make_engine(emulated::table(), LOCUS_ENGINE_BRICKS, {}, nullptr, true);
    std::vector<Source> sources_;
    uint64_t cutoff_ = UINT64_MAX;
    bool anew_ = true;
    locus::Progress progress_;
};

void expect_kept(const Kept &kept, const Report &report, const std::vector<uint64_t> &words, const std::string &what) {
    const auto &layout = kept.graph().layout();
    uint64_t reached = 0, largest = 0;
    for (const uint64_t word : words)
        if (layout.reached(word)) {
            ++reached;
            largest = std::max(largest, layout.distance(word));
        }
    ASSERT_TRUE(report.kept) << what;
    EXPECT_EQ(report.kept->reached, reached) << what;
    EXPECT_EQ(report.kept->max_exact, largest) << what;
    EXPECT_EQ(report.clipped, reached < kept.graph().passable_voxels()) << what;
}

TEST(CudaKept, UpdatesTellWhatChangedAndBringNothing) {
    for (const uint32_t word : {32u, 64u})
        for (uint32_t seed = 0; seed < 4; ++seed) {
            Kept kept(word, seed);
            ++emulated::settings().seed;
            std::vector<uint64_t> before(kept.graph().grid().voxels(), kept.graph().layout().unreached());
            if (seed % 2 == 0) { // else the first one is an update
                expect_kept(kept, kept.solve(), kept.expected(), "solve");
                before = kept.expected();
            }
            for (int step = 0; step < 8 && !testing::Test::HasFailure(); ++step) {
                const std::string what =
                    std::to_string(word) + " bits, seed " + std::to_string(seed) + ", step " + std::to_string(step);
                kept.edit();
                if (step == 3) { // a solve between updates
                    expect_kept(kept, kept.solve(), kept.expected(), what);
                    before = kept.expected();
                    kept.edit();
                }
                if (step == 5)
                    kept.edit_beyond_the_journal();
                if (step == 6) {
                    kept.be_anew();
                    before.assign(before.size(), kept.graph().layout().unreached());
                }
                const uint64_t moved = emulated::counters().downloaded;
                Change change;
                const Report report = kept.update(change);
                EXPECT_LT(emulated::counters().downloaded - moved, 4000u) << what;
                const std::vector<uint64_t> after = kept.expected();
                expect_kept(kept, report, after, what);
                expect_change(kept.graph(), change, before, after, what);
                if (step % 2 == 0) {
                    EXPECT_EQ(kept.fetched(), after) << what;
                }
                before = after;
            }
        }
}

TEST(CudaKept, AreLookedAtByThreadsAtTheSameTime) {
    const emulated::KeepSettings keep;
    emulated::settings().lanes = 3;
    emulated::settings().threads = emulated::settings().blocks = 2;
    Kept kept(32, 8);
    kept.solve();
    const std::vector<uint64_t> before = kept.expected();
    kept.edit();
    Change change;
    expect_kept(kept, kept.update(change), kept.expected(), "threads");
    expect_change(kept.graph(), change, before, kept.expected(), "threads");
}

template <typename T, typename Value>
void expect_read(Kept &kept, Told told, const Box &box, const std::vector<uint32_t> &ids, Value &&value) {
    const std::vector<uint64_t> words = kept.expected();
    std::vector<T> expected, found(box.extent[0] * box.extent[1] * box.extent[2]);
    for_each_voxel(kept.graph().grid(), box,
                   [&](uint64_t voxel, uint64_t) { expected.push_back(value(words[voxel])); });
    kept.engine().write({told, box, ids, kept.graph().scale()}, found.data());
    EXPECT_EQ(found, expected);
}

void expect_reads(Kept &kept, const Box &box, const std::vector<uint32_t> &ids) {
    const auto &layout = kept.graph().layout();
    expect_read<uint32_t>(kept, Told::ids, box, ids, [&](uint64_t word) {
        return layout.reached(word) ? ids[layout.label(word)] : LOCUS_NO_SEED;
    });
    expect_read<float>(kept, Told::distances, box, ids, [&](uint64_t word) {
        return layout.reached(word)
                   ? static_cast<float>(static_cast<double>(layout.distance(word)) / kept.graph().scale())
                   : std::numeric_limits<float>::infinity();
    });
    expect_read<uint64_t>(kept, Told::exact_distances, box, ids,
                          [&](uint64_t word) { return layout.reached(word) ? layout.distance(word) : UINT64_MAX; });
}

TEST(CudaKept, AreReadIntoTheDevicesMemory) {
    std::vector<uint32_t> ids;
    for (uint32_t label = 0; label < 64; ++label)
        ids.push_back(1000 - label);
    for (const uint32_t word : {32u, 64u})
        for (uint32_t seed = 0; seed < 4; ++seed) {
            Kept kept(word, seed);
            kept.solve();
            for (const Box &box :
                 {kept.graph().grid().whole(), Box{{3, 0, 9}, {11, 17, 2}}, Box{{22, 16, 17}, {1, 1, 1}}})
                expect_reads(kept, box, ids);
            std::reverse(ids.begin(), ids.end()); // those of a result do not change, those of the next may
            kept.solve();
            expect_reads(kept, kept.graph().grid().whole(), ids);
        }
}

// Run call() with its first call of the device failing, then a later one, until none does; failed() after each.
template <typename Call, typename Failed>
void fail_each(Call &&call, Failed &&failed) {
    bool again = true;
    for (int64_t calls = 0; again && !testing::Test::HasFailure(); calls += 1 + calls / 8) {
        emulated::settings().calls_left = calls;
        again = false;
        try {
            call();
        } catch (const locus::Error &error) {
            again = true;
            EXPECT_EQ(error.status(), LOCUS_E_DEVICE);
        }
        emulated::settings().calls_left = -1;
        if (again)
            failed();
    }
}

TEST(CudaKept, LoseNothingWhenAReadFails) {
    const emulated::KeepSettings keep;
    emulated::settings().failure = LOCUS_E_DEVICE;
    Kept kept(32, 1);
    kept.solve();
    const std::vector<uint32_t> ids(64, 7);
    const std::vector<uint64_t> expected = kept.expected();
    Words words;
    const auto intact = [&] { EXPECT_EQ(kept.fetched(), expected); };
    fail_each([&] { kept.engine().fetch(words); }, intact);
    EXPECT_EQ(wide(words), expected);
    std::vector<uint32_t> labels(expected.size());
    fail_each([&] { kept.engine().write({Told::ids, kept.graph().grid().whole(), ids, 1}, labels.data()); }, intact);
    expect_reads(kept, kept.graph().grid().whole(), ids);
}

TEST(CudaKept, BeginAnewAfterASolveOrUpdateFails) {
    const emulated::KeepSettings keep;
    emulated::settings().failure = LOCUS_E_DEVICE;
    Kept kept(64, 2);
    const auto begin = [&] {
        EXPECT_EQ(emulated::counters().allocated, 0u);
        Words words;
        EXPECT_THROW(kept.engine().fetch(words), locus::Error);
        kept.be_anew();
        kept.solve();
        EXPECT_EQ(kept.fetched(), kept.expected());
        kept.edit();
    };
    kept.solve();
    Change change;
    fail_each([&] { kept.update(change); }, begin);
    EXPECT_EQ(kept.fetched(), kept.expected());
}

TEST(CudaKept, AreNotThereOnOtherEngines) {
    const Graph graph(options_for(3, 3, 3), std::vector<float>(27, 1.0f).data());
    const Source source{0, 0, 0};
    const std::vector<uint32_t> ids{5};
    std::vector<uint32_t> labels(27);
    Words words;
    locus::Progress progress;
    const auto relax = device::make_engine(emulated::table(), LOCUS_ENGINE_RELAX, {}, nullptr, true);
    EXPECT_FALSE(relax->solve({graph, {&source, 1}}, words, progress).kept);
    EXPECT_EQ(wide(words).size(), 27u);
    EXPECT_THROW(relax->write({Told::ids, graph.grid().whole(), ids, 1}, labels.data()), locus::Error);
    const auto heap = make_engine(LOCUS_ENGINE_HEAP);
    heap->solve({graph, {&source, 1}}, words, progress);
    EXPECT_THROW(heap->write({Told::ids, graph.grid().whole(), ids, 1}, labels.data()), locus::Error);
}

} // namespace
