// The table of number types, byte order and conversion.
#include "io/voxel_type.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace locus::io {

static_assert(std::endian::native == std::endian::little, "the writers state little endian");

std::span<const VoxelType> voxel_types() {
    // NIfTI's codes are DT_ constants of nifti1.h.
    static constexpr std::array<VoxelType, 10> table{{
        {LOCUS_VOXEL_UINT8, 1, "MET_UCHAR", "uint8", 2},
        {LOCUS_VOXEL_INT8, 1, "MET_CHAR", "int8", 256},
        {LOCUS_VOXEL_UINT16, 2, "MET_USHORT", "uint16", 512},
        {LOCUS_VOXEL_INT16, 2, "MET_SHORT", "int16", 4},
        {LOCUS_VOXEL_UINT32, 4, "MET_UINT", "uint32", 768},
        {LOCUS_VOXEL_INT32, 4, "MET_INT", "int32", 8},
        {LOCUS_VOXEL_UINT64, 8, "MET_ULONG_LONG", "uint64", 1280},
        {LOCUS_VOXEL_INT64, 8, "MET_LONG_LONG", "int64", 1024},
        {LOCUS_VOXEL_FLOAT32, 4, "MET_FLOAT", "float", 16},
        {LOCUS_VOXEL_FLOAT64, 8, "MET_DOUBLE", "double", 64},
    }};
    return table;
}

const VoxelType *find_voxel_type(uint32_t type) {
    const auto table = voxel_types();
    const auto found = std::ranges::find(table, type, &VoxelType::type);
    return found == table.end() ? nullptr : &*found;
}

void swap_bytes(std::byte *numbers, size_t count, size_t width) {
    for (size_t i = 0; i < count; ++i)
        std::reverse(numbers + i * width, numbers + (i + 1) * width);
}

void convert_to_float(const std::byte *source, uint32_t type, size_t stride, float *target, size_t count, double slope,
                      double intercept) {
    with_voxel_type(type, [&]<typename T>(std::type_identity<T>) {
        const bool plain = slope == 1 && intercept == 0;
        for (size_t i = 0; i < count; ++i) {
            T number;
            std::memcpy(&number, source + i * stride * sizeof(T), sizeof(T));
            target[i] = plain ? static_cast<float>(number)
                              : static_cast<float>(slope * static_cast<double>(number) + intercept);
        }
    });
}

void copy_strided(const std::byte *source, size_t source_stride, std::byte *target, size_t target_stride, size_t count,
                  size_t width) {
    if (source_stride == 1 && target_stride == 1) {
        std::memcpy(target, source, count * width);
        return;
    }
    for (size_t i = 0; i < count; ++i)
        std::memcpy(target + i * target_stride * width, source + i * source_stride * width, width);
}

} // namespace locus::io
