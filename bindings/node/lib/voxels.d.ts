// The voxel graph, its diagrams and weights.
import type {
  BackendName,
  Disposable,
  EngineName,
  Integers,
  Listening,
  Log,
  MaterialName,
  Member,
  MethodName,
  MetricName,
  NO_SEED,
  Reals,
  SimdName,
  Triple,
  UnsupportedError,
  WeightRuleName,
  WordName,
} from './common.js';

/** A box of voxels: its lowest corner, by default the grid's, and its extent, by default the grid's, both x, y, z. */
export interface VoxelBox {
  origin?: Triple;
  extent?: Triple;
}

export interface GraphOptions {
  /** Voxels in x, y, z. */
  dims: Triple;
  /**
   * A compliance (or stiffness) per voxel, x fastest, as Float32Array; NaN, infinite or negative: impassable. Copied by the library.
   * Without one every voxel is impassable, and `materialRange` or `scale` is needed.
   */
  material?: Reals | null;
  /** A voxel's edge lengths in x, y, z; 1. */
  spacing?: Triple;
  /** 6, 18 or 26; 26. */
  connectivity?: number;
  /** How weights follow from materials; mean compliance. */
  weightRule?: Member<WeightRuleName>;
  /** What the numbers are; compliances. */
  kind?: Member<MaterialName>;
  /** Bits of a word; chosen by itself. */
  word?: Member<WordName>;
  /** p of the mean-stiffness rule; 1. */
  stiffnessExponent?: number;
  /**
   * The weight of the edge between the voxels with the indices u < v, for the rule CALLER. What it throws comes out of the call that
   * needed it, which then has no result. The graph then has one thread.
   */
  weight?: (u: number, v: number, length: number) => number;
  /** Seeds a diagram must be able to hold; 65,535. */
  maxSeeds?: number;
  /** Steps per unit of distance; chosen from the data. */
  scale?: number;
  /** The largest relative rounding error of a weight wanted where the scale is chosen; 1/256. */
  precision?: number;
  /** The smallest and the largest passable value that edits will bring. */
  materialRange?: readonly [number, number];
  /** Most threads a call may use; one per core. */
  threads?: number;
  /** What computes; forcing one that is not there is an `UnsupportedError`. */
  backend?: Member<BackendName>;
  /** The instruction set, likewise. */
  simd?: Member<SimdName>;
  /** Told what was chosen, and warnings. */
  log?: Log;
}

/** What a graph was made of; the C header tells what each number means. */
export interface GraphInfo {
  dims: number[];
  spacing: number[];
  passable: number;
  bytes: number;
  connectivity: number;
  weightRule: number;
  wordBits: number;
  labelBits: number;
  scale: number;
  maxExact: bigint;
  maxDistance: number;
  weightError: number;
  smallestStep: number;
  overflowFree: number;
  threads: number;
  backend: number;
  simd: number;
}

/**
 * A voxel graph: a grid of voxels, each with a compliance or impassable. Arrays of voxels are flat with x fastest: the voxel (x, y, z)
 * has the index `x + nx * (y + ny * z)`.
 */
export class Graph implements Disposable {
  constructor(options: GraphOptions);
  /** Make a graph on another thread. */
  static create(options: GraphOptions): Promise<Graph>;
  /** Voxels in x, y, z. */
  readonly dims: readonly number[];
  /** What it was made of: word width, scale, error bounds, memory. */
  readonly info: GraphInfo;
  /** Replace the materials of a box (nothing: the whole grid) by one value, or by a Float32Array of one each; NaN removes. */
  setBox(box: VoxelBox | null | undefined, values: number | Reals): Promise<void>;
  setBoxSync(box: VoxelBox | null | undefined, values: number | Reals): void;
  /** Replace the materials of voxels given by their indices (BigUint64Array). */
  setVoxels(voxels: Integers, values: Reals): void;
  /** Read the materials of a box, NaN where impassable, into `out` or a new array. */
  getBox(box?: VoxelBox | null, out?: Float32Array): Float32Array;
  /** The weight, in steps, of the edge between two voxels given by their indices; 0: there is none. */
  edgeWeight(u: number | bigint, v: number | bigint): bigint;
  /** Disable every edge that a plane separates, in units of the spacing; returns how many were whole before. */
  cutPlane(point: Triple, normal: Triple, box?: VoxelBox | null): number;
  /** The same with a mesh: x, y, z of the vertices (Float64Array), and three indices for each triangle (Uint32Array). */
  cutMesh(vertices: Reals, triangles: Integers): Promise<number>;
  cutMeshSync(vertices: Reals, triangles: Integers): number;
  /** Undo the cuts of all edges with an end in the box; returns how many they were. */
  mendBox(box?: VoxelBox | null): number;
  dispose(): void;
  [Symbol.dispose](): void;
}

/** A seed: a place with an id that names it in every result. */
export interface Seed {
  x: number;
  y: number;
  z: number;
  /** What it starts at, in units of distance. */
  distance: number;
  id: number;
  /** 1: `placeSeeds` leaves it where it is. */
  fixed: number;
}

/** A seed to add: at `position` or at x, y, z; ids go on from those there are. */
export type NewSeed = ({ position: Triple } | { x: number; y: number; z: number }) & {
  id?: number;
  distance?: number;
  fixed?: boolean | number;
};

export interface DiagramOptions {
  /** What solves. */
  engine?: Member<EngineName>;
  /** Keep the active voxels per iteration for `trace`. */
  recordTrace?: boolean;
  /** Voxels farther than this stay unreached. */
  maxDistance?: number;
  /** A grain's voxels in x, y, z, each 1 to 1024, for the compact engine of the CUDA backend; 8, 4, 4. */
  grain?: Triple;
  /** The address of the cudaStream_t that the CUDA backend puts all work on; it must outlive the diagram. A stream of its own. */
  stream?: bigint;
  /** The CUDA backend leaves results in the GPU's memory until something reads them. */
  onDevice?: boolean;
}

export interface PlaceOptions extends Listening {
  /** Seeds to add; 0 only moves those there are. */
  count?: number;
  /** The id of the first added seed; one more than the largest there is. */
  firstId?: number;
  /** Most rounds of Lloyd. */
  lloydIterations?: number;
  /** Distances of the graph, or those of the uniform grid. */
  metric?: Member<MetricName>;
}

/** What the latest solve did; the C header tells what each number means. */
export interface DiagramStats {
  reached: number;
  seeds: number;
  relaxations: number;
  iterations: number;
  maxExact: bigint;
  maxDistance: number;
  secondsImport: number;
  secondsSolve: number;
  secondsExport: number;
  bytes: number;
  engine: number;
  threads: number;
  backend: number;
}

/** What an update changed. */
export interface Change {
  /** The smallest box around it, with extents 0 where nothing changed. */
  box: { origin: number[]; extent: number[] };
  /** How many voxels. */
  voxels: number;
}

/** Two cells that touch: their seeds' ids, and the number of graph edges between them. */
export interface CellPair {
  a: number;
  b: number;
  edges: number;
}

/** The Voronoi diagram of a graph: every voxel's nearest seed and its distance. */
export class Diagram implements Disposable {
  constructor(graph: Graph, options?: DiagramOptions);
  readonly graph: Graph;
  addSeeds(seeds: Iterable<NewSeed>): void;
  /** Remove the seeds with these ids. */
  removeSeeds(ids: number | Integers): void;
  moveSeed(id: number, position: Triple): void;
  /** The seeds in the order they were added. */
  readonly seeds: Seed[];
  /** Add seeds by farthest-point sampling, then move all free ones to the centres of their cells (Lloyd). */
  placeSeeds(options?: PlaceOptions): Promise<void>;
  placeSeedsSync(options?: PlaceOptions): void;
  /** Compute the diagram anew; returns the diagram itself. */
  solve(listening?: Listening): Promise<this>;
  solveSync(listening?: Listening): this;
  /** Bring the diagram up to date with all that was changed since, recomputing only what has to be. */
  update(listening?: Listening): Promise<Change>;
  updateSync(listening?: Listening): Change;
  /** The nearest seed's id per voxel of the box, `NO_SEED` where none reaches. */
  labels(box?: VoxelBox | null, out?: Uint32Array): Uint32Array;
  /** The distance to it, infinite where none reaches. */
  distances(box?: VoxelBox | null, out?: Float32Array): Float32Array;
  /** The distance in steps, to be divided by `graph.info.scale`. */
  distancesExact(box?: VoxelBox | null, out?: BigUint64Array): BigUint64Array;
  /** The shortest path from a voxel to its seed as [x, y, z], both ends included; empty where no seed reaches. */
  path(position: Triple): [number, number, number][];
  /** The number of voxels of each seed's cell, in the order of `seeds`. */
  readonly cellSizes: number[];
  /** The pairs of cells that touch. */
  readonly cellPairs: CellPair[];
  /** The active voxels of each iteration of the latest solve; needs `recordTrace` and an engine that iterates. */
  readonly trace: number[];
  readonly stats: DiagramStats;
  dispose(): void;
  [Symbol.dispose](): void;
}

export interface WeightsOptions extends Listening {
  /** Sibson, Laplace or distance ratio. */
  method?: Member<MethodName>;
  /** The voxels that get rows, in the order of the box; the whole grid. */
  box?: VoxelBox | null;
  /** Their indices (BigUint64Array) instead of a box. */
  voxels?: Integers;
  /** Keep only so many largest weights of a row; 0 keeps all. */
  maxPerRow?: number;
  /** Most scratch memory. */
  batchBytes?: number;
}

/** Rows from `first` on, by default all. */
export interface RowSpan {
  first?: number;
  count?: number;
}

/** Rows of weights: row i has the entries `offsets[i]` to `offsets[i + 1]` (not included), by falling weight. */
export interface Rows {
  offsets: number[];
  ids: Uint32Array;
  values: Float32Array;
}

/** The interpolation weights of the voxels of a box, or of a list of voxels, from a solved diagram. */
export class Weights implements Disposable {
  /** A `progress` that is given here is called by `updateSync` too, and makes `update` an `UnsupportedError`. */
  constructor(diagram: Diagram, options?: Omit<WeightsOptions, 'signal'>);
  /** Make weights on another thread. */
  static create(diagram: Diagram, options?: WeightsOptions): Promise<Weights>;
  readonly diagram: Diagram;
  /** The number of rows. */
  readonly length: number;
  /** The number of entries in all rows. */
  readonly entries: number;
  /** The ids of the seeds the weights were made of, in their order. */
  readonly seedIds: number[];
  rows(span?: RowSpan): Rows;
  /** Rows as a dense array, row by row: the weight of each of the ids (by default all seeds). */
  dense(ids?: Integers, options?: RowSpan & { out?: Float32Array }): Float32Array;
  /**
   * Interpolate values given at the seeds, a Float32Array of `components` (1) for each, in the order of `seedIds`; an empty row gives
   * NaN.
   */
  interpolate(values: Reals, options?: RowSpan & { components?: number; out?: Float32Array }): Promise<Float32Array>;
  interpolateSync(values: Reals, options?: RowSpan & { components?: number; out?: Float32Array }): Float32Array;
  /** The gradient d/dx, d/dy, d/dz of one seed's weight at each row; needs weights of a box. */
  gradients(id: number, options?: RowSpan & { out?: Float32Array }): Float32Array;
  /**
   * Follow the diagram after it was solved or updated again; the numbers of the rows recomputed, rising. Weights of `create` report
   * progress here and can be cancelled.
   */
  update(listening?: Listening): Promise<number[]>;
  updateSync(): number[];
  dispose(): void;
  [Symbol.dispose](): void;
}
