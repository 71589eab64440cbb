// The folder of a store: what is recovered is what the store held, at every point.
#include "tests/unit/pmq/scratch.hpp"
#include "tests/unit/pmq/stored_content.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace locus::test {
namespace {

namespace fs = std::filesystem;

struct Kind {
    const char *name;
    uint32_t record = LOCUS_RECORD_POINT32;
    int64_t horizon = LOCUS_NO_HORIZON;
    uint64_t max_records = LOCUS_NO_LIMIT;
    bool predicate = false;
    double sink_stops = 0;
};
const Kind kinds[] = {
    {.name = "plain"},
    {.name = "text", .record = LOCUS_RECORD_TEXT156, .horizon = 3000},
    {.name = "horizon", .horizon = 1500, .sink_stops = 0.01},
    {.name = "predicate", .horizon = 3000, .predicate = true},
    {.name = "max_records", .max_records = 300, .sink_stops = 0.01},
    {.name = "one_record", .max_records = 1},
    {.name = "everything", .record = LOCUS_RECORD_TEXT156, .horizon = 2000, .max_records = 400, .predicate = true},
};

// A copy of a folder as a killed process would have left it.
std::string copied(const Scratch &scratch, const std::string &folder) {
    const std::string copy = scratch / "copy";
    fs::remove_all(copy);
    fs::copy(folder, copy);
    return copy;
}

std::string numbered(const std::string &folder, const char *kind, uint64_t number) {
    const std::string digits = std::to_string(number);
    return folder + "/" + kind + "-" + std::string(20 - digits.size(), '0') + digits;
}

class Logs : public testing::TestWithParam<std::tuple<size_t, LayoutChoice>> {
protected:
    const Kind &kind = kinds[std::get<0>(GetParam())];
    Scratch scratch;
    const std::string folder = scratch / "store";
    Changes changes{100 + std::get<0>(GetParam()), kind.record};
    uint64_t removable = 1; // of 5 by the predicate

    static int32_t on_remove(const void *record, void *user) {
        const Logs &self = *static_cast<Logs *>(user);
        return unpack(record, self.kind.record).id % 5 < self.removable;
    }
    static int32_t on_sink(const void *, void *user) {
        Logs &self = *static_cast<Logs *>(user);
        return self.changes.draw.chance(self.kind.sink_stops);
    }
    static int32_t odd(const void *record, void *user) {
        return unpack(record, static_cast<Logs *>(user)->kind.record).id % 2 == 1;
    }

    locus_pmq_options options(const LayoutChoice &layout) {
        locus_pmq_options o = default_options();
        o.record = kind.record;
        o.horizon = kind.horizon;
        o.max_records = kind.max_records;
        layout.apply(o);
        if (kind.predicate) {
            o.remove = on_remove;
            o.remove_user = this;
        }
        if (kind.sink_stops > 0) {
            o.sink = on_sink;
            o.sink_user = this;
        }
        return o;
    }

    void step(locus_pmq *pmq) {
        Places &draw = changes.draw;
        changes.now += static_cast<int64_t>(draw.below(100));
        const uint64_t choice = draw.below(40);
        locus_status status = LOCUS_OK;
        if (choice < 30) {
            const auto batch = changes.batch(choice == 0 ? 400 : 40);
            status = locus_pmq_insert(pmq, batch.data(), batch.size() / kind.record, changes.now);
        } else if (choice < 33) {
            status = locus_pmq_sweep(pmq, changes.now, nullptr);
        } else if (choice < 37) {
            locus_pmq_query query = box_query(draw.box());
            if (draw.chance(0.3)) {
                query.filter = odd;
                query.filter_user = this;
            }
            status = locus_pmq_erase(pmq, &query, nullptr);
        } else if (choice < 39) {
            status = locus_pmq_checkpoint(pmq, nullptr, nullptr);
        } else {
            removable = draw.below(5);
        }
        ASSERT_TRUE(status == LOCUS_OK || (status == LOCUS_E_STOPPED && kind.sink_stops > 0)) << locus_last_error();
    }
};

TEST_P(Logs, RecoverWhatTheStoreHeldAtEveryPoint) {
    const LayoutChoice &layout = std::get<1>(GetParam());
    StoreHandle pmq = open_store(folder, options(layout), log_options());
    for (int i = 0; i < 60 && !HasFailure(); ++i) {
        SCOPED_TRACE("step " + std::to_string(i));
        step(pmq.get());
        const Content content = content_of(pmq.get(), kind.record);
        // As after a kill; in another layout, with another store's callbacks.
        locus_pmq_options other = options(layouts[changes.draw.below(std::size(layouts))]);
        other.remove = nullptr;
        other.sink = nullptr;
        locus_pmq_recovery recovery = empty_recovery();
        const StoreHandle recovered = open_store(copied(scratch, folder), other, log_options(), &recovery);
        ASSERT_EQ(content_of(recovered.get(), kind.record), content);
        EXPECT_EQ(recovery.records, content.records.size() / kind.record);
        EXPECT_EQ(recovery.now, content.now);
        EXPECT_EQ(recovery.cut, 0u);
        EXPECT_EQ(recovery.skipped, 0u);
        if (i % 15 == 14) { // go on with what was recovered
            pmq.reset();
            pmq = open_store(folder, options(layout), log_options());
            ASSERT_EQ(content_of(pmq.get(), kind.record), content);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Logs,
                         testing::Combine(testing::Range<size_t>(0, std::size(kinds)), testing::ValuesIn(layouts)),
                         [](const auto &instance) {
                             return std::string(kinds[std::get<0>(instance.param)].name) + "_" +
                                    std::get<1>(instance.param).name;
                         });

locus_pmq_options plain_options() { return default_options(); }

locus_status insert_some(locus_pmq *pmq, Changes &changes, size_t count = 3) {
    std::vector<Item> items(count);
    for (Item &item : items) {
        item = changes.draw.place();
        item.time = changes.now;
        item.id = ++changes.id;
    }
    const auto batch = pack(items, changes.record);
    ++changes.now;
    return locus_pmq_insert(pmq, batch.data(), count, changes.now);
}

// A folder with one log of a few changes; what the store held when the log had each length.
struct Story {
    explicit Story(const std::string &folder) : folder(folder) {
        StoreHandle pmq = open_store(folder, plain_options(), log_options());
        const auto remember = [&] {
            locus_pmq_log_stats stats{};
            stats.struct_size = sizeof stats;
            EXPECT_EQ(locus_pmq_get_log_stats(pmq.get(), &stats), LOCUS_OK);
            states[stats.bytes] = content_of(pmq.get(), LOCUS_RECORD_POINT32);
        };
        remember();
        Changes changes(6);
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(insert_some(pmq.get(), changes), LOCUS_OK) << locus_last_error();
            remember();
        }
        const locus_pmq_query north = box_query({0, -180, 90, 180});
        EXPECT_EQ(locus_pmq_erase(pmq.get(), &north, nullptr), LOCUS_OK);
        remember();
        changes.now += 10;
        EXPECT_EQ(locus_pmq_sweep(pmq.get(), changes.now, nullptr), LOCUS_OK);
        remember();
        EXPECT_EQ(insert_some(pmq.get(), changes), LOCUS_OK) << locus_last_error();
        remember();
        log = numbered(folder, "log", 1);
        bytes = file_bytes(log);
        EXPECT_EQ(bytes.size(), states.rbegin()->first);
    }
    // The state of the longest whole log within a length.
    const Content &at(uint64_t length) const {
        const auto next = states.upper_bound(length);
        return next == states.begin() ? next->second : std::prev(next)->second;
    }
    std::string folder, log;
    std::map<uint64_t, Content> states;
    FileBytes bytes;
};

TEST(Log, ATornEndIsCutOff) {
    Scratch scratch;
    const Story story(scratch / "store");
    for (size_t length = 0; length <= story.bytes.size(); ++length) {
        SCOPED_TRACE(length);
        write_file(story.log, {story.bytes.begin(), story.bytes.begin() + static_cast<ptrdiff_t>(length)});
        locus_pmq_recovery recovery = empty_recovery();
        const Content &content = story.at(length);
        StoreHandle pmq = open_store(story.folder, plain_options(), log_options(), &recovery);
        ASSERT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), content);
        const auto whole = story.states.upper_bound(length);
        ASSERT_EQ(recovery.cut, length - (whole == story.states.begin() ? 0 : std::prev(whole)->first));
        // The log goes on behind the cut.
        Changes changes(7);
        changes.now = 200000;
        ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK) << locus_last_error();
        const Content more = content_of(pmq.get(), LOCUS_RECORD_POINT32);
        pmq.reset();
        pmq = open_store(story.folder, plain_options(), log_options());
        ASSERT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), more);
    }
}

// Each byte changed: an error that names the log, or, in the last change, which may be torn, the state before it.
TEST(Log, DamageIsNotTakenForATornEnd) {
    Scratch scratch;
    const Story story(scratch / "store");
    const uint64_t last = std::prev(story.states.end(), 2)->first;
    size_t refused = 0;
    for (size_t at = 0; at < story.bytes.size(); ++at) {
        for (const int flip : {0x01, 0xFF}) {
            SCOPED_TRACE(at);
            FileBytes bytes = story.bytes;
            bytes[at] = static_cast<char>(bytes[at] ^ flip);
            write_file(story.log, bytes);
            locus_pmq *pmq = nullptr;
            const locus_pmq_options options = plain_options();
            const locus_pmq_log_options log = log_options();
            const locus_status status =
                locus_pmq_open(story.folder.c_str(), &options, &log, nullptr, nullptr, nullptr, &pmq);
            const StoreHandle owner(pmq);
            if (at < last) {
                ASSERT_EQ(status, LOCUS_E_FORMAT) << locus_last_error();
                ASSERT_NE(std::string(locus_last_error()).find(story.log), std::string::npos) << locus_last_error();
                ASSERT_EQ(file_bytes(story.log), bytes) << "a refused log was changed";
                ++refused;
            } else {
                ASSERT_EQ(status, LOCUS_OK) << locus_last_error();
                ASSERT_EQ(content_of(pmq, LOCUS_RECORD_POINT32), story.at(last));
            }
        }
    }
    EXPECT_EQ(refused, 2 * last);
    // Asked to, the recovery goes as far as the log is sound.
    FileBytes bytes = story.bytes;
    const uint64_t third = std::next(story.states.begin(), 2)->first;
    bytes[third + 9] = static_cast<char>(bytes[third + 9] ^ 4);
    write_file(story.log, bytes);
    locus_pmq_log_options log = log_options();
    log.repair = 1;
    locus_pmq_recovery recovery = empty_recovery();
    StoreHandle pmq = open_store(story.folder, plain_options(), log, &recovery);
    EXPECT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), story.at(third));
    EXPECT_EQ(recovery.cut, story.bytes.size() - third);
    Changes changes(8);
    changes.now = 300000;
    ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK);
    const Content more = content_of(pmq.get(), LOCUS_RECORD_POINT32);
    pmq.reset();
    EXPECT_EQ(content_of(open_store(story.folder, plain_options(), log_options()).get(), LOCUS_RECORD_POINT32), more);
}

TEST(Log, ADamagedSaveIsSkipped) {
    Scratch scratch;
    const std::string folder = scratch / "store";
    Changes changes(9);
    StoreHandle pmq = open_store(folder, plain_options(), log_options());
    for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(insert_some(pmq.get(), changes, 50), LOCUS_OK);
        ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
    }
    ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK);
    const Content content = content_of(pmq.get(), LOCUS_RECORD_POINT32);
    pmq.reset();
    const std::string newest = numbered(folder, "store", 4), older = numbered(folder, "store", 3);
    EXPECT_TRUE(fs::exists(newest) && fs::exists(older));
    EXPECT_FALSE(fs::exists(numbered(folder, "store", 2)) || fs::exists(numbered(folder, "log", 2)));
    FileBytes bytes = file_bytes(newest);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_file(newest, bytes);
    write_file(newest + ".part-1-1", {'x'}); // of a save that was interrupted
    locus_pmq_recovery recovery = empty_recovery();
    pmq = open_store(folder, plain_options(), log_options(), &recovery);
    EXPECT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), content);
    EXPECT_EQ(recovery.skipped, 1u);
    EXPECT_EQ(recovery.number, 3u);
    EXPECT_FALSE(fs::exists(newest + ".part-1-1"));
    pmq.reset();
    fs::remove(older);
    locus_pmq *none = nullptr;
    EXPECT_EQ(locus_pmq_open(folder.c_str(), nullptr, nullptr, nullptr, nullptr, nullptr, &none), LOCUS_E_FORMAT);
    EXPECT_NE(std::string(locus_last_error()).find(newest), std::string::npos) << locus_last_error();
}

TEST(Log, AFullDiskRefusesChangesAndNothingElse) {
    Scratch scratch;
    const std::string folder = scratch / "store", log = numbered(folder, "log", 1);
    Changes changes(10);
    StoreHandle pmq = open_store(folder, plain_options(), log_options(LOCUS_SYNC_BATCH));
    ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK);
    const Content before = content_of(pmq.get(), LOCUS_RECORD_POINT32);
    const uint64_t bytes = fs::file_size(log);
    for (uint64_t room : {0, 1, 56, 100}) {
        const FullDisk full(bytes + room);
        ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_E_IO);
        EXPECT_NE(std::string(locus_last_error()).find(log), std::string::npos) << locus_last_error();
        EXPECT_NE(std::string(locus_last_error()).find("at byte " + std::to_string(bytes + room)), std::string::npos)
            << locus_last_error();
        EXPECT_EQ(locus_pmq_erase(pmq.get(), nullptr, nullptr), LOCUS_E_IO);
        EXPECT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), before);
        EXPECT_EQ(fs::file_size(log), bytes) << "half a change is left";
    }
    {
        const FullDisk full(100);
        EXPECT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_E_IO) << "the saved file does not fit";
    }
    ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK) << locus_last_error();
    const Content after = content_of(pmq.get(), LOCUS_RECORD_POINT32);
    pmq.reset();
    EXPECT_EQ(content_of(open_store(folder, plain_options(), log_options()).get(), LOCUS_RECORD_POINT32), after);
}

// With a limit the log is told afterwards what has left. If that fails, the log stops until a checkpoint.
TEST(Log, StopsWhenItFallsBehindAndGoesOnAfterACheckpoint) {
    for (const bool killed : {false, true}) {
        Scratch scratch;
        const std::string folder = scratch / "store", log = numbered(folder, "log", 1);
        locus_pmq_options options = plain_options();
        options.max_records = 10;
        Changes changes(11);
        StoreHandle pmq = open_store(folder, options, log_options());
        ASSERT_EQ(insert_some(pmq.get(), changes, 10), LOCUS_OK);
        const Content acknowledged = content_of(pmq.get(), LOCUS_RECORD_POINT32);
        {
            const FullDisk full(fs::file_size(log) + 56 + 4 * 32 + 20); // the batch fits, its result does not
            ASSERT_EQ(insert_some(pmq.get(), changes, 4), LOCUS_E_IO);
        }
        locus_pmq_log_stats stats{};
        stats.struct_size = sizeof stats;
        EXPECT_EQ(locus_pmq_get_log_stats(pmq.get(), &stats), LOCUS_OK);
        EXPECT_EQ(stats.stopped, 1u);
        const Content stopped = content_of(pmq.get(), LOCUS_RECORD_POINT32);
        EXPECT_EQ(insert_some(pmq.get(), changes), LOCUS_E_STATE);
        EXPECT_NE(std::string(locus_last_error()).find("checkpoint"), std::string::npos) << locus_last_error();
        EXPECT_EQ(locus_pmq_sync(pmq.get()), LOCUS_E_IO);
        EXPECT_EQ(content_of(pmq.get(), LOCUS_RECORD_POINT32), stopped);
        if (killed) {
            const StoreHandle recovered = open_store(copied(scratch, folder), options, log_options());
            EXPECT_EQ(content_of(recovered.get(), LOCUS_RECORD_POINT32), acknowledged);
            continue;
        }
        ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK) << locus_last_error();
        ASSERT_EQ(insert_some(pmq.get(), changes), LOCUS_OK) << locus_last_error();
        const Content after = content_of(pmq.get(), LOCUS_RECORD_POINT32);
        pmq.reset();
        EXPECT_EQ(content_of(open_store(folder, options, log_options()).get(), LOCUS_RECORD_POINT32), after);
    }
}

int32_t keep_id(const void *record, void *user) {
    static_cast<std::multiset<uint64_t> *>(user)->insert(unpack(record, LOCUS_RECORD_POINT32).id);
    return 0;
}
int32_t stop_at_once(const void *, void *) { return 1; }

// After a kill the sink gets again what left since the save, or, if the caller wants it so, only what it never had.
TEST(Log, TheSinkGetsWhatLeftAgain) {
    for (const uint32_t redeliver : {0u, 1u}) {
        SCOPED_TRACE(redeliver);
        Scratch scratch;
        const std::string folder = scratch / "store";
        std::multiset<uint64_t> handed;
        locus_pmq_options options = plain_options();
        options.sink = keep_id;
        options.sink_user = &handed;
        locus_pmq_log_options log = log_options();
        log.redeliver = redeliver;
        Changes changes(12);
        StoreHandle pmq = open_store(folder, options, log);
        ASSERT_EQ(insert_some(pmq.get(), changes, 20), LOCUS_OK); // ids 8..27
        const locus_pmq_query south = box_query({-90, -180, 30, 180});
        ASSERT_EQ(locus_pmq_erase(pmq.get(), &south, nullptr), LOCUS_OK);
        ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK);
        handed.clear();
        ASSERT_EQ(insert_some(pmq.get(), changes, 5), LOCUS_OK);
        ASSERT_EQ(locus_pmq_erase(pmq.get(), nullptr, nullptr), LOCUS_OK);
        const std::multiset<uint64_t> since = std::exchange(handed, {});
        ASSERT_GT(since.size(), 5u);
        pmq.reset();
        pmq = open_store(folder, options, log);
        EXPECT_TRUE(handed.empty()) << "no callback while the store is made";
        EXPECT_EQ(stats_of(pmq.get()).pending, redeliver ? since.size() : 0);
        ASSERT_EQ(locus_pmq_sweep(pmq.get(), changes.now, nullptr), LOCUS_OK);
        EXPECT_EQ(handed, redeliver ? since : std::multiset<uint64_t>());
        ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK);

        // What waits for a sink that has stopped is not lost with a checkpoint.
        handed.clear();
        ASSERT_EQ(insert_some(pmq.get(), changes, 6), LOCUS_OK);
        pmq.reset();
        options.sink = stop_at_once;
        pmq = open_store(folder, options, log);
        ASSERT_EQ(locus_pmq_erase(pmq.get(), nullptr, nullptr), LOCUS_E_STOPPED);
        ASSERT_EQ(locus_pmq_checkpoint(pmq.get(), nullptr, nullptr), LOCUS_OK);
        pmq.reset();
        options.sink = keep_id;
        pmq = open_store(folder, options, log);
        ASSERT_EQ(locus_pmq_sweep(pmq.get(), changes.now, nullptr), LOCUS_OK);
        EXPECT_EQ(handed.size(), 5u);
    }
}

TEST(Log, OneStoreAtATimeAndOnlyItsOwnFolder) {
    Scratch scratch;
    const std::string folder = scratch / "store";
    const locus_pmq_options options = plain_options();
    StoreHandle pmq = open_store(folder, options, log_options());
    locus_pmq *other = nullptr;
    EXPECT_EQ(locus_pmq_open(folder.c_str(), nullptr, nullptr, nullptr, nullptr, nullptr, &other), LOCUS_E_BUSY);
    EXPECT_EQ(other, nullptr);
    EXPECT_EQ(locus_pmq_attach(pmq.get(), (scratch / "second").c_str(), nullptr, nullptr, nullptr), LOCUS_E_STATE);
    ASSERT_EQ(locus_pmq_create(&options, &other), LOCUS_OK);
    const StoreHandle second(other);
    EXPECT_EQ(locus_pmq_checkpoint(other, nullptr, nullptr), LOCUS_E_STATE);
    EXPECT_EQ(locus_pmq_sync(other), LOCUS_E_STATE);
    pmq.reset();
    EXPECT_EQ(locus_pmq_attach(other, folder.c_str(), nullptr, nullptr, nullptr), LOCUS_E_STATE);
    Changes changes(13);
    ASSERT_EQ(insert_some(other, changes), LOCUS_OK);
    ASSERT_EQ(locus_pmq_attach(other, (scratch / "third").c_str(), nullptr, nullptr, nullptr), LOCUS_OK)
        << locus_last_error();
    ASSERT_EQ(insert_some(other, changes), LOCUS_OK);
    EXPECT_EQ(content_of(open_store(copied(scratch, scratch / "third"), options, log_options()).get(), 32),
              content_of(other, 32));
    locus_pmq_options text = options;
    text.record = LOCUS_RECORD_TEXT156;
    locus_pmq *none = nullptr;
    EXPECT_EQ(locus_pmq_open(folder.c_str(), &text, nullptr, nullptr, nullptr, nullptr, &none), LOCUS_E_ARGUMENT);
    EXPECT_NE(std::string(locus_last_error()).find("options.record is 156"), std::string::npos) << locus_last_error();
}

} // namespace
} // namespace locus::test
