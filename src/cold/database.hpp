// SQLite's connections and statements, with its errors as Locus' own.
#pragma once

#include "core/error.hpp"

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace locus::cold {

class Statement {
public:
    Statement() = default;
    Statement(sqlite3 *connection, const std::string &sql);

    Statement &bind(int parameter, int64_t value);
    Statement &bind(int parameter, const std::byte *bytes, size_t size); // not copied: until the next reset
    bool step();                                                         // false: no more rows
    void run();                                                          // one that has no rows
    void reset() noexcept { sqlite3_reset(handle_.get()); }
    int64_t number(int column) const noexcept { return sqlite3_column_int64(handle_.get(), column); }
    std::string text(int column) const;
    // The bytes of a column, valid until the next step; nullptr unless there are exactly `size`.
    const std::byte *bytes(int column, size_t size) const noexcept;

private:
    struct Finalize {
        void operator()(sqlite3_stmt *statement) const noexcept { sqlite3_finalize(statement); }
    };
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

class Database {
public:
    enum class Mode { write, read };
    Database(const std::string &path, Mode mode, uint64_t cache_bytes);

    void execute(const char *sql);
    void execute(const std::string &sql) { execute(sql.c_str()); }
    Statement prepare(const std::string &sql) const { return Statement(handle_.get(), sql); }
    int64_t number(const std::string &sql) const; // of a query's one row

private:
    struct Close {
        void operator()(sqlite3 *connection) const noexcept { sqlite3_close_v2(connection); }
    };
    std::unique_ptr<sqlite3, Close> handle_;
};

// Rolled back unless committed.
class Transaction {
public:
    enum class Kind { read, write };
    Transaction(Database &database, Kind kind);
    ~Transaction();
    Transaction(const Transaction &) = delete;
    Transaction &operator=(const Transaction &) = delete;
    void commit();

private:
    Database &database_;
    bool open_ = true;
};

} // namespace locus::cold
