// Streams of geo-located records: clustered like posts from cities, and the San Francisco taxis.
#ifndef LOCUS_BENCH_RECORDS_HPP
#define LOCUS_BENCH_RECORDS_HPP

#include <locus/pmq.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace bench {

constexpr int64_t second = 1'000'000; // in the store's microseconds

template <class Record>
constexpr uint32_t record_kind = std::is_same_v<Record, locus_text156> ? LOCUS_RECORD_TEXT156 : LOCUS_RECORD_POINT32;

/// `count` records around 2,000 city centres with Zipf weights and a Gaussian spread, in batches of `batch` a second.
template <class Record>
std::vector<Record> clustered(std::size_t count, std::size_t batch, uint64_t seed = 1);

/// The place of the heaviest of those cities, in degrees.
void heaviest_city(double &latitude, double &longitude, uint64_t seed = 1);

/// The first `limit` taxi positions in their order of arrival; throws Missing where data or decompressor are not there.
std::vector<locus_point32> taxis(std::size_t limit);

/// The box whose sides lie `radius_km` from its centre.
locus_box box_around(double latitude, double longitude, double radius_km);

} // namespace bench
#endif
