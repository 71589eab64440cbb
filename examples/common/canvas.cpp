// Drawing on a canvas.
#include "common/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace demo {

Colour mix(Colour under, Colour over, double cover) {
    const double part = std::clamp(cover, 0.0, 1.0);
    const auto one = [part](uint8_t a, uint8_t b) {
        return static_cast<uint8_t>(std::lround(a + part * (static_cast<double>(b) - a)));
    };
    return {one(under.red, over.red), one(under.green, over.green), one(under.blue, over.blue)};
}

Canvas::Canvas(int width, int height, Colour background) : width_(width), height_(height) {
    if (width < 1 || height < 1)
        throw std::invalid_argument("a picture needs at least one pixel");
    pixels_.assign(static_cast<size_t>(width) * static_cast<size_t>(height), background);
}

void Canvas::blend(int x, int y, Colour colour, double cover) {
    if (inside(x, y))
        pixels_[index(x, y)] = mix(pixels_[index(x, y)], colour, cover);
}

void Canvas::fill(int x, int y, int width, int height, Colour colour, double cover) {
    for (int row = std::max(y, 0); row < std::min(y + height, height_); ++row)
        for (int column = std::max(x, 0); column < std::min(x + width, width_); ++column)
            blend(column, row, colour, cover);
}

void Canvas::frame(int x, int y, int width, int height, Colour colour) {
    fill(x, y, width, 1, colour);
    fill(x, y + height - 1, width, 1, colour);
    fill(x, y, 1, height, colour);
    fill(x + width - 1, y, 1, height, colour);
}

// Wu 1991: step along the longer axis and share the colour between the two nearest pixels of the other one.
void Canvas::line(double x0, double y0, double x1, double y1, Colour colour, double cover) {
    const bool steep = std::abs(y1 - y0) > std::abs(x1 - x0);
    if (steep) {
        std::swap(x0, y0);
        std::swap(x1, y1);
    }
    if (x0 > x1) {
        std::swap(x0, x1);
        std::swap(y0, y1);
    }
    const double length = x1 - x0;
    const double slope = length > 0 ? (y1 - y0) / length : 0;
    const double end = steep ? height_ : width_;
    if (!(x1 >= 0 && x0 <= end))
        return;
    const int first = static_cast<int>(std::max(std::round(x0), 0.0));
    const int last = static_cast<int>(std::min(std::round(x1), end));
    for (int along = first; along <= last; ++along) {
        const double across = y0 + slope * (along - x0);
        if (!(std::abs(across) < 1e6))
            continue;
        const int lower = static_cast<int>(std::floor(across));
        const double upper_part = across - lower;
        const auto touch = [&](int other, double part) {
            steep ? blend(other, along, colour, cover * part) : blend(along, other, colour, cover * part);
        };
        touch(lower, 1 - upper_part);
        touch(lower + 1, upper_part);
    }
}

namespace {

// Call touch(x, y, distance to the centre) for the pixels up to `radius` + 1 away, clipped to the canvas.
template <typename Touch>
void around(const Canvas &canvas, double x, double y, double radius, Touch touch) {
    const double reach = radius + 1;
    const int top = static_cast<int>(std::max(0.0, std::floor(y - reach)));
    const int bottom = static_cast<int>(std::min<double>(canvas.height() - 1, std::ceil(y + reach)));
    const int left = static_cast<int>(std::max(0.0, std::floor(x - reach)));
    const int right = static_cast<int>(std::min<double>(canvas.width() - 1, std::ceil(x + reach)));
    for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column)
            touch(column, row, std::hypot(column - x, row - y));
}

} // namespace

void Canvas::circle(double x, double y, double radius, Colour colour, double cover) {
    around(*this, x, y, radius, [&](int column, int row, double distance) {
        blend(column, row, colour, cover * std::max(0.0, 1 - std::abs(distance - radius)));
    });
}

void Canvas::disc(double x, double y, double radius, Colour colour, double cover) {
    around(*this, x, y, radius, [&](int column, int row, double distance) {
        blend(column, row, colour, cover * std::clamp(radius - distance + 0.5, 0.0, 1.0));
    });
}

void Canvas::paste(const Canvas &picture, int x, int y, int scale) {
    for (int row = 0; row < picture.height() * scale; ++row)
        for (int column = 0; column < picture.width() * scale; ++column)
            set(x + column, y + row, picture.at(column / scale, row / scale));
}

} // namespace demo
