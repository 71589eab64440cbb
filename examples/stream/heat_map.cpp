// Drawing heat maps.
#include "stream/heat_map.hpp"

#include "common/colour_map.hpp"
#include "stream/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace demo {
namespace {

constexpr Colour sea{9, 11, 18};
constexpr Colour land{27, 31, 42};
constexpr Colour shore{62, 70, 90};
constexpr Colour ink{226, 228, 236};
constexpr Colour faint{140, 146, 164};
constexpr Colour mark{120, 220, 255};
constexpr Colour paper{14, 16, 24};
constexpr int heat_steps = 64; // which nobody sees, and which PNG packs well

constexpr int footing = 52; // height of the legend below the map
constexpr uint32_t log2_bins = 8;
constexpr int64_t bins = 1 << log2_bins;

// The coasts in the data are good for pixels of this size; closer up they would be wrong.
constexpr double finest_land_km = 0.5;

// Even-odd filling: on each row of pixels, land lies between the first and the second crossing with a ring, and so on.
void fill_land(Canvas &canvas, const View &view, const World &world, int above) {
    std::vector<std::vector<double>> crossings(static_cast<size_t>(view.height));
    // Not nearest to the middle, as View::x gives them: a ring must stay in one piece.
    const double circle = std::exp2(static_cast<double>(view.level));
    const auto x_of = [&](double longitude) {
        return (longitude + 180) / 360 * circle - static_cast<double>(view.left) - 0.5;
    };
    for (const Ring &ring : world.land) {
        for (size_t i = 1; i < ring.size(); ++i) {
            double x0 = x_of(ring[i - 1].longitude), y0 = view.y(ring[i - 1].latitude);
            double x1 = x_of(ring[i].longitude), y1 = view.y(ring[i].latitude);
            if (y0 > y1) {
                std::swap(x0, x1);
                std::swap(y0, y1);
            }
            const auto first = static_cast<int>(std::max(0.0, std::ceil(y0)));
            for (int row = first; row < view.height && row < y1; ++row)
                crossings[static_cast<size_t>(row)].push_back(x0 + (row - y0) / (y1 - y0) * (x1 - x0));
        }
    }
    for (int row = 0; row < view.height; ++row) {
        auto &at = crossings[static_cast<size_t>(row)];
        std::sort(at.begin(), at.end());
        for (size_t i = 0; i + 1 < at.size(); i += 2)
            for (const double turn : {-circle, 0.0, circle}) { // the view may reach across the antimeridian
                const auto from = static_cast<int>(std::clamp(std::ceil(at[i] + turn), 0.0, 1.0 * view.width));
                const auto to = static_cast<int>(std::clamp(std::floor(at[i + 1] + turn) + 1, 0.0, 1.0 * view.width));
                canvas.fill(from, above + row, to - from, 1, land);
            }
    }
}

void draw_shores(Canvas &canvas, const View &view, const World &world, int above) {
    for (const Ring &ring : world.land) {
        for (size_t i = 1; i < ring.size(); ++i) {
            const Position a = ring[i - 1], b = ring[i];

            const double x0 = view.x(a.longitude), x1 = view.x(b.longitude);
            const double y0 = view.y(a.latitude), y1 = view.y(b.latitude);
            const bool beside = std::max(x0, x1) < 0 || std::min(x0, x1) > view.width || std::max(y0, y1) < 0 ||
                                std::min(y0, y1) > view.height || std::abs(x0 - x1) > view.width / 2;
            if (!beside)
                canvas.line(x0, above + y0, x1, above + y1, shore, 0.8);
        }
    }
}

// Counts smoothed by the binomial kernel 1 4 6 4 1, so that a lone record is a dot that can be seen.
std::vector<float> smooth(const std::vector<uint32_t> &counts, int width, int height) {
    constexpr float kernel[] = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f};
    const auto at = [width](int x, int y) {
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    };
    std::vector<float> rows(counts.size()), result(counts.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int i = std::max(-2, -x); i <= std::min(2, width - 1 - x); ++i)
                rows[at(x, y)] += kernel[i + 2] * static_cast<float>(counts[at(x + i, y)]);
    for (int y = 0; y < height; ++y)
        for (int i = std::max(-2, -y); i <= std::min(2, height - 1 - y); ++i)
            for (int x = 0; x < width; ++x)
                result[at(x, y)] += kernel[i + 2] * rows[at(x, y + i)];
    return result;
}

// A colour of the heat, and how far it covers the ground: the dark end fades into it.
struct Heat {
    Colour colour;
    double cover;
};

// Logarithmic brightness between these numbers of records per pixel.
struct Scale {
    static constexpr double darkest = 0.18; // of the colour map: what is less would not be seen on the ground
    double low = 0.1;
    double high = 1;
    double place(double value) const { return std::log(value / low) / std::log(high / low); }
    static Heat heat(int step) {
        const double place = static_cast<double>(step) / heat_steps;
        return {colour_of(ColourMap::inferno, darkest + (1 - darkest) * place), std::min(1.0, 0.25 + 2.5 * place)};
    }
};

void draw_heat(Canvas &canvas, const View &view, const std::vector<float> &values, const Scale &scale, int above) {
    std::array<Heat, heat_steps + 1> heats;
    for (int step = 0; step <= heat_steps; ++step)
        heats[static_cast<size_t>(step)] = Scale::heat(step);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double value =
                values[static_cast<size_t>(y) * static_cast<size_t>(view.width) + static_cast<size_t>(x)];
            if (value <= scale.low / 4)
                continue;
            const auto step = static_cast<int>(std::lround(heat_steps * std::clamp(scale.place(value), 0.0, 1.0)));
            const Heat heat = heats[static_cast<size_t>(step)];
            canvas.blend(x, above + y, heat.colour, heat.cover);
        }
}

// Ticks for the longitudes of each third hour of local solar time.
void draw_solar_hours(Canvas &canvas, const View &view, int64_t clock, int above) {
    const double utc_hours = static_cast<double>(clock / 1'000'000 % 86400) / 3600;
    for (int hour = 0; hour < 24; hour += 3) {
        const double longitude = std::remainder((hour - utc_hours) * 15, 360.0);
        const auto x = static_cast<int>(std::lround(view.x(longitude)));
        char text[16];
        std::snprintf(text, sizeof text, "%02dh", hour);
        canvas.fill(x, above - 5, 1, 5, faint);
        canvas.text(std::clamp(x - Canvas::text_width(text) / 2, 2, view.width - 26), above - 21, text, faint);
    }
}

struct Area {
    int x, y, width, height;
    bool meets(const Area &other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
    }
};

// Labels in their order; one that would lie on another or leave the map is left out.
void draw_labels(Canvas &canvas, const View &view, const std::vector<Label> &labels, int above) {
    std::vector<Area> taken;
    for (const Label &label : labels) {
        const double x = view.x(label.position.longitude), y = above + view.y(label.position.latitude);
        const int gap = label.event ? 14 : 6;
        const int width = Canvas::text_width(label.text);
        const auto column = static_cast<int>(x), row = static_cast<int>(y);
        Area area{column + gap, row - 8, width, 16};
        if (area.x + width > view.width - 4)
            area.x = column - gap - width;
        const bool in =
            column >= 0 && column < view.width && area.x >= 0 && area.y >= above && area.y + 16 <= above + view.height;
        if (!in || std::any_of(taken.begin(), taken.end(), [&](const Area &other) { return area.meets(other); }))
            continue;
        taken.push_back(area);
        if (label.event)
            canvas.circle(x, y, 10, mark);
        else
            canvas.disc(x, y, 1.5, ink, 0.9);
        for (const auto &[dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) // an outline, to be read on any ground
            canvas.text(area.x + dx, area.y + dy, label.text, {0, 0, 0});
        canvas.text(area.x, area.y, label.text, label.event ? mark : ink);
    }
}

std::string short_number(double number) {
    if (number < 1)
        return "0.1";
    if (number < 1000)
        return std::to_string(std::lround(number));
    return std::to_string(std::lround(number / 1000)) + "k";
}

void draw_scale(Canvas &canvas, const View &view, const Scale &scale, int top) {
    std::vector<Mark> marks;
    for (double value = scale.low; value <= scale.high * 1.001; value *= 10)
        marks.push_back({scale.place(value), short_number(value)});
    const int width = std::min(320, view.width / 3);
    draw_legend(canvas, 24, top + 10, width, 12, ColourMap::inferno, marks, ink, Scale::darkest);
    const double km = view.pixel_km();
    const std::string size =
        km < 1 ? std::to_string(std::lround(km * 1000)) + " m" : std::to_string(std::lround(km)) + " km";
    canvas.text(width + 48, top + 8, "records per pixel (about " + size + " wide in the middle), smoothed", faint);
}

} // namespace

std::vector<uint32_t> counts_of(const View &view, const locus_pmq *store) {
    std::vector<uint32_t> counts(static_cast<size_t>(view.width) * static_cast<size_t>(view.height));
    std::vector<uint32_t> tile(size_t{1} << 2 * log2_bins);
    const int64_t tiles = int64_t{1} << (view.level - log2_bins); // a side
    const auto down = [](int64_t pixel) { return (pixel - (pixel < 0 ? bins - 1 : 0)) / bins; };
    for (int64_t ty = down(view.top); ty * bins < view.top + view.height; ++ty) {
        if (ty < 0 || ty >= tiles)
            continue;
        for (int64_t tx = down(view.left); tx * bins < view.left + view.width; ++tx) {
            const auto column = static_cast<uint32_t>((tx % tiles + tiles) % tiles);
            check(locus_pmq_tile(store, view.level - log2_bins, column, static_cast<uint32_t>(ty), log2_bins, nullptr,
                                 tile.data(), tile.size(), nullptr));
            for (int64_t y = std::max(ty * bins, view.top); y < std::min((ty + 1) * bins, view.top + view.height);
                 ++y) {
                const int64_t from = std::max(tx * bins, view.left);
                const int64_t to = std::min((tx + 1) * bins, view.left + view.width);
                std::copy_n(tile.begin() + (y - ty * bins) * bins + from - tx * bins, std::max<int64_t>(to - from, 0),
                            counts.begin() + (y - view.top) * view.width + from - view.left);
            }
        }
    }
    return counts;
}

Canvas draw_map(const View &view, const World &world, const std::vector<uint32_t> &counts, const MapText &text) {
    const int heading = text.solar_hours ? 84 : 64; // height of the text above the map
    Canvas canvas(view.width, heading + view.height + footing, paper);
    canvas.fill(0, heading, view.width, view.height, sea);
    if (view.pixel_km() >= finest_land_km) {
        fill_land(canvas, view, world, heading);
        draw_shores(canvas, view, world, heading);
    }
    const std::vector<float> heat = smooth(counts, view.width, view.height);
    const float most = heat.empty() ? 0 : *std::max_element(heat.begin(), heat.end());
    Scale scale;
    while (scale.high < most)
        scale.high *= 10;
    draw_heat(canvas, view, heat, scale, heading);
    draw_labels(canvas, view, text.labels, heading);
    // Lines and rings may have left the map.
    canvas.fill(0, 0, view.width, heading, paper);
    canvas.fill(0, heading + view.height, view.width, footing, paper);
    canvas.text(16, 8, text.title, ink, Font::large);
    canvas.text(16, 34, text.subtitle, faint);
    if (text.solar_hours)
        draw_solar_hours(canvas, view, text.clock, heading);
    draw_scale(canvas, view, scale, heading + view.height);
    return canvas;
}

std::vector<Colour> map_colours() {
    constexpr int ramp = 6; // of a shore's smooth line
    std::vector<Colour> colours{paper, ink, faint, mark, {0, 0, 0}, mix(ink, {}, 0.5), mix(mark, sea, 0.5)};
    std::vector<Colour> grounds{sea, land};
    for (int i = 1; i <= ramp; ++i)
        for (const Colour ground : {sea, land})
            grounds.push_back(mix(ground, shore, 0.8 * i / ramp));
    colours.insert(colours.end(), grounds.begin(), grounds.end());
    grounds = {sea, land, mix(land, shore, 0.8)};
    for (int step = 0; step <= heat_steps; ++step) {
        const Heat heat = Scale::heat(step);
        colours.push_back(heat.colour); // the legend's
        for (const Colour ground : grounds)
            if (heat.cover < 1)
                colours.push_back(mix(ground, heat.colour, heat.cover));
    }
    return colours;
}

} // namespace demo
