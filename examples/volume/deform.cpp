// Displacements by weights of uniform and of compliance distances, before and after a cut.
#include "volume/deform.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace volume {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// What the shapes of one slice have in common.
struct Scene {
    const Options &options;
    const Slicer &slicer;
    const Slice &slice;
    Plane plane;
    std::vector<uint32_t> ids;                 // of the seeds that move
    std::vector<std::array<double, 2>> places; // theirs in the slice
    std::vector<bool> stiff;                   // rows

    std::array<double, 2> place(size_t row) const { return slicer.place_of(slice, plane.at(row)); }
};

Scene make_scene(const Options &options, const Input &input, const Material &material, const Result &result,
                 const Slicer &slicer) {
    const Slice &slice = slicer.slices()[0];
    Scene scene{options, slicer, slice, Plane(slice, input), {}, {}, {}};
    for (const Motion &motion : options.motions) {
        const auto seed = std::ranges::find(result.seeds, motion.id, &locus_seed::id);
        if (seed == result.seeds.end())
            throw std::runtime_error("--deform: no seed has the id " + std::to_string(motion.id));
        scene.ids.push_back(motion.id);
        scene.places.push_back(slicer.place_of(slice, {seed->x, seed->y, seed->z}));
    }
    std::vector<float> stiffness(scene.plane.rows());
    check(locus_graph_get_box(material.graph.get(), &scene.plane.box, stiffness.data(), stiffness.size()));
    for (const float value : stiffness)
        scene.stiff.push_back(double{value} >= stiff_from(material));
    return scene;
}

// A seed's rigid motion of a place: turned about the seed, then shifted.
std::array<double, 2> displacement(const Motion &motion, const std::array<double, 2> &seed,
                                   const std::array<double, 2> &place) {
    const double angle = motion.degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const double right = place[0] - seed[0], down = place[1] - seed[1];
    return {c * right - s * down - right + motion.right, s * right + c * down - down + motion.down};
}

// visit(row, its neighbour's row) for all pairs of rows whose voxels share a face.
void for_pairs(const Plane &plane, auto visit) {
    size_t step = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        const size_t extent = static_cast<size_t>(plane.box.extent[axis]);
        for (size_t row = 0; extent > 1 && row < plane.rows(); ++row)
            if (row / step % extent + 1 < extent)
                visit(row, row + step);
        step *= extent;
    }
}

double stretch_of(const Scene &scene, const Shape &shape) {
    double most = 0;
    for_pairs(scene.plane, [&](size_t a, size_t b) {
        if (!scene.stiff[a] || !scene.stiff[b] || !shape.there[a] || !shape.there[b])
            return;
        const auto from = scene.place(a), to = scene.place(b);
        const double right = to[0] - from[0], down = to[1] - from[1];
        const double now =
            std::hypot(right + shape.moved[b][0] - shape.moved[a][0], down + shape.moved[b][1] - shape.moved[a][1]);
        most = std::max(most, std::abs(now / std::hypot(right, down) - 1));
    });
    return most;
}

// The object where the diagram's seeds reach it, moved by the weights; NULL: at rest.
Shape shape_of(const Scene &scene, const locus_diagram *diagram, const locus_weights *weights) {
    std::vector<uint32_t> labels(scene.plane.rows());
    check(locus_diagram_labels(diagram, &scene.plane.box, labels.data(), labels.size()));
    Shape shape;
    shape.moved.resize(labels.size());
    for (const uint32_t label : labels)
        shape.there.push_back(label != LOCUS_NO_SEED);
    if (weights == nullptr)
        return shape;
    const std::vector<float> numbers = dense(weights, scene.ids);
    for (size_t row = 0; row < labels.size(); ++row)
        for (size_t i = 0; i < scene.ids.size(); ++i) {
            const auto by = displacement(scene.options.motions[i], scene.places[i], scene.place(row));
            const double weight = double{numbers[row * scene.ids.size() + i]};
            shape.moved[row][0] += weight * by[0];
            shape.moved[row][1] += weight * by[1];
        }
    shape.stretch = stretch_of(scene, shape);
    return shape;
}

bool same_rows(const locus_weights *a, const locus_weights *b) {
    struct Rows {
        std::vector<uint64_t> offsets;
        std::vector<uint32_t> ids;
        std::vector<float> values;
        bool operator==(const Rows &) const = default;
    };
    const auto rows = [](const locus_weights *weights) {
        uint64_t count = 0, entries = 0;
        check(locus_weights_size(weights, &count, &entries));
        const size_t room = static_cast<size_t>(entries);
        Rows rows{std::vector<uint64_t>(static_cast<size_t>(count) + 1), std::vector<uint32_t>(room),
                  std::vector<float>(room)};
        check(locus_weights_rows(weights, 0, count, rows.offsets.data(), rows.ids.data(), rows.values.data(), room,
                                 nullptr));
        return rows;
    };
    return rows(a) == rows(b);
}

void cut(const Scene &scene, locus_graph *graph, locus_diagram *diagram, locus_weights *weights, Deformation &result) {
    check(locus_graph_fill_box(graph, &*scene.options.cut, std::numeric_limits<float>::quiet_NaN()));
    check(locus_diagram_solve(diagram, nullptr, nullptr));
    result.cut = true;
    result.cut_rest = shape_of(scene, diagram, nullptr);
    result.cut_stale = shape_of(scene, diagram, weights);
    auto begin = Clock::now();
    std::vector<uint64_t> changed(scene.plane.rows());
    check(locus_weights_update(weights, changed.data(), changed.size(), &result.changed));
    result.seconds_update = seconds_since(begin);
    begin = Clock::now();
    const Weights fresh = make_weights(diagram, LOCUS_METHOD_SIBSON, &scene.plane.box, nullptr);
    result.seconds_fresh = seconds_since(begin);
    result.same = same_rows(weights, fresh.get());
    result.cut_fresh = shape_of(scene, diagram, weights);
}

} // namespace

double stiff_from(const Material &material) { return std::sqrt(material.softest * material.stiffest); }

Deformation deform(const Options &options, const Input &input, const Material &material, const Result &result,
                   const Slicer &slicer) {
    const Scene scene = make_scene(options, input, material, result, slicer);
    Deformation deformation;
    Options geometric = options;
    geometric.weight_rule = LOCUS_WEIGHT_UNIFORM;
    {
        const Material uniform = make_material(geometric, input);
        const Diagram diagram = solve_again(geometric, uniform.graph.get(), result.seeds);
        const Weights weights = make_weights(diagram.get(), LOCUS_METHOD_SIBSON, &scene.plane.box, nullptr);
        deformation.uniform = shape_of(scene, diagram.get(), weights.get());
    }
    const Diagram diagram = solve_again(options, material.graph.get(), result.seeds);
    const Weights weights = make_weights(diagram.get(), LOCUS_METHOD_SIBSON, &scene.plane.box, nullptr);
    deformation.rest = shape_of(scene, diagram.get(), nullptr);
    deformation.compliance = shape_of(scene, diagram.get(), weights.get());
    if (options.cut)
        cut(scene, material.graph.get(), diagram.get(), weights.get(), deformation);
    return deformation;
}

} // namespace volume
