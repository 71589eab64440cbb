// Every call on files of every call of the library fails in turn, as on a disk that is full or broken, or the process
// ends there: what was there stays, and what was acknowledged is there again.
#include "tests/unit/pmq/failing_files.hpp"
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include <atomic>
#include <cerrno>
#include <functional>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace locus::test {
namespace {

namespace fs = std::filesystem;
using Way = FailingFiles::Way;

struct Outcome {
    locus_status status;
    bool failed; // a call on files did
    std::string text;
    bool says(const std::string &words) const { return text.find(words) != std::string::npos; }
};

Outcome refusing(size_t after, int code, const std::function<locus_status()> &call) {
    const FailingFiles failing(after, Way::refused, code);
    const locus_status status = call();
    return {status, failing.failed(), locus_last_error()};
}

// Some thousand records: a saved file of three blocks.
StoreHandle some_store(uint64_t seed = 41) {
    const locus_pmq_options options = default_options();
    Changes changes(seed);
    locus_pmq *pmq = nullptr;
    EXPECT_EQ(locus_pmq_create(&options, &pmq), LOCUS_OK);
    for (size_t records = 0; records < 20'000;) {
        const auto batch = changes.batch(4000);
        records += batch.size() / options.record;
        EXPECT_EQ(locus_pmq_insert(pmq, batch.data(), batch.size() / options.record, changes.now), LOCUS_OK);
    }
    return StoreHandle(pmq);
}

TEST(StorageFaults, SavesThatFailLeaveTheFormerFile) {
    const StoreHandle pmq = some_store();
    const Scratch folder;
    const std::string path = folder / "saved";
    const FileBytes old{'o', 'l', 'd'};
    size_t refused = 0;
    for (size_t after = 0;; ++after) {
        SCOPED_TRACE(after);
        write_file(path, old);
        const Outcome outcome =
            refusing(after, ENOSPC, [&] { return locus_pmq_save(pmq.get(), nullptr, path.c_str(), nullptr, nullptr); });
        EXPECT_EQ(folder.entries(), 1u) << "a temporary file was left";
        if (outcome.status == LOCUS_OK) { // only the folder's entry did not reach the disk, or all went well
            EXPECT_EQ(content_of(load_store(path, nullptr).get(), 32), content_of(pmq.get(), 32));
            if (!outcome.failed)
                break;
            continue;
        }
        ++refused;
        EXPECT_EQ(outcome.status, LOCUS_E_IO);
        EXPECT_TRUE(outcome.says(path) && outcome.says("No space left on device")) << outcome.text;
        EXPECT_EQ(file_bytes(path), old);
    }
    EXPECT_EQ(refused, 8u) << "create, write five times, flush, rename";
}

TEST(StorageFaults, ReadsThatFailMakeNoStore) {
    const StoreHandle pmq = some_store();
    const Scratch folder;
    const std::string path = folder / "saved";
    ASSERT_EQ(locus_pmq_save(pmq.get(), nullptr, path.c_str(), nullptr, nullptr), LOCUS_OK);
    for (size_t after = 0;; ++after) {
        SCOPED_TRACE(after);
        locus_pmq *loaded = nullptr;
        const Outcome outcome =
            refusing(after, EIO, [&] { return locus_pmq_load(path.c_str(), nullptr, nullptr, nullptr, &loaded); });
        const StoreHandle owner(loaded);
        if (!outcome.failed) {
            EXPECT_EQ(content_of(loaded, 32), content_of(pmq.get(), 32));
            EXPECT_GE(after, 5u) << "open, the header, three blocks";
            break;
        }
        EXPECT_EQ(outcome.status, LOCUS_E_IO);
        EXPECT_EQ(loaded, nullptr);
        EXPECT_TRUE(outcome.says(path) && outcome.says("Input/output error")) << outcome.text;
        EXPECT_EQ(outcome.says("cannot read at byte"), after > 0) << outcome.text;
    }
}

constexpr size_t most_live = 150;

locus_pmq_options limited_options() {
    locus_pmq_options options = default_options();
    options.max_records = most_live; // the log is told afterwards what left
    return options;
}

// A life of a store with a log, step by step, each made from its number alone.
locus_status take_step(locus_pmq *pmq, uint64_t number) {
    Changes changes(500 + number);
    changes.now += static_cast<int64_t>(number);
    changes.id = 1000 * number;
    const locus_pmq_query north = box_query({20, -180, 90, 180});
    switch (number % 6) {
    case 2:
        return locus_pmq_erase(pmq, &north, nullptr);
    case 3:
        return locus_pmq_checkpoint(pmq, nullptr, nullptr);
    case 4:
        return locus_pmq_sweep(pmq, changes.now, nullptr);
    default: {
        const auto batch = changes.batch(100);
        return locus_pmq_insert(pmq, batch.data(), batch.size() / 32, changes.now);
    }
    }
}
constexpr uint64_t steps = 12;

// Changes that fail have not happened, and the next attempt works. Where the log has stopped, as behind a flush that
// failed, it says so, and a checkpoint makes it go on.
TEST(StorageFaults, ChangesThatFailHaveNotHappened) {
    const Scratch scratch;
    const std::string folder = scratch / "store", copy = scratch / "copy";
    const locus_pmq_log_options log = log_options(LOCUS_SYNC_BATCH);
    StoreHandle pmq = open_store(folder, default_options(), log);
    size_t refused = 0, stopped = 0;
    for (uint64_t number = 0; number < steps; ++number) {
        for (size_t after = 0;; ++after) {
            SCOPED_TRACE("step " + std::to_string(number) + ", call " + std::to_string(after));
            const Content before = content_of(pmq.get(), 32);
            const Outcome outcome = refusing(after, ENOSPC, [&] { return take_step(pmq.get(), number); });
            if (outcome.status == LOCUS_OK)
                break;
            ++refused;
            ASSERT_TRUE(outcome.failed) << outcome.text;
            ASSERT_EQ(outcome.status, LOCUS_E_IO) << outcome.text;
            ASSERT_TRUE(outcome.says(folder) && outcome.says("No space left on device")) << outcome.text;
            ASSERT_EQ(content_of(pmq.get(), 32), before);
            fs::remove_all(copy);
            fs::copy(folder, copy);
            ASSERT_EQ(content_of(open_store(copy, default_options(), log).get(), 32), before) << "as if killed here";
            locus_pmq_log_stats stats{};
            stats.struct_size = sizeof stats;
            ASSERT_EQ(locus_pmq_get_log_stats(pmq.get(), &stats), LOCUS_OK);
            if (stats.stopped) {
                ++stopped;
                ASSERT_EQ(locus_pmq_sweep(pmq.get(), before.now + 1, nullptr), LOCUS_E_STATE);
                ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
            }
        }
    }
    EXPECT_GT(refused, 20u);
    EXPECT_GE(stopped, steps * 4 / 6) << "each change's flush, if nothing else";
    const Content last = content_of(pmq.get(), 32);
    pmq.reset();
    EXPECT_EQ(content_of(open_store(folder, default_options(), log).get(), 32), last);
}

// An attempt to open or to attach that failed leaves a folder that the next one finds as it was.
TEST(StorageFaults, OpeningThatFailsLosesNothing) {
    const Scratch scratch;
    const std::string folder = scratch / "store", fresh = scratch / "fresh";
    const locus_pmq_log_options log = log_options(LOCUS_SYNC_BATCH);
    StoreHandle pmq = open_store(folder, default_options(), log);
    for (uint64_t number = 0; number < steps; ++number)
        ASSERT_EQ(take_step(pmq.get(), number), LOCUS_OK) << locus_last_error();
    const Content content = content_of(pmq.get(), 32);
    pmq.reset();
    size_t refused = 0;
    for (bool failed = true; failed;) {
        SCOPED_TRACE(refused);
        locus_pmq *opened = nullptr;
        const Outcome outcome = refusing(refused, EIO, [&] {
            return locus_pmq_open(folder.c_str(), nullptr, &log, nullptr, nullptr, nullptr, &opened);
        });
        failed = outcome.failed;
        const StoreHandle owner(opened);
        if (outcome.status == LOCUS_OK) {
            ASSERT_EQ(content_of(opened, 32), content);
            ++refused;
            continue;
        }
        ASSERT_EQ(outcome.status, LOCUS_E_IO) << outcome.text;
        ASSERT_TRUE(outcome.says(folder)) << outcome.text;
        ASSERT_EQ(opened, nullptr);
        ++refused;
    }
    EXPECT_GT(refused, 10u);

    pmq = some_store();
    for (size_t after = 0;; ++after) {
        SCOPED_TRACE(after);
        const Outcome outcome =
            refusing(after, ENOSPC, [&] { return locus_pmq_attach(pmq.get(), fresh.c_str(), &log, nullptr, nullptr); });
        if (outcome.status == LOCUS_OK)
            break;
        ASSERT_EQ(outcome.status, LOCUS_E_IO) << outcome.text;
        ASSERT_TRUE(outcome.says(fresh)) << outcome.text;
        ASSERT_EQ(locus_pmq_sync(pmq.get()), LOCUS_E_STATE) << "it has no log";
    }
    EXPECT_EQ(locus_pmq_sync(pmq.get()), LOCUS_OK);
    const Content attached = content_of(pmq.get(), 32);
    pmq.reset();
    EXPECT_EQ(content_of(open_store(fresh, default_options(), log).get(), 32), attached);
}

// Run in a process of its own, which is killed at a call on files; false: it came to its end.
bool killed_at(size_t after, Way way, const std::function<void()> &work) {
    const pid_t child = fork();
    if (child == 0) {
        const FailingFiles failing(after, way, 0);
        work();
        _exit(0);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) || status == 0) << "the child ended with " << WEXITSTATUS(status);
    return WIFSIGNALED(status);
}

class KilledAtEveryCall : public testing::TestWithParam<Way> {};

TEST_P(KilledAtEveryCall, SavesLeaveTheOldFileOrTheNew) {
    const StoreHandle before = some_store(1), now = some_store(2);
    const Content old_content = content_of(before.get(), 32), new_content = content_of(now.get(), 32);
    const Scratch folder;
    const std::string path = folder / "saved";
    size_t olds = 0, news = 0;
    for (size_t after = 0;; ++after) {
        SCOPED_TRACE(after);
        ASSERT_EQ(locus_pmq_save(before.get(), nullptr, path.c_str(), nullptr, nullptr), LOCUS_OK);
        const bool killed = killed_at(after, GetParam(), [&] {
            if (locus_pmq_save(now.get(), nullptr, path.c_str(), nullptr, nullptr) != LOCUS_OK)
                _exit(1);
        });
        const Content found = content_of(load_store(path, nullptr).get(), 32);
        if (!killed) {
            EXPECT_EQ(found, new_content);
            break;
        }
        ASSERT_TRUE(found == old_content || found == new_content);
        ASSERT_EQ(found == new_content, news > 0 || found != old_content) << "once it is there it stays";
        ++(found == old_content ? olds : news);
    }
    EXPECT_GE(olds, 7u); // create, write five times, flush
    EXPECT_GE(news, 1u);
}

TEST_P(KilledAtEveryCall, FoldersHoldWhatWasAcknowledged) {
    const locus_pmq_options options = limited_options();
    const locus_pmq_log_options log = log_options(LOCUS_SYNC_BATCH);
    std::vector<Content> states{Content{}}; // behind so many calls: opened, then one step after the other
    {
        const Scratch scratch;
        const StoreHandle pmq = open_store(scratch / "store", options, log);
        states.push_back(content_of(pmq.get(), 32));
        for (uint64_t number = 0; number < steps; ++number) {
            ASSERT_EQ(take_step(pmq.get(), number), LOCUS_OK);
            states.push_back(content_of(pmq.get(), 32));
        }
    }
    auto *acknowledged = static_cast<std::atomic<uint64_t> *>(
        mmap(nullptr, sizeof(std::atomic<uint64_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(acknowledged, MAP_FAILED);
    size_t kills = 0, early = 0;
    for (;; ++kills) {
        SCOPED_TRACE(kills);
        const Scratch scratch;
        const std::string folder = scratch / "store";
        new (acknowledged) std::atomic<uint64_t>(0);
        const bool killed = killed_at(kills, GetParam(), [&] {
            locus_pmq *pmq = nullptr;
            if (locus_pmq_open(folder.c_str(), &options, &log, nullptr, nullptr, nullptr, &pmq) != LOCUS_OK)
                _exit(1);
            acknowledged->store(1);
            for (uint64_t number = 0; number < steps; ++number) {
                if (take_step(pmq, number) != LOCUS_OK)
                    _exit(2);
                acknowledged->store(number + 2);
            }
        });
        const uint64_t done = acknowledged->load();
        const Content found = content_of(open_store(folder, options, log).get(), 32);
        ASSERT_TRUE(found == states[done] || (killed && found == states[done + 1])) << done << " acknowledged";
        early += found != states[done];
        if (!killed)
            break;
    }
    munmap(acknowledged, sizeof *acknowledged);
    EXPECT_GT(kills, 50u);
    EXPECT_GE(early, 8u) << "a change that is logged is there before it is acknowledged";
}

TEST_P(KilledAtEveryCall, AttachedFoldersHoldTheStoreOrNothing) {
    const StoreHandle pmq = some_store();
    const Content whole = content_of(pmq.get(), 32);
    for (size_t after = 0;; ++after) {
        SCOPED_TRACE(after);
        const Scratch scratch;
        const std::string folder = scratch / "store";
        const bool killed = killed_at(after, GetParam(), [&] {
            if (locus_pmq_attach(pmq.get(), folder.c_str(), nullptr, nullptr, nullptr) != LOCUS_OK)
                _exit(1);
        });
        const Content found = content_of(open_store(folder, default_options(), log_options()).get(), 32);
        ASSERT_TRUE(found == whole || (killed && found == Content{}));
        if (!killed)
            break;
    }
}

INSTANTIATE_TEST_SUITE_P(Storage, KilledAtEveryCall, testing::Values(Way::killed, Way::killed_behind),
                         [](const auto &instance) {
                             return std::string(instance.param == Way::killed ? "before" : "behind");
                         });

} // namespace
} // namespace locus::test
