// XXH64.
#include "core/checksum.hpp"

#include <bit>
#include <cstring>

namespace locus {
namespace {

static_assert(std::endian::native == std::endian::little, "words are read as they lie");

constexpr uint64_t prime1 = 0x9E3779B185EBCA87, prime2 = 0xC2B2AE3D27D4EB4F, prime3 = 0x165667B19E3779F9,
                   prime4 = 0x85EBCA77C2B2AE63, prime5 = 0x27D4EB2F165667C5;

template <typename Word>
uint64_t word(const std::byte *at) noexcept {
    Word value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

uint64_t round(uint64_t lane, uint64_t input) noexcept { return std::rotl(lane + input * prime2, 31) * prime1; }

uint64_t merge(uint64_t sum, uint64_t lane) noexcept { return (sum ^ round(0, lane)) * prime1 + prime4; }

// Four lanes over the whole stripes of 32 bytes.
uint64_t stripes(const std::byte *at, const std::byte *end, uint64_t seed) noexcept {
    uint64_t a = seed + prime1 + prime2, b = seed + prime2, c = seed, d = seed - prime1;
    for (; at != end; at += 32) {
        a = round(a, word<uint64_t>(at));
        b = round(b, word<uint64_t>(at + 8));
        c = round(c, word<uint64_t>(at + 16));
        d = round(d, word<uint64_t>(at + 24));
    }
    const uint64_t sum = std::rotl(a, 1) + std::rotl(b, 7) + std::rotl(c, 12) + std::rotl(d, 18);
    return merge(merge(merge(merge(sum, a), b), c), d);
}

} // namespace

uint64_t checksum(std::span<const std::byte> bytes, uint64_t seed) noexcept {
    const std::byte *at = bytes.data();
    size_t left = bytes.size();
    uint64_t sum = seed + prime5;
    if (left >= 32) {
        sum = stripes(at, at + left / 32 * 32, seed);
        at += left / 32 * 32;
        left %= 32;
    }
    sum += bytes.size();
    for (; left >= 8; at += 8, left -= 8)
        sum = std::rotl(sum ^ round(0, word<uint64_t>(at)), 27) * prime1 + prime4;
    for (; left >= 4; at += 4, left -= 4)
        sum = std::rotl(sum ^ word<uint32_t>(at) * prime1, 23) * prime2 + prime3;
    for (; left > 0; ++at, --left)
        sum = std::rotl(sum ^ word<uint8_t>(at) * prime5, 11) * prime1;
    sum = (sum ^ sum >> 33) * prime2;
    sum = (sum ^ sum >> 29) * prime3;
    return sum ^ sum >> 32;
}

} // namespace locus
