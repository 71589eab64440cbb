// The trace of active voxels as a plot (thesis figure 2.10).
#include "common/canvas.hpp"
#include "volume/pictures.hpp"
#include "volume/text.hpp"

#include <algorithm>
#include <cmath>

namespace volume {
namespace {

using demo::Canvas;
using demo::Colour;
using demo::Font;

constexpr Colour paper{255, 255, 255}, ink{30, 30, 34}, grid{226, 228, 232}, area{31, 119, 180};
constexpr int width = 1100, height = 560, left = 96, right = 32, top = 76, bottom = 72;
constexpr int plot_width = width - left - right, plot_height = height - top - bottom;

// The axis of x or y: its end, a round step and grid lines with numbers.
struct Scale {
    double end, step;
};

Scale scale_for(double most, int parts) {
    const double step = round_step(std::max(most, 1e-9), parts);
    return {step * std::ceil(most / step), step};
}

} // namespace

void draw_trace(const std::string &path, const std::string &title, const std::vector<uint64_t> &active) {
    Canvas canvas(width, height, paper);
    const uint64_t peak = active.empty() ? 0 : *std::ranges::max_element(active);
    const double in_thousands = peak >= 10'000 ? 1000 : 1;
    const Scale x = scale_for(static_cast<double>(std::max<size_t>(active.size(), 1)), 10);
    const Scale y = scale_for(static_cast<double>(std::max<uint64_t>(peak, 1)) / in_thousands, 6);
    const int line = Canvas::text_height();

    canvas.text(left, 16, title, ink, Font::large);
    canvas.text(left, 46,
                in_thousands > 1 ? "active voxels (thousands) in each iteration" : "active voxels in each iteration",
                ink);
    for (double mark = 0; mark <= y.end * 1.0001; mark += y.step) {
        const int row = top + plot_height - static_cast<int>(std::lround(mark / y.end * plot_height));
        canvas.fill(left, row, plot_width, 1, grid);
        const std::string text = short_number(mark);
        canvas.text(left - 10 - Canvas::text_width(text), row - line / 2, text, ink);
    }
    for (double mark = 0; mark <= x.end * 1.0001; mark += x.step) {
        const int column = left + static_cast<int>(std::lround(mark / x.end * plot_width));
        canvas.fill(column, top + plot_height, 1, 6, ink);
        const std::string text = short_number(mark);
        canvas.text(column - Canvas::text_width(text) / 2, top + plot_height + 10, text, ink);
    }
    const std::string name = "iteration";
    canvas.text(left + plot_width / 2 - Canvas::text_width(name) / 2, height - line - 10, name, ink);

    const auto place = [&](size_t i) {
        return std::pair{left + (static_cast<double>(i) + 0.5) / x.end * plot_width,
                         top + plot_height - static_cast<double>(active[i]) / in_thousands / y.end * plot_height};
    };
    for (size_t i = 1; i < active.size(); ++i) { // the area under the curve, column by column
        const auto [x0, y0] = place(i - 1);
        const auto [x1, y1] = place(i);
        for (int column = static_cast<int>(std::ceil(x0)); column < x1; ++column) {
            const int row = static_cast<int>(std::lround(std::lerp(y0, y1, (column - x0) / (x1 - x0))));
            canvas.fill(column, row, 1, top + plot_height - row, area, 0.22);
        }
    }
    for (size_t i = 1; i < active.size(); ++i) {
        const auto [x0, y0] = place(i - 1);
        const auto [x1, y1] = place(i);
        canvas.line(x0, y0, x1, y1, area);
    }
    canvas.fill(left, top + plot_height, plot_width, 1, ink);
    canvas.fill(left, top, 1, plot_height, ink);
    demo::write_png(path, canvas);
}

} // namespace volume
