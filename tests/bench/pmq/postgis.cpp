// Peer: PostGIS, a cluster of its own in a scratch folder, reached through a socket there; writes need not reach the
// disk.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/databases.hpp"

#if __has_include(<postgresql/libpq-fe.h>)
#include "tests/bench/harness/scratch.hpp"

#include <postgresql/libpq-fe.h>

#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace bench {
namespace {

constexpr const char *programs = "/usr/lib/postgresql/15/bin/";

/// Run a shell command, as the user postgres where we are root (the server refuses to be root).
int run(const std::string &command) {
    const std::string prefix = geteuid() == 0 ? "runuser -u postgres -- " : "";
    return std::system(("cd / && " + prefix + command + " >/dev/null 2>&1").c_str());
}

/// A cluster, made, started, stopped and removed with the object.
class Cluster {
public:
    Cluster() : folder_(scratch_.path().string()), data_(folder_ + "/data") {
        if (geteuid() == 0 && std::system(("chown postgres " + folder_).c_str()) != 0) {
            throw Missing("there is no user postgres");
        }
        const std::string settings = "-c listen_addresses= -c unix_socket_directories=" + folder_ +
                                     " -c fsync=off -c synchronous_commit=off -c full_page_writes=off"
                                     " -c shared_buffers=512MB";
        if (run(std::string(programs) + "initdb -A trust -U bench -D " + data_) != 0 ||
            run(std::string(programs) + "pg_ctl -w -D " + data_ + " -o \"" + settings + "\" start") != 0) {
            throw Missing("PostgreSQL does not start");
        }
    }
    Cluster(const Cluster &) = delete;
    Cluster &operator=(const Cluster &) = delete;
    ~Cluster() { run(std::string(programs) + "pg_ctl -w -m immediate -D " + data_ + " stop"); }

    PGconn *connect() const { return PQconnectdb(("host=" + folder_ + " user=bench dbname=postgres").c_str()); }

private:
    Scratch scratch_;
    std::string folder_, data_;
};

class PostGis final : public Database {
public:
    PostGis() : connection_(cluster_.connect()) {
        execute("CREATE EXTENSION postgis", PGRES_COMMAND_OK);
        execute("CREATE UNLOGGED TABLE posts(record bytea, place geometry(Point, 4326))", PGRES_COMMAND_OK);
        execute("CREATE INDEX ON posts USING gist(place)", PGRES_COMMAND_OK);
    }

    /// One COPY a batch.
    void insert(std::span<const locus_point32> batch) override {
        execute("COPY posts FROM STDIN", PGRES_COPY_IN);
        std::string lines;
        for (const locus_point32 &record : batch) {
            lines += "\\\\x";
            const auto *bytes = reinterpret_cast<const unsigned char *>(&record);
            for (std::size_t i = 0; i < sizeof record; ++i) {
                lines += "0123456789abcdef"[bytes[i] >> 4];
                lines += "0123456789abcdef"[bytes[i] & 15];
            }
            char place[80];
            std::snprintf(place, sizeof place, "\tSRID=4326;POINT(%.9f %.9f)\n", record.longitude, record.latitude);
            lines += place;
        }
        if (PQputCopyData(connection_.get(), lines.data(), static_cast<int>(lines.size())) != 1 ||
            PQputCopyEnd(connection_.get(), nullptr) != 1) {
            fail();
        }
        expect(Result(PQgetResult(connection_.get())), PGRES_COMMAND_OK);
        while (Result(PQgetResult(connection_.get()))) {
        }
    }

    std::size_t read_all(std::span<locus_point32> out) override {
        const Result result(
            PQexecParams(connection_.get(), "SELECT record FROM posts", 0, nullptr, nullptr, nullptr, nullptr, 1));
        expect(result, PGRES_TUPLES_OK);
        const int found = PQntuples(result.get());
        for (int i = 0; i < found; ++i) {
            std::memcpy(&out[static_cast<std::size_t>(i)], PQgetvalue(result.get(), i, 0), sizeof(locus_point32));
        }
        return static_cast<std::size_t>(found);
    }

private:
    struct Free {
        void operator()(PGconn *connection) const { PQfinish(connection); }
        void operator()(PGresult *result) const { PQclear(result); }
    };
    using Result = std::unique_ptr<PGresult, Free>;

    [[noreturn]] void fail() const {
        throw std::runtime_error(std::string("PostgreSQL: ") + PQerrorMessage(connection_.get()));
    }
    void expect(const Result &result, ExecStatusType status) const {
        if (PQresultStatus(result.get()) != status) {
            fail();
        }
    }
    void execute(const char *sql, ExecStatusType status) const {
        expect(Result(PQexec(connection_.get(), sql)), status);
    }

    Cluster cluster_;
    std::unique_ptr<PGconn, Free> connection_;
};

} // namespace

std::unique_ptr<Database> make_postgis() {
    if (access((std::string(programs) + "initdb").c_str(), X_OK) != 0) {
        throw Missing(std::string(programs) + "initdb is not there");
    }
    return std::make_unique<PostGis>();
}

} // namespace bench
#else
namespace bench {
std::unique_ptr<Database> make_postgis() { throw Missing("built without libpq-fe.h"); }
} // namespace bench
#endif
