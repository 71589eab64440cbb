// The voxel graph: creation, the choice of its words, and its weights.
#include "graph/graph.hpp"

#include "core/error.hpp"
#include "core/team.hpp"
#include "graph/device/device.hpp"
#include "graph/scaling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace locus::graph {
namespace {

constexpr uint64_t default_max_seeds = 65535;
constexpr uint64_t default_max_seeds_32 = 256;
constexpr uint64_t most_seeds = uint64_t{1} << 24;
constexpr double most_exponent = 8;
constexpr double slack = 1 + 1e-6; // covers the roundings of float weights and of tabled powers

void check_options(const locus_graph_options &options) {
    require(options.weight_rule <= LOCUS_WEIGHT_CALLER, "options->weight_rule is ", options.weight_rule,
            ", not one of LOCUS_WEIGHT_");
    require(options.material <= LOCUS_MATERIAL_STIFFNESS, "options->material is ", options.material,
            ", not one of LOCUS_MATERIAL_");
    require(options.word_bits == LOCUS_WORD_AUTO || options.word_bits == LOCUS_WORD_32 ||
                options.word_bits == LOCUS_WORD_64,
            "options->word_bits is ", options.word_bits, ", not 0, 32 or 64");
    require(options.stiffness_exponent > 0 && options.stiffness_exponent <= most_exponent,
            "options->stiffness_exponent is ", options.stiffness_exponent, ", outside (0, ", most_exponent, "]");
    require(options.weight_rule != LOCUS_WEIGHT_CALLER || options.weight != nullptr,
            "options->weight is NULL with LOCUS_WEIGHT_CALLER");
    require(options.max_seeds >= 1 && options.max_seeds <= most_seeds, "options->max_seeds is ", options.max_seeds,
            ", outside 1..2^24");
    require(std::isfinite(options.scale) && options.scale >= 0, "options->scale is ", options.scale,
            ", not a finite number above 0 (or 0: chosen)");
    require(options.precision > 0 && options.precision <= 0.5, "options->precision is ", options.precision,
            ", outside (0, 0.5]");
    require(options.backend <= LOCUS_BACKEND_CUDA, "options->backend is ", options.backend,
            ", not one of LOCUS_BACKEND_");
}

uint32_t label_bits(const locus_graph_options &options) {
    const bool left = options.word_bits == LOCUS_WORD_32 && options.max_seeds == default_max_seeds;
    return static_cast<uint32_t>(std::bit_width((left ? default_max_seeds_32 : options.max_seeds) - 1));
}

// On smaller grids the CPU is done before a GPU has begun.
constexpr uint64_t smallest_for_cuda = 1 << 16;

// The backend that the options mean. Throws LOCUS_E_UNSUPPORTED or LOCUS_E_DEVICE where it was asked for and is not
// there.
uint32_t choose_backend(const locus_graph_options &options, uint64_t voxels) {
    const bool forced = options.backend == LOCUS_BACKEND_CUDA;
    if (options.backend == LOCUS_BACKEND_CPU || (!forced && voxels < smallest_for_cuda))
        return LOCUS_BACKEND_CPU;
    if (options.weight_rule == LOCUS_WEIGHT_CALLER) {
        if (forced)
            fail(LOCUS_E_UNSUPPORTED, "options->backend is LOCUS_BACKEND_CUDA, which has no LOCUS_WEIGHT_CALLER");
        return LOCUS_BACKEND_CPU;
    }
    const device::Found &found = device::find();
    if (found.table != nullptr)
        return LOCUS_BACKEND_CUDA;
    if (forced)
        fail(found.status, "options->backend is LOCUS_BACKEND_CUDA: ", found.why);
    return LOCUS_BACKEND_CPU;
}

} // namespace

void Graph::Range::add(double compliance) {
    if (compliance > 0) {
        low = std::min(low, compliance);
        high = std::max(high, compliance);
    } else {
        zero = true;
    }
}

Graph::Graph(const locus_graph_options &options, const float *material)
    : options_(options),
      grid_(options.dims, options.spacing, options.connectivity), operand_{options.weight_rule, options.material},
      threads_(options.threads == 0 ? default_threads() : options.threads), backend_(LOCUS_BACKEND_CPU) {
    check_options(options);
    backend_ = choose_backend(options, grid_.voxels());
    simd_ = simd_choose(options.simd);
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    materials_.assign(grid_.voxels(), nothing);
    if (material != nullptr)
        for (size_t i = 0; i < materials_.size(); ++i)
            if (operand_.passable(material[i]))
                materials_[i] = material[i];
    choose(material != nullptr);
    count_all();
}

Graph Graph::uniform() const {
    locus_graph_options options = options_;
    options.weight_rule = LOCUS_WEIGHT_UNIFORM;
    options.word_bits = LOCUS_WORD_AUTO;
    options.max_seeds = layout_.labels();
    options.scale = 0;
    options.precision = 1.0 / 256;
    options.material_min = options.material_max = std::numeric_limits<double>::quiet_NaN();
    Graph graph(options, materials_.data());
    graph.cuts_ = cuts_;
    return graph;
}

// A value's compliance; 1 where the rule asks for none.
double Graph::compliance(float value) const {
    if (operand_.rule == LOCUS_WEIGHT_UNIFORM || operand_.rule == LOCUS_WEIGHT_CALLER)
        return 1;
    const auto exact = static_cast<double>(value);
    return operand_.material == LOCUS_MATERIAL_STIFFNESS ? 1 / exact : exact;
}

// The number that gets rounded for an edge between two voxels of this compliance, in units of distance (see
// ScalingNeeds).
double Graph::share(double compliance, double length) const {
    switch (operand_.rule) {
    case LOCUS_WEIGHT_MEAN_COMPLIANCE:
    case LOCUS_WEIGHT_UNIFORM:
        return compliance * length / 2;
    case LOCUS_WEIGHT_MEAN_STIFFNESS:
        return length * std::pow(compliance, options_.stiffness_exponent);
    default:
        return compliance * length;
    }
}

double Graph::shares_per_edge() const {
    return operand_.rule == LOCUS_WEIGHT_MEAN_COMPLIANCE || operand_.rule == LOCUS_WEIGHT_UNIFORM ? 2 : 1;
}

double Graph::largest_steps(double compliance) const { return share(compliance, grid_.longest()) * scale_ * slack; }
double Graph::smallest_steps(double compliance) const { return share(compliance, grid_.shortest()) * scale_; }

Graph::Range Graph::range_of_data() const {
    Range range;
    for (const float value : materials_)
        if (value == value)
            range.add(compliance(value));
    return range;
}

Graph::Range Graph::range_of_callers_weights() const {
    Range range;
    for (uint64_t u = 0; u < grid_.voxels(); ++u) {
        if (!passable(u))
            continue;
        const uint32_t inside = grid_.inside(grid_.place(u));
        for (const Neighbour &to : grid_.neighbours()) {
            const uint64_t v = u + static_cast<uint64_t>(to.step);
            if (to.number < first_forward || (inside >> to.number & 1) == 0 || !passable(v))
                continue;
            const double length = grid_.length(to.kind);
            const double weight = options_.weight(u, v, length, options_.weight_user);
            if (weight >= 0 && std::isfinite(weight))
                range.add(weight / length);
        }
    }
    return range;
}

void Graph::add_declared(Range &range) const {
    const double least = options_.material_min;
    const double most = options_.material_max;
    require(!(least > most), "options->material_min is ", least, ", above options->material_max ", most);
    const char *const names[2] = {"options->material_min", "options->material_max"};
    const double values[2] = {least, most};
    for (int i = 0; i < 2; ++i) {
        if (std::isnan(values[i]))
            continue;
        const bool inverse = operand_.material == LOCUS_MATERIAL_STIFFNESS && operand_.rule != LOCUS_WEIGHT_CALLER;
        require(std::isfinite(values[i]) && (inverse ? values[i] > 0 : values[i] >= 0), names[i], " is ", values[i],
                ", not a passable material");
        range.add(inverse ? 1 / values[i] : values[i]);
    }
}

void Graph::choose(bool given) {
    const bool caller = operand_.rule == LOCUS_WEIGHT_CALLER;
    add_declared(range_);
    const bool declared = !range_.empty();
    if (!(caller && declared)) {
        const Range data = caller ? range_of_callers_weights() : range_of_data();
        range_.low = std::min(range_.low, data.low);
        range_.high = std::max(range_.high, data.high);
        range_.zero = range_.zero || data.zero;
    }
    require(given || declared || options_.scale > 0 || operand_.rule == LOCUS_WEIGHT_UNIFORM,
            "material is NULL: options->material_min and material_max, or options->scale, must be set then");
    Range range = range_;
    if (operand_.rule == LOCUS_WEIGHT_UNIFORM || range.empty())
        range.low = range.high = 1;

    const double largest = share(range.high, grid_.longest());
    double path = 0;
    double shares = 0;
    for (const float value : materials_) {
        if (!(value == value))
            continue;
        path += caller ? 2 * largest : 2 * share(compliance(value), grid_.longest());
        shares += 2;
    }
    if (declared || shares == 0) {
        shares = 2 * static_cast<double>(grid_.voxels());
        path = shares * largest;
    }
    const Scaling scaling =
        choose_scaling({options_.word_bits, label_bits(options_), options_.scale, options_.precision,
                        share(range.low, grid_.shortest()), largest, shares_per_edge(), path, shares});
    layout_ = scaling.layout;
    scale_ = scaling.scale;
    if (range_.empty()) {
        tolerance_ = options_.precision;
    } else {
        tolerance_ = std::max(options_.precision, rounding_error(smallest_steps(range.low)));
    }
    if (layout_.bits == 32)
        make_weights<uint32_t>();
    else
        make_weights<uint64_t>();
}

template <typename Word>
void Graph::make_weights() {
    const double p = options_.stiffness_exponent;
    const auto factors = [&](double part) {
        std::array<Real<Word>, 7> factor{};
        for (unsigned kind = 0; kind < grid_.kinds(); ++kind) {
            factor[kind] = static_cast<Real<Word>>(scale_ * grid_.length(kind) * part);
            if (!std::isnormal(factor[kind]))
                fail(LOCUS_E_RANGE, "the materials need a scale of ", scale_, ", which the arithmetic of ",
                     layout_.bits, "-bit words cannot hold");
        }
        return factor;
    };
    switch (operand_.rule) {
    case LOCUS_WEIGHT_MEAN_COMPLIANCE:
    case LOCUS_WEIGHT_UNIFORM:
        weights_ = HalfSum<Word>{factors(0.5)};
        return;
    case LOCUS_WEIGHT_MAX_COMPLIANCE:
        weights_ = Larger<Word>{factors(1)};
        return;
    case LOCUS_WEIGHT_MEAN_STIFFNESS:
        if (p == 1) {
            weights_ = MeanStiffness<Word>{factors(2)};
        } else if constexpr (sizeof(Word) == 4) {
            power32_ = std::make_unique<InversePower<float>>(p);
            weights_ = PowerStiffness<Word>{factors(std::exp2(p)), power32_.get()};
        } else {
            power64_ = std::make_unique<InversePower<double>>(p);
            weights_ = PowerStiffness<Word>{factors(std::exp2(p)), power64_.get()};
        }
        return;
    default:
        const double most = range_.empty() ? static_cast<double>(layout_.weight_limit()) : largest_steps(range_.high);
        weights_ = CallerWeights{options_.weight, options_.weight_user, scale_, most};
    }
}

// What a voxel can add to the length of a path, in steps: its share of the edge that leads in and of the one that leads
// out.
uint64_t Graph::on_path(float value) const {
    if (!(value == value))
        return 0;
    const double c = operand_.rule == LOCUS_WEIGHT_CALLER ? (range_.empty() ? 1 : range_.high) : compliance(value);
    return 2 * (static_cast<uint64_t>(largest_steps(c)) + 1);
}

void Graph::count_all() {
    passable_ = 0;
    longest_path_ = 0;
    for (const float value : materials_) {
        passable_ += value == value ? 1 : 0;
        longest_path_ += on_path(value);
    }
}

double Graph::safe_scale() const {
    const double room =
        static_cast<double>(layout_.max_exact()) - 2 * static_cast<double>(passable_); // for rounding up
    return scale_ * room / static_cast<double>(longest_path_);
}

uint64_t Graph::smallest_weight() const {
    if (operand_.rule == LOCUS_WEIGHT_UNIFORM)
        return static_cast<uint64_t>(std::max(1.0, std::rint(smallest_steps(1) / slack))) * 2;
    const auto each = static_cast<uint64_t>(shares_per_edge());
    if (operand_.rule == LOCUS_WEIGHT_CALLER || range_.zero || range_.empty())
        return each;
    return each * static_cast<uint64_t>(std::max(1.0, std::rint(smallest_steps(range_.low) / slack)));
}

uint64_t Graph::largest_weight() const {
    if (operand_.rule == LOCUS_WEIGHT_CALLER && range_.empty())
        return layout_.weight_limit();
    const double most = operand_.rule == LOCUS_WEIGHT_UNIFORM || range_.empty() ? 1 : range_.high;
    return static_cast<uint64_t>(shares_per_edge()) * (static_cast<uint64_t>(largest_steps(most)) + 1);
}

locus_graph_info Graph::info() const {
    locus_graph_info info{};
    info.struct_size = sizeof info;
    for (size_t axis = 0; axis < 3; ++axis) {
        info.dims[axis] = grid_.dims()[axis];
        info.spacing[axis] = grid_.spacing()[axis];
    }
    info.passable = passable_;
    info.bytes = sizeof *this + materials_.capacity() * sizeof(float) + cuts_.capacity() * sizeof(uint16_t) +
                 edited_.capacity() * sizeof(Box) + edited_at_.capacity() * sizeof(uint64_t);
    info.connectivity = grid_.connectivity();
    info.weight_rule = operand_.rule;
    info.word_bits = layout_.bits;
    info.label_bits = layout_.label_bits;
    info.scale = scale_;
    info.max_exact = layout_.max_exact();
    info.max_distance = static_cast<double>(info.max_exact) / scale_;
    const double low = operand_.rule == LOCUS_WEIGHT_UNIFORM || range_.empty() ? 1 : range_.low;
    const double arithmetic = layout_.bits == 32 ? 0x1p-22 : 0x1p-23; // of an operand that is an inverse, at least
    const double p = options_.stiffness_exponent;
    const bool tabled = operand_.rule == LOCUS_WEIGHT_MEAN_STIFFNESS && p != 1;
    info.weight_error = rounding_error(smallest_steps(low)) + arithmetic + (tabled ? p * (p + 1) / 8 * 0x1p-24 : 0);
    info.smallest_step = static_cast<double>(smallest_weight()) / scale_;
    info.overflow_free = longest_path_ <= layout_.max_exact() ? 1 : 0;
    info.threads = threads_;
    info.backend = backend_;
    info.simd = static_cast<uint32_t>(simd_);
    return info;
}

} // namespace locus::graph
