// Records from newline-delimited JSON.
#include "tests/unit/io/records_fixture.hpp"

namespace {

using namespace records_test;
using Bad = std::vector<std::pair<uint64_t, std::string>>;

TEST(Json, ObjectsAndEscapes) {
    const Result result =
        read_text(R"({"time": 1, "lat": 2, "lon": -3.5, "text": "tab\there \u00e9 \ud83d\ude00 \"q\" \\ \/"}
{"lon":"4.5","other":{"lat":77,"deep":[[1,{"lon":8}]]},"lat":1e1,"time":"2008-05-18T00:00:00Z","list":[1,2]}

 {"created_at":5,"latitude":6,"lng":7,"message":null}
)");
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_EQ(result.bad, Bad{});
    ASSERT_EQ(result.records.size(), 3u);
    EXPECT_EQ(text_of(result.records[0]), "tab\there \xc3\xa9 \xf0\x9f\x98\x80 \"q\" \\ /");
    EXPECT_EQ(result.records[0].longitude, -3.5f);
    EXPECT_EQ(result.records[1].latitude, 10.0f);
    EXPECT_EQ(result.records[1].longitude, 4.5f);
    EXPECT_EQ(when(result.records[1]), 1211068800'000'000);
    EXPECT_EQ(result.records[2].latitude, 6.0f);
    EXPECT_EQ(text_of(result.records[2]), "");
}

TEST(Json, PreferredAndLaterMembersWin) {
    const Result result = read_text(R"({"y":1,"lat":2,"latitude":3,"lon":4,"lon":5,"time":6})"
                                    "\n");
    ASSERT_EQ(result.records.size(), 1u);
    EXPECT_EQ(result.records[0].latitude, 2.0f);
    EXPECT_EQ(result.records[0].longitude, 5.0f);
}

TEST(Json, BadLines) {
    const Result result = read_text("{\"time\":1,\"lat\":2,\"lon\":3}\n"
                                    "{\"time\":1,\"lat\":2}\n"
                                    "{\"time\":1,\"lat\":null,\"lon\":3}\n"
                                    "{\"time\":1,\"lat\":[2],\"lon\":3}\n"
                                    "{\"time\":1,\"lat\":91,\"lon\":3}\n"
                                    "[1,2,3]\n"
                                    "17\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":3\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":3} x\n"
                                    "{\"time\":18446744073709551615,\"lat\":2,\"lon\":3}\n"
                                    "{\"time\":true,\"lat\":2,\"lon\":3}\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":1e999}\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":3,\"text\":\"\\ud800\"}\n"
                                    "{\"time\":9,\"lat\":2,\"lon\":3}");
    EXPECT_EQ(result.status, LOCUS_OK);
    EXPECT_EQ(result.records.size(), 2u);
    EXPECT_EQ(when(result.records.back()), 9'000'000);
    std::vector<uint64_t> lines;
    for (const auto &[line, reason] : result.bad)
        lines.push_back(line);
    EXPECT_EQ(lines, (std::vector<uint64_t>{2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13}));
    EXPECT_EQ(result.bad[0].second, "'lon' is missing");
    EXPECT_EQ(result.bad[1].second, "'lat' is not a number");
    EXPECT_EQ(result.bad[2].second, "'lat' is not a number");
    EXPECT_EQ(result.bad[3].second, "'lat' is 91, outside -90..90");
    EXPECT_EQ(result.bad[4].second, "not a JSON object");
    EXPECT_EQ(result.bad[5].second, "not a JSON object");
    EXPECT_TRUE(result.bad[6].second.starts_with("not JSON at byte 26")) << result.bad[6].second;
}

TEST(Json, NestingWithoutLimitIsNoProblem) {
    const std::string open(30'000, '[');
    const std::string close(30'000, ']');
    const Result result =
        read_text("{\"a\":" + open + close + ",\"time\":1,\"lat\":2,\"lon\":3}\n{\"b\":" + open + "\n");
    EXPECT_EQ(result.records.size(), 1u);
    EXPECT_EQ(result.bad.size(), 1u);
}

TEST(Json, BytesThatAreNotUtf8AreReplaced) {
    const Result result = read_text("{\"time\":1,\"lat\":2,\"lon\":3,\"text\":\"caf\xe9\"}\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":3,\"text\":\"cut \xe2\x82\"}\n"
                                    "{\"time\":1,\"lat\":2,\"lon\":3,\"text\":\"nul \\u0000 \"}\n");
    ASSERT_EQ(result.records.size(), 3u);
    EXPECT_EQ(text_of(result.records[0]), "caf\xef\xbf\xbd");
    EXPECT_EQ(text_of(result.records[1]), "cut \xef\xbf\xbd\xef\xbf\xbd");
    EXPECT_EQ(text_of(result.records[2]), "nul   ");
    EXPECT_EQ(result.stats.repaired, 2u);
}

TEST(Json, ForcedFormatTakesQuotesAsTheyAre) {
    locus_records_options options = usual_options();
    options.format = LOCUS_RECORDS_NDJSON;
    const Result result = read_text("time,lat,lon\n{\"time\":1,\"lat\":2,\"lon\":3}\n", options);
    EXPECT_EQ(result.records.size(), 1u);
    EXPECT_EQ(result.bad.size(), 1u);
    options.format = LOCUS_RECORDS_CSV;
    EXPECT_EQ(read_text("{\"time\":1}\n", options).status, LOCUS_E_FORMAT);
}

} // namespace
