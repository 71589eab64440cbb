/* locus/weights.h - shape functions: how much each seed of a Voronoi diagram weighs at a voxel.
 *
 * Three methods (thesis section 2.5.2), all on the graph's compliance distances:
 * - Sibson (natural neighbours, 1981): were the voxel q a seed, it would steal the voxels v with d(q, v) < D(v), D
 * being the distance to the nearest seed. The weight of a seed is its share of the voxels stolen.
 * - Laplace (non-Sibsonian; Belikov et al. 1997): A / d normalised, A being the area of the voxel faces between what q
 * steals and what remains of the seed's cell (the object's outer surface does not count), d the length of the shortest
 * path from q to the seed across one of these faces. Without any such face the row is the nearest seed alone.
 * - Distance ratio (Faure et al. 2011): from the distance dp to the seed and db to the border of its cell, (1 +
 * db/(dp+db))/2 inside the cell and (1 - db/(dp-db))/2 outside, 0 beyond twice the largest distance found in the cell
 * and the voxels that touch it; below 1e-4 it is 0, above 1 - 1e-4 it is 1; then normalised. A row holds the seeds that
 * weigh something at one voxel; its weights sum to 1. The row of a voxel where a seed starts at distance 0 is that seed
 * alone (of several the one added first). The row of an impassable or unreached voxel is empty. */
#ifndef LOCUS_WEIGHTS_H
#define LOCUS_WEIGHTS_H

#include <locus/diagram.h>
#include <locus/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_weights locus_weights;

#define LOCUS_METHOD_SIBSON 0
#define LOCUS_METHOD_LAPLACE 1
#define LOCUS_METHOD_DISTANCE_RATIO 2

#define LOCUS_ALL_SEEDS 0u /* for max_per_row: keep every seed that weighs something */

typedef struct locus_weights_options {
    uint64_t struct_size;
    uint32_t method;      /* LOCUS_METHOD_; default LOCUS_METHOD_SIBSON */
    uint32_t max_per_row; /* keep only this many largest weights of a row (the seed added first on ties) and normalise
                             them again; default LOCUS_ALL_SEEDS */
    uint64_t batch_bytes; /* most scratch memory of a call, beside its list of voxels and the rows themselves, >= 1 MiB;
                             a call takes fewer threads rather than more memory, and where the surroundings of a batch
                             of queries do not fit, natural neighbours are searched query by query. The distance ratio
                             needs 270 bytes (510 where distances or edges exceed 2^27 steps, as mostly with 64-bit
                             words) a voxel of the box that sixteen neighbouring cells and their supports take, so at
                             most for (nx + 2)(ny + 2)(nz + 2) voxels. Where one search does not fit, the call fails
                             with LOCUS_E_MEMORY; default 1 GiB */
    locus_progress_fn progress; /* kept, and called by locus_weights_update too; default NULL */
    void *progress_user;
} locus_weights_options;

/* Fill the options (of `size` bytes) with the defaults stated at the fields. Errors: LOCUS_E_ARGUMENT. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_weights_options_init(locus_weights_options *options, size_t size) LOCUS_NOEXCEPT;

/* Compute the rows of all voxels of `box` (NULL: the whole grid), in its order, x fastest, from a solved diagram.
 * The weights keep what they need of the diagram and its graph: those may be destroyed; with the distance ratio also
 * what every seed weighs before rows are pruned, 8 bytes each, for updates. `options` may be NULL.
 * `*weights` is the caller's, to be ended with locus_weights_destroy; NULL on any error.
 * Errors: LOCUS_E_STATE (the diagram is unsolved, or its graph or seeds changed since), LOCUS_E_ARGUMENT,
 * LOCUS_E_MEMORY (also of batch_bytes), LOCUS_E_STOPPED (by the progress callback). Uses up to the graph's threads. Not
 * beside calls that change the diagram or its graph. Since 0.1. */
LOCUS_API locus_status locus_weights_create(locus_diagram *diagram, const locus_weights_options *options,
                                            const locus_voxel_box *box, locus_weights **weights) LOCUS_NOEXCEPT;

/* The same for a list of voxels given by their indices x + nx * (y + ny * z); one row each, in the list's order.
 * Errors and threads as above. Since 0.1. */
LOCUS_API locus_status locus_weights_create_for(locus_diagram *diagram, const locus_weights_options *options,
                                                const uint64_t *voxels, size_t count,
                                                locus_weights **weights) LOCUS_NOEXCEPT;

/* End the weights. NULL is fine. Since 0.1. */
LOCUS_API void locus_weights_destroy(locus_weights *weights) LOCUS_NOEXCEPT;

/* The number of rows, and of entries in all of them. Each of `rows` and `entries` may be NULL. Errors:
 * LOCUS_E_ARGUMENT. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_weights_size(const locus_weights *weights, uint64_t *rows,
                                          uint64_t *entries) LOCUS_NOEXCEPT;

/* Copy `count` rows from row `first` on. Row first + i has the entries offsets[i] .. offsets[i + 1] - 1 of `ids` (the
 * caller's seed ids) and `values` (in (0, 1]), by falling weight, the seed added first on ties. `offsets` has room for
 * count + 1 numbers, `ids` and `values` for `capacity` each; `*entries` (may be NULL) is how many entries the rows
 * have, also when the capacity is too small (LOCUS_E_CAPACITY; then `offsets` is filled and nothing else). Errors:
 * LOCUS_E_ARGUMENT. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_weights_rows(const locus_weights *weights, uint64_t first, uint64_t count,
                                          uint64_t *offsets, uint32_t *ids, float *values, size_t capacity,
                                          uint64_t *entries) LOCUS_NOEXCEPT;

/* Write `count` rows from `first` on as a dense array of count times `seeds` numbers, row by row: entry [i][j] is the
 * weight of the j-th of the `seeds` seed ids at row first + i, 0 where it weighs nothing. An id that is no seed, or
 * stands there twice, is LOCUS_E_ARGUMENT. `dense` has room for `capacity` numbers. Errors: LOCUS_E_ARGUMENT,
 * LOCUS_E_CAPACITY. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_weights_dense(const locus_weights *weights, uint64_t first, uint64_t count,
                                           const uint32_t *ids, size_t seeds, float *dense,
                                           size_t capacity) LOCUS_NOEXCEPT;

/* Interpolate values given at the seeds: out[i][c] = sum over the entries of row first + i of weight * values[seed][c],
 * for `components` numbers a seed. `values` holds one line of `components` per seed, in the order of
 * locus_diagram_get_seeds when the weights were made; `out` has room for `capacity` numbers, count * components are
 * written; an empty row gives NaN. Errors: LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_weights_interpolate(const locus_weights *weights, uint64_t first, uint64_t count,
                                                 const float *values, uint32_t components, float *out,
                                                 size_t capacity) LOCUS_NOEXCEPT;

/* The gradient of one seed's weight, in 1 / unit of length, at `count` voxels from row `first` on: three numbers a row
 * (d/dx, d/dy, d/dz by spacing) from central differences between the 6-neighbours that have rows and an edge of the
 * graph to the voxel between them, one-sided where only one does, 0 where none does. Needs weights made for a box.
 * `gradients` has room for `capacity` numbers. Errors: LOCUS_E_STATE (weights of a list, or the graph was
 * edited since they were made or updated), LOCUS_E_ARGUMENT (no such seed), LOCUS_E_CAPACITY. Beside other readers.
 * Since 0.1. */
LOCUS_API locus_status locus_weights_gradients(const locus_weights *weights, uint64_t first, uint64_t count,
                                               uint32_t id, float *gradients, size_t capacity) LOCUS_NOEXCEPT;

/* Bring the weights up to date with their diagram after its graph or its seeds changed and it was solved or updated
 * again: only the rows that can have changed are recomputed, and all of them equal those of freshly made weights. Their
 * numbers (with the distance ratio only those of rows that did change), in rising order, go into `changed` with room
 * for `capacity` (NULL with capacity 0: not wanted); `*count` (may be NULL) is how many there are. Where seeds were
 * added after so many that the diagram numbered them anew, all rows can have changed. Works also when the diagram's own
 * handle was destroyed. Errors: LOCUS_E_STATE (the diagram is unsolved, or its graph or seeds changed
 * since), LOCUS_E_CAPACITY (the rows are up to date, the first `capacity` numbers were stored), LOCUS_E_MEMORY and
 * LOCUS_E_STOPPED (the rows are as before). Not beside any other call on the weights, or calls that change the diagram.
 * Since 0.1. */
LOCUS_API locus_status locus_weights_update(locus_weights *weights, uint64_t *changed, size_t capacity,
                                            size_t *count) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
