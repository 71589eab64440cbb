// Writing volumes as MetaImage and NRRD, in one file or as a header beside its data.
#include "core/error.hpp"
#include "io/byte_stream.hpp"
#include "io/volume_file.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>
#include <charconv>
#include <span>
#include <string_view>

namespace locus::io {
namespace {

constexpr uint64_t piece_bytes = uint64_t{1} << 20;
constexpr size_t size_digits = 20; // of CompressedDataSize, which is filled in when it is known

struct Target {
    uint32_t format;
    bool detached;
    std::string header_path;
    std::string data_path; // the same where attached
    ByteWriter::Wrap wrap;
};

Target target_of(const std::string &path, const locus_volume_write_options &options) {
    const bool meta = path.ends_with(".mha") || path.ends_with(".mhd");
    const bool nrrd = path.ends_with(".nrrd") || path.ends_with(".nhdr");
    uint32_t format = options.format;
    if (format == LOCUS_VOLUME_AUTO) {
        require(meta || nrrd, "path is \"", path, "\": its ending is none of .mha, .mhd, .nrrd, .nhdr");
        format = meta ? LOCUS_VOLUME_METAIMAGE : LOCUS_VOLUME_NRRD;
    }
    Target target{format, path.ends_with(".mhd") || path.ends_with(".nhdr"), path, path, ByteWriter::Wrap::none};
    if (options.compression > 0)
        target.wrap = format == LOCUS_VOLUME_METAIMAGE ? ByteWriter::Wrap::zlib : ByteWriter::Wrap::gzip;
    if (target.detached) {
        require(path.find_first_of("\r\n") == std::string::npos, "path holds a line break, which no header can name");
        const char *ending = target.wrap == ByteWriter::Wrap::none   ? ".raw"
                             : target.wrap == ByteWriter::Wrap::zlib ? ".zraw"
                                                                     : ".raw.gz";
        target.data_path = path.substr(0, path.rfind('.')) + ending;
    }
    return target;
}

// Parts of a header: texts as they are, whole numbers, and doubles as the shortest text that reads back the same.
void put(std::string &text, std::string_view part) { text += part; }
void put(std::string &text, uint64_t value) { text += std::to_string(value); }
void put(std::string &text, double value) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value == 0 ? 0.0 : value).ptr);
}

template <typename... Parts>
void line(std::string &text, const Parts &...parts) {
    (put(text, parts), ...);
    text += '\n';
}

template <typename T>
std::string joined(std::span<const T> values, std::string_view between) {
    std::string text;
    for (const T &value : values) {
        if (!text.empty())
            text += between;
        put(text, value);
    }
    return text;
}

std::string_view file_name(std::string_view path) { return path.substr(path.rfind('/') + 1); }

// ElementDataFile must be the last field.
std::string metaimage_header(const locus_volume_info &info, const Target &target, uint64_t compressed_bytes) {
    std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n";
    if (target.wrap != ByteWriter::Wrap::none) {
        const std::string size = std::to_string(compressed_bytes);
        line(text, "CompressedData = True");
        line(text, "CompressedDataSize = ", std::string(size_digits - size.size(), '0'), size);
    }
    line(text, "TransformMatrix = ", joined(std::span<const double>(info.direction), " "));
    line(text, "Offset = ", joined(std::span<const double>(info.origin), " "));
    line(text, "CenterOfRotation = 0 0 0");
    line(text, "ElementSpacing = ", joined(std::span<const double>(info.spacing), " "));
    line(text, "DimSize = ", joined(std::span<const uint64_t>(info.dims), " "));
    if (info.components > 1)
        line(text, "ElementNumberOfChannels = ", info.components);
    line(text, "ElementType = ", find_voxel_type(info.type)->metaimage);
    line(text, "ElementDataFile = ", target.detached ? file_name(target.data_path) : "LOCAL");
    return text;
}

std::string nrrd_header(const locus_volume_info &info, const Target &target) {
    const bool several = info.components > 1;
    std::string text = "NRRD0004\n# Complete NRRD file format specification at:\n"
                       "# http://teem.sourceforge.net/nrrd/format.html\n";
    line(text, "type: ", find_voxel_type(info.type)->nrrd);
    line(text, "dimension: ", several ? "4" : "3");
    const std::string list_size = several ? std::to_string(info.components) + " " : "";
    line(text, "sizes: ", list_size, joined(std::span<const uint64_t>(info.dims), " "));
    line(text, "space: left-posterior-superior"); // VTK forgets a fourth axis whose size comes later
    text += several ? "space directions: none" : "space directions:";
    for (int axis = 0; axis < 3; ++axis) {
        double step[3];
        for (int i = 0; i < 3; ++i)
            step[i] = info.spacing[axis] * info.direction[3 * axis + i];
        text += " (" + joined(std::span<const double>(step), ",") + ")";
    }
    line(text);
    line(text, several ? "kinds: list domain domain domain" : "kinds: domain domain domain");
    line(text, "endian: little");
    line(text, "encoding: ", target.wrap == ByteWriter::Wrap::none ? "raw" : "gzip");
    line(text, "space origin: (", joined(std::span<const double>(info.origin), ","), ")");
    if (target.detached)
        line(text, "data file: ", file_name(target.data_path));
    if (!target.detached)
        line(text); // the empty line that ends the header
    return text;
}

// All numbers, the components of a voxel side by side.
void write_numbers(const locus_volume_info &info, const std::byte *data, ByteWriter &writer) {
    const size_t width = find_voxel_type(info.type)->bytes;
    const uint64_t voxels = voxels_of(info);
    if (info.components == 1) {
        writer.write(std::span(data, static_cast<size_t>(voxels * width)));
        return;
    }
    const uint64_t piece = std::min(voxels, std::max<uint64_t>(1, piece_bytes / width / info.components));
    std::vector<std::byte> buffer(static_cast<size_t>(piece * info.components * width));
    for (uint64_t first = 0; first < voxels; first += piece) {
        const size_t count = static_cast<size_t>(std::min(piece, voxels - first));
        for (uint64_t c = 0; c < info.components; ++c)
            copy_strided(data + (c * voxels + first) * width, 1, buffer.data() + c * width,
                         static_cast<size_t>(info.components), count, width);
        writer.write(std::span(buffer).first(count * static_cast<size_t>(info.components) * width));
    }
}

std::span<const std::byte> bytes_of_text(const std::string &text) { return std::as_bytes(std::span(text)); }

} // namespace

void write_volume(const std::string &path, const locus_volume_info &info, const void *data,
                  const locus_volume_write_options &options) {
    const Target target = target_of(path, options);
    const auto header = [&](uint64_t compressed_bytes) {
        return target.format == LOCUS_VOLUME_METAIMAGE ? metaimage_header(info, target, compressed_bytes)
                                                       : nrrd_header(info, target);
    };
    AtomicFile file(target.data_path);
    if (!target.detached)
        file.write(bytes_of_text(header(0)));
    const uint64_t begin = file.size();
    ByteWriter writer(file, target.wrap, static_cast<int>(options.compression));
    write_numbers(info, static_cast<const std::byte *>(data), writer);
    writer.finish();
    const std::string text = header(file.size() - begin); // as long as before: the size has a fixed width
    if (target.detached) {
        AtomicFile header_file(target.header_path);
        header_file.write(bytes_of_text(text));
        file.commit();
        header_file.commit();
        return;
    }
    file.overwrite(0, bytes_of_text(text));
    file.commit();
}

} // namespace locus::io
