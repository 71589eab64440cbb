// Helpers of the volume tests: a folder of their own, files made by hand, reading through the public interface.
#pragma once

#include <locus/volume.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace volume_test {

class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "locus-volume-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::string operator/(const std::string &name) const { return (path_ / name).string(); }
    std::string write(const std::string &name, const std::string &bytes) const {
        std::ofstream(*this / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return *this / name;
    }
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto &entry : std::filesystem::directory_iterator(path_))
            found.push_back(entry.path().filename());
        std::ranges::sort(found);
        return found;
    }

private:
    std::filesystem::path path_;
};

inline std::string content(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline locus_volume_read_options read_options() {
    locus_volume_read_options options;
    EXPECT_EQ(locus_volume_read_options_init(&options, sizeof options), LOCUS_OK);
    return options;
}

inline locus_volume_info make_info(uint64_t nx, uint64_t ny, uint64_t nz, uint32_t type = LOCUS_VOXEL_FLOAT32) {
    locus_volume_info info;
    EXPECT_EQ(locus_volume_info_init(&info, sizeof info), LOCUS_OK);
    info.dims[0] = nx, info.dims[1] = ny, info.dims[2] = nz;
    info.type = type;
    return info;
}

struct Destroy {
    void operator()(locus_volume *volume) const { locus_volume_destroy(volume); }
};
using Volume = std::unique_ptr<locus_volume, Destroy>;

// Read a file that must be good.
inline Volume read(const std::string &path, const locus_volume_read_options *options = nullptr) {
    locus_volume *volume = nullptr;
    EXPECT_EQ(locus_volume_read(path.c_str(), options, &volume), LOCUS_OK) << locus_io_last_error();
    return Volume(volume);
}

inline locus_volume_info info_of(const Volume &volume) {
    locus_volume_info info{};
    info.struct_size = sizeof info;
    EXPECT_EQ(locus_volume_get_info(volume.get(), &info), LOCUS_OK);
    return info;
}

inline size_t count_of(const locus_volume_info &info) {
    return static_cast<size_t>(info.dims[0] * info.dims[1] * info.dims[2] * info.components);
}

template <typename T>
std::vector<T> numbers_of(const Volume &volume) {
    const auto *data = static_cast<const T *>(locus_volume_data(volume.get()));
    return {data, data + count_of(info_of(volume))};
}

// Numbers as bytes, high byte first if asked.
template <typename T>
std::string bytes_of(const std::vector<T> &numbers, bool big_endian = false) {
    std::string bytes(numbers.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    if (big_endian)
        for (auto at = bytes.begin(); at != bytes.end(); at += sizeof(T))
            std::reverse(at, at + sizeof(T));
    return bytes;
}

inline std::string compressed(const std::string &bytes, bool gzip) {
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY);
    std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef *>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    deflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
}

// Call visit(type, T{}) for every type of number.
template <typename Visit>
void for_every_type(Visit visit) {
    visit(LOCUS_VOXEL_UINT8, uint8_t{});
    visit(LOCUS_VOXEL_INT8, int8_t{});
    visit(LOCUS_VOXEL_UINT16, uint16_t{});
    visit(LOCUS_VOXEL_INT16, int16_t{});
    visit(LOCUS_VOXEL_UINT32, uint32_t{});
    visit(LOCUS_VOXEL_INT32, int32_t{});
    visit(LOCUS_VOXEL_UINT64, uint64_t{});
    visit(LOCUS_VOXEL_INT64, int64_t{});
    visit(LOCUS_VOXEL_FLOAT32, float{});
    visit(LOCUS_VOXEL_FLOAT64, double{});
}

// Numbers that use all bytes of their type, signs included.
template <typename T>
std::vector<T> sample(size_t count) {
    std::vector<T> numbers(count);
    uint64_t state = 0x9e3779b97f4a7c15u;
    for (T &number : numbers) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        if constexpr (std::is_floating_point_v<T>)
            number = static_cast<T>(static_cast<double>(static_cast<int64_t>(state)) * 1e-15);
        else
            number = static_cast<T>(state >> (64 - 8 * sizeof(T)));
    }
    return numbers;
}

template <typename T>
std::vector<float> as_float(const std::vector<T> &numbers) {
    std::vector<float> result;
    for (const T number : numbers)
        result.push_back(static_cast<float>(number));
    return result;
}

} // namespace volume_test
