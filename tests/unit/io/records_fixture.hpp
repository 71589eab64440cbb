// Reading records from a text in memory, for the tests of the readers.
#pragma once

#include <locus/records.h>

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace records_test {

struct Result {
    locus_status status = LOCUS_OK;
    std::string error;
    std::vector<locus_text156> records;
    std::vector<std::pair<uint64_t, std::string>> bad; // line and reason
    locus_records_stats stats{};
};

inline std::string text_of(const locus_text156 &record) {
    return {record.text, std::find(record.text, record.text + sizeof record.text, '\0')};
}

// By value: the member may lie at a multiple of 4 only, where a reference must not point.
inline int64_t when(const locus_text156 &record) { return record.time; }

inline locus_records_options usual_options() {
    locus_records_options options;
    EXPECT_EQ(locus_records_options_init(&options, sizeof options), LOCUS_OK);
    return options;
}

inline void keep_bad_line(uint64_t line, const char *reason, void *user) {
    static_cast<Result *>(user)->bad.emplace_back(line, reason);
}

// Everything a reader gives, taken in batches of `batch`; stops at the first failed call.
inline Result read_fd(int fd, locus_records_options options, size_t batch) {
    Result result;
    options.bad_line = keep_bad_line;
    options.bad_line_user = &result;
    locus_records *reader = nullptr;
    result.status = locus_records_open_fd(fd, "input", &options, &reader);
    std::vector<locus_text156> records(batch);
    for (size_t count = 1; result.status == LOCUS_OK && count > 0;) {
        result.status = locus_records_next(reader, records.data(), batch, &count);
        result.records.insert(result.records.end(), records.begin(), records.begin() + static_cast<long>(count));
    }
    if (result.status != LOCUS_OK)
        result.error = locus_io_last_error();
    result.stats.struct_size = sizeof result.stats;
    if (reader != nullptr) {
        EXPECT_EQ(locus_records_get_stats(reader, &result.stats), LOCUS_OK);
    }
    locus_records_close(reader);
    return result;
}

inline Result read_text(std::string_view text, const locus_records_options &options = usual_options(),
                        size_t batch = 3) {
    const int fd = memfd_create("records", MFD_CLOEXEC);
    EXPECT_EQ(write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    lseek(fd, 0, SEEK_SET);
    Result result = read_fd(fd, options, batch);
    close(fd);
    return result;
}

} // namespace records_test
