// CSV and NDJSON through locus/records.h.
#include "common/file_source.hpp"

#include "common/progress.hpp"

#include <stdexcept>

namespace demo {
namespace {

constexpr size_t bad_lines_shown = 10;

void check(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_io_last_error());
}

} // namespace

void FileSource::BadLines::keep(uint64_t line, const char *reason, void *user) {
    auto &first = static_cast<BadLines *>(user)->first;
    if (first.size() < bad_lines_shown)
        first.push_back("  line " + std::to_string(line) + ": " + reason);
}

FileSource::FileSource(const std::string &path, locus_records_options options) {
    options.record = LOCUS_RECORD_TEXT156;
    options.bad_line = BadLines::keep;
    options.bad_line_user = &bad_lines_;
    locus_records *reader = nullptr;
    check(path == "-" ? locus_records_open_fd(0, "standard input", &options, &reader)
                      : locus_records_open(path.c_str(), &options, &reader));
    reader_.reset(reader);
}

void FileSource::next(std::vector<locus_text156> &batch, size_t count) {
    batch.resize(count);
    size_t found = 0;
    check(locus_records_next(reader_.get(), batch.data(), count, &found));
    batch.resize(found);
}

locus_records_stats FileSource::stats() const {
    locus_records_stats stats{};
    stats.struct_size = sizeof stats;
    check(locus_records_get_stats(reader_.get(), &stats));
    return stats;
}

double FileSource::fraction() const {
    const locus_records_stats now = stats();
    return now.bytes == 0 ? -1 : static_cast<double>(now.bytes_read) / static_cast<double>(now.bytes);
}

std::vector<std::string> FileSource::remarks() const {
    const locus_records_stats all = stats();
    std::vector<std::string> lines;
    if (all.bad > 0) {
        const bool more = all.bad > bad_lines_.first.size();
        lines.push_back(with_commas(all.bad) + " bad lines left out" + (more ? ", the first of them:" : ":"));
        lines.insert(lines.end(), bad_lines_.first.begin(), bad_lines_.first.end());
    }
    if (all.cut > 0)
        lines.push_back(with_commas(all.cut) + " texts longer than 140 bytes, cut");
    if (all.repaired > 0)
        lines.push_back(with_commas(all.repaired) + " texts with bytes that are not UTF-8, replaced");
    return lines;
}

} // namespace demo
