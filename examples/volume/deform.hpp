// A small deformation: the object in one slice moved by the weighted displacements of the seeds' frames (linear
// blending of rigid motions; Faure et al. 2011, section 3), and a cut through it.
#pragma once

#include "volume/model.hpp"
#include "volume/slices.hpp"
#include "volume/weights.hpp"

#include <array>
#include <string>
#include <vector>

namespace volume {

// From a voxel of the slice to those around it: steps across and down.
constexpr std::array<std::array<int, 2>, 8> ways{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Every voxel of the slice where it was moved to.
struct Shape {
    std::vector<std::array<double, 2>> moved; // displacement (right, down) of the plane's rows, in units of length
    std::vector<bool> there;                  // the row's voxel belongs to the object and a seed reaches it
    std::vector<uint8_t> joined;              // per row a bit for each of `ways`: an edge of the graph leads there
    double stretch = 0;                       // largest change of length between stiff neighbours, 0.1: 10 %

    bool is_joined(size_t row, int across, int down) const; // with the voxel so many steps away, one of `ways`
};

// The object at rest and moved in several ways.
struct Deformation {
    Shape rest, uniform, compliance;      // weights of Euclidean and of compliance distances
    Shape cut_rest, cut_stale, cut_fresh; // after a cut: at rest, with the weights of before, with updated ones
    bool cut = false;
    double seconds_update = 0, seconds_fresh = 0; // of locus_weights_update, and of making them anew
    size_t changed = 0;                           // rows that the update changed
    bool same = true;                             // updated and new weights are the same
};

// Cuts `material`'s graph, where a cut is asked for.
Deformation deform(const Options &options, const Input &input, const Material &material, const Result &result,
                   const Slicer &slicer);

// Stiffness from which on a voxel is drawn as stiff and takes part in Shape::stretch.
double stiff_from(const Material &material);

// deform.png.
void draw_deformation(const std::string &path, const Options &options, const Input &input, const Material &material,
                      const Result &result, const Slicer &slicer, const Deformation &deformation);

} // namespace volume
