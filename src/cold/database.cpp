// What SQLite reports, as statuses; connections as the tier wants them.
#include "cold/database.hpp"

#include <cstring>
#include <new>

namespace locus::cold {
namespace {

locus_status status_of(int code) noexcept {
    switch (code & 0xFF) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
    case SQLITE_ERROR: // a table or a column that should be there
    case SQLITE_MISMATCH:
    case SQLITE_CONSTRAINT:
    case SQLITE_TOOBIG:
        return LOCUS_E_FORMAT;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return LOCUS_E_BUSY;
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
    case SQLITE_PROTOCOL:
    case SQLITE_NOLFS:
        return LOCUS_E_IO;
    default:
        return LOCUS_E_INTERNAL;
    }
}

[[noreturn]] void fail_with(sqlite3 *connection, int code, std::string path = {}) {
    if ((code & 0xFF) == SQLITE_NOMEM || code == SQLITE_IOERR_NOMEM || connection == nullptr)
        throw std::bad_alloc();
    const int reason = sqlite3_system_errno(connection);
    const locus_status status = status_of(code);
    const bool of_the_system = status == LOCUS_E_IO && reason != 0;
    const char *file = sqlite3_db_filename(connection, "main");
    if (path.empty() && file != nullptr)
        path = file;
    fail(status, path, ": ", sqlite3_errmsg(connection), of_the_system ? ": " : "",
         of_the_system ? std::strerror(reason) : "");
}

} // namespace

Statement::Statement(sqlite3 *connection, const std::string &sql) {
    sqlite3_stmt *statement = nullptr;
    const int code = sqlite3_prepare_v3(connection, sql.c_str(), static_cast<int>(sql.size() + 1),
                                        SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
    handle_.reset(statement);
    if (code != SQLITE_OK)
        fail_with(connection, code);
}

Statement &Statement::bind(int parameter, int64_t value) {
    if (const int code = sqlite3_bind_int64(handle_.get(), parameter, value); code != SQLITE_OK)
        fail_with(sqlite3_db_handle(handle_.get()), code);
    return *this;
}

Statement &Statement::bind(int parameter, const std::byte *bytes, size_t size) {
    const int code = sqlite3_bind_blob64(handle_.get(), parameter, bytes, size, SQLITE_STATIC);
    if (code != SQLITE_OK)
        fail_with(sqlite3_db_handle(handle_.get()), code);
    return *this;
}

bool Statement::step() {
    const int code = sqlite3_step(handle_.get());
    if (code == SQLITE_ROW)
        return true;
    if (code == SQLITE_DONE)
        return false;
    try {
        fail_with(sqlite3_db_handle(handle_.get()), code);
    } catch (...) {
        reset();
        throw;
    }
}

void Statement::run() {
    step();
    reset();
}

std::string Statement::text(int column) const {
    const auto *text = reinterpret_cast<const char *>(sqlite3_column_text(handle_.get(), column));
    return text ? text : "";
}

const std::byte *Statement::bytes(int column, size_t size) const noexcept {
    const void *bytes = sqlite3_column_blob(handle_.get(), column);
    return static_cast<size_t>(sqlite3_column_bytes(handle_.get(), column)) == size
               ? static_cast<const std::byte *>(bytes)
               : nullptr;
}

Database::Database(const std::string &path, Mode mode, uint64_t cache_bytes) {
    const int flags = mode == Mode::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READWRITE;
    sqlite3 *connection = nullptr;
    const int code =
        sqlite3_open_v2(path.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, nullptr);
    handle_.reset(connection);
    if (code != SQLITE_OK)
        fail_with(connection, code, path);
    if (sqlite3_db_readonly(connection, "main") == 1)
        fail(LOCUS_E_IO, path, ": the file is not to be written");
    sqlite3_busy_timeout(connection, 10000);
    // A file from elsewhere must not bring code along.
    sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    execute("PRAGMA cell_size_check = ON");
    execute("PRAGMA cache_size = -" + std::to_string(cache_bytes >> 10));
    if (mode == Mode::read)
        execute("PRAGMA query_only = ON");
}

void Database::execute(const char *sql) {
    if (const int code = sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr); code != SQLITE_OK)
        fail_with(handle_.get(), code);
}

int64_t Database::number(const std::string &sql) const {
    Statement statement = prepare(sql);
    if (!statement.step())
        fail(LOCUS_E_FORMAT, sqlite3_db_filename(handle_.get(), "main"), ": nothing for ", sql);
    return statement.number(0);
}

Transaction::Transaction(Database &database, Kind kind) : database_(database) {
    database_.execute(kind == Kind::write ? "BEGIN IMMEDIATE" : "BEGIN");
}

Transaction::~Transaction() {
    if (!open_)
        return;
    try {
        database_.execute("ROLLBACK");
    } catch (...) { // SQLite has rolled back already
    }
}

void Transaction::commit() {
    database_.execute("COMMIT");
    open_ = false;
}

} // namespace locus::cold
