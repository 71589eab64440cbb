// PNG files, and files written whole or not at all.
#include "common/canvas.hpp"

#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <unistd.h>
#include <unordered_map>

namespace demo {

namespace {

static_assert(sizeof(Colour) == 3); // as libpng reads them

// `pixels` as `format` says: colours, or places in `palette`.
std::vector<uint8_t> encode(const Canvas &picture, png_uint_32 format, const void *pixels,
                            const std::vector<Colour> &palette) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width());
    image.height = static_cast<png_uint_32>(picture.height());
    image.format = format;
    image.colormap_entries = static_cast<png_uint_32>(palette.size());
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<uint8_t> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, palette.data()) == 0)
        throw std::runtime_error(std::string("libpng: ") + image.message);
    bytes.resize(size);
    return bytes;
}

int distance(Colour a, Colour b) {
    const auto square = [](int difference) { return difference * difference; };
    return square(a.red - b.red) + square(a.green - b.green) + square(a.blue - b.blue);
}

uint8_t nearest(Colour colour, const std::vector<Colour> &palette) {
    const auto closer = [&](Colour a, Colour b) { return distance(a, colour) < distance(b, colour); };
    return static_cast<uint8_t>(std::min_element(palette.begin(), palette.end(), closer) - palette.begin());
}

} // namespace

std::vector<uint8_t> encode_png(const Canvas &picture) { return encode(picture, PNG_FORMAT_RGB, picture.pixels(), {}); }

std::vector<uint8_t> encode_png(const Canvas &picture, const std::vector<Colour> &palette) {
    const size_t size = static_cast<size_t>(picture.width()) * static_cast<size_t>(picture.height());
    std::unordered_map<uint32_t, uint8_t> known;
    std::vector<uint8_t> places(size);
    for (size_t i = 0; i < size; ++i) {
        const Colour colour = picture.pixels()[i];
        const uint32_t code = uint32_t{colour.red} << 16 | uint32_t{colour.green} << 8 | colour.blue;
        auto found = known.find(code);
        if (found == known.end())
            found = known.emplace(code, nearest(colour, palette)).first;
        places[i] = found->second;
    }
    return encode(picture, PNG_FORMAT_RGB_COLORMAP, places.data(), palette);
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
