// Reading and writing whole volumes, behind the C interface.
#pragma once

#include "io/volume_source.hpp"

#include <cstddef>
#include <memory>
#include <string>

// The body of the public handle.
struct locus_volume {
    locus_volume_info info{};          // of the numbers in memory
    std::unique_ptr<std::byte[]> data; // aligned by operator new[]
};

namespace locus::io {

// Parse the header, check it against the files' sizes and say what the volume will be in memory.
locus_volume_info probe_volume(const std::string &path, const locus_volume_read_options &options);

// The same, and read the numbers.
std::unique_ptr<locus_volume> read_volume(const std::string &path, const locus_volume_read_options &options);

void write_volume(const std::string &path, const locus_volume_info &info, const void *data,
                  const locus_volume_write_options &options);

} // namespace locus::io
