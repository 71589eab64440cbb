/* locus/diagram.h - the Voronoi diagram of a voxel graph: every voxel's nearest seed and its distance.
 *
 * Distances are lengths of shortest paths along the graph's edges, from a seed's starting distance on. Ties go to the
 * seed that was added earlier. Results are exact in the graph's integer weights and the same from every engine.
 * Method: multi-source Dijkstra, thesis 2.2.2 (Erwig 2000), 2.4. Threads: const calls beside each other. */
#ifndef LOCUS_DIAGRAM_H
#define LOCUS_DIAGRAM_H

#include <locus/graph.h>
#include <locus/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_diagram locus_diagram;

/* The label of a voxel that no seed reaches; never a seed's id. Its distance is +infinity, its exact distance
 * UINT64_MAX. */
#define LOCUS_NO_SEED 0xFFFFFFFFu

/* On a graph of the CUDA backend the bricks, relax and compact engines run on the GPU, heap and bucket on the CPU. */
#define LOCUS_ENGINE_AUTO 0   /* LOCUS_ENGINE_BRICKS */
#define LOCUS_ENGINE_HEAP 1   /* Dijkstra with a binary heap: the oracle every other engine is tested against */
#define LOCUS_ENGINE_BUCKET 2 /* Dijkstra with buckets (Dial 1969), each as wide as the smallest weight, 64 a level */
#define LOCUS_ENGINE_RELAX 3  /* the thesis' base algorithm, sections 2.4.1 to 2.4.3: relax all active voxels */
/* Blocks of 14 x 8 x 8 voxels in SIMD registers, on several threads. The diagram keeps 9.2 bytes per voxel (13.8 with
 * 64-bit words) beside its result, for a grid rounded up to whole blocks, so that updates follow what changes. On a GPU
 * blocks of 8 x 8 x 8 voxels, and 8 bytes per voxel (12 with 64-bit words, 4 more once edges were cut), which stay in
 * its memory from one solve or update to the next. */
#define LOCUS_ENGINE_BRICKS 4
/* The relax engine with coarse stream compaction (thesis section 2.4.5): only grains of voxels that hold active ones
 * are worked on; CUDA only. */
#define LOCUS_ENGINE_COMPACT 5

/* A seed: a place with an id of the caller's that names it in every result. */
typedef struct locus_seed {
    uint64_t x, y, z; /* its voxel */
    double distance;  /* what it starts at, in units of distance, finite and >= 0; usually 0 */
    uint32_t id;      /* unique within the diagram, not LOCUS_NO_SEED */
    uint32_t fixed;   /* 1: never moved by locus_diagram_place_seeds; 0: free */
} locus_seed;

typedef struct locus_diagram_options {
    uint64_t struct_size;
    uint32_t engine;       /* LOCUS_ENGINE_; default LOCUS_ENGINE_AUTO */
    uint32_t record_trace; /* 1: keep the active voxels per iteration for locus_diagram_trace; default 0 */
    double max_distance;   /* voxels farther than this stay unreached, >= 0; default +infinity: no cut-off */
    uint32_t grain[3];     /* for LOCUS_ENGINE_COMPACT: a grain's voxels in x, y, z, each 1..1024; default 8, 4, 4 */
    uint32_t reserved0;    /* 0 */
    void *stream; /* for the CUDA backend: the caller's cudaStream_t that all work is put on, Sibson's weights of the
                     diagram included; calls still return when their result is there. It must outlive the diagram and
                     its weights, and belong to the CUDA device that is the calling thread's. Default NULL: streams of
                     the library's own */
    uint32_t on_device; /* 1: on the CUDA backend LOCUS_ENGINE_BRICKS leaves a result in the GPU's memory, where
                           locus_diagram_labels_on_device and its like read it; the first call that reads it on the host
                           brings it there, and reports what the GPU fails at, losing nothing. locus_diagram_get_stats
                           needs none of it. An update then keeps 4 bytes more per voxel there (8 with 64-bit words).
                           The other engines and the CPU do as with 0. Default 0: results come to the host at once */
    uint32_t reserved1; /* 0 */
} locus_diagram_options;

/* What the latest solve did. */
typedef struct locus_diagram_stats {
    uint64_t struct_size;
    uint64_t reached;      /* voxels with a label */
    uint64_t seeds;        /* seeds in the diagram */
    uint64_t relaxations;  /* edges looked at */
    uint64_t iterations;   /* rounds (relax), buckets emptied (bucket), voxels settled (heap), visits of
                             bricks (bricks) */
    uint64_t max_exact;    /* the largest exact distance of a reached voxel, in steps */
    double max_distance;   /* the same in units of distance */
    double seconds_import; /* wall time: bringing the graph into the engine's form, */
    double seconds_solve;  /* solving, */
    double seconds_export; /* and bringing the result back */
    uint64_t bytes;        /* memory held by the diagram */
    uint32_t engine;       /* the engine that ran */
    uint32_t threads;      /* threads it used */
    uint32_t backend;      /* the backend that ran, LOCUS_BACKEND_CPU or LOCUS_BACKEND_CUDA */
    uint32_t reserved0;    /* 0 */
} locus_diagram_stats;

/* Two cells that touch: some voxel of the one is a graph neighbour of some voxel of the other, with an edge between. */
typedef struct locus_cell_pair {
    uint32_t a, b;  /* seed ids; the one added earlier first */
    uint64_t edges; /* graph edges between the two cells */
} locus_cell_pair;

#define LOCUS_PLACE_COMPLIANCE 0 /* distances of the graph */
#define LOCUS_PLACE_UNIFORM 1    /* distances of the same grid with the weight rule LOCUS_WEIGHT_UNIFORM */

typedef struct locus_place_options {
    uint64_t struct_size;
    uint64_t count;             /* free seeds to add, >= 0; default 0: only move the free ones that are there */
    uint32_t first_id;          /* ids of the added seeds: first_id, first_id + 1, ...; default 0 */
    uint32_t lloyd_iterations;  /* most rounds of Lloyd after the sampling; fewer when no seed moves; default 100 */
    uint32_t metric;            /* LOCUS_PLACE_; default LOCUS_PLACE_COMPLIANCE */
    uint32_t reserved0;         /* 0 */
    locus_progress_fn progress; /* default NULL */
    void *progress_user;
} locus_place_options;

/* Fill the options (of `size` bytes) with the defaults stated at the fields.
 * Errors: LOCUS_E_ARGUMENT. Any thread. Since 0.1. */
LOCUS_API locus_status locus_diagram_options_init(locus_diagram_options *options, size_t size) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_place_options_init(locus_place_options *options, size_t size) LOCUS_NOEXCEPT;

/* Make a diagram of `graph`, without seeds, unsolved. It sees later edits of the graph when it is solved again, and
 * keeps what it needs of the graph alive. `options` may be NULL for the defaults. `*diagram` is the caller's, to be
 * ended with locus_diagram_destroy; NULL on any error. Errors: LOCUS_E_ARGUMENT, LOCUS_E_MEMORY. Calls on diagrams of
 * one graph may run beside each other, but not beside calls that change the graph. Since 0.1. */
LOCUS_API locus_status locus_diagram_create(locus_graph *graph, const locus_diagram_options *options,
                                            locus_diagram **diagram) LOCUS_NOEXCEPT;

/* End a diagram. NULL is fine. Since 0.1. */
LOCUS_API void locus_diagram_destroy(locus_diagram *diagram) LOCUS_NOEXCEPT;

/* Add `count` seeds. The diagram's last result stays as it is until the next solve.
 * Errors: LOCUS_E_ARGUMENT (a seed outside the grid, on an impassable voxel, with an id that is taken or a bad starting
 * distance: the text names it), LOCUS_E_RANGE (more seeds than the graph's label bits hold, or a starting distance
 * beyond the words), LOCUS_E_MEMORY; none of the seeds is added then. Two seeds may share a voxel. Since 0.1. */
LOCUS_API locus_status locus_diagram_add_seeds(locus_diagram *diagram, const locus_seed *seeds,
                                               size_t count) LOCUS_NOEXCEPT;

/* Remove the seeds with these ids. Errors: LOCUS_E_ARGUMENT (an id that is not there; nothing is removed). Since 0.1.
 */
LOCUS_API locus_status locus_diagram_remove_seeds(locus_diagram *diagram, const uint32_t *ids,
                                                  size_t count) LOCUS_NOEXCEPT;

/* Move the seed with this id to the voxel (x, y, z); its place in the order of ties stays. Errors as for adding. Since
 * 0.1. */
LOCUS_API locus_status locus_diagram_move_seed(locus_diagram *diagram, uint32_t id, uint64_t x, uint64_t y,
                                               uint64_t z) LOCUS_NOEXCEPT;

/* Copy the seeds, in the order they were added, into `seeds` with room for `capacity`; `*count` is how many there are,
 * also when the capacity is too small (LOCUS_E_CAPACITY) or `seeds` is NULL with capacity 0. Since 0.1. */
LOCUS_API locus_status locus_diagram_get_seeds(const locus_diagram *diagram, locus_seed *seeds, size_t capacity,
                                               size_t *count) LOCUS_NOEXCEPT;

/* Add free seeds by farthest-point sampling (each next one on the voxel farthest from all seeds so far; unreached parts
 * of the object first, lowest voxel index on ties; with no seed yet, the first lies on the voxel farthest from the
 * lowest passable one), then move all free seeds to the centres of their cells (Lloyd: the centroid, then the closest
 * voxel of the cell, lowest index on ties) until none moves or the iterations are spent. `options` may not be NULL.
 * Leaves the diagram unsolved. Errors: LOCUS_E_ARGUMENT (more seeds than passable voxels, ids taken, a seed on a voxel
 * that was made impassable), LOCUS_E_RANGE, LOCUS_E_STATE (no passable voxel), LOCUS_E_MEMORY, LOCUS_E_STOPPED (by the
 * progress callback); the seeds are as before then. Since 0.1. */
LOCUS_API locus_status locus_diagram_place_seeds(locus_diagram *diagram,
                                                 const locus_place_options *options) LOCUS_NOEXCEPT;

/* Compute the diagram anew. `progress` may be NULL.
 * Errors: LOCUS_E_STATE (no seeds), LOCUS_E_ARGUMENT (a seed lies on a voxel that was made impassable), LOCUS_E_RANGE
 * (a distance exceeds what the graph's words hold: the text says which scale or width would do), LOCUS_E_MEMORY,
 * LOCUS_E_STOPPED, LOCUS_E_DEVICE. After LOCUS_E_RANGE, LOCUS_E_STOPPED and whatever a GPU fails at in the middle the
 * diagram is unsolved, after the others it is as before; with a result that options->on_device left on the GPU it is
 * unsolved after LOCUS_E_MEMORY too. Since 0.1. */
LOCUS_API locus_status locus_diagram_solve(locus_diagram *diagram, locus_progress_fn progress,
                                           void *user) LOCUS_NOEXCEPT;

/* Bring the diagram up to date with all that was changed since its latest solve or update: materials, cuts and seeds.
 * The result equals a fresh solve bit for bit. LOCUS_ENGINE_BRICKS looks only at what changes, from the edits outward;
 * the other engines solve anew and compare. Works on an unsolved diagram too, as a solve.
 * `*box` becomes the smallest box around the voxels whose label or distance changed, with extents 0 where there are
 * none, and `*voxels` their number; both may be NULL. Where the CPU goes on for a GPU that failed with the only words
 * from before, that is the whole grid. `progress` may be NULL.
 * Errors and the state they leave as for locus_diagram_solve. Since 0.1. */
LOCUS_API locus_status locus_diagram_update(locus_diagram *diagram, locus_voxel_box *box, uint64_t *voxels,
                                            locus_progress_fn progress, void *user) LOCUS_NOEXCEPT;

/* Read the result for a box of voxels into dense memory, x fastest, with room for `capacity` elements: the nearest
 * seed's id; the distance as float; the exact distance in steps (divide by the graph's scale). `box` NULL means the
 * whole grid. Errors: LOCUS_E_STATE (unsolved), LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_diagram_labels(const locus_diagram *diagram, const locus_voxel_box *box, uint32_t *labels,
                                            size_t capacity) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_diagram_distances(const locus_diagram *diagram, const locus_voxel_box *box,
                                               float *distances, size_t capacity) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_diagram_distances_exact(const locus_diagram *diagram, const locus_voxel_box *box,
                                                     uint64_t *distances, size_t capacity) LOCUS_NOEXCEPT;

/* The same values into memory of the GPU that solved the diagram, for programs that go on there: `labels` is for
 * uint32_t, `distances` for float and for uint64_t, with room for `capacity` elements, all of it memory that the GPU
 * can write to (from cudaMalloc, say), each element at a multiple of its size. Where the diagram has a stream of the
 * caller's, the call puts its work on that stream and does not wait for it; else all is written on return. The result
 * is that of LOCUS_ENGINE_BRICKS, with options->on_device or without. Errors: LOCUS_E_STATE (unsolved, or the GPU
 * failed since), LOCUS_E_UNSUPPORTED (solved on the CPU, or by an engine that leaves nothing on the GPU),
 * LOCUS_E_ARGUMENT (also an address the GPU cannot write to), LOCUS_E_CAPACITY, LOCUS_E_MEMORY, LOCUS_E_DEVICE; the
 * diagram is as before. Beside other readers, which wait for each other. Since 0.1. */
LOCUS_API locus_status locus_diagram_labels_on_device(const locus_diagram *diagram, const locus_voxel_box *box,
                                                      void *labels, size_t capacity) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_diagram_distances_on_device(const locus_diagram *diagram, const locus_voxel_box *box,
                                                         void *distances, size_t capacity) LOCUS_NOEXCEPT;
LOCUS_API locus_status locus_diagram_distances_exact_on_device(const locus_diagram *diagram, const locus_voxel_box *box,
                                                               void *distances, size_t capacity) LOCUS_NOEXCEPT;

/* Copy the shortest path from voxel (x, y, z) to its seed, both ends included, as voxel indices into `voxels` with room
 * for `capacity`; of several shortest paths, at each voxel the neighbour with the lowest index. `*count` is the path's
 * length, 0 for an unreached voxel. Errors: LOCUS_E_STATE (unsolved, or the graph was edited since), LOCUS_E_ARGUMENT,
 * LOCUS_E_CAPACITY. Since 0.1. */
LOCUS_API locus_status locus_diagram_path(const locus_diagram *diagram, uint64_t x, uint64_t y, uint64_t z,
                                          uint64_t *voxels, size_t capacity, size_t *count) LOCUS_NOEXCEPT;

/* Store the number of voxels of each seed's cell, in the order of locus_diagram_get_seeds. Errors: LOCUS_E_STATE
 * (unsolved, or the seeds were changed since), LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY (`*count` says how many there are).
 * Since 0.1. */
LOCUS_API locus_status locus_diagram_cell_sizes(const locus_diagram *diagram, uint64_t *sizes, size_t capacity,
                                                size_t *count) LOCUS_NOEXCEPT;

/* Store the pairs of cells that touch, sorted by (a, b) in the order of the seeds. Errors: LOCUS_E_STATE (unsolved, or
 * the graph was edited since), LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY (`*count` says how many there are). Since 0.1. */
LOCUS_API locus_status locus_diagram_cell_pairs(const locus_diagram *diagram, locus_cell_pair *pairs, size_t capacity,
                                                size_t *count) LOCUS_NOEXCEPT;

/* Store what the latest solve did; set stats->struct_size first. Errors: LOCUS_E_STATE (unsolved), LOCUS_E_ARGUMENT.
 * Since 0.1. */
LOCUS_API locus_status locus_diagram_get_stats(const locus_diagram *diagram, locus_diagram_stats *stats) LOCUS_NOEXCEPT;

/* Copy the active voxels of each iteration of the latest solve (thesis figure 2.10) into `active`, for a diagram made
 * with record_trace and an engine that works in iterations (relax, bucket). `*count` is the number of iterations.
 * Errors: LOCUS_E_STATE (unsolved, or no trace was recorded), LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY. Since 0.1. */
LOCUS_API locus_status locus_diagram_trace(const locus_diagram *diagram, uint64_t *active, size_t capacity,
                                           size_t *count) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
