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

constexpr size_t info_size_0_1 = sizeof(locus_volume_info);
constexpr size_t read_size_0_1 = sizeof(locus_volume_read_options);
constexpr size_t write_size_0_1 = sizeof(locus_volume_write_options);
static_assert(info_size_0_1 == 192, "append only; then pin the first release's size");
static_assert(read_size_0_1 == 128, "append only; then pin the first release's size");
static_assert(write_size_0_1 == 16, "append only; then pin the first release's size");

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
    const auto options = read_options(given, default_read_options(), read_size_0_1);
    require(options.memory_limit > 0, "memory_limit is 0");
    require(options.numbers <= LOCUS_READ_KEEP, "numbers is ", options.numbers, ", none of LOCUS_READ_");
    require(options.format <= LOCUS_VOLUME_RAW, "format is ", options.format, ", none of LOCUS_VOLUME_");
    require(options.allow_trailing <= 1, "allow_trailing is ", options.allow_trailing, ", neither 0 nor 1");
    require(options.raw_big_endian <= 1, "raw_big_endian is ", options.raw_big_endian, ", neither 0 nor 1");
    require(options.raw_interleaved <= 1, "raw_interleaved is ", options.raw_interleaved, ", neither 0 nor 1");
    return options;
}

locus_volume_write_options checked(const locus_volume_write_options *given) {
    const auto options = read_options(given, default_write_options(), write_size_0_1);
    require(options.format <= LOCUS_VOLUME_NRRD, "format is ", options.format, ", not one that is written");
    require(options.compression <= 9, "compression is ", options.compression, ", outside 0..9");
    return options;
}

} // namespace

locus_status locus_volume_info_init(locus_volume_info *info, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(info, size, default_info(), info_size_0_1, "info"); });
}

locus_status locus_volume_read_options_init(locus_volume_read_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, default_read_options(), read_size_0_1); });
}

locus_status locus_volume_write_options_init(locus_volume_write_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { init_options(options, size, default_write_options(), write_size_0_1); });
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
        write_report(info, probe_volume(&need(path, "path"), checked(options)), info_size_0_1, "info");
    });
}

void locus_volume_destroy(locus_volume *volume) noexcept { delete volume; }

locus_status locus_volume_get_info(const locus_volume *volume, locus_volume_info *info) noexcept {
    return boundary(__func__, [&] { write_report(info, need(volume, "volume").info, info_size_0_1, "info"); });
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
        const locus_volume_info whole = read_options(info, default_info(), info_size_0_1);
        check_info(whole, LOCUS_E_ARGUMENT, "info->");
        require(whole.slope == 1 && whole.intercept == 0, "info->slope and intercept are ", whole.slope, " and ",
                whole.intercept, ": apply them to the numbers first");
        write_volume(path, whole, data, checked(options));
    });
}
