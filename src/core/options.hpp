// Option structs that grow: they begin with their size, and a client may have been built against an older header.
#pragma once

#include "core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace locus {

// Fill the first `size` bytes of a caller's struct with `defaults`. `first_size` is the struct's size in the release
// that introduced it: no client can have a smaller one. `name` is the parameter's in the header.
template <typename Options>
void init_options(Options *options, size_t size, Options defaults, size_t first_size, const char *name = "options") {
    need(options, name);
    require(size >= first_size, "size is ", size, ", smaller than the first release's ", first_size);
    const size_t known = std::min(size, sizeof(Options));
    defaults.struct_size = size;
    std::memset(static_cast<void *>(options), 0, size);
    std::memcpy(static_cast<void *>(options), &defaults, known);
}

// A whole struct from a caller's one: `defaults` with the bytes the caller knows laid over it. A larger struct, from a
// newer header, passes only if what this library does not know is zero.
template <typename Options>
Options read_options(const Options *options, const Options &defaults, size_t first_size) {
    if (options == nullptr)
        return defaults;
    const uint64_t size = options->struct_size;
    require(size >= first_size, "struct_size is ", size, ", smaller than the first release's ", first_size,
            " (was the struct filled by its _init function?)");
    require(size <= sizeof(Options) + 4096, "struct_size is ", size, ", far larger than any release's");
    const auto *bytes = reinterpret_cast<const unsigned char *>(options);
    for (size_t i = sizeof(Options); i < size; ++i)
        require(bytes[i] == 0, "struct_size is ", size, ": byte ", i, " beyond this library's ", sizeof(Options),
                " is set, an option this version does not know");
    Options whole = defaults;
    std::memcpy(static_cast<void *>(&whole), options, std::min<size_t>(size, sizeof(Options)));
    whole.struct_size = sizeof(Options);
    return whole;
}

// Give a report struct to a caller whose struct may be older: as many bytes as it has room for.
template <typename Report>
void write_report(Report *report, const Report &whole, size_t first_size, const char *name) {
    const uint64_t size = need(report, name).struct_size;
    require(size >= first_size, name, "->struct_size is ", size, ", smaller than the first release's ", first_size);
    std::memcpy(static_cast<void *>(report), &whole, std::min<size_t>(size, sizeof(Report)));
    report->struct_size = size;
}

} // namespace locus
