// Checks that every format shares, raw files, and telling the formats apart.
#include "io/volume_source.hpp"

#include "core/error.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::io {
namespace {

constexpr uint64_t max_voxels = uint64_t{1} << 40; // locus_graph's limit
constexpr uint64_t max_components = uint64_t{1} << 24;

void check_direction(const locus_volume_info &info, locus_status status, const std::string &where) {
    for (int axis = 0; axis < 3; ++axis) {
        const double *unit = info.direction + 3 * axis;
        const double length = std::hypot(unit[0], unit[1], unit[2]);
        if (!(std::abs(length - 1) < 1e-3))
            fail(status, where, "the direction of axis ", axis, " is (", unit[0], ", ", unit[1], ", ", unit[2],
                 "), not a unit vector");
    }
}

bool ends_with(const std::string &path, std::string_view ending) { return path.ends_with(ending); }

} // namespace

locus_volume_info default_info() {
    locus_volume_info info{};
    info.struct_size = sizeof info;
    info.components = 1;
    for (int axis = 0; axis < 3; ++axis)
        info.spacing[axis] = info.direction[4 * axis] = 1;
    info.slope = 1;
    info.type = info.file_type = LOCUS_VOXEL_FLOAT32;
    return info;
}

void check_info(const locus_volume_info &info, locus_status status, const std::string &where) {
    uint64_t voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const uint64_t dim = info.dims[axis];
        if (dim < 1)
            fail(status, where, "dims[", axis, "] is 0");
        if (__builtin_mul_overflow(voxels, dim, &voxels) || voxels >= max_voxels)
            fail(status, where, "dims are ", info.dims[0], " x ", info.dims[1], " x ", info.dims[2],
                 ", 2^40 voxels or more");
    }
    if (info.components < 1 || info.components > max_components)
        fail(status, where, "components is ", info.components, ", outside 1..", max_components);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(info.spacing[axis] > 0) || !std::isfinite(info.spacing[axis]))
            fail(status, where, "spacing[", axis, "] is ", info.spacing[axis], ", not a positive number");
        if (!std::isfinite(info.origin[axis]))
            fail(status, where, "origin[", axis, "] is ", info.origin[axis], ", not a finite number");
    }
    check_direction(info, status, where);
    if (!std::isfinite(info.slope) || info.slope == 0 || !std::isfinite(info.intercept))
        fail(status, where, "slope and intercept are ", info.slope, " and ", info.intercept, ", no finite scaling");
    if (find_voxel_type(info.type) == nullptr)
        fail(status, where, "type ", info.type, " is none of LOCUS_VOXEL_");
}

uint64_t voxels_of(const locus_volume_info &info) { return info.dims[0] * info.dims[1] * info.dims[2]; }

uint64_t bytes_of(const locus_volume_info &info, size_t bytes_per_number) {
    uint64_t bytes = 0;
    if (__builtin_mul_overflow(voxels_of(info) * info.components, uint64_t{bytes_per_number}, &bytes))
        return std::numeric_limits<uint64_t>::max();
    return bytes;
}

std::string beside(const std::string &header_path, std::string_view name) {
    if (name.empty())
        fail(LOCUS_E_FORMAT, header_path, ": the name of the data file is empty");
    if (name.find('\0') != std::string_view::npos)
        fail(LOCUS_E_FORMAT, header_path, ": the name of the data file holds a NUL byte");
    bool climbs = name.front() == '/';
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find('/', begin), name.size());
        climbs = climbs || name.substr(begin, end - begin) == "..";
        begin = end + 1;
    }
    if (climbs)
        fail(LOCUS_E_FORMAT, header_path, ": the data file \"", std::string(name),
             "\" lies outside the header's folder");
    const size_t slash = header_path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : header_path.substr(0, slash + 1);
    return folder + std::string(name);
}

VolumeSource describe_raw(const InputFile &file, const locus_volume_read_options &options) {
    VolumeSource source;
    source.info = default_info();
    locus_volume_info &info = source.info;
    std::ranges::copy(options.raw_dims, info.dims);
    std::ranges::copy(options.raw_spacing, info.spacing);
    std::ranges::copy(options.raw_origin, info.origin);
    info.components = options.raw_components;
    require(find_voxel_type(options.raw_type) != nullptr, "raw_type is ", options.raw_type, ", none of LOCUS_VOXEL_");
    info.type = info.file_type = options.raw_type;
    info.format = LOCUS_VOLUME_RAW;
    info.big_endian = options.raw_big_endian;
    check_info(info, LOCUS_E_ARGUMENT, "raw_");
    source.data_path = file.path();
    source.offset = options.raw_offset;
    source.interleaved = options.raw_interleaved != 0;
    return source;
}

uint32_t detect_format(const InputFile &file, std::string_view head) {
    const auto starts = [&](std::string_view bytes) { return head.starts_with(bytes); };
    if (starts("NRRD"))
        return LOCUS_VOLUME_NRRD;
    // A NIfTI header begins with its size, 348 or 540, in either byte order; a .nii.gz is a gzip stream.
    using namespace std::string_view_literals;
    if (starts("\x1f\x8b"sv) || starts("\x5c\x01\0\0"sv) || starts("\0\0\x01\x5c"sv) || starts("\x1c\x02\0\0"sv) ||
        starts("\0\0\x02\x1c"sv))
        return LOCUS_VOLUME_NIFTI;
    if (starts("ObjectType") || starts("NDims") || ends_with(file.path(), ".mhd") || ends_with(file.path(), ".mha"))
        return LOCUS_VOLUME_METAIMAGE;
    if (head.empty())
        fail(LOCUS_E_FORMAT, file.path(), ": the file is empty");
    fail(LOCUS_E_FORMAT, file.path(),
         ": the first bytes are those of no known format (MetaImage, NRRD, NIfTI); a raw file needs its dims and type");
}

} // namespace locus::io
