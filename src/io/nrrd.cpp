// NRRD headers (.nrrd, .nhdr): lines "field: value", ended by an empty line or, beside the data, by the end of the
// file. Format: "Definition of NRRD File Format", Teem.
#include "core/error.hpp"
#include "io/header_text.hpp"
#include "io/volume_source.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace locus::io {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

// Read the fields, names in lower case without blanks; returns where the data begin (behind the empty line).
size_t read_fields(const InputFile &file, std::string_view head, HeaderFields &fields) {
    std::string_view rest = head;
    std::string_view line;
    next_line(rest, line);
    if (line.size() != 8 || !line.starts_with("NRRD000") || line[7] < '1' || line[7] > '5')
        fields.unsupported("the first line", line, "not NRRD0001 to NRRD0005");
    while (next_line(rest, line)) {
        if (line.empty())
            return head.size() - rest.size();
        if (line.front() == '#')
            continue;
        const size_t colon = line.find(':');
        if (colon == std::string_view::npos)
            fields.refuse("the header's line", line, "not of the form \"field: value\"");
        if (colon + 1 < line.size() && line[colon + 1] == '=')
            continue; // a key/value pair, for people
        std::string name = lower(line.substr(0, colon));
        std::erase(name, ' ');
        fields.add(name, trim(line.substr(colon + 1)));
        if (fields.optional({"datafile"}).starts_with("LIST"))
            return head.size() - rest.size();
    }
    if (!fields.has("datafile"))
        fail(LOCUS_E_FORMAT, file.path(), ": the header has no end (an empty line) and names no data file");
    return head.size();
}

uint32_t parse_type(const HeaderFields &fields) {
    static constexpr std::array<std::pair<std::string_view, uint32_t>, 40> names{{
        {"signed char", LOCUS_VOXEL_INT8},
        {"int8", LOCUS_VOXEL_INT8},
        {"int8_t", LOCUS_VOXEL_INT8},
        {"uchar", LOCUS_VOXEL_UINT8},
        {"unsigned char", LOCUS_VOXEL_UINT8},
        {"uint8", LOCUS_VOXEL_UINT8},
        {"uint8_t", LOCUS_VOXEL_UINT8},
        {"short", LOCUS_VOXEL_INT16},
        {"short int", LOCUS_VOXEL_INT16},
        {"signed short", LOCUS_VOXEL_INT16},
        {"signed short int", LOCUS_VOXEL_INT16},
        {"int16", LOCUS_VOXEL_INT16},
        {"int16_t", LOCUS_VOXEL_INT16},
        {"ushort", LOCUS_VOXEL_UINT16},
        {"unsigned short", LOCUS_VOXEL_UINT16},
        {"unsigned short int", LOCUS_VOXEL_UINT16},
        {"uint16", LOCUS_VOXEL_UINT16},
        {"uint16_t", LOCUS_VOXEL_UINT16},
        {"int", LOCUS_VOXEL_INT32},
        {"signed int", LOCUS_VOXEL_INT32},
        {"int32", LOCUS_VOXEL_INT32},
        {"int32_t", LOCUS_VOXEL_INT32},
        {"uint", LOCUS_VOXEL_UINT32},
        {"unsigned int", LOCUS_VOXEL_UINT32},
        {"uint32", LOCUS_VOXEL_UINT32},
        {"uint32_t", LOCUS_VOXEL_UINT32},
        {"longlong", LOCUS_VOXEL_INT64},
        {"long long", LOCUS_VOXEL_INT64},
        {"long long int", LOCUS_VOXEL_INT64},
        {"signed long long", LOCUS_VOXEL_INT64},
        {"signed long long int", LOCUS_VOXEL_INT64},
        {"int64", LOCUS_VOXEL_INT64},
        {"int64_t", LOCUS_VOXEL_INT64},
        {"ulonglong", LOCUS_VOXEL_UINT64},
        {"unsigned long long", LOCUS_VOXEL_UINT64},
        {"unsigned long long int", LOCUS_VOXEL_UINT64},
        {"uint64", LOCUS_VOXEL_UINT64},
        {"uint64_t", LOCUS_VOXEL_UINT64},
        {"float", LOCUS_VOXEL_FLOAT32},
        {"double", LOCUS_VOXEL_FLOAT64},
    }};
    const std::string_view text = fields.required("type");
    const auto found = std::ranges::find(names, lower(text), &std::pair<std::string_view, uint32_t>::first);
    if (found == names.end())
        fields.unsupported("type", text, "not a type of number that is read");
    return found->second;
}

using Vector = std::array<double, 3>;

// "(a,b,c)" with blanks anywhere; takes it off the front of `text`.
Vector take_vector(const HeaderFields &fields, std::string_view name, std::string_view whole, std::string_view &text) {
    const size_t close = text.find(')');
    if (!text.starts_with('(') || close == std::string_view::npos)
        fields.refuse(name, whole, "not vectors of the form (a,b,c)");
    std::string inside(text.substr(1, close - 1));
    if (std::ranges::count(inside, ',') != 2)
        fields.unsupported(name, whole, "not vectors of three numbers");
    std::ranges::replace(inside, ',', ' ');
    const auto numbers = fields.numbers(name, inside, 3);
    text = trim(text.substr(close + 1));
    return {numbers[0], numbers[1], numbers[2]};
}

struct Axes {
    std::vector<uint64_t> sizes;
    std::vector<std::optional<Vector>> directions; // empty, or one per axis; none for an axis outside space
    size_t component = SIZE_MAX;                   // the axis of the components, if any
};

void parse_directions(const HeaderFields &fields, Axes &axes) {
    const std::string_view whole = fields.optional({"spacedirections"});
    for (std::string_view text = trim(whole); !text.empty();) {
        if (lower(text.substr(0, 4)) == "none") {
            axes.directions.emplace_back();
            text = trim(text.substr(4));
        } else {
            axes.directions.emplace_back(take_vector(fields, "space directions", whole, text));
        }
    }
    if (!whole.empty() && axes.directions.size() != axes.sizes.size())
        fields.refuse("space directions", whole, "not one per axis");
}

// The axis that is not one of space: by its direction "none", else by its kind, else the fourth.
void find_component_axis(const HeaderFields &fields, Axes &axes) {
    const auto kinds = words(fields.optional({"kinds"}));
    if (!kinds.empty() && kinds.size() != axes.sizes.size())
        fields.refuse("kinds", fields.optional({"kinds"}), "not one per axis");
    for (size_t axis = 0; axis < axes.sizes.size(); ++axis) {
        const std::string kind = kinds.empty() ? "" : lower(kinds[axis]);
        const bool spatial = axes.directions.empty() ? kind.empty() || kind == "domain" || kind == "space" ||
                                                           kind == "none" || kind == "???"
                                                     : axes.directions[axis].has_value();
        if (spatial)
            continue;
        if (axes.component != SIZE_MAX)
            fields.unsupported("kinds", fields.optional({"kinds"}), "more than one axis outside space");
        axes.component = axis;
    }
    const size_t last = axes.sizes.size() - 1;
    if (axes.component == SIZE_MAX && axes.sizes.size() == 4)
        axes.component = last;
    if (axes.component != SIZE_MAX && axes.component != 0 && axes.component != last)
        fields.unsupported("kinds", fields.optional({"kinds"}), "the axis outside space is neither first nor last");
}

// Turn the world's axes to left, posterior, superior; other spaces are taken as they are.
void turn_to_lps(const HeaderFields &fields, locus_volume_info &info) {
    const std::string space = lower(fields.optional({"space"}));
    if (space.ends_with("-time"))
        fields.unsupported("space", space, "a space with time");
    const bool right = space == "right-anterior-superior" || space == "ras";
    const bool anterior = right || space == "left-anterior-superior" || space == "las";
    const auto flip = [&](size_t coordinate) {
        for (size_t axis = 0; axis < 3; ++axis)
            info.direction[3 * axis + coordinate] *= -1;
        info.origin[coordinate] *= -1;
    };
    if (right)
        flip(0);
    if (anterior)
        flip(1);
}

void parse_geometry(const HeaderFields &fields, const Axes &axes, locus_volume_info &info) {
    const std::string_view spacings = fields.optional({"spacings"});
    const auto steps =
        spacings.empty() ? std::vector<double>{} : fields.numbers("spacings", spacings, axes.sizes.size());
    size_t grid = 0;
    for (size_t axis = 0; axis < axes.sizes.size(); ++axis) {
        if (axis == axes.component)
            continue;
        info.dims[grid] = axes.sizes[axis];
        if (!axes.directions.empty()) {
            const Vector &step = *axes.directions[axis];
            const double length = std::hypot(step[0], step[1], step[2]);
            if (!(length > 0) || !std::isfinite(length))
                fields.refuse("space directions", fields.optional({"spacedirections"}), "a vector has no length");
            info.spacing[grid] = length;
            for (size_t i = 0; i < 3; ++i)
                info.direction[3 * grid + i] = step[i] / length;
        } else if (!steps.empty() && !std::isnan(steps[axis])) {
            info.spacing[grid] = steps[axis];
        }
        ++grid;
    }
    if (const auto whole = fields.optional({"spaceorigin"}); !whole.empty()) {
        std::string_view rest = whole;
        const Vector origin = take_vector(fields, "space origin", whole, rest);
        std::ranges::copy(origin, info.origin);
    }
    turn_to_lps(fields, info);
}

// How many bytes `lines` lines take from `offset` on in the data file.
uint64_t skip_lines(const InputFile &file, uint64_t offset, uint64_t lines) {
    std::array<std::byte, 4096> buffer{};
    while (lines > 0) {
        const size_t got = file.read_at(offset, buffer);
        if (got == 0)
            fail(LOCUS_E_FORMAT, file.path(), ": fewer lines than \"line skip\" passes over");
        size_t used = 0;
        while (used < got && lines > 0)
            lines -= buffer[used++] == std::byte{'\n'};
        offset += used;
    }
    return offset;
}

void parse_place(const InputFile &file, const HeaderFields &fields, size_t header_bytes, VolumeSource &source) {
    const std::string encoding = lower(fields.required("encoding"));
    source.deflated = encoding == "gzip" || encoding == "gz";
    if (!source.deflated && encoding != "raw")
        fields.unsupported("encoding", encoding, "neither raw nor gzip");
    const std::string_view name = fields.optional({"datafile"});
    if (name.starts_with("LIST") || name.find('%') != std::string_view::npos)
        fields.unsupported("data file", name, "one file per slice");
    source.data_path = name.empty() ? file.path() : beside(file.path(), name);
    source.offset = name.empty() ? header_bytes : 0;
    if (const auto text = fields.optional({"lineskip"}); !text.empty())
        source.offset = skip_lines(name.empty() ? InputFile(file.path()) : InputFile(source.data_path), source.offset,
                                   fields.whole("line skip", text));
    const std::string_view skip = fields.optional({"byteskip"});
    if (skip == "-1") {
        if (source.deflated)
            fields.unsupported("byte skip", skip, "with compressed data");
        source.at_end = true;
    } else if (!skip.empty()) {
        source.skip = fields.whole("byte skip", skip);
    }
}

} // namespace

VolumeSource parse_nrrd(const InputFile &file, std::string_view head) {
    HeaderFields fields(file.path());
    const size_t header_bytes = read_fields(file, head, fields);

    VolumeSource source;
    locus_volume_info &info = source.info;
    info = default_info();
    info.format = LOCUS_VOLUME_NRRD;
    info.type = info.file_type = parse_type(fields);
    const std::string_view dimension = fields.required("dimension");
    const uint64_t count = fields.whole("dimension", dimension);
    if (count < 1)
        fields.refuse("dimension", dimension, "not a dimension");
    if (count > 4)
        fields.unsupported("dimension", dimension, "more than four axes");
    Axes axes;
    axes.sizes = fields.wholes("sizes", fields.required("sizes"), static_cast<size_t>(count));
    parse_directions(fields, axes);
    find_component_axis(fields, axes);
    for (uint64_t &dim : info.dims)
        dim = 1;
    parse_geometry(fields, axes, info);
    if (axes.component != SIZE_MAX)
        info.components = axes.sizes[axes.component];
    source.interleaved = axes.component == 0;

    if (find_voxel_type(info.type)->bytes > 1) {
        const std::string endian = lower(fields.required("endian"));
        if (endian != "little" && endian != "big")
            fields.refuse("endian", endian, "neither little nor big");
        info.big_endian = endian == "big" ? 1 : 0;
    }
    parse_place(file, fields, header_bytes, source);
    return source;
}

} // namespace locus::io
