// Displacements by weights of uniform and of compliance distances, before and after a cut.
#include "volume/deform.hpp"

#include "volume/blade.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace volume {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// What the shapes of one slice have in common.
struct Scene {
    const Options &options;
    const Input &input;
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
    Scene scene{options, input, slicer, slice, Plane(slice, input), {}, {}, {}};
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

// Which voxels of the plane the graph's edges join.
void join(const Scene &scene, const locus_graph *graph, Shape &shape) {
    const Plane &plane = scene.plane;
    shape.joined.resize(shape.there.size());
    for (size_t row = 0; row < shape.there.size(); ++row)
        for (unsigned way = 0; way < ways.size(); ++way) {
            const auto other = plane.beside(row, ways[way][0], ways[way][1]);
            if (!other || !shape.there[row] || !shape.there[*other])
                continue;
            uint64_t weight = 0;
            check(locus_graph_edge_weight(graph, index_of(scene.input, plane.at(row)),
                                          index_of(scene.input, plane.at(*other)), &weight));
            if (weight > 0)
                shape.joined[row] = static_cast<uint8_t>(shape.joined[row] | 1u << way);
        }
}

double stretch_of(const Scene &scene, const Shape &shape) {
    double most = 0;
    for (size_t a = 0; a < shape.there.size(); ++a)
        for (const auto &[across, down] : {std::pair{1, 0}, std::pair{0, 1}}) {
            if (!scene.stiff[a] || !shape.is_joined(a, across, down))
                continue;
            const size_t b = *scene.plane.beside(a, across, down);
            if (!scene.stiff[b])
                continue;
            const auto from = scene.place(a), to = scene.place(b);
            const double right = to[0] - from[0], below = to[1] - from[1];
            const double now = std::hypot(right + shape.moved[b][0] - shape.moved[a][0],
                                          below + shape.moved[b][1] - shape.moved[a][1]);
            most = std::max(most, std::abs(now / std::hypot(right, below) - 1));
        }
    return most;
}

// The object where the diagram's seeds reach it, moved by the weights; NULL: at rest.
Shape shape_of(const Scene &scene, const locus_graph *graph, const locus_diagram *diagram,
               const locus_weights *weights) {
    std::vector<uint32_t> labels(scene.plane.rows());
    check(locus_diagram_labels(diagram, &scene.plane.box, labels.data(), labels.size()));
    Shape shape;
    shape.moved.resize(labels.size());
    for (const uint32_t label : labels)
        shape.there.push_back(label != LOCUS_NO_SEED);
    join(scene, graph, shape);
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
    cut_along(*scene.options.cut, 1, scene.input, graph);
    check(locus_diagram_update(diagram, nullptr, nullptr, nullptr, nullptr));
    result.cut = true;
    result.cut_rest = shape_of(scene, graph, diagram, nullptr);
    result.cut_stale = shape_of(scene, graph, diagram, weights);
    auto begin = Clock::now();
    std::vector<uint64_t> changed(scene.plane.rows());
    check(locus_weights_update(weights, changed.data(), changed.size(), &result.changed));
    result.seconds_update = seconds_since(begin);
    begin = Clock::now();
    const Weights fresh = make_weights(diagram, LOCUS_METHOD_SIBSON, &scene.plane.box, nullptr);
    result.seconds_fresh = seconds_since(begin);
    result.same = same_rows(weights, fresh.get());
    result.cut_fresh = shape_of(scene, graph, diagram, weights);
}

} // namespace

bool Shape::is_joined(size_t row, int across, int down) const {
    const auto way = std::ranges::find(ways, std::array{across, down});
    return (joined[row] >> (way - ways.begin()) & 1) != 0;
}

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
        deformation.uniform = shape_of(scene, uniform.graph.get(), diagram.get(), weights.get());
    }
    const Diagram diagram = solve_again(options, material.graph.get(), result.seeds);
    const Weights weights = make_weights(diagram.get(), LOCUS_METHOD_SIBSON, &scene.plane.box, nullptr);
    deformation.rest = shape_of(scene, material.graph.get(), diagram.get(), nullptr);
    deformation.compliance = shape_of(scene, material.graph.get(), diagram.get(), weights.get());
    if (options.cut)
        cut(scene, material.graph.get(), diagram.get(), weights.get(), deformation);
    return deformation;
}

} // namespace volume
