// Records, stores, snapshots and alerts.
import type { Cold } from './cold.js';
import type {
  AlertKind,
  BusyError,
  Disposable,
  FieldName,
  FutureName,
  IndexName,
  LayoutName,
  Listening,
  Log,
  Member,
  Path,
  RecordName,
  Span,
  StaleError,
  Sync,
  SyncName,
  Time,
  version,
} from './common.js';

/** A record of 32 bytes. The time is in microseconds since 1970. */
export interface Point32 {
  latitude: number;
  longitude: number;
  time: number;
  device: number;
  application: number;
  language: number;
  /** Yours. */
  spare: number;
}

/** A record of 156 bytes with a text of at most 140 bytes of UTF-8. */
export interface Text156 {
  latitude: number;
  longitude: number;
  time: number;
  text: string;
}

/** Fields to write: what is left out stays, or is 0; a time may be a bigint or a Date. */
export type Fields<Value> = { [Name in keyof Value]?: Name extends 'time' ? Time : Value[Name] };

/** A record where it lies: reading and writing its fields reads and writes the array. */
export type View<Value> = Value & {
  /** The fields as a plain object. */
  toJSON(): Value;
};

/** Records side by side in an ArrayBuffer, as the library reads and writes them. */
export interface RecordArray<Value> extends Iterable<View<Value>> {
  readonly length: number;
  /** The memory of the records, and no more. */
  readonly bytes: Uint8Array;
  readonly buffer: ArrayBufferLike;
  readonly byteOffset: number;
  readonly byteLength: number;
  /** The record at an index; a negative one counts from the end. */
  at(index: number): View<Value>;
  set(index: number, record: Fields<Value>): void;
  /** A field of all records. */
  column<Name extends keyof Value>(name: Name): Value[Name][];
  /** The records `from` to `to` (not included), in the same memory. */
  subarray(from?: number, to?: number): this;
  /** The same as a copy. */
  slice(from?: number, to?: number): this;
}

export interface RecordArrayConstructor<Value, Made> {
  /** So many records, all zero. */
  new (length: number): Made;
  /** Those that lie in memory from an offset on. */
  new (buffer: ArrayBufferLike, byteOffset?: number, length?: number): Made;
  new (records: Iterable<Fields<Value>>): Made;
  readonly BYTES_PER_ELEMENT: number;
}

export interface Point32Array extends RecordArray<Point32> {}
/** Arrays of records of 32 bytes. */
export const Point32Array: RecordArrayConstructor<Point32, Point32Array>;
export interface Text156Array extends RecordArray<Text156> {}
/** Arrays of records of 156 bytes. */
export const Text156Array: RecordArrayConstructor<Text156, Text156Array>;

/** Latitude and longitude in degrees. */
export type Place = readonly [number, number] | { latitude: number; longitude: number };

/** What to ask for: everything, until it is narrowed; at most one of box, circle and polygon. */
export interface Query<Value = Point32> {
  /** Degrees, borders included; west > east crosses the antimeridian. */
  box?: readonly [south: number, west: number, north: number, east: number] | { south: number; west: number; north: number; east: number };
  /** The places within `radius` metres along the great circle. */
  circle?: readonly [latitude: number, longitude: number, radius: number] | { latitude: number; longitude: number; radius: number };
  /** Rings of places; the even-odd rule makes a ring within another a hole. */
  polygon?: Iterable<Iterable<Place>>;
  /** The first and the last time, both included. */
  since?: Time;
  until?: Time;
  /** Records that have expired and have not left the store yet, too; not for `erase`. */
  expired?: boolean;
  /** True: records need not come in the store's order, which is quicker. */
  anyOrder?: boolean;
}

/** A query of a Sync call, which may ask a function too. The record that it is shown is valid during the call only. */
export interface FilteredQuery<Value = Point32> extends Query<Value> {
  filter?: (record: View<Value>) => unknown;
}

/** A tile of the Web-Mercator square, x from the west, y from the north, and its 2^log2Bins (256) bins a side. */
export interface Tile<Q, Bins> {
  zoom: number;
  x: number;
  y: number;
  log2Bins?: number;
  query?: Q;
  out?: Bins;
}

/** What makes a record good: near to a place, and young. */
export interface Score<Q> {
  latitude: number;
  longitude: number;
  /** R in metres; 30,000. */
  radius?: number;
  /** The weight of the distance, 0 to 1; 0.2. */
  alpha?: number;
  /** T; 10,000 seconds. */
  period?: Span;
  query?: Q;
}

/** Records, best first, and what they scored, or how far they are in metres. */
export interface Ranked<Made> {
  records: Made;
  values: Float64Array;
}

/** How often a value occurs, and the newest time among those records. */
export interface Group {
  value: number;
  count: number;
  newest: number;
}

export type ArrayOf<Value> = Value extends Text156 ? Text156Array : Point32Array;

/** The questions to a store or a snapshot; each is answered from one moment, beside the writer too. */
export interface Questions<Value> {
  /** The class of the records' arrays. */
  readonly Records: RecordArrayConstructor<Value, ArrayOf<Value>>;
  /** How many live records the query selects. */
  count(query?: Query<Value>): Promise<number>;
  countSync(query?: FilteredQuery<Value>): number;
  /** Copy the live records that the query selects, in the store's order, into `out` or new memory. */
  read(query?: Query<Value>, out?: ArrayOf<Value>): Promise<ArrayOf<Value>>;
  readSync(query?: FilteredQuery<Value>, out?: ArrayOf<Value>): ArrayOf<Value>;
  /** Show the same records one by one, each valid during the call only, until `visitor` returns false. True: all were shown. */
  visitSync(visitor: (record: View<Value>) => unknown, query?: FilteredQuery<Value>): boolean;
  /** Read the same records page by page; while the store changes, no record is shown twice. */
  pages(options?: { size?: number; query?: Query<Value> }): AsyncGenerator<ArrayOf<Value>, void>;
  pagesSync(options?: { size?: number; query?: FilteredQuery<Value> }): Generator<ArrayOf<Value>, void>;
  /** Count the records by a field, or by what a function says of each; the largest group first. */
  groups(field: Member<FieldName>, query?: Query<Value>): Promise<Group[]>;
  groupsSync(field: Member<FieldName> | ((record: View<Value>) => number | bigint), query?: FilteredQuery<Value>): Group[];
  /** Count the live records per bin of a tile, row by row from the north-west. */
  tile(tile: Tile<Query<Value>, Uint32Array>): Promise<Uint32Array>;
  tileSync(tile: Tile<FilteredQuery<Value>, Uint32Array>): Uint32Array;
  /** The same with each record counted as `weight(record)`, a finite number. */
  weightedTileSync(weight: (record: View<Value>) => number, tile: Tile<FilteredQuery<Value>, Float64Array>): Float64Array;
  /** The k records with the lowest scores `alpha * distance / radius + (1 - alpha) * age / period`, lowest first. */
  topk(k: number, score: Score<Query<Value>>): Promise<Ranked<ArrayOf<Value>>>;
  topkSync(k: number, score: Score<FilteredQuery<Value>>): Ranked<ArrayOf<Value>>;
  /** The k records nearest to a place. */
  nearest(k: number, place: { latitude: number; longitude: number; query?: Query<Value> }): Promise<Ranked<ArrayOf<Value>>>;
  nearestSync(k: number, place: { latitude: number; longitude: number; query?: FilteredQuery<Value> }): Ranked<ArrayOf<Value>>;
  /** Save the records as a file, which replaces an older one whole or not at all. */
  save(path: Path, listening?: Listening): Promise<void>;
  saveSync(path: Path, listening?: Listening): void;
}

export interface StoreOptions<Value = Point32> {
  /** The layout of the records; Point32. */
  record?: Member<RecordName>;
  /** How long a record lives. */
  horizon?: Span;
  /** Limits; beyond, the oldest records go. */
  maxRecords?: number;
  maxBytes?: number;
  layout?: Member<LayoutName>;
  /** Of the packed array. */
  index?: Member<IndexName>;
  /** Whether times after the clock are refused or clamped. */
  future?: Member<FutureName>;
  /** May this record go? It is valid during the call only. */
  remove?: (record: View<Value>) => unknown;
  /** Takes over the records that left. Where it throws, the array is handed over again with the next change. */
  sink?: (records: ArrayOf<Value>) => void;
  /** Takes over, instead of a sink, the records that left; for one store at a time. */
  cold?: Cold<Value>;
  log?: Log;
  /** As in locus_pmq_options. */
  segmentSlots?: number;
  rhoLeaf?: number;
  tauLeaf?: number;
  rhoRoot?: number;
  tauRoot?: number;
  snapshotBytes?: number;
}

/** How a store's folder is kept, as in locus_pmq_log_options. */
export interface LogOptions extends Listening {
  sync?: Member<SyncName>;
  /** Hand what left since the last save to the sink again; true. */
  redeliver?: boolean;
  syncInterval?: Span;
  syncBytes?: number;
  keep?: number;
  repair?: boolean;
}

export interface PmqStats {
  records: number;
  stored: number;
  pending: number;
  slots: number;
  bytes: number;
  inserted: number;
  evicted: number;
  erased: number;
  batches: number;
  moved: number;
  rebalances: number;
  grows: number;
  shrinks: number;
  longestPauseNs: number;
  density: number;
  now: number;
}

export interface PmqLogStats {
  number: number;
  bytes: number;
  unsynced: number;
  changes: number;
  syncs: number;
  attached: number;
  stopped: number;
}

/** What `open` found. */
export interface PmqRecovery {
  created: number;
  skipped: number;
  number: number;
  saved: number;
  changes: number;
  inserted: number;
  departed: number;
  records: number;
  cut: number;
  now: number;
}

export interface PmqFileInfo {
  version: number;
  record: number;
  records: number;
  bytes: number;
  now: number;
}

/** One moment of a store, for several questions. A stale one is a `StaleError`. */
export class Snapshot<Value = Point32> implements Disposable {
  constructor(store: Store<Value>);
  dispose(): void;
  [Symbol.dispose](): void;
}
export interface Snapshot<Value = Point32> extends Questions<Value> {}

/**
 * The live window of a stream. One call at a time changes a store, a second one is a `BusyError`; any number may ask at the same time.
 * A store with functions (`remove`, `sink`, `log`, or those of `Alerts`) is changed by Sync calls only.
 */
export class Store<Value = Point32> implements Disposable {
  constructor(options?: StoreOptions<Value>);
  /** Make a store from a saved file, by default with the file's record layout. */
  static load<Value = Point32>(path: Path, options?: StoreOptions<Value> & Listening): Promise<Store<Value>>;
  static loadSync<Value = Point32>(path: Path, options?: StoreOptions<Value> & Listening): Store<Value>;
  /** Recover the store of a folder, or make a new one, and log every change before it is acknowledged. */
  static open<Value = Point32>(folder: Path, options?: StoreOptions<Value> & LogOptions): Promise<Store<Value>>;
  static openSync<Value = Point32>(folder: Path, options?: StoreOptions<Value> & LogOptions): Store<Value>;
  /** What `open` found; undefined for other stores. */
  readonly recovery: PmqRecovery | undefined;
  /** Insert a batch, in any order, and set the store's clock, which never runs back. The records are read where they lie. */
  insert(records: ArrayOf<Value>, now: Time): Promise<void>;
  insertSync(records: ArrayOf<Value>, now: Time): void;
  /** Set the clock and evict everything that may go; how many records left. */
  sweep(now: Time): Promise<number>;
  sweepSync(now: Time): number;
  /** Remove the live records that the query selects and hand them to the sink; how many they were. */
  erase(query?: Query<Value>): Promise<number>;
  eraseSync(query?: FilteredQuery<Value>): number;
  /** Keep the present moment for several questions. */
  snapshot(): Snapshot<Value>;
  /** Give a store that has no log a folder that has no store. */
  attach(folder: Path, options?: LogOptions): Promise<void>;
  attachSync(folder: Path, options?: LogOptions): void;
  /** Save the present moment into the store's folder and begin a new log. */
  checkpoint(listening?: Listening): Promise<void>;
  checkpointSync(listening?: Listening): void;
  /** Flush the log to the disk. */
  flush(): Promise<void>;
  flushSync(): void;
  /** Verify every invariant of the store. */
  check(): Promise<void>;
  checkSync(): void;
  /** Counts, memory, density, the longest pause. */
  readonly stats: PmqStats;
  /** The log's figures; zeros without one. */
  readonly logStats: PmqLogStats;
  dispose(): void;
  [Symbol.dispose](): void;
}
export interface Store<Value = Point32> extends Questions<Value> {}

/** What a saved file says of itself. */
export function fileInfo(path: Path): PmqFileInfo;
/** The key of a place: the Morton code of its Web-Mercator tile at zoom 25. */
export function pmqKey(latitude: number, longitude: number): number;

/** A region that stands out: its number, kind (of `AlertKind`), tile, box, time, and the numbers that made it one. */
export interface Alert {
  number: number;
  kind: number;
  zoom: number;
  x: number;
  y: number;
  box: { south: number; west: number; north: number; east: number };
  time: number;
  records: number;
  rate: number;
  expected: number;
  share: number;
}

export interface AlertsOptions<Value = Point32> {
  /** Told, once, of a region that stands out; returning false stops. */
  alert?: (region: Alert) => unknown;
  /** Shown each record that arrives inside a fence; returning false stops. */
  fence?: (id: number, record: View<Value>) => unknown;
  /** The coarsest and the finest regions reported. */
  zoomFrom?: number;
  zoomTo?: number;
  /** The half lives of the present and of the history, and how long a region then stays silent. */
  halfLife?: Span;
  history?: Span;
  coolDown?: Span;
  /** When a region stands out, as in locus_alerts_options. */
  minimum?: number;
  factor?: number;
  rate?: number;
  share?: number;
  /** Most memory. */
  maxBytes?: number;
}

export interface AlertsStats {
  regions: number;
  fences: number;
  raised: number;
  shown: number;
  bytes: number;
}

/**
 * Watches what is inserted into a store, from now on until it is disposed of. The functions are called within `insertSync`, after the
 * batch is stored; what they throw comes out of it. They may ask the store, add and remove fences, and dispose of this object.
 */
export class Alerts<Value = Point32> implements Disposable {
  constructor(store: Store<Value>, options?: AlertsOptions<Value>);
  readonly store: Store<Value>;
  /** The active alerts, the latest first. */
  active(): Alert[];
  /** Add a fence under an id of yours: the records that the query selects. */
  addFence(id: number | bigint, query: FilteredQuery<Value>): void;
  removeFence(id: number | bigint): void;
  readonly stats: AlertsStats;
  dispose(): void;
  [Symbol.dispose](): void;
}
