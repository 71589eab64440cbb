// MetaImage headers (.mhd, .mha): lines "Key = Value", ended by ElementDataFile. Format: the MetaIO documentation of
// ITK.
#include "core/error.hpp"
#include "io/header_text.hpp"
#include "io/volume_source.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>

namespace locus::io {
namespace {

// Read the fields up to ElementDataFile; returns how many bytes they take.
size_t read_fields(const InputFile &file, std::string_view head, HeaderFields &fields) {
    std::string_view rest = head;
    for (std::string_view line; next_line(rest, line);) {
        if (trim(line).empty())
            continue;
        const size_t equals = line.find('=');
        if (equals == std::string_view::npos || line.find('\0') != std::string_view::npos)
            fields.refuse("the header's line", line, "not of the form \"Key = Value\"");
        const std::string_view key = trim(line.substr(0, equals));
        fields.add(key, trim(line.substr(equals + 1)));
        if (key == "ElementDataFile")
            return head.size() - rest.size();
    }
    fail(LOCUS_E_FORMAT, file.path(), ": the header has no field \"ElementDataFile\"");
}

uint32_t parse_type(const HeaderFields &fields) {
    const std::string_view text = fields.required("ElementType");
    std::string_view name = text;
    // The channels of older files; MET_LONG has 4 bytes in the format, whatever the machine's long has.
    if (name.ends_with("_ARRAY"))
        name.remove_suffix(6);
    if (name == "MET_LONG")
        return LOCUS_VOXEL_INT32;
    if (name == "MET_ULONG")
        return LOCUS_VOXEL_UINT32;
    for (const VoxelType &type : voxel_types())
        if (type.metaimage == name)
            return type.type;
    fields.unsupported("ElementType", text, "not a type of number that is read");
}

// Fill axes 0 .. count-1 of what lies in space; a fourth axis holds the components.
void parse_geometry(const HeaderFields &fields, size_t count, locus_volume_info &info) {
    const size_t axes = std::min<size_t>(count, 3);
    if (const auto text = fields.optional({"ElementSpacing", "ElementSize"}); !text.empty()) {
        const auto spacing = fields.numbers("ElementSpacing", text, count);
        std::copy_n(spacing.begin(), axes, info.spacing);
    }
    if (const auto text = fields.optional({"Offset", "Position", "Origin"}); !text.empty()) {
        const auto origin = fields.numbers("Offset", text, count);
        std::copy_n(origin.begin(), axes, info.origin);
    }
    if (const auto text = fields.optional({"TransformMatrix", "Rotation", "Orientation"}); !text.empty()) {
        const auto matrix = fields.numbers("TransformMatrix", text, count * count); // one row per grid axis
        for (size_t axis = 0; axis < axes; ++axis)
            std::copy_n(matrix.begin() + static_cast<ptrdiff_t>(axis * count), axes, info.direction + 3 * axis);
    }
}

// Where the numbers are.
void parse_place(const InputFile &file, const HeaderFields &fields, size_t header_bytes, VolumeSource &source) {
    const std::string_view name = fields.required("ElementDataFile");
    const std::string_view skip = fields.optional({"HeaderSize"});
    const bool local = equal_ignoring_case(name, "LOCAL");
    if (name == "LIST" || name.starts_with("LIST ") || name.find('%') != std::string_view::npos)
        fields.unsupported("ElementDataFile", name, "one file per slice");
    source.data_path = local ? file.path() : beside(file.path(), name);
    source.offset = local ? header_bytes : 0;
    if (skip == "-1") {
        if (source.deflated)
            fields.unsupported("HeaderSize", skip, "with compressed data");
        source.at_end = true;
    } else if (!skip.empty()) {
        source.offset += std::min(fields.whole("HeaderSize", skip), uint64_t{1} << 62);
    }
    if (const auto text = fields.optional({"CompressedDataSize"}); source.deflated && !text.empty())
        source.stated = fields.whole("CompressedDataSize", text);
}

} // namespace

VolumeSource parse_metaimage(const InputFile &file, std::string_view head) {
    HeaderFields fields(file.path());
    const size_t header_bytes = read_fields(file, head, fields);
    if (const auto object = fields.optional({"ObjectType"}); !object.empty() && object != "Image")
        fields.unsupported("ObjectType", object, "not an image");

    VolumeSource source;
    locus_volume_info &info = source.info;
    info = default_info();
    info.format = LOCUS_VOLUME_METAIMAGE;
    info.type = info.file_type = parse_type(fields);
    const uint64_t count = fields.whole("NDims", fields.required("NDims"));
    if (count < 1)
        fields.refuse("NDims", fields.required("NDims"), "not a dimension");
    if (count > 4)
        fields.unsupported("NDims", fields.required("NDims"), "more than four axes");
    const auto dims = fields.wholes("DimSize", fields.required("DimSize"), static_cast<size_t>(count));
    for (size_t axis = 0; axis < 3; ++axis)
        info.dims[axis] = axis < count ? dims[axis] : 1;
    if (const auto text = fields.optional({"ElementNumberOfChannels"}); !text.empty())
        info.components = fields.whole("ElementNumberOfChannels", text);
    source.interleaved = true;
    if (count == 4) {
        if (info.components != 1)
            fields.unsupported("NDims", "4", "with several channels");
        info.components = dims[3];
        source.interleaved = false;
    }
    parse_geometry(fields, static_cast<size_t>(count), info);

    const auto flag = [&](std::initializer_list<std::string_view> names, bool absent) {
        const auto text = fields.optional(names);
        return text.empty() ? absent : fields.truth(*names.begin(), text);
    };
    if (!flag({"BinaryData"}, true))
        fields.unsupported("BinaryData", "False", "numbers written as text");
    info.big_endian = flag({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false) ? 1 : 0;
    source.deflated = flag({"CompressedData"}, false);
    const auto slope = fields.optional({"ElementToIntensityFunctionSlope"});
    const auto intercept = fields.optional({"ElementToIntensityFunctionOffset"});
    if (!slope.empty())
        info.slope = fields.number("ElementToIntensityFunctionSlope", slope);
    if (!intercept.empty())
        info.intercept = fields.number("ElementToIntensityFunctionOffset", intercept);
    parse_place(file, fields, header_bytes, source);
    return source;
}

} // namespace locus::io
