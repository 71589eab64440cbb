// A process that is killed at any point has lost nothing it had acknowledged.
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include <algorithm>
#include <atomic>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace locus::test {
namespace {

// Operation number n, on a store and on its plain model. Every operation is made from its number alone.
struct Operation {
    explicit Operation(uint64_t number) : draw(1000 + number) {
        now = 100000 + static_cast<int64_t>(number) * 20;
        const uint64_t choice = draw.below(20);
        kind = choice < 14 ? insert : choice < 15 ? sweep : choice < 17 ? erase : checkpoint;
        if (kind == insert) {
            items.resize(1 + draw.below(draw.chance(0.1) ? 300 : 30));
            for (size_t i = 0; i < items.size(); ++i) {
                items[i] = draw.place();
                items[i].id = number * 1000 + i;
                items[i].time = now - static_cast<int64_t>(draw.below(draw.chance(0.9) ? 20 : 3000));
                locus_pmq_key(items[i].latitude, items[i].longitude, &items[i].key);
            }
        } else if (kind == erase) {
            box = draw.box();
        }
    }

    locus_status apply(locus_pmq *pmq, uint32_t record) const {
        if (kind == insert) {
            const auto batch = pack(items, record);
            return locus_pmq_insert(pmq, batch.data(), items.size(), now);
        }
        if (kind == sweep)
            return locus_pmq_sweep(pmq, now, nullptr);
        const locus_pmq_query query = box_query(box);
        return kind == erase ? locus_pmq_erase(pmq, &query, nullptr) : locus_pmq_checkpoint(pmq, nullptr, nullptr);
    }

    enum { insert, sweep, erase, checkpoint } kind;
    Places draw;
    std::vector<Item> items;
    int64_t now;
    locus_box box{};
};

struct Model {
    void apply(const Operation &operation) {
        if (operation.kind == Operation::erase)
            std::erase_if(items, [&](const Item &item) { return in_box(operation.box, item); });
        if (operation.kind == Operation::insert || operation.kind == Operation::sweep)
            now = operation.now;
        if (operation.kind == Operation::insert) {
            items.insert(items.end(), operation.items.begin(), operation.items.end());
            std::stable_sort(items.begin(), items.end(), [](const Item &a, const Item &b) { return a.key < b.key; });
        }
        std::erase_if(items, [&](const Item &item) { return item.time < now - horizon; });
    }
    Content content(uint32_t record) const { return {pack(items, record), now}; }

    static constexpr int64_t horizon = 2500;
    std::vector<Item> items;
    int64_t now = INT64_MIN;
};

class Killed : public testing::TestWithParam<std::tuple<LayoutChoice, uint32_t>> {};

TEST_P(Killed, LosesNothingAcknowledged) {
    const uint32_t sync = std::get<1>(GetParam());
    locus_pmq_options options = default_options();
    std::get<0>(GetParam()).apply(options);
    options.horizon = Model::horizon;
    Scratch scratch;
    const std::string folder = scratch / "store";
    auto *acknowledged = static_cast<std::atomic<uint64_t> *>(
        mmap(nullptr, sizeof(std::atomic<uint64_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(acknowledged, MAP_FAILED);
    new (acknowledged) std::atomic<uint64_t>(0);

    Model model;
    Places draw(20 + sync);
    uint64_t done = 0, in_flight = 0; // operations that the folder holds; kills amid one that was kept
    for (int round = 0; round < 20 && !HasFailure(); ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        acknowledged->store(done);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            locus_pmq *pmq = nullptr;
            const locus_pmq_log_options log = log_options(sync);
            if (locus_pmq_open(folder.c_str(), &options, &log, nullptr, nullptr, nullptr, &pmq) != LOCUS_OK)
                _exit(1);
            for (uint64_t number = done;; ++number) {
                if (Operation(number).apply(pmq, options.record) != LOCUS_OK)
                    _exit(2);
                acknowledged->store(number + 1);
            }
        }
        // Now and then before it has begun; else at some point within some operations.
        const uint64_t wanted = done + draw.below(12), patience = draw.below(3000);
        int status = 0;
        for (int waits = 0; acknowledged->load() < wanted && waits < 100000; ++waits) {
            usleep(100);
            ASSERT_EQ(waitpid(child, &status, WNOHANG), 0) << "the child ended with " << WEXITSTATUS(status);
        }
        usleep(static_cast<useconds_t>(patience));
        kill(child, SIGKILL);
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended with " << WEXITSTATUS(status);

        for (; done < acknowledged->load(); ++done)
            model.apply(Operation(done));
        const StoreHandle pmq = open_store(folder, options, log_options(sync));
        const Content found = content_of(pmq.get(), options.record);
        if (found != model.content(options.record)) { // the operation at work may be there, whole
            model.apply(Operation(done++));
            ASSERT_EQ(found, model.content(options.record));
            ++in_flight;
        }
    }
    EXPECT_GT(done, 60u);
    munmap(acknowledged, sizeof *acknowledged);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Killed,
                         testing::Combine(testing::Values(layouts[0], layouts[2]),
                                          testing::Values<uint32_t>(LOCUS_SYNC_NONE, LOCUS_SYNC_BATCH)),
                         [](const auto &instance) {
                             return std::string(std::get<0>(instance.param).name) +
                                    (std::get<1>(instance.param) == LOCUS_SYNC_NONE ? "_unsynced" : "_synced");
                         });

} // namespace
} // namespace locus::test
