// The transfer table: from a voxel's value (a grey level, a Hounsfield number, a label) to its stiffness.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace volume {

// Entries, one a line of a file or separated by ';' on the command line; '#' begins a comment:
//   point VALUE STIFFNESS     a point of a piecewise linear curve, which ends at its first and last point
//   label VALUE STIFFNESS     voxels of exactly this value
//   range FROM TO STIFFNESS   voxels with FROM <= value < TO; FROM may be -inf, TO inf
// STIFFNESS is a number > 0 or "none": impassable. The first label or range that holds a value decides, else the curve
// does; a value that nothing holds is impassable, NaN always is.
class TransferTable {
public:
    // Throw std::runtime_error that names the line and what is wrong with it.
    static TransferTable parse(const std::string &text, const std::string &where);
    static TransferTable read(const std::string &path);

    float stiffness(float value) const; // NaN: impassable

private:
    void add(const std::string &line);
    double on_curve(double value) const;

    struct Range {
        double from, to, stiffness; // from == to: a label
    };
    std::vector<Range> ranges_;
    std::vector<std::pair<double, double>> curve_;
};

} // namespace volume
