// Every allocation of every call fails in turn: the store stays valid, and a call that says so has changed nothing.
#include "tests/unit/pmq/failing_memory.hpp"
#include "tests/unit/pmq/tracked_store.hpp"

#include <locus/pmq.h>

#include <gtest/gtest.h>

#include <functional>

namespace locus::test {
namespace {

using Bytes = std::vector<unsigned char>;

int32_t keep_id(const void *record, void *user) {
    static_cast<std::vector<uint64_t> *>(user)->push_back(unpack(record, LOCUS_RECORD_POINT32).id);
    return 0;
}
int32_t remove_some(const void *record, void *) { return unpack(record, LOCUS_RECORD_POINT32).id % 7 == 0; }

class Memory : public testing::TestWithParam<LayoutChoice> {
protected:
    Memory() {
        departed.reserve(100000); // the sink itself must not allocate
        locus_pmq_options options;
        locus_pmq_options_init(&options, sizeof options);
        GetParam().apply(options);
        options.horizon = 500;
        options.max_records = 900;
        options.remove = remove_some;
        options.sink = keep_id;
        options.sink_user = &departed;
        for (size_t after = 0;; ++after) {
            FailingMemory failing(after);
            const locus_status status = locus_pmq_create(&options, &pmq);
            EXPECT_EQ(status == LOCUS_OK, !failing.failed()) << "allocation " << after;
            if (status == LOCUS_OK)
                break;
            EXPECT_EQ(status, LOCUS_E_MEMORY);
            EXPECT_EQ(pmq, nullptr);
        }
    }
    ~Memory() override { locus_pmq_destroy(pmq); }

    Bytes content() const {
        size_t count = 0;
        locus_pmq_count(pmq, nullptr, &count);
        Bytes bytes(count * sizeof(locus_point32));
        EXPECT_EQ(locus_pmq_read(pmq, nullptr, bytes.data(), count, &count), LOCUS_OK);
        return bytes;
    }

    // Call until no allocation fails; before that, nothing may have happened.
    void insist(const std::function<locus_status()> &call) {
        const Bytes before = content();
        const size_t departed_before = departed.size();
        for (size_t after = 0;; ++after) {
            FailingMemory failing(after);
            const locus_status status = call();
            if (status == LOCUS_OK)
                return; // an index that was given up for want of memory is no failure
            ASSERT_EQ(status, LOCUS_E_MEMORY) << locus_last_error();
            ASSERT_TRUE(failing.failed());
            ++failures;
            ASSERT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
            ASSERT_EQ(content(), before) << "allocation " << after;
            ASSERT_EQ(departed.size(), departed_before);
        }
    }

    locus_pmq *pmq = nullptr;
    std::vector<uint64_t> departed;
    size_t failures = 0;
};

TEST_P(Memory, FailsWithoutATrace) {
    Places draw(9);
    uint64_t id = 0;
    int64_t now = 0;
    for (int step = 0; step < 60 && !HasFatalFailure(); ++step) {
        now += 20;
        std::vector<Item> items(draw.below(120));
        for (Item &item : items) {
            item = draw.place();
            item.id = ++id;
            item.time = now - static_cast<int64_t>(draw.below(30));
        }
        const Bytes bytes = pack(items, LOCUS_RECORD_POINT32);
        insist([&] { return locus_pmq_insert(pmq, bytes.data(), items.size(), now); });
        if (step % 7 == 3)
            insist([&] { return locus_pmq_sweep(pmq, now, nullptr); });
        if (step % 11 == 5) {
            locus_pmq_query query;
            locus_pmq_query_init(&query, sizeof query);
            query.region = LOCUS_REGION_BOX;
            query.box = draw.box();
            insist([&] { return locus_pmq_erase(pmq, &query, nullptr); });
        }
        ASSERT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
    }
    EXPECT_GT(failures, 150u);
    // Nothing was lost or doubled on the way.
    EXPECT_EQ(locus_pmq_erase(pmq, nullptr, nullptr), LOCUS_OK);
    EXPECT_EQ(locus_pmq_sweep(pmq, now + 10000, nullptr), LOCUS_OK);
    std::sort(departed.begin(), departed.end());
    ASSERT_EQ(departed.size(), id);
    for (uint64_t i = 0; i < id; ++i)
        ASSERT_EQ(departed[i], i + 1);
}

// The n-th allocation of every call fails, for n in turn: this reaches what is behind a failure that is no error.
TEST_P(Memory, TheIndexComesBack) {
    Places draw(10);
    int64_t now = 0;
    for (size_t after = 0; after < 40; ++after) {
        std::vector<Item> items(200);
        for (Item &item : items) {
            item = draw.place();
            item.time = ++now;
        }
        const Bytes bytes = pack(items, LOCUS_RECORD_POINT32);
        {
            FailingMemory failing(after);
            const locus_status status = locus_pmq_insert(pmq, bytes.data(), items.size(), now);
            ASSERT_TRUE(status == LOCUS_OK || status == LOCUS_E_MEMORY);
        }
        ASSERT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
        ASSERT_EQ(locus_pmq_sweep(pmq, now, nullptr), LOCUS_OK);
        ASSERT_EQ(locus_pmq_check(pmq), LOCUS_OK) << locus_last_error();
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, Memory, testing::ValuesIn(layouts),
                         [](const auto &instance) { return instance.param.name; });

} // namespace
} // namespace locus::test
