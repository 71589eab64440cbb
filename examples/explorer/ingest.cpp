// Newline-delimited JSON through locus/records.h.
#include "explorer/ingest.hpp"

#include "explorer/arguments.hpp"

#include <locus/records.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <sys/mman.h>
#include <unistd.h>

namespace explorer {
namespace {

constexpr size_t chunk_records = 4096;
constexpr size_t most_reasons = 10;
constexpr const char *media_type = "application/x-ndjson";

// The body as a file in memory, which is what the reader reads.
class MemoryFile {
public:
    explicit MemoryFile(const std::string &bytes) : fd_(memfd_create("ingest", MFD_CLOEXEC)) {
        size_t written = 0;
        while (fd_ >= 0 && written < bytes.size()) {
            const ssize_t count = write(fd_, bytes.data() + written, bytes.size() - written);
            if (count < 0)
                break;
            written += static_cast<size_t>(count);
        }
        if (fd_ >= 0 && written == bytes.size() && lseek(fd_, 0, SEEK_SET) == 0)
            return;
        const std::string reason = std::strerror(errno);
        if (fd_ >= 0)
            close(fd_);
        throw Failure(503, "ingest: no room for the body: " + reason);
    }
    ~MemoryFile() { close(fd_); }
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;
    int fd() const { return fd_; }

private:
    int fd_;
};

struct Close {
    void operator()(locus_records *reader) const { locus_records_close(reader); }
};

void check_reader(locus_status status) {
    if (status != LOCUS_OK)
        throw Failure(status == LOCUS_E_MEMORY ? 503 : 400, locus_io_last_error());
}

struct Reading {
    Batch records;
    std::vector<std::string> reasons; // the first ones
    uint64_t bad = 0;
};

void keep_reason(uint64_t line, const char *reason, void *user) {
    auto &reading = *static_cast<Reading *>(user);
    ++reading.bad;
    if (reading.reasons.size() < most_reasons)
        reading.reasons.push_back("line " + std::to_string(line) + ": " + reason);
}

Reading read_records(const std::string &body) {
    Reading reading;
    const MemoryFile file(body);
    locus_records_options options;
    check_reader(locus_records_options_init(&options, sizeof options));
    options.format = LOCUS_RECORDS_NDJSON;
    options.bad_line = keep_reason;
    options.bad_line_user = &reading;
    locus_records *opened = nullptr;
    check_reader(locus_records_open_fd(file.fd(), "body", &options, &opened));
    const std::unique_ptr<locus_records, Close> reader(opened);
    for (size_t found = chunk_records; found > 0;) {
        const size_t size = reading.records.size();
        reading.records.resize(size + chunk_records);
        check_reader(locus_records_next(reader.get(), reading.records.data() + size, chunk_records, &found));
        reading.records.resize(size + found);
    }
    return reading;
}

// In a time that tells nothing of where they differ.
bool same(const std::string &a, const std::string &b) {
    unsigned difference = a.size() == b.size() ? 0 : 1;
    for (size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i % (b.size() + 1)]);
    return difference == 0;
}

} // namespace

Ingest::Ingest(Live &live, std::string token, bool open) : live_(live), token_(std::move(token)), open_(open) {}

void Ingest::admit(const Request &request) const {
    if (token_.empty() && !open_)
        throw Failure(403, "ingest: this address takes records only with a token, and the server has none");
    const std::string origin = request.header("origin");
    if (!origin.empty() && origin != "http://" + request.header("host"))
        throw Failure(403, "ingest: not from the site " + shown(origin));
    if (!token_.empty()) {
        const std::string given = request.header("authorization");
        if (given.empty() || !same("Bearer " + token_, given))
            throw Failure(401, given.empty() ? "ingest: a token is needed" : "ingest: not that token");
    }
    const std::string type = request.header("content-type");
    if (type.substr(0, type.find(';')) != media_type)
        throw Failure(415, "content-type: " + shown(type) + " is not " + media_type);
}

Reply Ingest::take(const Request &request) {
    Arguments arguments(request);
    const bool count_bad = arguments.word("bad_lines", {"refuse", "count"}) == 1;
    arguments.done();
    Reading reading = read_records(request.body);
    if (reading.bad > 0 && !count_bad)
        throw Failure(400,
                      reading.reasons.front() +
                          (reading.bad > 1 ? " (and " + std::to_string(reading.bad - 1) + " more bad lines)" : ""));
    const size_t stored = reading.records.size();
    if (stored > 0)
        live_.ingest(std::move(reading.records));
    Json json{{"stored", stored}, {"bad", reading.bad}};
    if (reading.bad > 0)
        json["reasons"] = reading.reasons;
    json["version"] = live_.version();
    json["now"] = live_.now() == INT64_MIN ? Json() : Json(live_.now());
    return json_reply(json);
}

} // namespace explorer
