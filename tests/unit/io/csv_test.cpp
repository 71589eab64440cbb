// Records from CSV.
#include "tests/unit/io/records_fixture.hpp"

#include <cstring>

namespace {

using namespace records_test;
using Bad = std::vector<std::pair<uint64_t, std::string>>;

TEST(Csv, PlainRows) {
    const Result result = read_text("time,lat,lon,text\n100,1.5,-2.25,hello\n101,-90,180,\n102.5,90,-180,last");
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_TRUE(result.bad.empty());
    ASSERT_EQ(result.records.size(), 3u);
    EXPECT_EQ(result.records[0].latitude, 1.5f);
    EXPECT_EQ(result.records[0].longitude, -2.25f);
    EXPECT_EQ(when(result.records[0]), 100'000'000);
    EXPECT_EQ(text_of(result.records[0]), "hello");
    EXPECT_EQ(text_of(result.records[1]), "");
    EXPECT_EQ(when(result.records[2]), 102'500'000);
    EXPECT_EQ(text_of(result.records[2]), "last");
    EXPECT_EQ(result.stats.line, 4u);
    EXPECT_EQ(result.stats.records, 3u);
    EXPECT_EQ(result.stats.bytes_read, result.stats.bytes);
}

TEST(Csv, ByteOrderMarkCarriageReturnsBlankLinesAndSpaces) {
    const Result result = read_text("\xef\xbb\xbf time , lat,lon \r\n\r\n 1 , +2 ,3\r\n   \r\n4,5,6\r\n");
    EXPECT_EQ(result.status, LOCUS_OK) << result.error;
    EXPECT_TRUE(result.bad.empty());
    ASSERT_EQ(result.records.size(), 2u);
    EXPECT_EQ(result.records[0].latitude, 2.0f);
    EXPECT_EQ(result.records[1].longitude, 6.0f);
}

TEST(Csv, QuotedFields) {
    const Result result = read_text("text,\"time\",lat,lon\n"
                                    "\"a,b\",1,2,3\n"
                                    "\"she said \"\"no\"\"\",1,2,3\n"
                                    "\"two\nlines\",1,\"2\",3\n"
                                    "5\" pipe,1,2,3\n"
                                    "\"\",1,2,3\n"
                                    "\"end\"ing,1,2,3\n"
                                    "\"\"\"\"\"\",1,2,\"3\"");
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_EQ(result.bad, Bad{});
    std::vector<std::string> texts;
    for (const auto &record : result.records)
        texts.push_back(text_of(record));
    EXPECT_EQ(texts,
              (std::vector<std::string>{"a,b", "she said \"no\"", "two\nlines", "5\" pipe", "", "ending", "\"\""}));
    EXPECT_EQ(result.stats.line, 9u);
}

TEST(Csv, BadLinesAreCountedAndTheRestIsRead) {
    const Result result = read_text("time,lat,lon\n"
                                    "1,2,3\n"
                                    "1,2\n"
                                    "1,abc,3\n"
                                    "1,,3\n"
                                    "1,90.5,3\n"
                                    "1,2,-180.25\n"
                                    "1,nan,3\n"
                                    "yesterday,2,3\n"
                                    "99999999999999999999,2,3\n"
                                    "1,2,3e1\n"
                                    "1,2,1e400\n");
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_EQ(result.records.size(), 2u);
    EXPECT_EQ(result.records.back().longitude, 30.0f);
    EXPECT_EQ(result.bad, (Bad{{3, "only 2 of the 3 fields that are needed"},
                               {4, "'lat' is 'abc', not a number"},
                               {5, "'lat' is empty"},
                               {6, "'lat' is 90.5, outside -90..90"},
                               {7, "'lon' is -180.25, outside -180..180"},
                               {8, "'lat' is nan, outside -90..90"},
                               {9, "'time' is 'yesterday', not a time"},
                               {10, "'time' is 1e+20, which no 64-bit number of microseconds holds"},
                               {12, "'lon' is '1e400', not a number"}}));
    EXPECT_EQ(result.stats.bad, 9u);
}

TEST(Csv, RefusedBadLineComesAfterTheRecordsBeforeIt) {
    locus_records_options options = usual_options();
    options.bad_lines = LOCUS_BAD_LINES_REFUSE;
    const Result result = read_text("time,lat,lon\n1,2,3\n1,2,4\n1,2,x\n1,2,5\n", options, 10);
    EXPECT_EQ(result.status, LOCUS_E_FORMAT);
    EXPECT_EQ(result.records.size(), 2u);
    EXPECT_EQ(result.error, "locus_records_next: input, line 4: 'lon' is 'x', not a number");
}

TEST(Csv, AnErrorStays) {
    const int fd = memfd_create("records", MFD_CLOEXEC);
    ASSERT_EQ(write(fd, "a,b\n1,2\n", 8), 8);
    lseek(fd, 0, SEEK_SET);
    locus_records *reader = nullptr;
    ASSERT_EQ(locus_records_open_fd(fd, "input", nullptr, &reader), LOCUS_OK);
    locus_text156 record;
    size_t count = 7;
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(locus_records_next(reader, &record, 1, &count), LOCUS_E_FORMAT);
        EXPECT_EQ(count, 0u);
        EXPECT_STREQ(locus_io_last_error(), "locus_records_next: no column 'time', 'timestamp', 'datetime', 'date', "
                                            "'created_at' for the time in the first row: a,b");
    }
    locus_records_close(reader);
    close(fd);
}

TEST(Csv, NamedColumnsAndSeparators) {
    locus_records_options options = usual_options();
    options.separator = ';';
    options.time_column = "when";
    options.latitude_column = "north";
    options.longitude_column = "east";
    options.text_column = "what";
    const Result result = read_text("lat;what;east;when;north\n0;a,b;3;1;2\n", options);
    ASSERT_EQ(result.records.size(), 1u);
    EXPECT_EQ(result.records[0].latitude, 2.0f);
    EXPECT_EQ(text_of(result.records[0]), "a,b");
    options.text_column = "who";
    EXPECT_EQ(read_text("when;north;east\n", options).status, LOCUS_E_FORMAT);
}

TEST(Csv, UsualNamesInTheirOrder) {
    const Result result = read_text("y,latitude,x,lng,created_at,timestamp\n1,2,3,4,5,6\n");
    ASSERT_EQ(result.records.size(), 1u);
    EXPECT_EQ(result.records[0].latitude, 2.0f);
    EXPECT_EQ(result.records[0].longitude, 4.0f);
    EXPECT_EQ(when(result.records[0]), 6'000'000);
}

TEST(Csv, NoRecords) {
    for (const char *text : {"", "\n\n", "\xef\xbb\xbf", "time,lat,lon", "time,lat,lon\n"}) {
        const Result result = read_text(text);
        EXPECT_EQ(result.status, LOCUS_OK) << text << result.error;
        EXPECT_TRUE(result.records.empty());
        EXPECT_TRUE(result.bad.empty());
    }
}

TEST(Csv, LinesWithoutEnd) {
    locus_records_options options = usual_options();
    options.max_line = 64;
    const std::string endless(10'000'000, 'z'); // far more than the buffer
    const Result result =
        read_text("time,lat,lon\n" + endless + "\n1,2,3\n" + std::string(80, 'z') + "\n4,5,6\n" + endless, options);
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_EQ(result.records.size(), 2u);
    EXPECT_EQ(result.bad, (Bad{{2, "longer than 64 bytes"}, {4, "longer than 64 bytes"}, {6, "longer than 64 bytes"}}));
    EXPECT_EQ(result.stats.line, 6u);
    const Result header = read_text(endless, options);
    EXPECT_EQ(header.status, LOCUS_E_FORMAT);
    EXPECT_EQ(header.error, "locus_records_next: input, line 1: the column names: longer than 64 bytes");
}

TEST(Csv, AnOpenQuoteCostsItsLineOnly) {
    const Result at_end = read_text("time,lat,lon,text\n1,2,3,\"open\n4,5,6,a\n7,8,9,b\n");
    EXPECT_EQ(at_end.records.size(), 2u);
    EXPECT_EQ(at_end.bad, (Bad{{2, "a double quote is not closed before the end of the input"}}));

    locus_records_options options = usual_options();
    options.max_line = 64;
    std::string text = "time,lat,lon,text\n1,2,3,\"open\n";
    for (int i = 0; i < 100'000; ++i)
        text += "4,5,6,a\n";
    const Result far = read_text(text, options, 1000);
    EXPECT_EQ(far.records.size(), 100'000u);
    EXPECT_EQ(far.bad, (Bad{{2, "a double quote is not closed before the end of this length"}}));
}

TEST(Csv, LongTextsAreCutAtACharacter) {
    const std::string exact(140, 'a');
    const std::string one_more = std::string(139, 'a') + "\xc3\xa9";      // an e with an accent at 139..140
    const std::string emoji = std::string(137, 'a') + "\xf0\x9f\x98\x80"; // four bytes at 137..140
    const std::string fits = std::string(136, 'a') + "\xf0\x9f\x98\x80";
    const Result result = read_text("time,lat,lon,text\n1,2,3," + exact + "\n1,2,3," + one_more + "\n1,2,3," + emoji +
                                    "\n1,2,3," + fits + "\n");
    ASSERT_EQ(result.records.size(), 4u);
    EXPECT_EQ(text_of(result.records[0]), exact);
    EXPECT_EQ(text_of(result.records[1]), std::string(139, 'a'));
    EXPECT_EQ(text_of(result.records[2]), std::string(137, 'a'));
    EXPECT_EQ(text_of(result.records[3]), fits);
    EXPECT_EQ(result.stats.cut, 2u);
    EXPECT_EQ(result.stats.repaired, 0u);
}

TEST(Csv, BytesThatAreNotUtf8AreReplaced) {
    using namespace std::string_literals;
    const std::pair<std::string, std::string> cases[] = {
        {"caf\xe9", "caf\xef\xbf\xbd"},                                             // Latin-1
        {"cut \xe2\x82", "cut \xef\xbf\xbd\xef\xbf\xbd"},                           // a character without its end
        {"\xc0\xaf", "\xef\xbf\xbd\xef\xbf\xbd"},                                   // overlong
        {"\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"},                   // a surrogate
        {"\xf4\x90\x80\x80!", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd!"}, // beyond U+10FFFF
    };
    for (const auto &[given, wanted] : cases) {
        const Result result = read_text("time,lat,lon,text\n1,2,3," + given + "\n");
        ASSERT_EQ(result.records.size(), 1u);
        EXPECT_EQ(text_of(result.records[0]), wanted);
        EXPECT_EQ(result.stats.repaired, 1u);
    }
    const Result nul = read_text("time,lat,lon,text\n1,2,3,a\0b\n"s);
    EXPECT_EQ(text_of(nul.records[0]), "a b");
}

TEST(Csv, PointsKeepFullPrecision) {
    locus_records_options options = usual_options();
    options.record = LOCUS_RECORD_POINT32;
    const int fd = memfd_create("records", MFD_CLOEXEC);
    const std::string text = "lat,lon,time\n37.743561234,-122.401201234,1211068800\n";
    ASSERT_EQ(write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    lseek(fd, 0, SEEK_SET);
    locus_records *reader = nullptr;
    ASSERT_EQ(locus_records_open_fd(fd, "input", &options, &reader), LOCUS_OK);
    locus_point32 points[2];
    size_t count = 0;
    ASSERT_EQ(locus_records_next(reader, points, 2, &count), LOCUS_OK);
    ASSERT_EQ(count, 1u);
    EXPECT_EQ(points[0].latitude, 37.743561234);
    EXPECT_EQ(points[0].longitude, -122.401201234);
    EXPECT_EQ(points[0].time, 1211068800'000'000);
    EXPECT_EQ(points[0].device + points[0].application + points[0].language + points[0].spare, 0);
    locus_records_close(reader);
    close(fd);
}

} // namespace
