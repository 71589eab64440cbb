// The types of numbers in volume files: sizes, names, byte order and conversion.
#pragma once

#include <locus/volume.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace locus::io {

struct VoxelType {
    uint32_t type; // LOCUS_VOXEL_
    size_t bytes;
    std::string_view metaimage; // its names in the headers of the formats
    std::string_view nrrd;
    int nifti; // its code in NIfTI headers
};

// All types there are.
std::span<const VoxelType> voxel_types();

// A type's row of the table; NULL for a number that is none of LOCUS_VOXEL_.
const VoxelType *find_voxel_type(uint32_t type);

// Call visit(std::type_identity<T>{}) with the C++ type of a valid LOCUS_VOXEL_.
template <typename Visit>
void with_voxel_type(uint32_t type, Visit &&visit) {
    switch (type) {
    case LOCUS_VOXEL_UINT8:
        return visit(std::type_identity<uint8_t>{});
    case LOCUS_VOXEL_INT8:
        return visit(std::type_identity<int8_t>{});
    case LOCUS_VOXEL_UINT16:
        return visit(std::type_identity<uint16_t>{});
    case LOCUS_VOXEL_INT16:
        return visit(std::type_identity<int16_t>{});
    case LOCUS_VOXEL_UINT32:
        return visit(std::type_identity<uint32_t>{});
    case LOCUS_VOXEL_INT32:
        return visit(std::type_identity<int32_t>{});
    case LOCUS_VOXEL_UINT64:
        return visit(std::type_identity<uint64_t>{});
    case LOCUS_VOXEL_INT64:
        return visit(std::type_identity<int64_t>{});
    case LOCUS_VOXEL_FLOAT32:
        return visit(std::type_identity<float>{});
    case LOCUS_VOXEL_FLOAT64:
        return visit(std::type_identity<double>{});
    default:
        return;
    }
}

// Reverse the bytes of each number of `width` bytes.
void swap_bytes(std::byte *numbers, size_t count, size_t width);

// target[i] = slope * source[i * stride] + intercept, for `count` numbers of `type` in the machine's byte order.
void convert_to_float(const std::byte *source, uint32_t type, size_t stride, float *target, size_t count, double slope,
                      double intercept);

// Copy `count` numbers of `width` bytes, every source_stride'th to every target_stride'th place.
void copy_strided(const std::byte *source, size_t source_stride, std::byte *target, size_t target_stride, size_t count,
                  size_t width);

} // namespace locus::io
