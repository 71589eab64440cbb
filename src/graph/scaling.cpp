// The choice of word width, label bits and scale.
#include "graph/scaling.hpp"

#include "core/error.hpp"

#include <locus/graph.h>

#include <algorithm>
#include <cmath>

namespace locus::graph {
namespace {

constexpr double slack = 1 - 1e-6; // for the roundings of float weights and of the sums here

double largest_weight_scale(const WordLayout &layout, const ScalingNeeds &needs) {
    const double by_share = static_cast<double>(layout.weight_limit()) / needs.largest_share;
    const double by_edge = static_cast<double>(layout.max_exact()) / (needs.largest_share * needs.shares_per_edge);
    return slack * std::min(by_share, by_edge);
}

// The largest scale at which no path can exceed the words; not positive where there is none.
double largest_safe_scale(const WordLayout &layout, const ScalingNeeds &needs) {
    const double room = static_cast<double>(layout.max_exact()) - needs.shares_in_path; // each share may round up
    return std::min(slack * room / needs.longest_path, largest_weight_scale(layout, needs));
}

double needed_scale(const ScalingNeeds &needs) { return 0.5 / (needs.precision * needs.smallest_share); }

bool safe(const WordLayout &layout, const ScalingNeeds &needs) {
    const double least = needs.scale > 0 ? needs.scale : needed_scale(needs);
    return least <= largest_safe_scale(layout, needs);
}

WordLayout choose_layout(const ScalingNeeds &needs) {
    if (needs.word_bits != LOCUS_WORD_AUTO)
        return {needs.word_bits, needs.label_bits};
    const WordLayout narrow{32, needs.label_bits};
    return safe(narrow, needs) ? narrow : WordLayout{64, needs.label_bits};
}

} // namespace

double rounding_error(double steps) { return steps >= 0.5 ? 0.5 / steps : 1 / steps - 1; }

Scaling choose_scaling(const ScalingNeeds &needs) {
    const WordLayout layout = choose_layout(needs);
    const double largest = largest_weight_scale(layout, needs);
    if (needs.scale > 0) {
        if (needs.scale > largest)
            fail(LOCUS_E_RANGE, "options->scale is ", needs.scale, ": the largest weight would not fit words of ",
                 layout.bits, " bits with ", layout.label_bits, " of them for labels; a scale of at most ", largest,
                 layout.bits == 32 ? " or 64-bit words would do" : " would do");
        return {layout, needs.scale};
    }
    const double least = needed_scale(needs);
    if (!(least <= largest))
        fail(LOCUS_E_RANGE, "the materials span a range of 1 to ", needs.largest_share / needs.smallest_share,
             " in edge weights: words of ", layout.bits, " bits with ", layout.label_bits,
             " of them for labels cannot hold it with options->precision ", needs.precision, "; a scale of at most ",
             largest, layout.bits == 32 ? " or 64-bit words would do" : " would do");
    if (safe(layout, needs)) {
        const double most = largest_safe_scale(layout, needs);
        const double even = std::exp2(std::floor(std::log2(most)));
        return {layout, even >= least ? even : most};
    }
    const double even = std::exp2(std::ceil(std::log2(least)));
    return {layout, even <= largest ? even : least};
}

} // namespace locus::graph
