// Interpolation weights of a diagram for a box or a list of voxels: what locus/weights.h offers.
#pragma once

#include "core/progress.hpp"
#include "graph/diagram.hpp"
#include "graph/weights/cells.hpp"
#include "graph/weights/rows.hpp"

#include <locus/weights.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace locus::graph {

class Interpolation {
public:
    // For the voxels of a box, in its order, or for a list. Throws LOCUS_E_STATE unless the diagram is solved and
    // nothing has changed since.
    Interpolation(std::shared_ptr<const Diagram> diagram, const locus_weights_options &options, const Box &box);
    Interpolation(std::shared_ptr<const Diagram> diagram, const locus_weights_options &options,
                  std::span<const uint64_t> voxels);

    uint64_t count() const { return rows_.count(); }
    uint64_t entries() const { return rows_.shares.size(); }

    // These take rows first..first + count - 1, which the caller has checked; a Share's label is the seed's position in
    // ids().
    const Rows &rows() const { return rows_; }
    const std::vector<uint32_t> &ids() const { return ids_; } // in the order of the seeds
    void dense(uint64_t first, uint64_t count, std::span<const uint32_t> ids, float *out) const;
    void interpolate(uint64_t first, uint64_t count, const float *values, uint32_t components, float *out) const;
    void gradients(uint64_t first, uint64_t count, uint32_t id, float *out) const;

    // Follow the diagram; the rows that were computed anew, rising.
    std::vector<uint64_t> update();

private:
    void take_options(const locus_weights_options &options);
    void check_diagram() const;
    // Rows and parts with seeds by slot.
    void compute_all();
    Rows natural(std::span<const uint64_t> rows, const Rows *base) const;
    Rows ratio_parts(const std::vector<Cell> &cells, const std::vector<bool> *concerned) const;
    bool same_slots() const;
    std::vector<uint64_t> update_natural(Rows rows);
    std::vector<uint64_t> update_ratio(const Rows &rows);
    void adopt(Rows rows, Rows parts);
    uint32_t position(uint32_t id) const;

    std::shared_ptr<const Diagram> diagram_;
    locus_weights_options options_;
    std::optional<Box> box_;
    std::vector<uint64_t> voxels_; // of each row
    Rows rows_;
    Rows parts_; // of the distance ratio, by slot: what every row is made from
    std::vector<uint32_t> ids_;
    // The diagram as it was when the rows were made.
    Words words_;
    std::vector<uint32_t> id_of_slot_; // LOCUS_NO_SEED for an empty slot
    uint64_t version_ = 0;             // of the graph
};

} // namespace locus::graph
