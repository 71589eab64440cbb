// Errors and sized options.
#include "core/error.hpp"
#include "core/options.hpp"

#include <gtest/gtest.h>

namespace {

TEST(Error, JoinsItsPartsAndKeepsTheStatus) {
    try {
        locus::require(false, "threads is ", 7, ", more than ", 2.5);
        FAIL();
    } catch (const locus::Error &error) {
        EXPECT_EQ(error.status(), LOCUS_E_ARGUMENT);
        EXPECT_STREQ(error.what(), "threads is 7, more than 2.5");
    }
}

struct Sample {
    uint64_t struct_size;
    uint32_t first;
    uint32_t second;
    uint64_t third;
};
constexpr Sample defaults{sizeof(Sample), 1, 2, 3};
constexpr size_t first_size = offsetof(Sample, third);

TEST(Options, AnOlderClientGetsTheDefaultsOfWhatItDoesNotKnow) {
    Sample older{first_size, 10, 20, 999};
    const Sample whole = locus::read_options(&older, defaults, first_size);
    EXPECT_EQ(whole.first, 10u);
    EXPECT_EQ(whole.third, 3u);
}

TEST(Options, ANewerClientPassesOnlyWithAZeroTail) {
    struct {
        Sample sample;
        uint64_t unknown;
    } newer{{sizeof(Sample) + 8, 10, 20, 30}, 0};
    EXPECT_EQ(locus::read_options(&newer.sample, defaults, first_size).third, 30u);
    newer.unknown = uint64_t{1} << 40;
    EXPECT_THROW(locus::read_options(&newer.sample, defaults, first_size), locus::Error);
}

TEST(Options, InitFillsNoMoreThanTheCallerHas) {
    Sample sample{0, 0, 0, 77};
    locus::init_options(&sample, first_size, defaults, first_size);
    EXPECT_EQ(sample.second, 2u);
    EXPECT_EQ(sample.third, 77u);
    EXPECT_THROW(locus::init_options(&sample, first_size - 1, defaults, first_size), locus::Error);
}

} // namespace
