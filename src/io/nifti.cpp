// NIfTI headers, versions 1 and 2 (.nii, .nii.gz). libnifti2 knows the format's byte order and orientation; it prints
// on what it does not like and repairs silently, so it only sees a header in memory whose every field it uses was
// checked.
#include "core/error.hpp"
#include "io/byte_stream.hpp"
#include "io/volume_source.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include <nifti2_io.h>

namespace locus::io {
namespace {

constexpr int16_t rgb24 = 128; // NIFTI_TYPE_RGB24 and NIFTI_TYPE_RGBA32: bytes side by side
constexpr int16_t rgba32 = 2304;

struct ImageDeleter {
    void operator()(nifti_image *image) const { nifti_image_free(image); }
};
using Image = std::unique_ptr<nifti_image, ImageDeleter>;

// Dims, type and place of a header in native byte order, before libnifti2 sees it.
template <typename Header>
void check(const Header &header, const std::string &path) {
    const auto refuse = [&](const auto &...parts) { fail(LOCUS_E_FORMAT, path, ": ", parts...); };
    if (header.dim[0] < 1 || header.dim[0] > 7)
        refuse("dim[0] is ", header.dim[0], ", not 1 to 7");
    int64_t product = 1;
    for (int axis = 1; axis <= header.dim[0]; ++axis)
        if (header.dim[axis] < 1 || __builtin_mul_overflow(product, header.dim[axis], &product))
            refuse("dim[", axis, "] is ", header.dim[axis], ", not a size, or too many voxels");
    const double offset = static_cast<double>(header.vox_offset);
    if (!(offset >= static_cast<double>(sizeof(Header))) || offset > 1e9)
        refuse("vox_offset is ", offset, ", not between the header's end and 1e9");
    for (int axis = 1; axis <= std::min<int64_t>(header.dim[0], 3); ++axis)
        if (!std::isfinite(header.pixdim[axis]))
            refuse("pixdim[", axis, "] is ", header.pixdim[axis]);
    int bytes = 0;
    int swap = 0;
    nifti_datatype_sizes(header.datatype, &bytes, &swap);
    if (bytes == 0)
        refuse("datatype is ", header.datatype, ", not a type of the format");
    if (header.bitpix != 8 * bytes)
        refuse("bitpix is ", header.bitpix, ", but datatype ", header.datatype, " has ", 8 * bytes, " bits");
}

// The header's bytes as libnifti2's image, which has no data; `swapped`: they are in the other byte order.
template <typename Header>
Image interpret(const std::array<std::byte, sizeof(nifti_2_header)> &bytes, int version, bool swapped,
                nifti_image *convert(Header, const char *), const std::string &path) {
    Header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (swapped)
        swap_nifti_header(&header, version);
    check(header, path);
    Image image(convert(header, nullptr));
    if (!image)
        throw std::bad_alloc();
    return image;
}

// A size of 348 or 540 in either byte order, and the magic text that goes with it, tell the version.
Image read_image(const InputFile &file, bool deflated, bool &swapped) {
    std::array<std::byte, sizeof(nifti_2_header)> bytes{};
    const size_t got = ByteReader(file, 0, deflated).read(bytes);
    int32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    int32_t other = size;
    swap_bytes(reinterpret_cast<std::byte *>(&other), 1, sizeof other);
    swapped = other == 348 || other == 540;
    const int32_t header_size = swapped ? other : size;
    if (header_size != 348 && header_size != 540)
        fail(LOCUS_E_FORMAT, file.path(), ": sizeof_hdr is ", size, ", not that of a NIfTI header (348 or 540)");
    if (got < static_cast<size_t>(header_size))
        fail(LOCUS_E_FORMAT, file.path(), ": the header ends after ", got, " of ", header_size, " bytes");
    const int version = header_size == 348 ? 1 : 2;
    const std::byte *magic = bytes.data() + (version == 1 ? offsetof(nifti_1_header, magic) : 4);
    const char digit = static_cast<char>('0' + version);
    const std::string single{'n', '+', digit, '\0'};
    const std::string pair{'n', 'i', digit, '\0'};
    if (std::memcmp(magic, pair.data(), 4) == 0)
        fail(LOCUS_E_UNSUPPORTED, file.path(), ": a pair of .hdr and .img; only one file (.nii, .nii.gz) is read");
    if (std::memcmp(magic, single.data(), 4) != 0)
        fail(LOCUS_E_FORMAT, file.path(), ": the magic text is not \"n+", digit, "\": not a NIfTI file");
    if (version == 1)
        return interpret<nifti_1_header>(bytes, 1, swapped, nifti_convert_n1hdr2nim, file.path());
    return interpret<nifti_2_header>(bytes, 2, swapped, nifti_convert_n2hdr2nim, file.path());
}

// The numbers' type; colours are components that lie side by side.
void set_type(const nifti_image &image, VolumeSource &source, const std::string &path) {
    locus_volume_info &info = source.info;
    if (image.datatype == rgb24 || image.datatype == rgba32) {
        info.type = LOCUS_VOXEL_UINT8;
        source.interleaved = true;
        if (info.components != 1)
            fail(LOCUS_E_UNSUPPORTED, path, ": dim[4] is ", info.components, " with a type of colours");
        info.components = image.datatype == rgb24 ? 3 : 4;
    } else {
        const auto table = voxel_types();
        const auto found = std::ranges::find(table, image.datatype, &VoxelType::nifti);
        if (found == table.end())
            fail(LOCUS_E_UNSUPPORTED, path, ": datatype is ", image.datatype, " (",
                 nifti_datatype_to_string(image.datatype), "), not a type of number that is read");
        info.type = found->type;
        if (image.scl_slope != 0) { // 0: no scaling
            info.slope = image.scl_slope;
            info.intercept = image.scl_inter;
        }
    }
    info.file_type = info.type;
}

// The sform if there is one, else the qform, else the spacing alone; from right, anterior to left, posterior.
void set_geometry(const nifti_image &image, locus_volume_info &info, const std::string &path) {
    const bool sform = image.sform_code > 0;
    if (!sform && image.qform_code <= 0) {
        const double pixdim[3] = {image.dx, image.dy, image.dz};
        for (int axis = 0; axis < std::min<int64_t>(image.ndim, 3); ++axis)
            info.spacing[axis] = std::abs(pixdim[axis]);
        return;
    }
    const nifti_dmat44 &world = sform ? image.sto_xyz : image.qto_xyz;
    constexpr double turn[3] = {-1, -1, 1};
    for (int axis = 0; axis < 3; ++axis) {
        const double length = std::hypot(world.m[0][axis], world.m[1][axis], world.m[2][axis]);
        if (!(length > 0) || !std::isfinite(length))
            fail(LOCUS_E_FORMAT, path, sform ? ": the sform's column " : ": the qform's column ", axis,
                 " has the length ", length);
        info.spacing[axis] = length;
        for (int i = 0; i < 3; ++i)
            info.direction[3 * axis + i] = turn[i] * world.m[i][axis] / length;
        info.origin[axis] = turn[axis] * world.m[axis][3];
    }
}

} // namespace

VolumeSource parse_nifti(const InputFile &file) {
    VolumeSource source;
    std::array<std::byte, 2> magic{};
    source.deflated = file.read_at(0, magic) == 2 && magic[0] == std::byte{0x1f} && magic[1] == std::byte{0x8b};
    bool swapped = false;
    const Image image = read_image(file, source.deflated, swapped);

    locus_volume_info &info = source.info;
    info = default_info();
    info.format = LOCUS_VOLUME_NIFTI;
    info.big_endian = swapped ? 1 : 0; // as long as this machine is little endian
    for (int axis = 0; axis < 3; ++axis)
        info.dims[axis] = axis < image->ndim ? static_cast<uint64_t>(image->dim[axis + 1]) : 1;
    // Everything beyond space counts as components: time, or the fifth axis of vectors.
    for (int64_t axis = 4; axis <= image->ndim; ++axis)
        info.components *= static_cast<uint64_t>(image->dim[axis]);
    set_type(*image, source, file.path());
    set_geometry(*image, info, file.path());
    source.data_path = file.path();
    source.skip = static_cast<uint64_t>(image->iname_offset);
    return source;
}

} // namespace locus::io
