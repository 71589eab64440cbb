// An RGB picture in memory: pixels, lines, circles, text; and writing it as PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace demo {

struct Colour {
    uint8_t red = 0, green = 0, blue = 0;
    bool operator==(const Colour &) const = default;
};

// `over` laid on `under`: 0 leaves `under`, 1 covers it.
Colour mix(Colour under, Colour over, double cover);

enum class Font { small, large }; // 8x16 and 12x24 pixels a character

// Pixel (0, 0) is the top left one, its centre at (0, 0); what lies outside the picture is not drawn.
class Canvas {
public:
    Canvas(int width, int height, Colour background = {});

    int width() const { return width_; }
    int height() const { return height_; }
    const Colour *pixels() const { return pixels_.data(); } // row by row from the top
    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    Colour at(int x, int y) const { return pixels_[index(x, y)]; } // inside only
    void set(int x, int y, Colour colour) {
        if (inside(x, y))
            pixels_[index(x, y)] = colour;
    }
    void blend(int x, int y, Colour colour, double cover);

    void fill(int x, int y, int width, int height, Colour colour, double cover = 1);
    void frame(int x, int y, int width, int height, Colour colour); // a border of one pixel, inside the box
    void line(double x0, double y0, double x1, double y1, Colour colour, double cover = 1); // smooth, one pixel wide
    void circle(double x, double y, double radius, Colour colour, double cover = 1);        // its line, smooth
    void disc(double x, double y, double radius, Colour colour, double cover = 1);
    void paste(const Canvas &picture, int x, int y, int scale = 1); // every pixel `scale` times as wide and high

    // One line of UTF-8 with its top left corner at (x, y); letters beyond Latin Extended-A show as '?'.
    void text(int x, int y, std::string_view utf8, Colour colour, Font font = Font::small);
    static int text_width(std::string_view utf8, Font font = Font::small);
    static int text_height(Font font = Font::small);

private:
    size_t index(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
    }

    int width_;
    int height_;
    std::vector<Colour> pixels_;
};

// The picture as the bytes of a PNG file.
std::vector<uint8_t> encode_png(const Canvas &picture);

// The same in these colours alone, 1..256 of them, which makes it far smaller: each pixel gets the nearest one.
std::vector<uint8_t> encode_png(const Canvas &picture, const std::vector<Colour> &palette);

// Write a file whole or not at all: into "<path>.partial", renamed once everything is on the disk. Throws
// std::runtime_error with the path and the system's reason, and leaves no partial file.
void write_file(const std::string &path, const void *bytes, size_t size);
void write_png(const std::string &path, const Canvas &picture);

} // namespace demo
