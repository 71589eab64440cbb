// XXH64 against values of the reference implementation.
#include "core/checksum.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace locus {
namespace {

uint64_t sum(std::string_view text, uint64_t seed = 0) { return checksum(std::as_bytes(std::span(text)), seed); }

TEST(Checksum, IsXxh64) {
    EXPECT_EQ(sum(""), 0xEF46DB3751D8E999u);
    EXPECT_EQ(sum("a"), 0xD24EC4F1A98C6E5Bu);
    EXPECT_EQ(sum("abc"), 0x44BC2CF5AD770999u);
    EXPECT_EQ(sum("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1u);
}

} // namespace
} // namespace locus
