// pmq.cold.*: what leaves a store goes into SQLite in the background; queries see both.
#include "tests/bench/harness/cases.hpp"

#if __has_include(<sqlite3.h>)
#include "tests/bench/harness/clock.hpp"
#include "tests/bench/harness/scratch.hpp"
#include "tests/bench/pmq/cover.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <locus/cold.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>

namespace bench {
namespace {

constexpr std::size_t batch = 1000;

void works(locus_status status, const char *text) {
    if (status != LOCUS_OK) {
        throw std::runtime_error(text);
    }
}

/// A store whose horizon holds `live` records of a stream, over a tier in a folder of its own.
class Tiers {
public:
    Tiers(std::span<const locus_point32> records, std::size_t live) {
        locus_pmq_options window;
        works(locus_pmq_options_init(&window, sizeof window), locus_last_error());
        window.horizon = records.back().time - records[records.size() - live].time;
        works(locus_cold_open(scratch_.file("tier.db").c_str(), nullptr, &cold_), locus_cold_last_error());
        works(locus_cold_attach(cold_, &window), locus_cold_last_error());
        works(locus_pmq_create(&window, &pmq_), locus_last_error());
    }
    Tiers(const Tiers &) = delete;
    Tiers &operator=(const Tiers &) = delete;
    ~Tiers() {
        locus_pmq_destroy(pmq_);
        locus_cold_close(cold_);
    }

    void insert(std::span<const locus_point32> records) {
        for (std::size_t i = 0; i < records.size(); i += batch) {
            const auto part = records.subspan(i, std::min(batch, records.size() - i));
            works(locus_pmq_insert(pmq_, part.data(), part.size(), part.back().time), locus_last_error());
        }
    }
    void flush() { works(locus_cold_flush(cold_), locus_cold_last_error()); }
    locus_cold_stats stats() const {
        locus_cold_stats stats{};
        stats.struct_size = sizeof stats;
        works(locus_cold_get_stats(cold_, &stats), locus_cold_last_error());
        return stats;
    }
    std::uint64_t count(const locus_pmq_query &query) const {
        std::uint64_t number = 0;
        works(locus_cold_count(cold_, pmq_, &query, &number), locus_cold_last_error());
        return number;
    }
    std::size_t read(const locus_pmq_query &query, std::span<locus_point32> out) const {
        std::size_t number = 0;
        works(locus_cold_read(cold_, pmq_, &query, out.data(), out.size(), &number), locus_cold_last_error());
        return number;
    }

private:
    Scratch scratch_;
    locus_cold *cold_ = nullptr;
    locus_pmq *pmq_ = nullptr;
};

/// The simplest tier: one clustered table, batches sorted and written by the thread that has them.
class OneTable {
public:
    explicit OneTable(const std::string &file) {
        sqlite3 *database = nullptr;
        check(sqlite3_open(file.c_str(), &database), database);
        database_.reset(database);
        execute("PRAGMA page_size = 16384; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
                "PRAGMA cache_size = -65536; CREATE TABLE records(key INTEGER, arrival INTEGER, record BLOB,"
                " PRIMARY KEY(key, arrival)) WITHOUT ROWID");
        sqlite3_stmt *statement = nullptr;
        check(sqlite3_prepare_v2(database, "INSERT INTO records VALUES(?, ?, ?)", -1, &statement, nullptr), database);
        insert_.reset(statement);
    }
    void insert(std::span<const locus_point32> records) {
        std::vector<std::pair<std::uint64_t, std::size_t>> order(records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            locus_pmq_key(records[i].latitude, records[i].longitude, &order[i].first);
            order[i].second = i;
        }
        std::sort(order.begin(), order.end());
        execute("BEGIN");
        for (const auto &[key, i] : order) {
            sqlite3_bind_int64(insert_.get(), 1, static_cast<sqlite3_int64>(key));
            sqlite3_bind_int64(insert_.get(), 2, static_cast<sqlite3_int64>(first_ + i));
            sqlite3_bind_blob(insert_.get(), 3, &records[i], sizeof records[i], SQLITE_STATIC);
            check(sqlite3_step(insert_.get()) == SQLITE_DONE ? SQLITE_OK : SQLITE_ERROR, database_.get());
            sqlite3_reset(insert_.get());
        }
        execute("COMMIT");
        first_ += records.size();
    }

private:
    struct Close {
        void operator()(sqlite3 *database) const { sqlite3_close(database); }
        void operator()(sqlite3_stmt *statement) const { sqlite3_finalize(statement); }
    };
    static void check(int code, sqlite3 *database) {
        if (code != SQLITE_OK) {
            throw std::runtime_error(std::string("SQLite: ") + sqlite3_errmsg(database));
        }
    }
    void execute(const char *sql) {
        check(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr), database_.get());
    }

    std::unique_ptr<sqlite3, Close> database_;
    std::unique_ptr<sqlite3_stmt, Close> insert_;
    std::size_t first_ = 0;
};

/// Wall and processor time of the whole process for each record that goes through the window into the file.
void ingest_case(Row &row) {
    const std::size_t live = row.quick ? 20'000 : 200'000, all = row.quick ? 300'000 : 6'000'000;
    const std::vector<locus_point32> records = clustered<locus_point32>(all, batch);
    row.threads = 2;
    const auto measured = [](Notes &notes, std::size_t number, auto &&work) {
        const double cpu = read_clock(CLOCK_PROCESS_CPUTIME_ID);
        const double seconds = timed_wall(work);
        const double per_record = (read_clock(CLOCK_PROCESS_CPUTIME_ID) - cpu) / static_cast<double>(number);
        notes.add("cpu_us", 1e6 * per_record);
        notes.add("records_per_s", static_cast<double>(number) / seconds);
        return 1e6 * seconds / static_cast<double>(number);
    };
    const auto ours = [&](Notes &notes) {
        Tiers tiers(records, live);
        const double time = measured(notes, records.size() - live, [&] {
            tiers.insert(records);
            tiers.flush();
        });
        const locus_cold_stats stats = tiers.stats();
        notes.add("bytes_per_record", static_cast<double>(stats.file_bytes) / static_cast<double>(stats.stored));
        notes.add("waits", static_cast<double>(stats.waits));
        locus_pmq_query everything;
        locus_pmq_query_init(&everything, sizeof everything);
        row.check(tiers.count(everything) == records.size(), "records are missing");
        return time;
    };
    const auto table = [&](Notes &notes) {
        constexpr std::size_t transaction = 1 << 18;
        const Scratch scratch;
        OneTable one(scratch.file("table.db"));
        const auto part = std::span(records).first(records.size() - live);
        return measured(notes, part.size(), [&] {
            for (std::size_t i = 0; i < part.size(); i += transaction) {
                one.insert(part.subspan(i, std::min(transaction, part.size() - i)));
            }
        });
    };
    race(row, {{"", ours}, {"one_table", table}});
}

/// Boxes around places drawn from the records, of which a fifth is live and the rest lies in the file.
void query_case(Row &row, double radius_km, bool read) {
    const std::size_t all = row.quick ? 200'000 : 5'000'000;
    const std::vector<locus_point32> records = clustered<locus_point32>(all, batch);
    Tiers tiers(records, all / 5);
    tiers.insert(records);
    tiers.flush();
    std::mt19937_64 random(11);
    std::vector<locus_pmq_query> queries(row.quick ? 4 : 24);
    std::vector<std::uint64_t> found(queries.size()), want(queries.size());
    for (locus_pmq_query &query : queries) {
        const locus_point32 &centre = records[random() % records.size()];
        locus_pmq_query_init(&query, sizeof query);
        query.region = LOCUS_REGION_BOX;
        query.box = box_around(centre.latitude, centre.longitude, radius_km);
    }
    std::vector<locus_point32> out(records.size());
    const auto per_query = [&](std::vector<std::uint64_t> &answers, auto &&ask) {
        const double seconds = timed([&] {
            for (std::size_t q = 0; q < queries.size(); ++q) {
                answers[q] = ask(queries[q]);
            }
        });
        return 1e6 * seconds / static_cast<double>(queries.size());
    };
    const auto ours = [&](Notes &) {
        return per_query(found, [&](const auto &query) { return read ? tiers.read(query, out) : tiers.count(query); });
    };
    const auto scan = [&](Notes &) {
        return per_query(want, [&](const auto &query) {
            std::uint64_t number = 0;
            for (const locus_point32 &record : records) {
                if (inside(query.box, record.latitude, record.longitude)) {
                    if (read) {
                        out[number] = record;
                    }
                    ++number;
                }
            }
            return number;
        });
    };
    race(row, {{"", ours}, {"scan", scan}});
    row.check(found == want, "the tiers find other numbers than a scan");
    row.extras["records_per_query"] = static_cast<double>(std::accumulate(want.begin(), want.end(), std::uint64_t{0})) /
                                      static_cast<double>(want.size());
    row.extras["runs"] = static_cast<double>(tiers.stats().runs);
}

} // namespace

void add_pmq_cold(Cases &cases) {
    cases.push_back({"pmq.cold.ingest", "us/record", {}, ingest_case});
    for (const bool read : {false, true}) {
        for (const int km : {1, 30}) {
            cases.push_back({std::string("pmq.cold.") + (read ? "read." : "count.") + std::to_string(km) + "km",
                             "us",
                             {},
                             [km, read](Row &row) { query_case(row, km, read); }});
        }
    }
}

} // namespace bench
#else
namespace bench {
void add_pmq_cold(Cases &) {}
} // namespace bench
#endif
