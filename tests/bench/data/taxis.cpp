// The San Francisco taxis: a zstd-compressed CSV with time, lat, lon, occupied, cab.
#include "tests/bench/data/records.hpp"
#include "tests/bench/harness/cases.hpp"

#include <charconv>
#include <cstdio>
#include <functional>
#include <memory>
#include <string_view>

#if __has_include(<zstd.h>)
#include <zstd.h>
#endif

namespace bench {
namespace {

#if __has_include(<zstd.h>)
/// Hand the decompressed text of a file to `take`, piece by piece, until it returns false.
void decompress(const std::string &path, const std::function<bool(std::string_view)> &take) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx *)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
    if (!file || !context) {
        throw std::runtime_error("cannot open " + path);
    }
    std::string in(ZSTD_DStreamInSize(), '\0'), out(ZSTD_DStreamOutSize(), '\0');
    while (const std::size_t got = std::fread(in.data(), 1, in.size(), file.get())) {
        ZSTD_inBuffer from{in.data(), got, 0};
        while (from.pos < from.size) {
            ZSTD_outBuffer to{out.data(), out.size(), 0};
            if (ZSTD_isError(ZSTD_decompressStream(context.get(), &to, &from)) != 0) {
                throw std::runtime_error(path + " is not a zstd file");
            }
            if (!take(std::string_view(out.data(), to.pos))) {
                return;
            }
        }
    }
}
#endif

template <class Number>
const char *parse(const char *from, const char *end, Number &number) {
    const auto [next, error] = std::from_chars(from, end, number);
    if (error != std::errc{} || next == end) {
        throw std::runtime_error("a line of the taxis that cannot be read");
    }
    return next + 1; // past the comma
}

[[maybe_unused]] locus_point32 parse_line(std::string_view line) {
    locus_point32 record{};
    const char *const end = line.data() + line.size();
    int occupied = 0;
    const char *next = parse(line.data(), end, record.time);
    next = parse(next, end, record.latitude);
    next = parse(next, end, record.longitude);
    next = parse(next, end, occupied);
    record.time *= second;
    record.device = static_cast<uint16_t>(occupied);
    record.application = static_cast<uint16_t>(std::hash<std::string_view>{}({next, static_cast<size_t>(end - next)}));
    return record;
}

} // namespace

std::vector<locus_point32> taxis(std::size_t limit) {
    const std::string path = data_file("taxis/cabspotting-sf-2008-05-18_31.csv.zst");
#if __has_include(<zstd.h>)
    std::vector<locus_point32> records;
    std::string rest;
    bool header = true;
    decompress(path, [&](std::string_view piece) {
        rest += piece;
        std::size_t start = 0;
        for (std::size_t end; (end = rest.find('\n', start)) != std::string::npos; start = end + 1) {
            if (!header && records.size() < limit) {
                records.push_back(parse_line(std::string_view(rest).substr(start, end - start)));
            }
            header = false;
        }
        rest.erase(0, start);
        return records.size() < limit;
    });
    return records;
#else
    (void)limit;
    throw Missing("built without libzstd, which reads " + path);
#endif
}

} // namespace bench
