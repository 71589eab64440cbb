// Locus: data that changes all the time, close in memory. index.d.ts tells what everything here is.
export * from './constants.js';
export {
  ArgumentError,
  BusyError,
  CapacityError,
  DeviceError,
  FormatError,
  InternalError,
  IoError,
  LibraryError,
  LocusError,
  OutOfMemoryError,
  StaleError,
  StateError,
  StoppedError,
  UnsupportedError,
  ValueRangeError,
} from './errors.js';
export { LIBRARY_PATH, version } from './library.js';
export { Point32Array, Text156Array } from './records.js';
export { Graph } from './graph.js';
export { Diagram } from './diagram.js';
export { Weights } from './weights.js';
export { Snapshot, Store, fileInfo, pmqKey } from './store.js';
export { Cold } from './cold.js';
export { Alerts } from './alerts.js';
export { RecordReader } from './recordreader.js';
export { readVolume, readVolumeInfo, readVolumeSync, writeVolume, writeVolumeSync } from './volume.js';
