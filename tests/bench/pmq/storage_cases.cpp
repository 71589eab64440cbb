// pmq.save.*, pmq.load.* and pmq.log.*: stores on disk, against the disk's own sequential rate in the same run: as many
// bytes written in large blocks and flushed, or read after they have left the page cache.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/harness/handles.hpp"
#include "tests/bench/harness/scratch.hpp"
#include "tests/bench/pmq/drive.hpp"

#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace bench {
namespace {

constexpr std::size_t block = 1 << 20;

class File {
public:
    File(const std::string &path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        check(number_ >= 0);
    }
    File(const File &) = delete;
    File &operator=(const File &) = delete;
    ~File() { ::close(number_); }
    void write(std::span<const char> bytes) {
        for (std::size_t done = 0; done < bytes.size(); done += block) {
            const std::size_t part = std::min(block, bytes.size() - done);
            check(::write(number_, bytes.data() + done, part) == static_cast<ssize_t>(part));
        }
    }
    void flush() { check(::fdatasync(number_) == 0); }
    void read_all() {
        std::vector<char> bytes(block);
        ssize_t got = 1;
        while (got > 0) {
            got = ::read(number_, bytes.data(), bytes.size());
        }
        check(got == 0);
    }
    /// Out of the page cache, so that the next reader comes to the disk.
    void forget() {
        flush();
        check(::posix_fadvise(number_, 0, 0, POSIX_FADV_DONTNEED) == 0);
    }

private:
    static void check(bool good) {
        if (!good) {
            throw std::runtime_error("the scratch file cannot be used");
        }
    }
    int number_;
};

Pmq ring_store() {
    locus_pmq_options options;
    need(locus_pmq_options_init(&options, sizeof options));
    return make_pmq(options);
}

std::vector<char> noise(std::size_t bytes) {
    std::vector<char> filler(bytes);
    uint64_t state = 1;
    for (char &byte : filler) {
        state = state * 6364136223846793005 + 1442695040888963407;
        byte = static_cast<char>(state >> 56);
    }
    return filler;
}

uint64_t count_of(const Pmq &pmq) {
    uint64_t count = 0;
    need(locus_pmq_count(pmq.get(), nullptr, &count));
    return count;
}

std::vector<locus_point32> all_of(const Pmq &pmq, std::size_t count) {
    std::vector<locus_point32> records(count);
    need(locus_pmq_read(pmq.get(), nullptr, records.data(), count, &count));
    return records;
}

bool same_records(const std::vector<locus_point32> &a, const std::vector<locus_point32> &b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(locus_point32)) == 0;
}

/// A store of `count` records, what saving it takes and what the disk takes for the bytes of the file.
struct Setting {
    Setting(Row &row, std::size_t count) : pmq(ring_store()) {
        const std::vector<locus_point32> records = clustered<locus_point32>(row.quick ? count / 20 : count, 1000);
        for (std::size_t i = 0; i < records.size(); i += 1000) {
            const std::size_t part = std::min<std::size_t>(1000, records.size() - i);
            need(locus_pmq_insert(pmq.get(), &records[i], part, records[i + part - 1].time));
        }
        save();
        bytes = std::filesystem::file_size(saved);
        row.extras["file_mb"] = static_cast<double>(bytes) / 1e6;
    }
    void save() const { need(locus_pmq_save(pmq.get(), nullptr, saved.c_str(), nullptr, nullptr)); }
    Pmq load() const {
        locus_pmq *loaded = nullptr;
        need(locus_pmq_load(saved.c_str(), nullptr, nullptr, nullptr, &loaded));
        return Pmq(loaded);
    }

    Scratch scratch;
    Pmq pmq;
    const std::string saved = scratch.file("saved"), plain = scratch.file("plain");
    std::uintmax_t bytes = 0;
};

/// Milliseconds of wall time: what waits for a disk is no matter of one thread's CPU time, which is noted beside.
template <class Work>
double waited(Notes &notes, Work &&work) {
    double cpu = 0;
    const double wall = timed_wall([&] { cpu = timed(work); });
    notes.add("cpu_ms", 1e3 * cpu);
    return 1e3 * wall;
}

void save_case(Row &row) {
    const Setting setting(row, 10'000'000);
    const std::vector<char> filler = noise(setting.bytes);
    race(row, {{"", [&](Notes &notes) { return waited(notes, [&] { setting.save(); }); }},
               {"disk", [&](Notes &notes) {
                    return waited(notes, [&] {
                        File file(setting.plain, O_WRONLY | O_CREAT | O_TRUNC);
                        file.write(filler);
                        file.flush();
                    });
                }}});
    const std::size_t count = count_of(setting.pmq);
    row.check(same_records(all_of(setting.load(), count), all_of(setting.pmq, count)), "the saved records");
}

void load_case(Row &row) {
    Setting setting(row, 10'000'000);
    {
        File file(setting.plain, O_WRONLY | O_CREAT | O_TRUNC);
        file.write(noise(setting.bytes));
    }
    const std::size_t count = count_of(setting.pmq);
    const std::vector<locus_point32> records = all_of(setting.pmq, count);
    setting.pmq.reset();
    race(row, {{"",
                [&, first = true](Notes &notes) mutable {
                    File(setting.saved, O_RDWR).forget();
                    Pmq loaded;
                    const double time = waited(notes, [&] { loaded = setting.load(); });
                    if (std::exchange(first, false)) {
                        row.check(same_records(all_of(loaded, count), records), "the loaded records");
                    }
                    return time;
                }},
               {"disk", [&](Notes &notes) {
                    File(setting.plain, O_RDWR).forget();
                    return waited(notes, [&] { File(setting.plain, O_RDONLY).read_all(); });
                }}});
}

/// Batches into a store with a log, against the same bytes appended to a file with the same flushes; and in the extras
/// `unlogged`, into a store without a log.
void log_case(Row &row, uint32_t sync, std::size_t batches) {
    constexpr std::size_t batch = 1000;
    const std::vector<locus_point32> records = clustered<locus_point32>(batches * batch, batch);
    const auto feed_all = [&](locus_pmq *pmq) {
        for (std::size_t i = 0; i < records.size(); i += batch) {
            need(locus_pmq_insert(pmq, &records[i], batch, records[i + batch - 1].time));
        }
    };
    locus_pmq_log_options options;
    need(locus_pmq_log_options_init(&options, sizeof options));
    options.sync = sync;
    const auto per_batch = [&](double milliseconds) { return 1e3 * milliseconds / static_cast<double>(batches); };
    race(row, {{"",
                [&, first = true](Notes &notes) mutable {
                    const Scratch scratch;
                    locus_pmq *pmq = nullptr;
                    const std::string folder = scratch.file("store");
                    need(locus_pmq_open(folder.c_str(), nullptr, &options, nullptr, nullptr, nullptr, &pmq));
                    Pmq owner(pmq);
                    const double time = per_batch(waited(notes, [&] { feed_all(pmq); }));
                    if (std::exchange(first, false)) {
                        const std::vector<locus_point32> live = all_of(owner, records.size());
                        owner.reset();
                        need(locus_pmq_open(folder.c_str(), nullptr, &options, nullptr, nullptr, nullptr, &pmq));
                        owner.reset(pmq);
                        row.check(same_records(all_of(owner, records.size()), live), "the recovered records");
                    }
                    return time;
                }},
               {"disk",
                [&](Notes &notes) {
                    const Scratch scratch;
                    File file(scratch.file("plain"), O_WRONLY | O_CREAT | O_TRUNC);
                    return per_batch(waited(notes, [&] {
                        for (std::size_t i = 0; i < records.size(); i += batch) {
                            file.write({reinterpret_cast<const char *>(&records[i]), batch * sizeof(locus_point32)});
                            if (sync == LOCUS_SYNC_BATCH) {
                                file.flush();
                            }
                        }
                    }));
                }},
               {"unlogged", [&](Notes &notes) {
                    const Pmq pmq = ring_store();
                    return per_batch(waited(notes, [&] { feed_all(pmq.get()); }));
                }}});
}

} // namespace

void add_pmq_storage(Cases &cases) {
    cases.push_back({"pmq.save.10M", "ms", {{"disk", 0.5}}, save_case});
    cases.push_back({"pmq.load.10M", "ms", {{"disk", 0.5}}, load_case});
    cases.push_back(
        {"pmq.log.b1000", "us/batch", {}, [](Row &row) { log_case(row, LOCUS_SYNC_NONE, row.quick ? 200 : 2000); }});
    cases.push_back({"pmq.log.b1000.synced", "us/batch", {{"disk", 0.5}}, [](Row &row) {
                         log_case(row, LOCUS_SYNC_BATCH, row.quick ? 20 : 200);
                     }});
}

} // namespace bench
