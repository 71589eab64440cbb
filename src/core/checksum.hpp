// The checksum of everything the store writes: XXH64 of Yann Collet's xxHash, whose scalar code outruns the disks.
// Source: the specification "xxHash fast digest algorithm", version 0.1.1, of the xxHash project. The library's own
// code, since it has to build without any package.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace locus {

uint64_t checksum(std::span<const std::byte> bytes, uint64_t seed = 0) noexcept;

// A header of a file, and the checksum of what stands before its last word, `sum`.
template <typename Header>
std::span<const std::byte> bytes_of(const Header &header) noexcept {
    return {reinterpret_cast<const std::byte *>(&header), sizeof header};
}
template <typename Header>
uint64_t sum_of(const Header &header) noexcept {
    return checksum(bytes_of(header).first(offsetof(Header, sum)));
}

} // namespace locus
