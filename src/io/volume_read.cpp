// Reading a volume: header, checks against the files' sizes, then the numbers in pieces through one buffer.
#include "core/error.hpp"
#include "io/byte_stream.hpp"
#include "io/volume_file.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>

namespace locus::io {
namespace {

constexpr uint64_t piece_bytes = uint64_t{1} << 20;
constexpr uint64_t deflate_limit = 1032; // no deflate stream grows by more (zlib's technical notes)

VolumeSource parse(const std::string &path, const locus_volume_read_options &options) {
    const InputFile file(path);
    if (options.format == LOCUS_VOLUME_RAW)
        return describe_raw(file, options);
    std::string head(static_cast<size_t>(std::min<uint64_t>(file.size(), head_bytes)), '\0');
    head.resize(file.read_at(0, std::as_writable_bytes(std::span(head))));
    const uint32_t format = options.format == LOCUS_VOLUME_AUTO ? detect_format(file, head) : options.format;
    VolumeSource source = format == LOCUS_VOLUME_METAIMAGE ? parse_metaimage(file, head)
                          : format == LOCUS_VOLUME_NRRD    ? parse_nrrd(file, head)
                                                           : parse_nifti(file);
    check_info(source.info, LOCUS_E_FORMAT, path + ": ");
    return source;
}

// Bytes of the numbers in the file, decompressed.
uint64_t stored_bytes(const VolumeSource &source) {
    return bytes_of(source.info, find_voxel_type(source.info.type)->bytes);
}

// Refuse sizes that cannot be true before any memory is taken; settles where the numbers begin.
void check_sizes(VolumeSource &source, const InputFile &file, bool allow_trailing) {
    const uint64_t need = stored_bytes(source);
    const auto lies = [&](const auto &...parts) {
        const locus_volume_info &info = source.info;
        fail(LOCUS_E_FORMAT, file.path(), ": ", info.dims[0], " x ", info.dims[1], " x ", info.dims[2], " voxels of ",
             info.components, " component(s) take ", need, " bytes, but ", parts...);
    };
    if (source.at_end) {
        if (need > file.size())
            lies("the file has ", file.size());
        source.offset = file.size() - need;
        source.skip = 0;
        return;
    }
    const uint64_t there = file.size() - std::min(source.offset, file.size());
    if (source.stated && (*source.stated > there || (*source.stated < there && !allow_trailing)))
        fail(LOCUS_E_FORMAT, file.path(), ": the compressed data are ", *source.stated,
             " bytes by the header, but the file holds ", there);
    if (source.deflated) {
        if (source.skip / deflate_limit > there || need / deflate_limit > there)
            lies("the file's ", there, " compressed bytes cannot hold as many");
        return;
    }
    const uint64_t behind = there - std::min(source.skip, there);
    if (behind < need)
        lies("the file holds ", behind, " behind its header");
    if (behind > need && !allow_trailing)
        lies("the file holds ", behind, " behind its header: are the dims wrong? (allow_trailing would take it)");
}

bool to_float(const locus_volume_read_options &options) { return options.numbers == LOCUS_READ_FLOAT; }

locus_volume_info info_in_memory(const VolumeSource &source, const locus_volume_read_options &options) {
    locus_volume_info info = source.info;
    if (!to_float(options))
        return info;
    info.type = LOCUS_VOXEL_FLOAT32;
    info.slope = 1;
    info.intercept = 0;
    return info;
}

// Take over `count` numbers of the file that begin with its number `first`.
void store(const VolumeSource &source, std::byte *piece, uint64_t first, size_t count, locus_volume &volume) {
    const locus_volume_info &from = source.info;
    const size_t width = find_voxel_type(from.type)->bytes;
    const size_t target_width = find_voxel_type(volume.info.type)->bytes;
    if (from.big_endian != 0)
        swap_bytes(piece, count, width);
    // Interleaved numbers go to as many volumes as there are components; pieces hold whole voxels then.
    const uint64_t lanes = source.interleaved ? from.components : 1;
    const uint64_t lane_stride = source.interleaved ? voxels_of(from) : 0;
    for (uint64_t lane = 0; lane < lanes; ++lane) {
        std::byte *target = volume.data.get() + (lane * lane_stride + first / lanes) * target_width;
        const std::byte *begin = piece + lane * width;
        if (volume.info.type == from.type && from.slope == volume.info.slope && from.intercept == volume.info.intercept)
            copy_strided(begin, lanes, target, 1, count / lanes, width);
        else
            convert_to_float(begin, from.type, lanes, reinterpret_cast<float *>(target), count / lanes, from.slope,
                             from.intercept);
    }
}

void read_numbers(const VolumeSource &source, const InputFile &file, bool allow_trailing, locus_volume &volume) {
    ByteReader reader(file, source.deflated ? source.offset : source.offset + source.skip, source.deflated);
    const uint64_t need = stored_bytes(source);
    const auto truncated = [&](uint64_t got) {
        fail(LOCUS_E_FORMAT, file.path(), ": the data end after ", got, " of ", need, " bytes");
    };
    if (source.deflated && reader.skip(source.skip) < source.skip)
        truncated(0);
    const size_t width = find_voxel_type(source.info.type)->bytes;
    const uint64_t step = source.interleaved ? source.info.components : 1;
    const uint64_t numbers = need / width;
    const uint64_t piece = std::min(numbers, std::max<uint64_t>(1, piece_bytes / width / step) * step);
    std::vector<std::byte> buffer(static_cast<size_t>(piece * width));
    for (uint64_t first = 0; first < numbers; first += piece) {
        const size_t count = static_cast<size_t>(std::min(piece, numbers - first));
        const size_t got = reader.read(std::span(buffer).first(count * width));
        if (got < count * width)
            truncated(first * width + got);
        store(source, buffer.data(), first, count, volume);
    }
    if (allow_trailing || source.at_end)
        return;
    std::byte beyond{};
    if (reader.read(std::span(&beyond, 1)) != 0)
        fail(LOCUS_E_FORMAT, file.path(), ": the data are longer than the ", need,
             " bytes of the header's dims (allow_trailing would take it)");
    if (reader.broken_off())
        fail(LOCUS_E_FORMAT, file.path(), ": the compressed data break off before their checksum");
}

} // namespace

locus_volume_info probe_volume(const std::string &path, const locus_volume_read_options &options) {
    VolumeSource source = parse(path, options);
    check_sizes(source, InputFile(source.data_path), options.allow_trailing != 0);
    return info_in_memory(source, options);
}

std::unique_ptr<locus_volume> read_volume(const std::string &path, const locus_volume_read_options &options) {
    VolumeSource source = parse(path, options);
    const InputFile file(source.data_path);
    check_sizes(source, file, options.allow_trailing != 0);
    auto volume = std::make_unique<locus_volume>();
    volume->info = info_in_memory(source, options);
    const uint64_t bytes = bytes_of(volume->info, find_voxel_type(volume->info.type)->bytes);
    if (bytes > options.memory_limit)
        fail(LOCUS_E_MEMORY, path, ": the volume takes ", bytes, " bytes in memory, more than memory_limit, ",
             options.memory_limit);
    volume->data = std::make_unique_for_overwrite<std::byte[]>(static_cast<size_t>(bytes));
    read_numbers(source, file, options.allow_trailing != 0, *volume);
    return volume;
}

} // namespace locus::io
