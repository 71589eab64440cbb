// Keys of many places at once, on every instruction set, against one at a time.
#include "core/mercator.hpp"
#include "core/zcurve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace locus;

TEST(Mercator, EveryTargetFindsTheSameKeys) {
    std::vector<double> latitudes, longitudes;
    for (const double edge : {90.0, mercator_latitude, 85.0, 45.0, 1e-300, 0.0})
        for (const double sign : {1.0, -1.0})
            for (const double towards : {-1000.0, 1000.0})
                for (const double longitude : {-180.0, 180.0, std::nextafter(180.0, 0.0), 0.0, -0.0, 1e-300}) {
                    const double latitude = sign * edge;
                    latitudes.push_back(std::abs(latitude) == 90 ? latitude : std::nextafter(latitude, towards));
                    longitudes.push_back(longitude);
                }
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> north(-90, 90), east(-180, 180);
    for (int i = 0; i < 20001; ++i) { // no whole number of vectors
        latitudes.push_back(north(random));
        longitudes.push_back(east(random));
    }
    std::vector<uint64_t> keys(latitudes.size());
    for (const Simd target : {Simd::scalar, Simd::sse4, Simd::avx2, Simd::avx512, Simd::neon}) {
        if (!simd_available(target))
            continue;
        keys.assign(keys.size(), UINT64_MAX);
        keys_of(target)(latitudes.data(), longitudes.data(), keys.data(), keys.size());
        for (size_t i = 0; i < keys.size(); ++i)
            ASSERT_EQ(keys[i], key_of(latitudes[i], longitudes[i]))
                << simd_name(target) << " at " << latitudes[i] << ", " << longitudes[i];
    }
}

// Against the mathematical library, in longer words.
TEST(Mercator, IsAsExactAsADoubleCanBe) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> north(-85, 85);
    for (int i = 0; i < 20000; ++i) {
        const double latitude = north(random);
        const long double s = std::sin(static_cast<long double>(latitude) * (std::acos(-1.0L) / 180));
        const long double y = 0.5L - std::log((1 + s) / (1 - s)) / (4 * std::acos(-1.0L));
        ASSERT_NEAR(map_point(latitude, 0).y, static_cast<double>(y), 1e-14);
    }
}

} // namespace
