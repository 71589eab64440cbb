// Times, compression, pipes and arguments of the record readers.
#include "tests/unit/io/records_fixture.hpp"

#include <cerrno>
#include <fcntl.h>
#include <random>
#include <thread>
#include <zstd.h>

namespace {

using namespace records_test;

std::string zstd(std::string_view text) {
    std::string out(ZSTD_compressBound(text.size()), '\0');
    out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 3));
    return out;
}

int64_t time_of(const std::string &text, uint32_t unit = LOCUS_TIME_AUTO) {
    locus_records_options options = usual_options();
    options.time_unit = unit;
    options.separator = ';';
    const Result result = read_text("time;lat;lon\n" + text + ";1;2\n", options);
    return result.records.empty() ? INT64_MIN : result.records[0].time;
}

TEST(RecordTimes, UnitsOfNumbers) {
    EXPECT_EQ(time_of("1211068800"), 1211068800'000'000);
    EXPECT_EQ(time_of("1211068800.25"), 1211068800'250'000);
    EXPECT_EQ(time_of("1211068800123"), 1211068800'123'000);
    EXPECT_EQ(time_of("1211068800123456"), 1211068800'123'456);
    EXPECT_EQ(time_of("1211068800123456789"), 1211068800'123'456);
    EXPECT_EQ(time_of("-5"), -5'000'000);
    EXPECT_EQ(time_of("7", LOCUS_TIME_MILLISECONDS), 7000);
    EXPECT_EQ(time_of("7", LOCUS_TIME_MICROSECONDS), 7);
    EXPECT_EQ(time_of("-1", LOCUS_TIME_NANOSECONDS), -1);
    EXPECT_EQ(time_of("9223372036854", LOCUS_TIME_SECONDS), 9223372036854'000'000);
    EXPECT_EQ(time_of("9223372036855", LOCUS_TIME_SECONDS), INT64_MIN);
    EXPECT_EQ(time_of("inf"), INT64_MIN);
    EXPECT_EQ(time_of("nan"), INT64_MIN);
}

TEST(RecordTimes, TheFirstNumberDecidesForAll) {
    const Result result = read_text("time,lat,lon\n1211068800123,1,2\n5,1,2\n");
    ASSERT_EQ(result.records.size(), 2u);
    EXPECT_EQ(when(result.records[1]), 5000);
}

TEST(RecordTimes, Iso8601) {
    constexpr int64_t noon = 1211112000'000'000; // 2008-05-18T12:00:00Z
    for (const char *text : {"2008-05-18T12:00:00Z", "2008-05-18 12:00:00", "2008-05-18T12:00",
                             "2008-05-18T14:00:00+02:00", "2008-05-18T14:00:00+0200", "2008-05-18T06:30-05:30",
                             "2008-05-18 12:00:00.000 +00", "2008-05-18T12:00:00.0000000000Z"})
        EXPECT_EQ(time_of(text), noon) << text;
    EXPECT_EQ(time_of("2008-05-18T12:00:00.123456789Z"), noon + 123'456);
    EXPECT_EQ(time_of("2008-05-18"), noon - 43'200'000'000);
    EXPECT_EQ(time_of("1969-12-31T23:59:59Z"), -1'000'000);
    EXPECT_EQ(time_of("2008-02-29"), 1204243200'000'000);
    for (const char *text :
         {"2008-05-32", "2009-02-29", "2008-13-01", "2008-05-18T25:00", "2008-05-18T12:61", "2008-05-18T",
          "2008-05-18T12", "2008-05-18T12:00:00.", "2008-05-18T12:00:00+1", "2008-5-18", "2008-05-18x"})
        EXPECT_EQ(time_of(text), INT64_MIN) << text;
}

std::string many_rows(int count) {
    std::string text = "time,lat,lon,text\n";
    std::mt19937 random(7);
    for (int i = 0; i < count; ++i)
        text += std::to_string(i) + ",1,2,\"row, " + std::string(random() % 90, 'x') + (i % 7 == 0 ? "\n" : " ") +
                std::to_string(i) + "\"\n";
    return text;
}

void expect_many(const Result &result, size_t count) {
    EXPECT_EQ(result.status, LOCUS_OK) << result.error;
    EXPECT_TRUE(result.bad.empty());
    ASSERT_EQ(result.records.size(), count);
    for (size_t i = 0; i < count; ++i) {
        ASSERT_EQ(when(result.records[i]), static_cast<int64_t>(i) * 1'000'000);
        ASSERT_TRUE(text_of(result.records[i]).ends_with(std::to_string(i)));
    }
}

TEST(RecordInput, BufferBoundariesDoNotShow) {
    locus_records_options options = usual_options();
    options.max_line = 256;
    expect_many(read_text(many_rows(20'000), options, 1), 20'000);
}

TEST(RecordInput, ZstdInSeveralFrames) {
    const std::string text = many_rows(20'000);
    const std::string packed = zstd(text.substr(0, 1000)) + zstd("") + zstd(text.substr(1000));
    const Result result = read_text(packed, usual_options(), 1000);
    expect_many(result, 20'000);
    EXPECT_EQ(result.stats.bytes_read, packed.size());
}

TEST(RecordInput, BrokenCompression) {
    const std::string packed = zstd(many_rows(20'000));
    const Result cut = read_text(packed.substr(0, packed.size() / 2), usual_options(), 100);
    EXPECT_EQ(cut.status, LOCUS_E_FORMAT);
    EXPECT_FALSE(cut.records.empty()); // what was read before is not lost
    EXPECT_NE(cut.error.find("ends inside a frame"), std::string::npos) << cut.error;
    const Result junk = read_text(packed + "junk behind the end", usual_options(), 100);
    EXPECT_EQ(junk.status, LOCUS_E_FORMAT);
    EXPECT_EQ(junk.records.size(), 20'000u);
    EXPECT_EQ(read_text("\x1f\x8b\x08 gzip").status, LOCUS_E_FORMAT);
}

TEST(RecordInput, APipeHandsOutWhatItHas) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    locus_records *reader = nullptr;
    ASSERT_EQ(locus_records_open_fd(ends[0], "pipe", nullptr, &reader), LOCUS_OK);
    const std::string_view first = "time,lat,lon\n1,2,3\n4,5,6\n7,8";
    ASSERT_EQ(write(ends[1], first.data(), first.size()), static_cast<ssize_t>(first.size()));
    locus_text156 records[8];
    size_t count = 0;
    EXPECT_EQ(locus_records_next(reader, records, 8, &count), LOCUS_OK);
    EXPECT_EQ(count, 2u);
    std::thread writer([&] {
        for (const char c : std::string_view(",9\n10,11,12"))
            EXPECT_EQ(write(ends[1], &c, 1), 1);
        close(ends[1]);
    });
    size_t total = count;
    while (locus_records_next(reader, records, 8, &count) == LOCUS_OK && count > 0)
        total += count;
    EXPECT_EQ(total, 4u);
    writer.join();
    locus_records_close(reader);
    close(ends[0]);
}

TEST(RecordInput, ArgumentsAndFiles) {
    locus_records *reader = nullptr;
    EXPECT_EQ(locus_records_open("/nowhere/at/all.csv", nullptr, &reader), LOCUS_E_IO);
    EXPECT_STREQ(locus_io_last_error(),
                 "locus_records_open: cannot open /nowhere/at/all.csv: No such file or directory");
    EXPECT_EQ(reader, nullptr);
    EXPECT_EQ(locus_records_open("/tmp", nullptr, &reader), LOCUS_E_IO);
    EXPECT_EQ(locus_records_open(nullptr, nullptr, &reader), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_open("x", nullptr, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_open_fd(-1, "x", nullptr, &reader), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_open_fd(9999, "x", nullptr, &reader), LOCUS_E_IO);
    EXPECT_EQ(locus_records_open_fd(0, nullptr, nullptr, &reader), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_options_init(nullptr, 80), LOCUS_E_ARGUMENT);
    locus_records_close(nullptr);

    const auto refused = [&](auto change) {
        locus_records_options options = usual_options();
        change(options);
        return locus_records_open("/dev/null", &options, &reader) == LOCUS_E_ARGUMENT && reader == nullptr;
    };
    EXPECT_TRUE(refused([](auto &o) { o.record = 33; }));
    EXPECT_TRUE(refused([](auto &o) { o.format = 3; }));
    EXPECT_TRUE(refused([](auto &o) { o.time_unit = 5; }));
    EXPECT_TRUE(refused([](auto &o) { o.bad_lines = 2; }));
    EXPECT_TRUE(refused([](auto &o) { o.separator = '"'; }));
    EXPECT_TRUE(refused([](auto &o) { o.separator = 0; }));
    EXPECT_TRUE(refused([](auto &o) { o.max_line = 63; }));
    EXPECT_TRUE(refused([](auto &o) { o.struct_size = 8; }));

    ASSERT_EQ(locus_records_open("/dev/null", nullptr, &reader), LOCUS_OK);
    locus_text156 record;
    size_t count = 1;
    EXPECT_EQ(locus_records_next(reader, &record, 0, &count), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_next(reader, nullptr, 1, &count), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_next(nullptr, &record, 1, &count), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_next(reader, &record, 1, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_get_stats(reader, nullptr), LOCUS_E_ARGUMENT);
    EXPECT_EQ(locus_records_next(reader, &record, 1, &count), LOCUS_OK);
    EXPECT_EQ(count, 0u);
    locus_records_close(reader);
}

} // namespace
