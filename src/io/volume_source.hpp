// What a header says: the volume's description and where and how its numbers are stored. One parser per format.
#pragma once

#include "core/file.hpp"

#include <locus/volume.h>

#include <optional>
#include <string>
#include <string_view>

namespace locus::io {

struct VolumeSource {
    locus_volume_info info{};       // of the numbers as they are stored
    std::string data_path;          // the file that holds them
    uint64_t offset = 0;            // where in it they begin, or their compressed stream
    uint64_t skip = 0;              // bytes to pass over behind that place, after decompression
    std::optional<uint64_t> stated; // bytes they take in the file, when the header says so
    bool at_end = false;            // they are the last bytes of the file; offset and skip do not count
    bool deflated = false;          // zlib or gzip
    bool interleaved = false;       // the components of a voxel lie side by side, else one volume follows the other
};

// The defaults of locus_volume_info_init.
locus_volume_info default_info();

// Check dims, components, spacing, origin and direction; `where` (the file's path) leads the texts, `status` is theirs.
void check_info(const locus_volume_info &info, locus_status status, const std::string &where);

// Voxels, numbers and bytes of a checked description; no overflow: numbers < 2^64, and bytes are capped at 2^64 - 1.
uint64_t voxels_of(const locus_volume_info &info);
uint64_t bytes_of(const locus_volume_info &info, size_t bytes_per_number);

// The path of the data file that a header names: in the header's folder or below, else LOCUS_E_FORMAT.
std::string beside(const std::string &header_path, std::string_view name);

// The description in the file's header. `head` is its beginning, at most head_bytes of it.
inline constexpr size_t head_bytes = size_t{1} << 20;
VolumeSource parse_metaimage(const InputFile &file, std::string_view head);
VolumeSource parse_nrrd(const InputFile &file, std::string_view head);
VolumeSource parse_nifti(const InputFile &file);
VolumeSource describe_raw(const InputFile &file, const locus_volume_read_options &options);

// The format that the file's beginning shows; LOCUS_E_FORMAT when it is none.
uint32_t detect_format(const InputFile &file, std::string_view head);

} // namespace locus::io
