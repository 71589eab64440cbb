// The enumerations of the C interface: frozen objects from a member's name to its number.
import { CONSTANTS } from './interface.js';

/** The members of the constants with a prefix. A name that begins with a digit gets BITS_ before it. */
function enumeration(prefix, but = []) {
  const members = Object.entries(CONSTANTS)
    .filter(([name]) => name.startsWith(`${prefix}_`) && !but.includes(name))
    .map(([name, value]) => [name.slice(prefix.length + 1).replace(/^(?=\d)/, 'BITS_'), value]);
  return Object.freeze(Object.fromEntries(members));
}

export const AlertKind = enumeration('ALERT');
export const Backend = enumeration('BACKEND');
export const ColdFull = enumeration('COLD_FULL');
export const ColdSync = enumeration('COLD_SYNC');
export const Engine = enumeration('ENGINE');
export const Field = enumeration('FIELD', ['FIELD_CALLER']);
export const Future = enumeration('FUTURE');
export const Index = enumeration('INDEX');
export const Layout = enumeration('LAYOUT');
export const LogLevel = enumeration('LOG');
export const Material = enumeration('MATERIAL');
export const Method = enumeration('METHOD');
export const Metric = enumeration('PLACE');
export const Record = enumeration('RECORD');
export const RecordsFormat = enumeration('RECORDS');
export const Simd = enumeration('SIMD');
export const Status = Object.freeze({ OK: CONSTANTS.OK, ...enumeration('E') });
export const Sync = enumeration('SYNC');
export const TimeUnit = enumeration('TIME');
export const VolumeFormat = enumeration('VOLUME');
export const Voxel = enumeration('VOXEL');
export const WeightRule = enumeration('WEIGHT');
export const Word = enumeration('WORD');

/** The label of a voxel that no seed reaches. */
export const NO_SEED = CONSTANTS.NO_SEED;
/** The Earth's mean radius in metres, on whose sphere distances are measured. */
export const EARTH_RADIUS = CONSTANTS.EARTH_RADIUS;
/** Lengths of time in microseconds, the unit of every time of a store. */
export const SECOND = 1e6;
export const MINUTE = 60 * SECOND;
export const HOUR = 60 * MINUTE;
export const DAY = 24 * HOUR;
