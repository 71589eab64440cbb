// Web Mercator (EPSG:3857): x and y as parts of the world's width, 0..1 from the north-west.
#include "stream/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace demo {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double edge = 85.0511287798066;
constexpr double around_km = 40075.017;

double mercator_x(double longitude) { return (longitude + 180) / 360; }

double mercator_y(double latitude) {
    const double angle = std::clamp(latitude, -edge, edge) * pi / 180;
    return 0.5 - std::asinh(std::tan(angle)) / (2 * pi);
}

double latitude_of(double y) { return std::atan(std::sinh(pi * (1 - 2 * y))) * 180 / pi; }

double pixels(uint32_t level) { return std::exp2(static_cast<double>(level)); }

} // namespace

double View::x(double longitude) const {
    const double world = pixels(level);
    const double middle = static_cast<double>(left) + width / 2.0;
    const double away = std::remainder(mercator_x(longitude) * world - middle, world);
    return away + width / 2.0 - 0.5;
}

double View::y(double latitude) const { return mercator_y(latitude) * pixels(level) - static_cast<double>(top) - 0.5; }

Position View::position(double x, double y) const {
    const double world = pixels(level);
    return {latitude_of((static_cast<double>(top) + y + 0.5) / world),
            (static_cast<double>(left) + x + 0.5) / world * 360 - 180};
}

double View::pixel_km() const {
    return around_km / pixels(level) * std::cos(position(width / 2.0, height / 2.0).latitude * pi / 180);
}

View world_view(uint32_t level) {
    const double world = pixels(level);
    const auto top = static_cast<int64_t>(mercator_y(74) * world);
    const auto bottom = static_cast<int64_t>(mercator_y(-56) * world);
    return {level, 0, top, static_cast<int>(world), static_cast<int>(bottom - top)};
}

View zoom_view(Position centre, double km, int width, int height) {
    const double circle_km = around_km * std::max(0.05, std::cos(centre.latitude * pi / 180));
    const double exact = std::log2(circle_km * width / km);
    const auto level = static_cast<uint32_t>(std::clamp(std::floor(exact), std::ceil(std::log2(width)), 25.0));
    const double world = pixels(level);
    View view{level, 0, 0, width, height};
    view.left = static_cast<int64_t>(std::lround(mercator_x(centre.longitude) * world)) - width / 2;
    view.top = std::clamp<int64_t>(static_cast<int64_t>(std::lround(mercator_y(centre.latitude) * world)) - height / 2,
                                   0, static_cast<int64_t>(world) - height);
    return view;
}

// Across the antimeridian west is greater than east, as in locus_box.
locus_box box_of(const View &view) {
    const Position north_west = view.position(-0.5, -0.5);
    const Position south_east = view.position(view.width - 0.5, view.height - 0.5);
    const bool whole = view.width >= pixels(view.level);
    const auto wrap = [](double longitude) { return std::remainder(longitude, 360.0); };
    return {south_east.latitude, whole ? -180 : wrap(north_west.longitude), north_west.latitude,
            whole ? 180 : wrap(south_east.longitude)};
}

} // namespace demo
