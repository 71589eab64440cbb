// Perceptual colour maps as polynomials.
#include "common/colour_map.hpp"

#include <algorithm>
#include <cmath>

namespace demo {
namespace {

// Matplotlib's maps (van der Walt and Smith, CC0), fitted by polynomials of degree 6 per channel (M. Zucker, CC0).
struct Polynomial {
    double factors[7][3];
};

constexpr Polynomial inferno_fit{{{0.0002189403691192265, 0.001651004631001012, -0.01948089843709184},
                                  {0.1065134194856116, 0.5639564367884091, 3.932712388889277},
                                  {11.60249308247187, -3.972853965665698, -15.9423941062914},
                                  {-41.70399613139459, 17.43639888205313, 44.35414519872813},
                                  {77.162935699427, -33.40235894210092, -81.80730925738993},
                                  {-71.31942824499214, 32.62606426397723, 73.20951985803202},
                                  {25.13112622477341, -12.24266895238567, -23.07032500287172}}};
constexpr Polynomial magma_fit{{{-0.002136485053939582, -0.000749655052795221, -0.005386127855323933},
                                {0.2516605407371642, 0.6775232436837668, 2.494026599312351},
                                {8.353717279216625, -3.577719514958484, 0.3144679030132573},
                                {-27.66873308576866, 14.26473078096533, -13.64921318813922},
                                {52.17613981234068, -27.94360607168351, 12.94416944238394},
                                {-50.76852536473588, 29.04658282127291, 4.23415299384598},
                                {18.65570506591883, -11.48977351997711, -5.601961508734096}}};
constexpr Polynomial viridis_fit{{{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
                                  {0.1050930431085774, 1.404613529898575, 1.384590162594685},
                                  {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
                                  {-4.634230498983486, -5.799100973351585, -19.33244095627987},
                                  {6.228269936347081, 14.17993336680509, 56.69055260068105},
                                  {4.776384997670288, -13.74514537774601, -65.35303263337234},
                                  {-5.435455855934631, 4.645852612178535, 26.3124352495832}}};

uint8_t byte_of(double part) { return static_cast<uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0))); }

Colour evaluate(const Polynomial &fit, double value) {
    double channel[3] = {0, 0, 0};
    for (int power = 6; power >= 0; --power)
        for (int i = 0; i < 3; ++i)
            channel[i] = channel[i] * value + fit.factors[power][i];
    return {byte_of(channel[0]), byte_of(channel[1]), byte_of(channel[2])};
}

} // namespace

Colour colour_of(ColourMap map, double value) {
    const double t = std::isnan(value) ? 0 : std::clamp(value, 0.0, 1.0);
    switch (map) {
    case ColourMap::inferno:
        return evaluate(inferno_fit, t);
    case ColourMap::magma:
        return evaluate(magma_fit, t);
    case ColourMap::viridis:
        return evaluate(viridis_fit, t);
    case ColourMap::grey:
        break;
    }
    return {byte_of(t), byte_of(t), byte_of(t)};
}

// Hues in steps of the golden ratio never come close soon; three steps of brightness tell the rest apart.
Colour label_colour(uint32_t label) {
    const double hue = 6 * std::fmod(0.618033988749895 * label + 0.05, 1.0);
    const double value = 0.95 - 0.17 * (label / 2 % 3);
    const double saturation = 0.62;
    const auto channel = [&](double shift) {
        const double place = std::fmod(hue + shift, 6.0);
        const double ramp = std::clamp(std::min(place, 4 - place), 0.0, 1.0);
        return byte_of(value * (1 - saturation * ramp));
    };
    return {channel(5), channel(3), channel(1)};
}

void draw_legend(Canvas &canvas, int x, int y, int width, int height, ColourMap map, const std::vector<Mark> &marks,
                 Colour ink, double darkest) {
    for (int column = 0; column < width; ++column) {
        const double place = column / std::max(1.0, width - 1.0);
        canvas.fill(x + column, y, 1, height, colour_of(map, darkest + (1 - darkest) * place));
    }
    canvas.frame(x - 1, y - 1, width + 2, height + 2, mix(ink, {}, 0.5));
    for (const Mark &mark : marks) {
        const int place = x + static_cast<int>(std::lround(mark.where * (width - 1)));
        canvas.fill(place, y + height, 1, 5, ink);
        canvas.text(place - Canvas::text_width(mark.text) / 2, y + height + 6, mark.text, ink);
    }
}

} // namespace demo
