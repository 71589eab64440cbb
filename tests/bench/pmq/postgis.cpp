// Peer: PostGIS, a cluster of its own in a scratch folder, reached through a socket there; writes need not reach the
// disk.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/databases.hpp"

#if __has_include(<postgresql/libpq-fe.h>)
#include "tests/bench/harness/scratch.hpp"
#include "tests/bench/harness/server.hpp"

#include <postgresql/libpq-fe.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>
#include <unistd.h>

namespace bench {
namespace {

constexpr const char *programs = "/usr/lib/postgresql/15/bin/";

/// An empty cluster in a scratch folder, made as the user postgres where we are root (the server refuses to be root).
class ClusterFiles {
public:
    ClusterFiles() {
        std::string command = "cd / && ";
        if (geteuid() == 0) {
            command = "chown postgres " + folder() + " && cd / && ";
        }
        for (const std::string &word : as_user("postgres")) {
            command += word + " ";
        }
        command += std::string(programs) + "initdb -A trust -U bench -D " + data() + " >/dev/null 2>&1";
        if (std::system(command.c_str()) != 0) {
            throw Missing("PostgreSQL's initdb fails");
        }
    }
    std::string folder() const { return scratch_.path().string(); }
    std::string data() const { return folder() + "/data"; }

private:
    Scratch scratch_;
};

std::vector<std::string> server_command(const ClusterFiles &files) {
    std::vector<std::string> words = as_user("postgres");
    words.insert(words.end(), {std::string(programs) + "postgres", "-D", files.data()});
    for (const std::string &setting : {std::string("listen_addresses="), "unix_socket_directories=" + files.folder(),
                                       std::string("fsync=off"), std::string("synchronous_commit=off"),
                                       std::string("full_page_writes=off"), std::string("shared_buffers=512MB")}) {
        words.insert(words.end(), {"-c", setting});
    }
    return words;
}

class PostGis final : public Database {
public:
    PostGis() : server_(server_command(files_)), connection_(connect()) {
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

    PGconn *connect() const {
        const std::string where = "host=" + files_.folder() + " user=bench dbname=postgres";
        for (int attempt = 0; attempt < 200 && PQping(where.c_str()) != PQPING_OK; ++attempt) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return PQconnectdb(where.c_str());
    }
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

    ClusterFiles files_;
    Server server_;
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
