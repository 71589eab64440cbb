// libFuzzer: any bytes as a volume file. The first byte chooses the options, the rest is the file.
#include <locus/volume.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr uint64_t memory_limit = uint64_t{1} << 22;

void require(bool good) {
    if (!good)
        std::abort();
}

locus_volume_read_options options_of(uint8_t choice) {
    locus_volume_read_options options;
    require(locus_volume_read_options_init(&options, sizeof options) == LOCUS_OK);
    options.memory_limit = memory_limit;
    options.numbers = choice & 1;
    options.allow_trailing = choice >> 1 & 1;
    options.format = (choice >> 2 & 7) % (LOCUS_VOLUME_RAW + 1);
    options.raw_type = 1 + (choice >> 5);
    options.raw_dims[0] = options.raw_dims[1] = options.raw_dims[2] = 2;
    return options;
}

// A whole volume: every number of it can be read.
void use(const locus_volume *volume) {
    locus_volume_info info{};
    info.struct_size = sizeof info;
    require(locus_volume_get_info(volume, &info) == LOCUS_OK);
    uint64_t width = 4;
    if (info.type == LOCUS_VOXEL_UINT8 || info.type == LOCUS_VOXEL_INT8)
        width = 1;
    if (info.type == LOCUS_VOXEL_UINT16 || info.type == LOCUS_VOXEL_INT16)
        width = 2;
    if (info.type == LOCUS_VOXEL_UINT64 || info.type == LOCUS_VOXEL_INT64 || info.type == LOCUS_VOXEL_FLOAT64)
        width = 8;
    const uint64_t bytes = info.dims[0] * info.dims[1] * info.dims[2] * info.components * width;
    require(bytes > 0 && bytes <= memory_limit);
    const auto *data = static_cast<const unsigned char *>(locus_volume_data(volume));
    unsigned sum = 0;
    for (uint64_t i = 0; i < bytes; ++i)
        sum += data[i];
    volatile unsigned sink = sum;
    (void)sink;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    if (size < 1)
        return 0;
    static const int file = memfd_create("volume", 0);
    static const std::string path = "/proc/self/fd/" + std::to_string(file);
    require(file >= 0 && ftruncate(file, 0) == 0);
    require(pwrite(file, bytes + 1, size - 1, 0) == static_cast<ssize_t>(size - 1));
    const locus_volume_read_options options = options_of(bytes[0]);
    locus_volume *volume = nullptr;
    const locus_status status = locus_volume_read(path.c_str(), &options, &volume);
    require((status == LOCUS_OK) == (volume != nullptr));
    require(status != LOCUS_E_INTERNAL);
    if (status != LOCUS_OK)
        require(std::strlen(locus_io_last_error()) > 0);
    if (volume != nullptr)
        use(volume);
    locus_volume_destroy(volume);
    return 0;
}
