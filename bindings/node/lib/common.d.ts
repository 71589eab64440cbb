// Enumerations, errors and what both engines share.

/** The numbers of an enumeration, by their names. */
export type Enumeration<Names extends string> = Readonly<Record<Names, number>>;
/** A member of an enumeration: its number, or its name in any case. */
export type Member<Names extends string> = number | Lowercase<Names> | Names;

export type AlertKindName = 'JUMP' | 'RATE' | 'SHARE';
export type BackendName = 'AUTO' | 'CPU' | 'CUDA';
export type ColdFullName = 'WAIT' | 'REFUSE';
export type ColdSyncName = 'OFF' | 'NORMAL' | 'FULL';
export type EngineName = 'AUTO' | 'HEAP' | 'BUCKET' | 'RELAX' | 'BRICKS' | 'COMPACT';
export type FieldName = 'DEVICE' | 'APPLICATION' | 'LANGUAGE';
export type FutureName = 'REFUSE' | 'CLAMP';
export type IndexName = 'IMPLICIT' | 'EXPLICIT' | 'HEADS';
export type LayoutName = 'RING_LEAVES' | 'PACKED_ARRAY';
export type LogLevelName = 'DEBUG' | 'INFO' | 'WARNING';
export type MaterialName = 'COMPLIANCE' | 'STIFFNESS';
export type MethodName = 'SIBSON' | 'LAPLACE' | 'DISTANCE_RATIO';
export type MetricName = 'COMPLIANCE' | 'UNIFORM';
export type RecordName = 'POINT32' | 'TEXT156';
export type RecordsFormatName = 'AUTO' | 'CSV' | 'NDJSON';
export type SimdName = 'AUTO' | 'SCALAR' | 'SSE4' | 'AVX2' | 'AVX512' | 'NEON';
export type StatusName =
  | 'OK' | 'ARGUMENT' | 'RANGE' | 'CAPACITY' | 'STATE' | 'UNSUPPORTED' | 'STOPPED' | 'BUSY' | 'STALE' | 'MEMORY' | 'IO' | 'FORMAT'
  | 'DEVICE' | 'INTERNAL';
export type SyncName = 'NONE' | 'BATCH' | 'INTERVAL';
export type TimeUnitName = 'AUTO' | 'SECONDS' | 'MILLISECONDS' | 'MICROSECONDS' | 'NANOSECONDS';
export type VolumeFormatName = 'AUTO' | 'METAIMAGE' | 'NRRD' | 'NIFTI' | 'RAW';
export type VoxelName =
  | 'UINT8' | 'INT8' | 'UINT16' | 'INT16' | 'UINT32' | 'INT32' | 'UINT64' | 'INT64' | 'FLOAT32' | 'FLOAT64';
export type WeightRuleName = 'MEAN_COMPLIANCE' | 'MAX_COMPLIANCE' | 'MEAN_STIFFNESS' | 'UNIFORM' | 'CALLER';
export type WordName = 'AUTO' | 'BITS_32' | 'BITS_64';

/** Why a region is reported. */
export const AlertKind: Enumeration<AlertKindName>;
/** Where diagrams and Sibson's weights are computed. */
export const Backend: Enumeration<BackendName>;
/** What a change of a store does while its cold tier's queue is full. */
export const ColdFull: Enumeration<ColdFullName>;
/** How a cold tier's file is made safe against loss of power. */
export const ColdSync: Enumeration<ColdSyncName>;
/** What solves a diagram; all give the same bits. */
export const Engine: Enumeration<EngineName>;
/** Fields to group records by. */
export const Field: Enumeration<FieldName>;
/** What becomes of a batch with a time after the clock. */
export const Future: Enumeration<FutureName>;
/** How the packed array finds the records of a quadrant. */
export const Index: Enumeration<IndexName>;
/** How records lie in memory. */
export const Layout: Enumeration<LayoutName>;
/** Levels of a log line. */
export const LogLevel: Enumeration<LogLevelName>;
/** What the numbers of a graph's material are. */
export const Material: Enumeration<MaterialName>;
/** Methods of interpolation. */
export const Method: Enumeration<MethodName>;
/** Distances to place seeds by. */
export const Metric: Enumeration<MetricName>;
/** Layouts of records: 32 or 156 bytes. */
export const Record: Enumeration<RecordName>;
/** Formats of record files. */
export const RecordsFormat: Enumeration<RecordsFormatName>;
/** Instruction sets. */
export const Simd: Enumeration<SimdName>;
/** The statuses of the C interface, a `LocusError`'s `status`. */
export const Status: Enumeration<StatusName>;
/** When a store's log is flushed to the disk. */
export const Sync: Enumeration<SyncName>;
/** What numbers in a time column are. */
export const TimeUnit: Enumeration<TimeUnitName>;
/** Formats of volume files. */
export const VolumeFormat: Enumeration<VolumeFormatName>;
/** Types of a volume's numbers. */
export const Voxel: Enumeration<VoxelName>;
/** How an edge's weight follows from the two materials and its length. */
export const WeightRule: Enumeration<WeightRuleName>;
/** Bits of a packed word. */
export const Word: Enumeration<WordName>;

/** The label of a voxel that no seed reaches. */
export const NO_SEED: number;
/** The Earth's mean radius in metres, on whose sphere distances are measured. */
export const EARTH_RADIUS: number;
/** A second in microseconds, the unit of every time of a store. */
export const SECOND: number;
/** A minute in microseconds. */
export const MINUTE: number;
/** An hour in microseconds. */
export const HOUR: number;
/** A day in microseconds. */
export const DAY: number;

/** The path or name that liblocus was opened by. */
export const LIBRARY_PATH: string;
/** The loaded library's version and what was built into it, such as `0.1.0 simd=highway cuda=no`. */
export function version(): string;

/** The shared library was not found, or is of a version this package cannot work with. */
export class LibraryError extends Error {}
/** A call of the library failed: the message names the function, the argument and the offending value. */
export class LocusError extends Error {
  constructor(message: string, status: number, code: string);
  /** A number of `Status`. */
  readonly status: number;
  /** The status' name, such as LOCUS_E_RANGE. */
  readonly code: string;
}
/** An argument is out of its range or contradicts another one. */
export class ArgumentError extends LocusError {}
/** A value cannot be represented in the words the object was created with. */
export class ValueRangeError extends LocusError {}
/** The caller's memory is too small. */
export class CapacityError extends LocusError {}
/** The object is not in a state that allows the call. */
export class StateError extends LocusError {}
/** Not available in this build, on this machine, or in this form of the call. */
export class UnsupportedError extends LocusError {}
/** A callback asked to stop, or the work was cancelled. */
export class StoppedError extends LocusError {}
/** Another call is at work on the object that excludes this one. */
export class BusyError extends LocusError {}
/** The snapshot outlived its memory budget. */
export class StaleError extends LocusError {}
/** Out of memory. */
export class OutOfMemoryError extends LocusError {}
/** The operating system refused to read or write. */
export class IoError extends LocusError {}
/** Bytes from outside are not what they claim to be. */
export class FormatError extends LocusError {}
/** The GPU or its driver reported an error. */
export class DeviceError extends LocusError {}
/** A defect in Locus; please report the text. */
export class InternalError extends LocusError {}

/** Three numbers x, y, z. */
export type Triple = readonly [number, number, number] | readonly [bigint, bigint, bigint];
/** Real numbers: a typed array of the type that the method names is read where it lies, another array is converted first. */
export type Reals = ArrayLike<number> & Iterable<number>;
/** Integers, likewise. */
export type Integers = Iterable<number | bigint>;
/** A path: text, or a file: URL. */
export type Path = string | URL;
/** A time: microseconds since 1970-01-01 UTC, or a Date. */
export type Time = number | bigint | Date;
/** A length of time in microseconds; see `SECOND`, `MINUTE`, `HOUR` and `DAY`. */
export type Span = number | bigint;
/** Told a line of text and its level, a number of `LogLevel`. */
export type Log = (level: number, text: string) => void;

/** How to follow and to cancel long work. */
export interface Listening {
  /** Told how far the work is, 0 to 1; returning false cancels it, which is a `StoppedError`. */
  progress?: (fraction: number) => boolean | void;
  /** Cancels the work: the call then fails with the signal's reason. */
  signal?: AbortSignal;
}

/** What has an end: it comes with `dispose()`, at the end of a `using` block, or when the object is collected. */
export interface Disposable {
  /** End the object and free its memory now; a second time does nothing. A `BusyError` while a call is at work on it. */
  dispose(): void;
  [Symbol.dispose](): void;
}
