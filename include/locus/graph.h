/* locus/graph.h - the voxel graph: a grid of voxels, each with a compliance or impassable.
 *
 * Two passable voxels that share a face (connectivity 6), a face or an edge (18), or a face, an edge or a corner (26)
 * are joined by an edge whose weight follows one rule from the voxels' compliances and the edge's length. Weights are
 * kept as integers (fixed point, `scale` steps per unit of distance), and a voxel's distance and label share one word
 * of 32 or 64 bits; so a Voronoi diagram is the same, bit for bit, from every engine, thread count and backend. Method:
 * thesis sections 2.2.4 and 2.4; Faure et al., Sparse Meshless Models of Complex Deformable Solids, 2011. */
#ifndef LOCUS_GRAPH_H
#define LOCUS_GRAPH_H

#include <locus/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct locus_graph locus_graph;

/* The weight of an edge of length len (Euclidean, by spacing) between the voxels u and v; c is the compliance, k = 1/c.
 */
#define LOCUS_WEIGHT_MEAN_COMPLIANCE 0 /* len * (c_u + c_v) / 2: the thesis, Faure et al. 2011; the default */
#define LOCUS_WEIGHT_MAX_COMPLIANCE 1  /* len * max(c_u, c_v): SOFA's Dijkstra */
#define LOCUS_WEIGHT_MEAN_STIFFNESS 2  /* len / ((k_u + k_v) / 2)^p: SOFA's first frame plugin */
#define LOCUS_WEIGHT_UNIFORM 3         /* len */
#define LOCUS_WEIGHT_CALLER 4          /* the caller's function; CPU only */

/* What the numbers of the volume are. NaN, an infinite or negative compliance, and a NaN, negative or zero stiffness
 * are impassable (so is a stiffness too small to be a normal float); a compliance of 0 (an infinite stiffness) is the
 * smallest step, never a free one. */
#define LOCUS_MATERIAL_COMPLIANCE 0 /* distance per length: mm of distance per mm, 1/Pa, ... */
#define LOCUS_MATERIAL_STIFFNESS 1  /* its inverse: Young's modulus in Pa, ... */

/* Packed words: distance in the high bits, label in the low ones. */
#define LOCUS_WORD_AUTO 0 /* 32 bits where no path can overflow them at the precision asked for, else 64 */
#define LOCUS_WORD_32 32
#define LOCUS_WORD_64 64

/* Where diagrams and Sibson's weights are computed; the results are the same, bit for bit. The CUDA backend is
 * liblocus_cuda.so, of the same build as this library, found as the loader finds libraries or beside it; it needs an
 * NVIDIA driver and a GPU of compute capability 8.0 or higher, takes the calling thread's CUDA device, and has every
 * rule but LOCUS_WEIGHT_CALLER. AUTO: CUDA where all that is there and the grid has 65,536 voxels or more, else the
 * CPU; and when the GPU fails or has no memory left, the CPU goes on. CUDA, asked for and not there, is
 * LOCUS_E_UNSUPPORTED with the reason; where the GPU fails later, that call returns LOCUS_E_DEVICE or LOCUS_E_MEMORY,
 * and the next one begins anew. */
#define LOCUS_BACKEND_AUTO 0
#define LOCUS_BACKEND_CPU 1
#define LOCUS_BACKEND_CUDA 2

/* The instruction set of the SIMD code. Forcing one the machine or the build lacks is LOCUS_E_UNSUPPORTED. */
#define LOCUS_SIMD_AUTO 0
#define LOCUS_SIMD_SCALAR 1
#define LOCUS_SIMD_SSE4 2
#define LOCUS_SIMD_AVX2 3
#define LOCUS_SIMD_AVX512 4
#define LOCUS_SIMD_NEON 5

/* The weight of the edge between the neighbouring voxels `u` and `v` (indices x + nx * (y + ny * z)), `length` long:
 * finite and >= 0, and always the same for the same pair; a negative, NaN or infinite value means that there is no such
 * edge. Called with u < v, so that both directions weigh the same, and for passable voxels only; by the thread that
 * solves, or by several at once where the graph has several threads, and while the graph is made where material_min and
 * material_max are not given. Must not throw, longjmp or call into the graph or its diagrams. */
typedef double (*locus_weight_fn)(uint64_t u, uint64_t v, double length, void *user);

typedef struct locus_graph_options {
    uint64_t struct_size;      /* sizeof(locus_graph_options), set by _init */
    uint64_t dims[3];          /* voxels in x, y, z, each >= 1, their product < 2^40; default 0: must be set */
    double spacing[3];         /* a voxel's edge lengths in x, y, z, finite and > 0; default 1 */
    uint32_t connectivity;     /* 6, 18 or 26; default 26 */
    uint32_t weight_rule;      /* LOCUS_WEIGHT_; default LOCUS_WEIGHT_MEAN_COMPLIANCE */
    uint32_t material;         /* LOCUS_MATERIAL_; default LOCUS_MATERIAL_COMPLIANCE */
    uint32_t word_bits;        /* LOCUS_WORD_; default LOCUS_WORD_AUTO */
    double stiffness_exponent; /* p of LOCUS_WEIGHT_MEAN_STIFFNESS, in (0, 8]; default 1 */
    locus_weight_fn weight;    /* for LOCUS_WEIGHT_CALLER; default NULL */
    void *weight_user;
    uint64_t max_seeds;  /* seeds a diagram must be able to hold, 1..2^24: decides the label bits; default 65,535
                            (256 with LOCUS_WORD_32 when left at the default) */
    double scale;        /* steps per unit of distance, > 0; default 0: chosen from the data */
    double precision;    /* when the scale is chosen: largest relative rounding error wanted in any edge weight,
                            in (0, 0.5]; default 1/256 */
    double material_min; /* the smallest and the largest passable value the graph must be able to take later, */
    double material_max; /* beside those of the data given now; default NaN: only those of the data. For
                            LOCUS_WEIGHT_CALLER: the range of the function's weight divided by the length; a
                            larger one met by a solve is LOCUS_E_RANGE */
    uint32_t threads;    /* most threads a call may use; default 0: one per core */
    uint32_t backend;    /* LOCUS_BACKEND_; default LOCUS_BACKEND_AUTO */
    uint32_t simd;       /* LOCUS_SIMD_; default LOCUS_SIMD_AUTO */
    uint32_t reserved0;  /* 0 */
    locus_log_fn log;    /* default NULL: no log */
    void *log_user;
} locus_graph_options;

/* What a graph was made of. */
typedef struct locus_graph_info {
    uint64_t struct_size;
    uint64_t dims[3];
    double spacing[3];
    uint64_t passable; /* passable voxels */
    uint64_t bytes;    /* memory held by the graph */
    uint32_t connectivity;
    uint32_t weight_rule;
    uint32_t word_bits;     /* 32 or 64 */
    uint32_t label_bits;    /* of them for the label */
    double scale;           /* steps per unit of distance: distance = exact distance / scale */
    uint64_t max_exact;     /* the largest exact distance (in steps) that a word can hold */
    double max_distance;    /* the same in units of distance */
    double weight_error;    /* bound of the relative rounding error of an edge weight, over the range of materials */
    double smallest_step;   /* the smallest edge weight, in units of distance */
    uint32_t overflow_free; /* 1: no shortest path of the graph as it is now can exceed max_exact (from seeds that start
                               at 0); 0: a solve may find that one does and return LOCUS_E_RANGE */
    uint32_t threads;       /* threads a call may use */
    uint32_t backend;       /* the backend chosen */
    uint32_t simd;          /* the instruction set chosen */
} locus_graph_info;

/* A box of voxels: origin (x, y, z) and extent in voxels; it must lie inside the grid. */
typedef struct locus_voxel_box {
    uint64_t origin[3];
    uint64_t extent[3];
} locus_voxel_box;

/* Fill `options` (of `size` bytes: pass sizeof *options) with the defaults stated at the fields.
 * Errors: LOCUS_E_ARGUMENT for NULL or a size smaller than the first release's. Any thread. Since 0.1. */
LOCUS_API locus_status locus_graph_options_init(locus_graph_options *options, size_t size) LOCUS_NOEXCEPT;

/* Make a graph. `material` holds dims[0]*dims[1]*dims[2] values, x fastest, and is copied; NULL makes every voxel
 * impassable, to be filled box by box with locus_graph_set_box, and needs material_min and material_max (or a scale).
 * Word width, scale and label bits are fixed here, and locus_graph_get_info reports them: label bits for max_seeds;
 * LOCUS_WORD_AUTO takes 32 bits where no path can overflow them at the precision asked for, else 64; the scale is the
 * largest at which no path can overflow, where that meets the precision (a path visits each voxel at most once, at the
 * largest material declared or, with none declared, at its own), else the smallest that meets the precision.
 * A chosen scale is a power of two where one fits.
 * `*graph` is the caller's, to be ended with locus_graph_destroy; NULL on any error.
 * Errors: LOCUS_E_ARGUMENT (an option out of its range), LOCUS_E_RANGE (the materials cannot be represented in the
 * words asked for), LOCUS_E_UNSUPPORTED (a forced backend or instruction set is not there), LOCUS_E_MEMORY. Any thread.
 * Since 0.1. */
LOCUS_API locus_status locus_graph_create(const locus_graph_options *options, const float *material,
                                          locus_graph **graph) LOCUS_NOEXCEPT;

/* End a graph. Diagrams made from it stay usable. NULL is fine. No call may be running on it. Since 0.1. */
LOCUS_API void locus_graph_destroy(locus_graph *graph) LOCUS_NOEXCEPT;

/* Store what the graph was made of in `*info`; set info->struct_size to sizeof *info before the call.
 * Errors: LOCUS_E_ARGUMENT. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_graph_get_info(const locus_graph *graph, locus_graph_info *info) LOCUS_NOEXCEPT;

/* Replace the materials of a box. `values` holds extent[0]*extent[1]*extent[2] numbers of the graph's kind (compliance
 * or stiffness), x fastest, dense. Diagrams of the graph keep their last result until they are solved or updated again.
 * Errors: LOCUS_E_ARGUMENT (a box outside the grid), LOCUS_E_RANGE (a value so large that its weights do not fit the
 * words, or so small that their rounding error exceeds the precision and that of the materials so far; nothing is
 * changed), LOCUS_E_MEMORY. Not beside any other call on the graph or its diagrams. Since 0.1. */
LOCUS_API locus_status locus_graph_set_box(locus_graph *graph, const locus_voxel_box *box,
                                           const float *values) LOCUS_NOEXCEPT;

/* The same with one value for the box: NaN removes (a cut), a number fills. Errors and threads as above. Since 0.1. */
LOCUS_API locus_status locus_graph_fill_box(locus_graph *graph, const locus_voxel_box *box, float value) LOCUS_NOEXCEPT;

/* Replace the materials of `count` voxels given by their indices x + nx * (y + ny * z); `values` holds as many numbers.
 * A voxel named twice takes the later value. Errors and threads as locus_graph_set_box; an index outside the grid is
 * LOCUS_E_ARGUMENT and nothing is changed. Since 0.1. */
LOCUS_API locus_status locus_graph_set_voxels(locus_graph *graph, const uint64_t *voxels, const float *values,
                                              size_t count) LOCUS_NOEXCEPT;

/* Read the materials of a box (NULL: the whole grid) back into `values`, which has room for `capacity` numbers: the
 * values given, NaN where impassable. Errors: LOCUS_E_ARGUMENT, LOCUS_E_CAPACITY. Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_graph_get_box(const locus_graph *graph, const locus_voxel_box *box, float *values,
                                           size_t capacity) LOCUS_NOEXCEPT;

/* Store in `*steps` the integer weight of the edge between the voxels with indices `u` and `v`, and 0 where there is no
 * such edge (not neighbours, an end impassable, or cut). Errors: LOCUS_E_ARGUMENT (an index outside the grid).
 * Beside other readers. Since 0.1. */
LOCUS_API locus_status locus_graph_edge_weight(const locus_graph *graph, uint64_t u, uint64_t v,
                                               uint64_t *steps) LOCUS_NOEXCEPT;

/* Cut along a surface: disable every edge between two voxels that the surface separates. The voxels stay, and so do
 * their materials; weights and distances no longer pass there. Positions are in units of the spacing: the centre of
 * voxel (x, y, z) lies at (x * spacing[0], y * spacing[1], z * spacing[2]). A centre exactly on the surface counts as
 * lying on the side of the normal, for a triangle the normal whose first non-zero component is positive. Cuts add up,
 * and stay when materials change. Diagrams of the graph keep their last result until they are solved or updated again.
 * `edges`, which may be NULL, receives how many edges were whole before. The first cut takes 2 bytes for each voxel of
 * the grid.
 *
 * A plane through `point` with the normal `normal` (any length above 0), for the edges with both ends in `box` (NULL:
 * the whole grid). Errors: LOCUS_E_ARGUMENT (a number that is not finite, a normal of length 0, a box outside the
 * grid), LOCUS_E_MEMORY; the graph is unchanged then. Not beside any other call on the graph or its diagrams. Since
 * 0.1. */
LOCUS_API locus_status locus_graph_cut_plane(locus_graph *graph, const double point[3], const double normal[3],
                                             const locus_voxel_box *box, uint64_t *edges) LOCUS_NOEXCEPT;

/* The same along a mesh of `triangle_count` triangles, each three indices into the `vertex_count` vertices of three
 * coordinates each. Triangles without area are left out; parts outside the grid do nothing. A mesh without gaps cuts
 * without gaps. Errors (an index beyond the vertices, a coordinate that is not finite) and threads as above. Since 0.1.
 */
LOCUS_API locus_status locus_graph_cut_mesh(locus_graph *graph, const double *vertices, size_t vertex_count,
                                            const uint32_t *triangles, size_t triangle_count,
                                            uint64_t *edges) LOCUS_NOEXCEPT;

/* Undo the cuts of all edges with at least one end in `box` (NULL: the whole grid); `edges`, which may be NULL,
 * receives how many they were. Errors: LOCUS_E_ARGUMENT, LOCUS_E_MEMORY. Threads as above. Since 0.1. */
LOCUS_API locus_status locus_graph_mend_box(locus_graph *graph, const locus_voxel_box *box,
                                            uint64_t *edges) LOCUS_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
