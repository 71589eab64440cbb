// Heat as a picture: an indexed PNG, which is small and quickly made.
#include "explorer/heat.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace explorer {
namespace {

constexpr size_t pixels = 256; // a side
constexpr size_t colours = 64; // steps that nobody sees, and that pack well

using Palette = std::array<uint8_t, 4 * (colours + 1)>;

// Entry 0 is transparent. The dark end fades into the ground.
Palette palette_of(demo::ColourMap map) {
    Palette palette{};
    for (size_t i = 0; i < colours; ++i) {
        const double place = static_cast<double>(i) / static_cast<double>(colours - 1);
        const demo::Colour colour = scale_colour(map, place);
        uint8_t *entry = palette.data() + 4 * (i + 1);
        entry[0] = colour.red, entry[1] = colour.green, entry[2] = colour.blue;
        entry[3] = static_cast<uint8_t>(std::lround(255 * std::min(1.0, 0.7 + 1.5 * place)));
    }
    return palette;
}

std::string encode(const std::vector<uint8_t> &indices, const Palette &palette) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = pixels;
    image.format = PNG_FORMAT_RGBA_COLORMAP;
    image.colormap_entries = colours + 1;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, indices.data(), 0, palette.data()) == 0)
        throw std::runtime_error(std::string("libpng: ") + image.message);
    bytes.resize(size);
    return bytes;
}

} // namespace

std::string tile_png(const std::vector<float> &heat, const Grain &grain, const Scale &scale, demo::ColourMap map) {
    std::vector<uint8_t> indices(pixels * pixels);
    const size_t bins = grain.bins();
    const size_t square = pixels / bins;
    for (size_t y = 0; y < bins; ++y)
        for (size_t x = 0; x < bins; ++x) {
            const double value = heat[y * bins + x];
            if (!scale.shows(value))
                continue;
            const double step = std::round(scale.place(value) * static_cast<double>(colours - 1));
            for (size_t row = y * square; row < (y + 1) * square; ++row)
                std::fill_n(indices.begin() + static_cast<std::ptrdiff_t>(row * pixels + x * square), square,
                            static_cast<uint8_t>(1 + step));
        }
    return encode(indices, palette_of(map));
}

} // namespace explorer
