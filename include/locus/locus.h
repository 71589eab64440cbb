/* locus/locus.h - everything of Locus but the file formats (locus/volume.h, locus/records.h).
 *
 * Locus keeps data that changes all the time close in memory. It holds two engines:
 * - the voxel graph (locus/graph.h, locus/diagram.h, locus/weights.h): compliance distances, Voronoi diagrams and
 *   interpolation weights on 3-D material maps;
 * - the PMQ (locus/pmq.h): the live window of a stream of geo-located records, sorted along the Z-curve; what stands
 * out in it (locus/alerts.h); and how it is kept on disk (locus/storage.h).
 *
 * Rules that hold everywhere:
 * - Errors: see locus/status.h. No exception, abort, exit or print ever leaves the library.
 * - Handles are incomplete structs with one owner: `_create` makes one, `_destroy` ends it and takes NULL. A child,
 * such as a diagram of a graph, keeps what it needs of its parent alive.
 * - Options are structs that begin with their size. Fill one with its `_options_init` function, change what you want,
 *   pass it. Options only grow at the end: a client built against an older header goes on working with a newer library.
 * - Threads: calls on different handles may run at once. On one handle, calls that take it as `const` may run beside
 * each other, and no other call may run beside any; where a header promises more, it says so.
 * - Callbacks get the `user` pointer given with them, and are never called under a lock.
 * - Volumes are dense arrays, x fastest: the voxel (x, y, z) has the index x + nx * (y + ny * z).
 * - Latitudes and longitudes are degrees (WGS84), times are microseconds since 1970-01-01 UTC, lengths on the Earth are
 *   metres, sizes are bytes. */
#ifndef LOCUS_LOCUS_H
#define LOCUS_LOCUS_H

#include <locus/alerts.h>
#include <locus/diagram.h>
#include <locus/graph.h>
#include <locus/pmq.h>
#include <locus/status.h>
#include <locus/storage.h>
#include <locus/weights.h>

#endif
