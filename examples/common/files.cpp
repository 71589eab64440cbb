// PNG files, and files written whole or not at all.
#include "common/canvas.hpp"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <unistd.h>

namespace demo {

std::vector<uint8_t> encode_png(const Canvas &picture) {
    static_assert(sizeof(Colour) == 3);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width());
    image.height = static_cast<png_uint_32>(picture.height());
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<uint8_t> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels(), 0, nullptr) == 0)
        throw std::runtime_error(std::string("libpng: ") + image.message);
    bytes.resize(size);
    return bytes;
}

void write_file(const std::string &path, const void *bytes, size_t size) {
    const std::string partial = path + ".partial";
    const auto give_up = [&](int reason) {
        std::remove(partial.c_str());
        throw std::runtime_error("cannot write " + path + ": " + std::strerror(reason));
    };
    std::FILE *file = std::fopen(partial.c_str(), "wb");
    if (file == nullptr)
        give_up(errno);
    errno = 0;
    bool good = std::fwrite(bytes, 1, size, file) == size && std::fflush(file) == 0 && fsync(fileno(file)) == 0;
    int reason = errno;
    if (std::fclose(file) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (!good)
        give_up(reason != 0 ? reason : EIO);
    if (std::rename(partial.c_str(), path.c_str()) != 0)
        give_up(errno);
}

void write_png(const std::string &path, const Canvas &picture) {
    const std::vector<uint8_t> bytes = encode_png(picture);
    write_file(path, bytes.data(), bytes.size());
}

} // namespace demo
