// Updates along a moving cut, against solving anew.
#include "volume/cutting.hpp"

#include "volume/blade.hpp"

#include <algorithm>
#include <chrono>

namespace volume {
namespace {

double seconds_of(auto &&work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Every voxel's label and exact distance.
struct Whole {
    std::vector<uint32_t> labels;
    std::vector<uint64_t> distances;
    bool operator==(const Whole &) const = default;
};

Whole whole_of(const Input &input, const locus_diagram *diagram) {
    const size_t voxels = static_cast<size_t>(input.voxels());
    Whole whole{std::vector<uint32_t>(voxels), std::vector<uint64_t>(voxels)};
    check(locus_diagram_labels(diagram, nullptr, whole.labels.data(), voxels));
    check(locus_diagram_distances_exact(diagram, nullptr, whole.distances.data(), voxels));
    return whole;
}

void look(const Plane &plane, const locus_diagram *diagram, CutStep &step) {
    step.labels.resize(plane.rows());
    step.distances.resize(plane.rows());
    check(locus_diagram_labels(diagram, &plane.box, step.labels.data(), plane.rows()));
    check(locus_diagram_distances(diagram, &plane.box, step.distances.data(), plane.rows()));
}

} // namespace

uint64_t Cutting::changed() const {
    uint64_t sum = 0;
    for (const CutStep &step : steps)
        sum += step.changed;
    return sum;
}

double Cutting::slowest() const { return std::ranges::max(steps, {}, &CutStep::seconds).seconds; }

double Cutting::median() const {
    std::vector<double> seconds;
    for (size_t i = 1; i < steps.size(); ++i)
        seconds.push_back(steps[i].seconds);
    std::ranges::nth_element(seconds, seconds.begin() + static_cast<ptrdiff_t>(seconds.size() / 2));
    return seconds[seconds.size() / 2];
}

Cutting cut_in_steps(const Options &options, const Input &input, const Material &material, const Result &result,
                     const Slicer &slicer) {
    const Plane plane(slicer.slices()[0], input);
    locus_graph *graph = material.graph.get();
    const Diagram diagram = solve_again(options, graph, result.seeds);
    const Whole before = whole_of(input, diagram.get());
    Cutting cutting;
    cutting.passable = material.passable;
    look(plane, diagram.get(), cutting.steps.emplace_back());
    for (uint32_t i = 1; i <= options.cut_steps; ++i) {
        CutStep &step = cutting.steps.emplace_back();
        step.reach = static_cast<double>(i) / options.cut_steps;
        step.edges = cut_along(*options.cut, step.reach, input, graph);
        cutting.edges += step.edges;
        step.seconds =
            seconds_of([&] { check(locus_diagram_update(diagram.get(), nullptr, &step.changed, nullptr, nullptr)); });
        look(plane, diagram.get(), step);
    }
    const Whole updated = whole_of(input, diagram.get());
    cutting.seconds_full = seconds_of([&] { check(locus_diagram_solve(diagram.get(), nullptr, nullptr)); });
    cutting.same = whole_of(input, diagram.get()) == updated;
    check(locus_graph_mend_box(graph, nullptr, nullptr));
    check(locus_diagram_update(diagram.get(), nullptr, nullptr, nullptr, nullptr));
    cutting.same = whole_of(input, diagram.get()) == before && cutting.same;
    return cutting;
}

} // namespace volume
