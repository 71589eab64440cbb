// Files of records and volumes.
import type {
  Disposable,
  FormatError,
  Member,
  Path,
  RecordName,
  RecordsFormatName,
  TimeUnitName,
  Triple,
  VolumeFormatName,
  VoxelName,
} from './common.js';
import type { ArrayOf, RecordArrayConstructor, Text156 } from './stream.js';

export interface RecordReaderOptions {
  /** The layout of the records; Text156. */
  record?: Member<RecordName>;
  /** Most records of an array; 65,536. */
  batch?: number;
  format?: Member<RecordsFormatName>;
  /** What numbers in the time column are. */
  timeUnit?: Member<TimeUnitName>;
  /** Of CSV fields; a comma. */
  separator?: string;
  /** Bytes; a longer line is a bad one. */
  maxLine?: number;
  /** By default the usual names. */
  timeColumn?: string;
  latitudeColumn?: string;
  longitudeColumn?: string;
  textColumn?: string;
  /** A bad line is a `FormatError` instead of being counted. */
  refuseBadLines?: boolean;
  /** Told each bad line. */
  badLine?: (line: number, reason: string) => void;
}

export interface RecordsStats {
  records: number;
  bad: number;
  cut: number;
  repaired: number;
  line: number;
  bytesRead: number;
  bytes: number;
}

/** A reader of rows from CSV or newline-delimited JSON: iterating over it gives arrays of at most `batch` records. */
export class RecordReader<Value = Text156> implements Disposable, Iterable<ArrayOf<Value>>, AsyncIterable<ArrayOf<Value>> {
  /** A file, or an open descriptor such as 0 for standard input, which stays yours. */
  constructor(source: Path | number, options?: RecordReaderOptions);
  /** The class of the records' arrays. */
  readonly Records: RecordArrayConstructor<Value, ArrayOf<Value>>;
  /** Read at most so many records (by default `batch`); none is the end. */
  read(most?: number): Promise<ArrayOf<Value>>;
  readSync(most?: number): ArrayOf<Value>;
  [Symbol.iterator](): Generator<ArrayOf<Value>, void>;
  [Symbol.asyncIterator](): AsyncGenerator<ArrayOf<Value>, void>;
  /** How far the reader is. */
  readonly stats: RecordsStats;
  dispose(): void;
  [Symbol.dispose](): void;
}

/** Arrays of a volume's numbers. */
export type VoxelArray =
  | Uint8Array | Int8Array | Uint16Array | Int16Array | Uint32Array | Int32Array | BigUint64Array | BigInt64Array | Float32Array
  | Float64Array;

export interface VolumeInfo {
  dims: number[];
  components: number;
  spacing: number[];
  origin: number[];
  direction: number[];
  slope: number;
  intercept: number;
  type: number;
  fileType: number;
  format: number;
  bigEndian: number;
}

/** A volume: its numbers, x fastest, one component after the other, and what is known about them. */
export interface Volume<Numbers = Float32Array> {
  data: Numbers;
  info: VolumeInfo;
}

export interface ReadVolumeOptions {
  /** Keep the file's own type of numbers, instead of float32 with slope and intercept applied. */
  keep?: boolean;
  /** By default told by the first bytes. */
  format?: Member<VolumeFormatName>;
  /** How the numbers of a file without a header lie. */
  raw?: {
    dims: Triple;
    type: Member<VoxelName>;
    components?: number;
    /** Bytes before the numbers. */
    offset?: number;
    spacing?: Triple;
    origin?: Triple;
    /** The components of a voxel lie side by side. */
    interleaved?: boolean;
    /** The high byte comes first. */
    bigEndian?: boolean;
  };
  /** Most bytes the numbers may take. */
  memoryLimit?: number;
  /** Bytes after the numbers are fine. */
  allowTrailing?: boolean;
}

/** Read a volume file: MetaImage, NRRD, NIfTI, or raw numbers. */
export function readVolume(path: Path, options: ReadVolumeOptions & { keep: true }): Promise<Volume<VoxelArray>>;
export function readVolume(path: Path, options?: ReadVolumeOptions): Promise<Volume>;
export function readVolumeSync(path: Path, options: ReadVolumeOptions & { keep: true }): Volume<VoxelArray>;
export function readVolumeSync(path: Path, options?: ReadVolumeOptions): Volume;
/** What `readVolume` would give, from the file's header alone. */
export function readVolumeInfo(path: Path, options?: ReadVolumeOptions): VolumeInfo;

export interface WriteVolumeOptions {
  dims: Triple;
  components?: number;
  spacing?: Triple;
  origin?: Triple;
  /** Unit vectors along the grid's x, y and z axes, nine numbers. */
  direction?: readonly number[];
  /** By default by the ending of the path. */
  format?: Member<VolumeFormatName>;
  /** 0 for none, 1 (fast) to 9 (small). */
  compression?: number;
}

/** Write numbers, x fastest, as MetaImage or NRRD. */
export function writeVolume(path: Path, data: VoxelArray, options: WriteVolumeOptions): Promise<void>;
export function writeVolumeSync(path: Path, data: VoxelArray, options: WriteVolumeOptions): void;
