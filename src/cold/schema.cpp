// The tables.
#include "cold/schema.hpp"

#include <locus/cold.h>

namespace locus::cold {
namespace {

constexpr int64_t application_id = 0x4C434C44, schema_version = 1; // locus/cold.h
constexpr int page_size = 16384;

void create(Database &database, uint32_t record) {
    database.execute("PRAGMA page_size = " + std::to_string(page_size));
    database.execute("PRAGMA auto_vacuum = INCREMENTAL");
    database.execute("PRAGMA journal_mode = WAL");
    Transaction transaction(database, Transaction::Kind::write);
    database.execute("CREATE TABLE tier(name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;"
                     "CREATE TABLE runs(first INTEGER PRIMARY KEY, end INTEGER NOT NULL,"
                     " records INTEGER NOT NULL, oldest INTEGER NOT NULL, youngest INTEGER NOT NULL,"
                     " lowest INTEGER NOT NULL, highest INTEGER NOT NULL, cleared INTEGER NOT NULL)");
    database.execute("INSERT INTO tier VALUES('record', " + std::to_string(record) + ")");
    database.execute("PRAGMA application_id = " + std::to_string(application_id));
    database.execute("PRAGMA user_version = " + std::to_string(schema_version));
    write_state(database, {});
    transaction.commit();
}

int64_t figure(const Database &database, const char *name) {
    return database.number(std::string("SELECT value FROM tier WHERE name = '") + name + "'");
}

void check(const Database &database, const std::string &path, uint32_t record) {
    const int64_t version = database.number("PRAGMA user_version");
    if (version != schema_version)
        fail(LOCUS_E_FORMAT, path, ": schema version ", version, ", not ", schema_version);
    const int64_t layout = figure(database, "record");
    if (layout != LOCUS_RECORD_POINT32 && layout != LOCUS_RECORD_TEXT156)
        fail(LOCUS_E_FORMAT, path, ": record layout ", layout, ", not a LOCUS_RECORD_");
    require(layout == record, path, " holds records of ", layout, " bytes, options.record is ", record);
    uint64_t end = 0;
    const uint64_t written = read_state(database).written;
    for (const Run &run : read_runs(database)) {
        if (run.first < end || run.end < run.first || run.end > written || run.records > run.end - run.first)
            fail(LOCUS_E_FORMAT, path, ": a run is of ", run.records, " records ", run.first, "..", run.end,
                 ", behind ", end, " and up to ", written);
        end = run.end;
        database.prepare("SELECT key, arrival, record FROM " + run.table());
    }
}

} // namespace

int64_t cutoff_at(int64_t now, int64_t max_age) noexcept {
    int64_t cutoff;
    if (max_age == LOCUS_NO_HORIZON || now == INT64_MIN || __builtin_sub_overflow(now, max_age, &cutoff))
        return INT64_MIN;
    return cutoff;
}

void prepare(Database &database, const std::string &path, uint32_t record) {
    const int64_t application = database.number("PRAGMA application_id");
    const bool empty = application == 0 && database.number("SELECT count(*) FROM sqlite_schema") == 0;
    if (empty) {
        create(database, record);
        return;
    }
    if (application != application_id)
        fail(LOCUS_E_FORMAT, path, ": an SQLite database, but no cold tier: application id ", application, ", not ",
             application_id);
    check(database, path, record);
    database.execute("PRAGMA journal_mode = WAL");
}

State read_state(const Database &database) {
    State state;
    state.written = static_cast<uint64_t>(figure(database, "written"));
    state.removed = static_cast<uint64_t>(figure(database, "removed"));
    state.now = figure(database, "now");
    return state;
}

void write_state(Database &database, const State &state) {
    Statement write =
        database.prepare("INSERT OR REPLACE INTO tier VALUES('written', ?1), ('removed', ?2), ('now', ?3)");
    write.bind(1, static_cast<int64_t>(state.written)).bind(2, static_cast<int64_t>(state.removed)).bind(3, state.now);
    write.run();
}

std::vector<Run> read_runs(const Database &database) {
    std::vector<Run> runs;
    Statement read = database.prepare(
        "SELECT first, end, records, oldest, youngest, lowest, highest, cleared FROM runs ORDER BY first");
    while (read.step()) {
        Run run;
        run.first = static_cast<uint64_t>(read.number(0));
        run.end = static_cast<uint64_t>(read.number(1));
        run.records = static_cast<uint64_t>(read.number(2));
        run.oldest = read.number(3);
        run.youngest = read.number(4);
        run.lowest = static_cast<uint64_t>(read.number(5));
        run.highest = static_cast<uint64_t>(read.number(6));
        run.cleared = read.number(7);
        runs.push_back(run);
    }
    return runs;
}

void create_run(Database &database, const Run &run) {
    database.execute("CREATE TABLE " + run.table() +
                     "(key INTEGER NOT NULL, arrival INTEGER NOT NULL, record BLOB NOT NULL,"
                     " PRIMARY KEY(key, arrival)) WITHOUT ROWID");
}

void write_run(Database &database, const Run &run) {
    Statement write = database.prepare("INSERT OR REPLACE INTO runs VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
    write.bind(1, static_cast<int64_t>(run.first)).bind(2, static_cast<int64_t>(run.end));
    write.bind(3, static_cast<int64_t>(run.records)).bind(4, run.oldest).bind(5, run.youngest);
    write.bind(6, static_cast<int64_t>(run.lowest)).bind(7, static_cast<int64_t>(run.highest)).bind(8, run.cleared);
    write.run();
}

void drop_run(Database &database, const Run &run) {
    database.execute("DELETE FROM runs WHERE first = " + std::to_string(run.first));
    database.execute("DROP TABLE " + run.table());
}

} // namespace locus::cold
