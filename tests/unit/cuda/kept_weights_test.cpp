// Sibson's rows from what an engine of the emulated device keeps of its latest solve, against those of the CPU.
#include "graph/device/engine.hpp"
#include "graph/weights/natural.hpp"
#include "tests/emulated/device.hpp"
#include "tests/unit/weights/fields.hpp"

#include <locus/weights.h>

#include <gtest/gtest.h>

namespace locus::graph {
namespace {

namespace emulated = device::emulated;

const std::pair<uint32_t, device::Grain> forms[] = {
    {LOCUS_ENGINE_BRICKS, {}}, {LOCUS_ENGINE_RELAX, {}}, {LOCUS_ENGINE_COMPACT, {4, 2, 1}}};

class Kept {
public:
    Kept(const locus_graph_options &options, uint32_t engine, const device::Grain &grain = {}, uint64_t step = 61)
        : graph_(options, noise(options.dims[0] * options.dims[1] * options.dims[2], 3, 0.1).data()),
          engine_(device::make_engine(emulated::table(), engine, grain, nullptr)) {
        move_sources(5);
        solve();
        for (uint64_t v = 0; v < graph_.grid().voxels(); v += step)
            voxels_.push_back(v);
    }

    Graph &graph() { return graph_; }
    void move_sources(uint32_t random) {
        std::mt19937 rng(random);
        sources_.clear();
        while (sources_.size() < 6) {
            const uint64_t voxel = rng() % graph_.grid().voxels();
            if (graph_.passable(voxel))
                sources_.push_back({voxel, 0, static_cast<uint32_t>(sources_.size())});
        }
    }
    void solve() { engine_->solve({graph_, sources_}, words_, progress_); }
    void update() {
        Change change;
        engine_->update({graph_, sources_}, words_, progress_, change);
    }

    bool rows(Rows &rows, Progress &progress) {
        const Field field(graph_, words_);
        std::vector<RowPile> piles;
        if (!engine_->natural_rows(job(field), piles, progress))
            return false;
        rows = assemble(voxels_.size(), piles);
        return true;
    }
    void expect_cpus_rows(const char *when) {
        const Field field(graph_, words_);
        const Rows expected = assemble(voxels_.size(), natural_rows(job(field), progress_));
        Rows found;
        ASSERT_TRUE(rows(found, progress_));
        for (uint64_t i = 0; i < voxels_.size(); ++i)
            ASSERT_TRUE(std::ranges::equal(found.row(i), expected.row(i))) << "voxel " << voxels_[i] << ", " << when;
    }

private:
    NaturalJob job(const Field &field) const {
        return {field, LOCUS_METHOD_SIBSON, 0, uint64_t{1} << 30, 1, Simd::scalar, voxels_, {}};
    }

    Graph graph_;
    std::unique_ptr<Engine> engine_;
    std::vector<Source> sources_;
    std::vector<uint64_t> voxels_;
    Words words_;
    Progress progress_;
};

TEST(CudaKeptWeights, FollowSolvesUpdatesAndEdits) {
    for (const auto &[engine, grain] : forms)
        for (const locus_graph_options &options : both_widths(options_for(19, 14, 11))) {
            auto wide = options;
            wide.material_min = 0.5;
            wide.material_max = 20;
            Kept kept(wide, engine, grain);
            kept.expect_cpus_rows("solved");
            kept.move_sources(8);
            kept.solve();
            kept.expect_cpus_rows("solved again");
            const Box box{{3, 2, 1}, {9, 8, 7}};
            kept.graph().fill_box(box, 15);
            kept.update();
            kept.expect_cpus_rows("updated");
            std::vector<uint64_t> voxels;
            for (uint64_t v = 100; v < 1500; ++v)
                voxels.push_back(v);
            kept.graph().cut_edges(voxels, std::vector<uint16_t>(voxels.size(), 0x0F0F));
            kept.update();
            kept.expect_cpus_rows("cut");
            kept.move_sources(9);
            kept.update();
            kept.expect_cpus_rows("moved");
        }
}

// The bricks' own words; what the others' solves leave behind is copied once.
TEST(CudaKeptWeights, CopyNoFieldThatIsThere) {
    for (const auto &[engine, grain] : forms) {
        Kept kept(options_for(30, 30, 30), engine, grain, 2999);
        const uint64_t few = 30 * 30 * 30, before = emulated::counters().uploaded;
        kept.expect_cpus_rows("first");
        const uint64_t first = emulated::counters().uploaded - before;
        EXPECT_EQ(first < few, engine == LOCUS_ENGINE_BRICKS);
        kept.expect_cpus_rows("second");
        EXPECT_LT(emulated::counters().uploaded - before - first, few);
    }
}

TEST(CudaKeptWeights, AreThereAgainAfterAnyFailure) {
    for (const int32_t failure : {LOCUS_E_DEVICE, LOCUS_E_MEMORY})
        for (const auto &[engine, grain] : forms) {
            const emulated::KeepSettings keep;
            Kept kept(options_for(12, 10, 8), engine, grain);
            Progress progress;
            bool failed = true;
            for (int64_t calls = 0; failed; ++calls) {
                emulated::settings().calls_left = calls;
                emulated::settings().failure = failure;
                failed = false;
                try {
                    Rows rows;
                    kept.rows(rows, progress);
                } catch (const Error &error) {
                    failed = true;
                    EXPECT_EQ(error.status(), failure);
                }
                emulated::settings().calls_left = -1;
                kept.expect_cpus_rows("after a failure");
                kept.solve();
            }
        }
    EXPECT_EQ(emulated::counters().allocated, 0u);
}

// Rows asked for while others are made: the caller has to find another way.
TEST(CudaKeptWeights, AreMadeForOneCallAtATime) {
    Kept kept(options_for(12, 10, 8), LOCUS_ENGINE_BRICKS);
    struct Seen {
        Kept &kept;
        int calls = 0, refused = 0;
    } seen{kept};
    Progress progress(
        [](double, void *user) {
            auto &seen = *static_cast<Seen *>(user);
            Progress quiet;
            Rows rows;
            ++seen.calls;
            seen.refused += seen.kept.rows(rows, quiet) ? 0 : 1;
            return 0;
        },
        &seen);
    Rows rows;
    EXPECT_TRUE(kept.rows(rows, progress));
    EXPECT_GT(seen.calls, 0);
    EXPECT_EQ(seen.refused, seen.calls);
    kept.expect_cpus_rows("afterwards");
}

TEST(CudaKeptWeights, AreLetGoWhenTheCallerStops) {
    Kept kept(options_for(12, 10, 8), LOCUS_ENGINE_BRICKS);
    Progress progress([](double, void *) { return 1; }, nullptr);
    Rows rows;
    EXPECT_THROW(kept.rows(rows, progress), Error);
    kept.expect_cpus_rows("after a stop");
}

} // namespace
} // namespace locus::graph
