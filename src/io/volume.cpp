// locus/volume.h
#include <locus/volume.h>

#include "core/options.hpp"
#include "io/boundary.hpp"
#include "io/volume_file.hpp"
#include "io/voxel_type.hpp"

#include <algorithm>
#include <cstddef>

using namespace locus;
using namespace locus::io;

namespace {

// Sizes of the first release; fields are only ever appended.
constexpr size_t first_info_size = 192;
constexpr size_t first_read_size = 128;
constexpr size_t first_write_size = 16;
static_assert(sizeof(locus_volume_info) == first_info_size, "append only; then keep first_info_size a number");
static_assert(sizeof(locus_volume_read_options) == first_read_size, "append only; then keep first_read_size a number");
static_assert(sizeof(locus_volume_write_options) == first_write_size,
              "append only; then keep first_write_size a number");

locus_volume_read_options default_read_options() {
    locus_volume_read_options options{};
    options.struct_size = sizeof options;
    options.memory_limit = uint64_t{8} << 30;
    options.raw_components = 1;
    std::ranges::fill(options.raw_spacing, 1.0);
    return options;
}

locus_volume_write_options default_write_options() { return {sizeof(locus_volume_write_options), 0, 0}; }

locus_volume_read_options checked(const locus_volume_read_options *given) {
    const auto options = read_options(given, default_read_options(), first_read_size);
    require(options.memory_limit > 0, "memory_limit is 0");
    require(options.numbers <= LOCUS_READ_KEEP, "numbers is ", options.numbers, ", none of LOCUS_READ_");
    require(options.format <= LOCUS_VOLUME_RAW, "format is ", options.format, ", none of LOCUS_VOLUME_");
    require(options.allow_trailing <= 1, "allow_trailing is ", options.allow_trailing, ", neither 0 nor 1");
    require(options.raw_big_endian <= 1, "raw_big_endian is ", options.raw_big_endian, ", neither 0 nor 1");
    require(options.raw_interleaved <= 1, "raw_interleaved is ", options.raw_interleaved, ", neither 0 nor 1");
    return options;
}

locus_volume_write_options checked(const locus_volume_write_options *given) {
    const auto options = read_options(given, default_write_options(), first_write_size);
    require(options.format <= LOCUS_VOLUME_NRRD, "format is ", options.format, ", not one that is written");
    require(options.compression <= 9, "compression is ", options.compression, ", outside 0..9");
    return options;
}

} // namespace

locus_status locus_volume_info_init(locus_volume_info *info, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(info, size, default_info(), first_info_size, "info"); });
}

locus_status locus_volume_read_options_init(locus_volume_read_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, default_read_options(), first_read_size); });
}

locus_status locus_volume_write_options_init(locus_volume_write_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, default_write_options(), first_write_size); });
}

locus_status locus_volume_read(const char *path, const locus_volume_read_options *options,
                               locus_volume **volume) noexcept {
    return boundary(__func__, [&] {
        need(volume, "volume") = nullptr;
        *volume = read_volume(&need(path, "path"), checked(options)).release();
    });
}

locus_status locus_volume_read_info(const char *path, const locus_volume_read_options *options,
                                    locus_volume_info *info) noexcept {
    return boundary(__func__, [&] {
        need(info, "info");
        write_report(info, probe_volume(&need(path, "path"), checked(options)), first_info_size, "info");
    });
}

void locus_volume_destroy(locus_volume *volume) noexcept { delete volume; }

locus_status locus_volume_get_info(const locus_volume *volume, locus_volume_info *info) noexcept {
    return boundary(__func__, [&] { write_report(info, need(volume, "volume").info, first_info_size, "info"); });
}

const void *locus_volume_data(const locus_volume *volume) noexcept {
    return volume == nullptr ? nullptr : volume->data.get();
}

locus_status locus_volume_write(const char *path, const locus_volume_info *info, const void *data,
                                const locus_volume_write_options *options) noexcept {
    return boundary(__func__, [&] {
        need(path, "path");
        require(data != nullptr, "data is NULL");
        need(info, "info");
        const locus_volume_info whole = read_options(info, default_info(), first_info_size);
        check_info(whole, LOCUS_E_ARGUMENT, "info->");
        require(whole.slope == 1 && whole.intercept == 0, "info->slope and intercept are ", whole.slope, " and ",
                whole.intercept, ": apply them to the numbers first");
        write_volume(path, whole, data, checked(options));
    });
}
