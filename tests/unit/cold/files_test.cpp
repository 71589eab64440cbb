// What lies in the file: files that are no tier's, damaged ones, writes that fail, processes that are killed.
#include "tests/unit/cold/tiers.hpp"

#include <sqlite3.h>

#include <csignal>
#include <fstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace locus::test {
namespace {

locus_status open_status(const std::string &file, const locus_cold_options &options = cold_options()) {
    locus_cold *cold = nullptr;
    const locus_status status = locus_cold_open(file.c_str(), &options, &cold);
    EXPECT_EQ(cold == nullptr, status != LOCUS_OK);
    locus_cold_close(cold);
    return status;
}

void expect_refused(const std::string &file, locus_status status, const char *words) {
    EXPECT_EQ(open_status(file), status) << locus_cold_last_error();
    const std::string text = locus_cold_last_error();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find(file), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(file + "-lock"));
}

std::string bytes_of(const std::string &file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::string &file, const std::string &bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

void execute(const std::string &file, const char *sql) {
    sqlite3 *database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
}

// Records that have all left the store.
void fill(Tiers &tiers, size_t records, uint64_t seed = 3) {
    Places draw(seed);
    std::vector<Item> items(records);
    for (Item &item : items) {
        item = draw.place();
        item.time = 1;
    }
    ASSERT_EQ(tiers.insert(items, 1), LOCUS_OK);
    ASSERT_EQ(locus_pmq_erase(tiers.pmq, nullptr, nullptr), LOCUS_OK);
}

TEST(TierFile, RefusesWhatIsNoTier) {
    const Folder folder;
    const std::string file = folder.file();
    write_bytes(file, "this is a text, and not at all short, but no database of any kind");
    expect_refused(file, LOCUS_E_FORMAT, "not a database");
    write_bytes(file, std::string(100000, '\7'));
    expect_refused(file, LOCUS_E_FORMAT, "not a database");
    std::filesystem::remove(file);
    execute(file, "CREATE TABLE mine(a); INSERT INTO mine VALUES(1)");
    const std::string before = bytes_of(file);
    expect_refused(file, LOCUS_E_FORMAT, "application id 0");
    EXPECT_EQ(bytes_of(file), before);
    expect_refused(folder.path() + "/no/such/folder.db", LOCUS_E_IO, "No such file");
    expect_refused(folder.path(), LOCUS_E_IO, "");
    write_bytes(file, ""); // as a process leaves it that was killed early
    EXPECT_EQ(open_status(file), LOCUS_OK) << locus_cold_last_error();
    execute(file, "PRAGMA user_version = 2");
    expect_refused(file, LOCUS_E_FORMAT, "schema version 2");
    execute(file, "PRAGMA user_version = 1; UPDATE tier SET value = 33 WHERE name = 'record'");
    expect_refused(file, LOCUS_E_FORMAT, "record layout 33");
    execute(file, "UPDATE tier SET value = 156 WHERE name = 'record'");
    expect_refused(file, LOCUS_E_ARGUMENT, "holds records of 156 bytes");
    execute(file, "DROP TABLE runs");
    EXPECT_EQ(open_status(file, cold_options(LOCUS_RECORD_TEXT156)), LOCUS_E_FORMAT);
    execute(file, "DROP TABLE tier");
    expect_refused(file, LOCUS_E_FORMAT, "no such table");
}

TEST(TierFile, ChecksWhatRunsSay) {
    const Folder folder;
    const auto check = [&] {
        locus_cold *cold = nullptr;
        const locus_cold_options options = cold_options();
        locus_status status = locus_cold_open(folder.file().c_str(), &options, &cold);
        if (status == LOCUS_OK)
            status = locus_cold_check(cold);
        locus_cold_close(cold);
        return status;
    };
    {
        Tiers tiers(folder.file(), default_options(), cold_options());
        fill(tiers, 1000);
    }
    EXPECT_EQ(check(), LOCUS_OK) << locus_cold_last_error();
    const std::string good = bytes_of(folder.file());
    for (const char *damage :
         {"UPDATE runs SET records = 999", "UPDATE runs SET records = 2000", "UPDATE runs SET lowest = highest",
          "UPDATE runs SET oldest = 2", "DELETE FROM run_0 WHERE arrival = 7", "DROP TABLE run_0",
          "UPDATE run_0 SET key = key + 1 WHERE arrival = 7", "UPDATE run_0 SET record = x'00' WHERE arrival = 7",
          "UPDATE run_0 SET record = zeroblob(32) WHERE arrival = 7", "UPDATE runs SET \"end\" = 5000",
          "DELETE FROM tier WHERE name = 'written'"}) {
        execute(folder.file(), damage);
        EXPECT_EQ(check(), LOCUS_E_FORMAT) << damage;
        write_bytes(folder.file(), good);
    }
}

// A flipped byte or a missing end: an error, or an answer; never a crash, never more than there was.
TEST(TierFile, StandsDamage) {
    const Folder folder;
    const std::string file = folder.file(), damaged = folder.path() + "/damaged.db";
    constexpr size_t records = 600;
    {
        Tiers tiers(file, default_options(), cold_options());
        fill(tiers, records);
    }
    const std::string good = bytes_of(file);
    const auto try_it = [&](const std::string &bytes) {
        write_bytes(damaged, bytes);
        std::filesystem::remove(damaged + "-wal");
        std::filesystem::remove(damaged + "-shm");
        locus_cold *cold = nullptr;
        const locus_cold_options options = cold_options();
        if (locus_cold_open(damaged.c_str(), &options, &cold) != LOCUS_OK)
            return;
        std::vector<locus_point32> found(records);
        size_t count = 0;
        if (locus_cold_read(cold, nullptr, nullptr, found.data(), found.size(), &count) == LOCUS_OK) {
            EXPECT_LE(count, records);
        }
        static_cast<void>(locus_cold_check(cold));
        locus_cold_close(cold);
    };
    for (size_t at = 0; at < good.size(); at += at < 100 ? 1 : 1999) {
        std::string bytes = good;
        bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
        try_it(bytes);
    }
    for (size_t size = 0; size < good.size(); size += 20000)
        try_it(good.substr(0, size));
}

// Writes fail beyond a size, as on a full disk: nothing is lost, and once there is room it goes on.
TEST(TierFile, SurvivesAFullDisk) {
    std::signal(SIGXFSZ, SIG_IGN);
    const Folder folder;
    Tiers tiers(folder.file(), default_options(), cold_options());
    fill(tiers, 5000);
    ASSERT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
    rlimit room{};
    getrlimit(RLIMIT_FSIZE, &room);
    const rlimit none{16, room.rlim_max};
    setrlimit(RLIMIT_FSIZE, &none);
    Places draw(4);
    locus_status status = LOCUS_OK;
    for (int round = 0; round < 100 && status == LOCUS_OK; ++round) { // far more than the queue takes
        std::vector<Item> items(2000);
        for (Item &item : items) {
            item = draw.place();
            item.time = 2;
        }
        ASSERT_EQ(tiers.insert(items, 2), LOCUS_OK);
        status = locus_pmq_erase(tiers.pmq, nullptr, nullptr);
    }
    EXPECT_EQ(status, LOCUS_E_STOPPED);
    uint64_t count = 0;
    EXPECT_EQ(locus_cold_count(tiers.cold, tiers.pmq, nullptr, &count), LOCUS_E_STATE);
    EXPECT_NE(std::string(locus_cold_last_error()).find("wait in it"), std::string::npos) << locus_cold_last_error();
    EXPECT_EQ(locus_cold_flush(tiers.cold), LOCUS_E_IO) << locus_cold_last_error();
    EXPECT_NE(std::string(locus_cold_last_error()).find("tier.db"), std::string::npos) << locus_cold_last_error();
    EXPECT_EQ(stats_of(tiers.cold).failure, LOCUS_E_IO);
    ASSERT_EQ(locus_cold_count(tiers.cold, nullptr, nullptr, &count), LOCUS_OK) << locus_cold_last_error();
    EXPECT_EQ(count, stats_of(tiers.cold).received); // what waits in the queue is in the answer
    setrlimit(RLIMIT_FSIZE, &room);
    EXPECT_EQ(locus_cold_flush(tiers.cold), LOCUS_OK) << locus_cold_last_error();
    while (locus_pmq_sweep(tiers.pmq, 2, nullptr) == LOCUS_E_STOPPED) {
    }
    tiers.expect(default_query());
    EXPECT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
    EXPECT_EQ(stats_of(tiers.cold).failure, LOCUS_OK);
}

TEST(TierFile, IsNotMadeInAReadOnlyFolder) {
    const Folder folder;
    { Tiers tiers(folder.file(), default_options(), cold_options()); }
    chmod(folder.path().c_str(), 0555);
    const pid_t child = fork();
    if (child == 0) {
        if (getuid() == 0 && setuid(65534) != 0)
            _exit(3);
        locus_cold *cold = nullptr;
        const locus_status fresh = locus_cold_open((folder.path() + "/new.db").c_str(), nullptr, &cold);
        const locus_status old = locus_cold_open(folder.file().c_str(), nullptr, &cold);
        const bool told = std::string(locus_cold_last_error()).find("Permission denied") != std::string::npos;
        _exit(fresh == LOCUS_E_IO && old == LOCUS_E_IO && told && cold == nullptr ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    chmod(folder.path().c_str(), 0755);
    EXPECT_EQ(status, 0);
}

// A process that is killed leaves whole transactions: the records that came first, up to some number, and all that were
// flushed.
TEST(TierFile, SurvivesTheKilledProcess) {
    for (int round = 0; round < 3; ++round) {
        const Folder folder;
        int pipe_ends[2];
        ASSERT_EQ(pipe(pipe_ends), 0);
        const pid_t child = fork();
        if (child == 0) {
            locus_cold_options options = cold_options();
            options.batch_records = 500;
            options.run_records = 2000;
            options.sync = static_cast<uint32_t>(round);
            Tiers tiers(folder.file(), default_options(), options);
            for (uint64_t batch = 0;; ++batch) {
                fill(tiers, 300, batch);
                if (batch % 5 == 4 && locus_cold_flush(tiers.cold) == LOCUS_OK &&
                    write(pipe_ends[1], &tiers.last_id, sizeof tiers.last_id) < 0)
                    _exit(1);
            }
        }
        close(pipe_ends[1]);
        uint64_t flushed = 0;
        for (int reports = 0; reports < 4 + round; ++reports)
            ASSERT_EQ(read(pipe_ends[0], &flushed, sizeof flushed), static_cast<ssize_t>(sizeof flushed));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        while (read(pipe_ends[0], &flushed, sizeof flushed) > 0) {
        }
        close(pipe_ends[0]);

        Tiers tiers(folder.file(), default_options(), cold_options());
        ASSERT_EQ(locus_cold_check(tiers.cold), LOCUS_OK) << locus_cold_last_error();
        const uint64_t there = stats_of(tiers.cold).received;
        EXPECT_GE(there, flushed);
        std::vector<locus_point32> records(there + 1);
        size_t count = 0;
        ASSERT_EQ(locus_cold_read(tiers.cold, nullptr, nullptr, records.data(), records.size(), &count), LOCUS_OK);
        ASSERT_EQ(count, there);
        std::vector<bool> seen(there + 300);
        for (size_t i = 0; i < count; ++i) {
            const uint64_t id = unpack(&records[i], LOCUS_RECORD_POINT32).id;
            ASSERT_GE(id, 1u);
            ASSERT_LT(id, seen.size()) << "batches left the store one after the other";
            ASSERT_FALSE(seen[id]);
            seen[id] = true;
        }
        for (uint64_t id = 1; id <= there / 300 * 300; ++id)
            ASSERT_TRUE(seen[id]) << id;
    }
}

// A handle that ends gives the file back; a second one meanwhile is turned away.
TEST(TierFile, IsOpenOnce) {
    const Folder folder;
    locus_cold *first = nullptr;
    const locus_cold_options options = cold_options();
    ASSERT_EQ(locus_cold_open(folder.file().c_str(), &options, &first), LOCUS_OK);
    EXPECT_EQ(open_status(folder.file()), LOCUS_E_BUSY);
    locus_cold_close(first);
    EXPECT_EQ(open_status(folder.file()), LOCUS_OK) << locus_cold_last_error();
}

} // namespace
} // namespace locus::test
