// libFuzzer target: any bytes through the record readers. The first two bytes choose the options.
// Build: clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -Iinclude -Isrc tests/fuzz/records_fuzz.cpp
// src/io/*.cpp ...
#include <locus/records.h>

#include <cmath>
#include <cstdlib>
#include <sys/mman.h>
#include <unistd.h>

namespace {

void expect(bool good) {
    if (!good)
        std::abort();
}

void check(const locus_text156 &record) {
    expect(std::fabs(record.latitude) <= 90 && std::fabs(record.longitude) <= 180);
    bool ended = false; // padded with NUL, none before the end
    for (const char c : record.text) {
        expect(!ended || c == '\0');
        ended = ended || c == '\0';
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < 2)
        return 0;
    static const int fd = memfd_create("fuzz", 0);
    expect(ftruncate(fd, 0) == 0);
    expect(pwrite(fd, data + 2, size - 2, 0) == static_cast<ssize_t>(size - 2));
    lseek(fd, 0, SEEK_SET);

    locus_records_options options;
    expect(locus_records_options_init(&options, sizeof options) == LOCUS_OK);
    options.format = data[0] % 3u;
    options.time_unit = data[0] / 3u % 5u;
    options.bad_lines = data[0] / 15u % 2u;
    options.max_line = 64 + data[1];
    locus_records *reader = nullptr;
    expect(locus_records_open_fd(fd, "fuzz", &options, &reader) == LOCUS_OK);
    locus_text156 records[5];
    size_t count = 1;
    uint64_t total = 0;
    while (locus_records_next(reader, records, 5, &count) == LOCUS_OK && count > 0) {
        for (size_t i = 0; i < count; ++i)
            check(records[i]);
        total += count;
    }
    locus_records_stats stats{};
    stats.struct_size = sizeof stats;
    expect(locus_records_get_stats(reader, &stats) == LOCUS_OK);
    expect(stats.records == total && stats.records + stats.bad <= stats.line + 1);
    locus_records_close(reader);
    return 0;
}
