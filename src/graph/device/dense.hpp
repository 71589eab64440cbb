// The thesis' algorithms on a device, x fastest in memory, a thread per voxel: relax and update (sections 2.4.1 to
// 2.4.3, algorithms 2.2 to 2.4), and relaxing only the grains of voxels that coarse stream compaction (section 2.4.5)
// has found active.
#pragma once

#include "graph/device/atomics.hpp"
#include "graph/device/block.hpp"
#include "graph/device/neighbours.hpp"
#include "graph/device/rules.hpp"

namespace locus::device {

// What a device holds of a graph.
struct Dense {
    uint64_t dims[3];
    const float *operands;
    const uint32_t *open; // the neighbours an edge leads to, by number; null where no edge is cut
    uint32_t classes;     // 1 faces, 2 and edges, 3 and corners

    LOCUS_HD uint64_t voxels() const { return dims[0] * dims[1] * dims[2]; }
    LOCUS_HD void place(uint64_t voxel, uint64_t (&at)[3]) const {
        const uint64_t row = voxel / dims[0];
        at[0] = voxel % dims[0];
        at[1] = row % dims[1];
        at[2] = row / dims[1];
    }
    // visit(neighbour's offset in memory, dx, dy, dz) for the neighbours of a voxel.
    template <typename Visit>
    LOCUS_HD void neighbours(uint64_t voxel, const uint64_t (&at)[3], Visit &&visit) const {
        const uint32_t leads = open != nullptr ? open[voxel] : ~0u;
        for (int dz = -1; dz <= 1; ++dz) {
            if (at[2] + static_cast<uint64_t>(dz) >= dims[2]) // huge below 0
                continue;
            for (int dy = -1; dy <= 1; ++dy) {
                if (at[1] + static_cast<uint64_t>(dy) >= dims[1])
                    continue;
                for (int dx = -1; dx <= 1; ++dx) {
                    const unsigned moved = moves(axes_of(dx, dy, dz));
                    if (at[0] + static_cast<uint64_t>(dx) >= dims[0] || moved == 0 || moved > classes ||
                        (leads >> number_of(dx, dy, dz) & 1) == 0)
                        continue;
                    const int64_t offset =
                        dx + static_cast<int64_t>(dims[0]) * (dy + static_cast<int64_t>(dims[1]) * dz);
                    visit(voxel + static_cast<uint64_t>(offset), dx, dy, dz);
                }
            }
        }
    }
};

// The volume in grains, and the list of the active ones. Without a list every voxel gets a thread.
struct Grains {
    uint32_t size[3];  // voxels
    uint64_t count[3]; // grains
    uint8_t *active;   // a byte per grain
    uint64_t *list;
    uint64_t *listed;

    LOCUS_HD uint64_t volume() const { return uint64_t{size[0]} * size[1] * size[2]; }
    LOCUS_HD uint64_t of(const uint64_t (&at)[3]) const {
        return at[0] / size[0] + count[0] * (at[1] / size[1] + count[1] * (at[2] / size[2]));
    }
    // Where thread i of those that work on the list finds its voxel.
    LOCUS_HD void place(uint64_t i, uint64_t (&at)[3]) const {
        const uint64_t grain = list[i / volume()], row = grain / count[0], in = i % volume();
        at[0] = grain % count[0] * size[0] + in % size[0];
        at[1] = row % count[1] * size[1] + in / size[0] % size[1];
        at[2] = row / count[1] * size[2] + in / (uint64_t{size[0]} * size[1]);
    }
};

// Algorithm 2.3.
template <typename Word, typename Rule>
struct Relax {
    Dense graph;
    Grains grains;
    Rule rule;
    const Word *settled; // C0
    Word *estimate;      // C1
    uint8_t *mask;
    Word beyond; // just above the largest word to keep
    uint32_t label_bits;

    LOCUS_HD uint64_t count() const {
        return grains.list != nullptr ? *grains.listed * grains.volume() : graph.voxels();
    }
    LOCUS_HD void operator()(uint64_t i) const {
        uint64_t at[3];
        uint64_t voxel = i;
        if (grains.list != nullptr) {
            grains.place(i, at);
            if (at[0] >= graph.dims[0] || at[1] >= graph.dims[1] || at[2] >= graph.dims[2])
                return;
            voxel = at[0] + graph.dims[0] * (at[1] + graph.dims[1] * at[2]);
        }
        if (mask[voxel] == 0)
            return;
        mask[voxel] = 0;
        if (grains.list == nullptr)
            graph.place(voxel, at);
        const Word own = settled[voxel];
        const float operand = graph.operands[voxel];
        graph.neighbours(voxel, at, [&](uint64_t next, int dx, int dy, int dz) {
            const Word weight = rule(operand, graph.operands[next], axes_of(dx, dy, dz));
            const Word longer = own + (weight << label_bits);
            if (longer < beyond && longer < load_shared(&estimate[next]))
                atomic_min(&estimate[next], longer);
        });
    }
};

// Algorithm 2.4.
template <typename Word>
struct Update {
    Dense graph;
    Grains grains;
    Word *settled;
    const Word *estimate;
    uint8_t *mask;
    uint64_t *active; // how many voxels become active

    LOCUS_HD uint64_t count() const { return graph.voxels(); }
    LOCUS_HD void operator()(uint64_t voxel) const {
        const Word lowered = estimate[voxel];
        if (settled[voxel] <= lowered)
            return;
        settled[voxel] = lowered;
        mask[voxel] = 1;
        atomic_add(active, uint64_t{1});
        if (grains.active == nullptr)
            return;
        uint64_t at[3];
        graph.place(voxel, at);
        store_shared(&grains.active[grains.of(at)], uint8_t{1});
    }
};

// Seeds into the estimates, for the first update.
template <typename Word>
struct Sow {
    Word *estimate;
    const uint64_t *voxel;
    const Word *word;
    uint64_t seeds;
    Word beyond;

    LOCUS_HD uint64_t count() const { return seeds; }
    LOCUS_HD void operator()(uint64_t i) const {
        if (word[i] < beyond)
            atomic_min(&estimate[voxel[i]], word[i]);
    }
};

} // namespace locus::device
