// Random numbers that are the same with every compiler: the standard fixes the engines, not the distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace demo {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}

    // 0 <= result < 1
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    size_t below(size_t count) { return static_cast<size_t>(uniform() * static_cast<double>(count)); }

    // Box and Muller 1958.
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

    // Small means by Knuth's product of uniforms, large ones by the normal distribution.
    uint64_t poisson(double mean) {
        if (mean > 50)
            return static_cast<uint64_t>(std::max(0.0, std::round(mean + std::sqrt(mean) * normal())));
        const double limit = std::exp(-mean);
        uint64_t count = 0;
        for (double product = uniform(); product > limit; product *= uniform())
            ++count;
        return count;
    }

private:
    std::mt19937_64 engine_;
};

} // namespace demo
