// Peers: SQLite's R-tree module and SpatiaLite, both in memory, one transaction a batch.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/databases.hpp"

#if __has_include(<sqlite3.h>)
#include <sqlite3.h>

#include <cstring>

namespace bench {
namespace {

class Sqlite final : public Database {
public:
    /// Run the statements of `schema`; `insert` binds longitude, latitude and record; `read` returns records.
    Sqlite(bool spatialite, const std::string &schema, const char *insert, const char *read) {
        sqlite3 *db = nullptr;
        check(sqlite3_open(":memory:", &db), db);
        db_.reset(db);
        if (spatialite) {
            load_spatialite();
        }
        execute(schema.c_str());
        insert_ = prepare(insert);
        read_ = prepare(read);
    }

    void insert(std::span<const locus_point32> batch) override {
        execute("BEGIN");
        for (const locus_point32 &record : batch) {
            sqlite3_bind_double(insert_.get(), 1, record.longitude);
            sqlite3_bind_double(insert_.get(), 2, record.latitude);
            sqlite3_bind_blob(insert_.get(), 3, &record, sizeof record, SQLITE_STATIC);
            check(sqlite3_step(insert_.get()), db_.get());
            sqlite3_reset(insert_.get());
        }
        execute("COMMIT");
    }

    std::size_t read_all(std::span<locus_point32> out) override {
        std::size_t found = 0;
        while (sqlite3_step(read_.get()) == SQLITE_ROW) {
            std::memcpy(&out[found++], sqlite3_column_blob(read_.get(), 0), sizeof(locus_point32));
        }
        sqlite3_reset(read_.get());
        return found;
    }

private:
    struct Close {
        void operator()(sqlite3 *db) const { sqlite3_close(db); }
        void operator()(sqlite3_stmt *statement) const { sqlite3_finalize(statement); }
    };

    static void check(int code, sqlite3 *db) {
        if (code != SQLITE_OK && code != SQLITE_DONE && code != SQLITE_ROW) {
            throw std::runtime_error(std::string("SQLite: ") + sqlite3_errmsg(db));
        }
    }
    void load_spatialite() {
        sqlite3_enable_load_extension(db_.get(), 1);
        if (sqlite3_load_extension(db_.get(), "mod_spatialite", nullptr, nullptr) != SQLITE_OK) {
            throw Missing("mod_spatialite is not there");
        }
        execute("SELECT InitSpatialMetaData(1)");
    }
    void execute(const char *sql) { check(sqlite3_exec(db_.get(), sql, nullptr, nullptr, nullptr), db_.get()); }
    std::unique_ptr<sqlite3_stmt, Close> prepare(const char *sql) {
        sqlite3_stmt *statement = nullptr;
        check(sqlite3_prepare_v2(db_.get(), sql, -1, &statement, nullptr), db_.get());
        return std::unique_ptr<sqlite3_stmt, Close>(statement);
    }

    std::unique_ptr<sqlite3, Close> db_;
    std::unique_ptr<sqlite3_stmt, Close> insert_, read_;
};

} // namespace

std::unique_ptr<Database> make_sqlite_rtree() {
    return std::make_unique<Sqlite>(
        false, "CREATE VIRTUAL TABLE posts USING rtree(id, west, east, south, north, +record BLOB)",
        "INSERT INTO posts(west, east, south, north, record) VALUES(?1, ?1, ?2, ?2, ?3)", "SELECT record FROM posts");
}

std::unique_ptr<Database> make_spatialite() {
    return std::make_unique<Sqlite>(true,
                                    "CREATE TABLE posts(id INTEGER PRIMARY KEY, record BLOB);"
                                    "SELECT AddGeometryColumn('posts', 'place', 4326, 'POINT', 'XY');"
                                    "SELECT CreateSpatialIndex('posts', 'place')",
                                    "INSERT INTO posts(place, record) VALUES(MakePoint(?1, ?2, 4326), ?3)",
                                    "SELECT record FROM posts");
}

} // namespace bench
#else
namespace bench {
std::unique_ptr<Database> make_sqlite_rtree() { throw Missing("built without sqlite3.h"); }
std::unique_ptr<Database> make_spatialite() { throw Missing("built without sqlite3.h"); }
} // namespace bench
#endif
