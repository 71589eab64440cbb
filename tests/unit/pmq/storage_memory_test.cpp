// Every allocation of every call on files fails in turn: nothing is lost, no file is half written, and the same call
// works afterwards.
#include "tests/unit/pmq/failing_memory.hpp"
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include <functional>

namespace locus::test {
namespace {

class StorageMemory : public testing::TestWithParam<LayoutChoice> {
protected:
    StorageMemory() {
        options = default_options();
        GetParam().apply(options);
        options.horizon = 5000;
        options.max_records = 200; // the log is told afterwards what left
    }

    // Call until no allocation fails; before that, nothing may have happened.
    void insist(const std::function<locus_status()> &call, const std::function<bool()> &unchanged) {
        for (size_t after = 0;; ++after) {
            locus_status status = LOCUS_OK;
            bool failed = false;
            {
                FailingMemory failing(after);
                status = call();
                failed = failing.failed();
            }
            if (status == LOCUS_OK)
                return;
            ASSERT_EQ(status, LOCUS_E_MEMORY) << locus_last_error();
            ASSERT_TRUE(failed) << locus_last_error();
            ASSERT_TRUE(unchanged()) << "allocation " << after;
            ++failures;
        }
    }
    Content content(const locus_pmq *pmq) const { return content_of(pmq, options.record); }

    locus_pmq_options options{};
    Scratch scratch;
    size_t failures = 0;
};

TEST_P(StorageMemory, SaveAndLoadFailWithoutATrace) {
    locus_pmq *made = nullptr;
    ASSERT_EQ(locus_pmq_create(&options, &made), LOCUS_OK);
    const StoreHandle pmq(made);
    Changes changes(31);
    const auto batch = changes.batch(150);
    ASSERT_EQ(locus_pmq_insert(made, batch.data(), batch.size() / options.record, changes.now), LOCUS_OK);
    const std::string path = scratch / "saved";
    const FileBytes old{'o', 'l', 'd'};
    write_file(path, old);
    insist([&] { return locus_pmq_save(made, nullptr, path.c_str(), nullptr, nullptr); },
           [&] { return file_bytes(path) == old && scratch.entries() == 1; });
    locus_pmq *loaded = nullptr;
    insist([&] { return locus_pmq_load(path.c_str(), &options, nullptr, nullptr, &loaded); },
           [&] { return loaded == nullptr; });
    const StoreHandle owner(loaded);
    EXPECT_EQ(content(loaded), content(made));
    EXPECT_GT(failures, 15u);
}

TEST_P(StorageMemory, LoggedChangesFailWithoutATrace) {
    const std::string folder = scratch / "store";
    const locus_pmq_log_options log = log_options();
    Changes changes(32);
    locus_pmq *pmq = nullptr;
    const auto open = [&] {
        insist([&] { return locus_pmq_open(folder.c_str(), &options, &log, nullptr, nullptr, nullptr, &pmq); },
               [&] { return pmq == nullptr; });
    };
    open();
    for (int i = 0; i < 12 && !HasFailure(); ++i) {
        SCOPED_TRACE(i);
        const Content before = content(pmq);
        const auto unchanged = [&] { return locus_pmq_check(pmq) == LOCUS_OK && content(pmq) == before; };
        const auto batch = changes.batch(60);
        const size_t count = batch.size() / options.record;
        changes.now += 100;
        // A log that could not be told of what left has stopped: a checkpoint makes up for it.
        const auto insert = [&] {
            const locus_status status = locus_pmq_insert(pmq, batch.data(), count, changes.now);
            locus_pmq_log_stats stats{};
            stats.struct_size = sizeof stats;
            locus_pmq_get_log_stats(pmq, &stats);
            if (stats.stopped == 0)
                return status;
            EXPECT_EQ(status, LOCUS_E_IO);
            return locus_pmq_checkpoint(pmq, nullptr, nullptr);
        };
        insist(insert, unchanged);
        if (i % 3 == 0) {
            const locus_pmq_query query = box_query(changes.draw.box());
            const Content present = content(pmq);
            insist([&] { return locus_pmq_erase(pmq, &query, nullptr); }, [&] { return content(pmq) == present; });
        }
        // Where there was no memory for it, the limit has been put off; recovery holds it.
        ASSERT_EQ(locus_pmq_sweep(pmq, changes.now, nullptr), LOCUS_OK) << locus_last_error();
        const Content after = content(pmq);
        if (i % 4 == 2)
            insist([&] { return locus_pmq_checkpoint(pmq, nullptr, nullptr); }, [&] { return content(pmq) == after; });
        locus_pmq_destroy(pmq);
        pmq = nullptr;
        open();
        ASSERT_EQ(content(pmq), after);
    }
    locus_pmq_destroy(pmq);
    EXPECT_GT(failures, 500u);
}

INSTANTIATE_TEST_SUITE_P(Layouts, StorageMemory, testing::ValuesIn(layouts),
                         [](const auto &instance) { return instance.param.name; });

} // namespace
} // namespace locus::test
