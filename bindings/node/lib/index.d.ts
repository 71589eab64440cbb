/**
 * Locus: data that changes all the time, close in memory. Two engines: the voxel graph (`Graph`, `Diagram`, `Weights`), exact compliance
 * distances, Voronoi diagrams and interpolation weights on 3-D volumes; and the PMQ (`Store`, `Snapshot`), the live window of a
 * geo-located stream, with `Cold` for what leaves it. `readVolume`, `writeVolume` and `RecordReader` read and write files.
 *
 * A method that may take long has two forms: `solve()` works on another thread and returns a promise, `solveSync()` works here. Both
 * throw, or reject with, the same errors. JavaScript functions (filters, sinks, weights) are called on the thread they belong to: a call
 * that needs one has its Sync form only, and as a promise is an `UnsupportedError`. Arrays of a call that is at work must not be written
 * to or transferred until its promise is settled.
 */

export * from './common.js';
export * from './voxels.js';
export * from './stream.js';
export * from './cold.js';
export * from './files.js';
