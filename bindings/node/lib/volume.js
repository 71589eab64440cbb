// Volume files: MetaImage, NRRD, NIfTI and raw arrays (liblocus_io).
import { CONSTANTS } from './interface.js';
import { VolumeFormat, Voxel } from './constants.js';
import { away, filled, here, must, number64, options } from './call.js';
import { native } from './library.js';
import { copyFrom } from './native.js';
import { Struct } from './struct.js';
import { enumOption, enumValue, integer, pathText, triple } from './values.js';

/** The class of arrays of a voxel type. */
const ARRAYS = new Map([
  [Voxel.UINT8, Uint8Array],
  [Voxel.INT8, Int8Array],
  [Voxel.UINT16, Uint16Array],
  [Voxel.INT16, Int16Array],
  [Voxel.UINT32, Uint32Array],
  [Voxel.INT32, Int32Array],
  [Voxel.UINT64, BigUint64Array],
  [Voxel.INT64, BigInt64Array],
  [Voxel.FLOAT32, Float32Array],
  [Voxel.FLOAT64, Float64Array],
]);

function rawOptions(raw) {
  return {
    format: VolumeFormat.RAW,
    raw_dims: triple(raw.dims, 'raw.dims'),
    raw_type: enumValue(Voxel, raw.type, 'raw.type'),
    raw_components: raw.components,
    raw_offset: raw.offset,
    raw_spacing: raw.spacing && triple(raw.spacing, 'raw.spacing'),
    raw_origin: raw.origin && triple(raw.origin, 'raw.origin'),
    raw_interleaved: raw.interleaved === undefined ? undefined : Number(raw.interleaved),
    raw_big_endian: raw.bigEndian === undefined ? undefined : Number(raw.bigEndian),
  };
}

function readOptions({ keep = false, format, raw, memoryLimit, allowTrailing }) {
  return options('locus_volume_read_options_init', {
    numbers: keep ? CONSTANTS.READ_KEEP : CONSTANTS.READ_FLOAT,
    memory_limit: memoryLimit,
    allow_trailing: allowTrailing === undefined ? undefined : Number(allowTrailing),
    ...(raw ? rawOptions(raw) : { format: enumOption(VolumeFormat, format, 'format') }),
  });
}

function* read(path, given) {
  const made = number64();
  yield* must('locus_volume_read', pathText(path), readOptions(given), made);
  const volume = made[0];
  try {
    const info = filled('locus_volume_info', 'locus_volume_get_info', volume);
    const data = new (ARRAYS.get(info.type))(info.dims.reduce((product, size) => product * size, info.components));
    copyFrom(native.get('locus_volume_data')(volume), data);
    return { data, info };
  } finally {
    native.get('locus_volume_destroy')(volume);
  }
}

export function readVolumeSync(path, given = {}) {
  return here('readVolume', () => read(path, given));
}

export async function readVolume(path, given = {}) {
  return away('readVolume', () => read(path, given));
}

export function readVolumeInfo(path, given = {}) {
  const into = new Struct('locus_volume_info');
  here('readVolumeInfo', () => must('locus_volume_read_info', pathText(path), readOptions(given), into));
  return into.read();
}

function* write(path, data, given) {
  const type = [...ARRAYS].find(([, kind]) => data instanceof kind)?.[0];
  if (!type) throw new TypeError(`data must be a typed array of 8- to 64-bit numbers, not ${data?.constructor?.name ?? data}`);
  const dims = triple(given.dims, 'dims');
  const components = Number(integer(given.components ?? 1, 'uint64_t', 'components'));
  const room = dims.reduce((product, size) => product * Number(size), components);
  if (data.length !== room) throw new RangeError(`data has ${data.length} numbers instead of ${room}`);
  const info = options('locus_volume_info_init', {
    dims,
    components,
    type,
    spacing: given.spacing && triple(given.spacing, 'spacing'),
    origin: given.origin && triple(given.origin, 'origin'),
  });
  if (given.direction) {
    if (given.direction.length !== 9) throw new RangeError(`direction has ${given.direction.length} numbers instead of 9`);
    info.set({ direction: given.direction });
  }
  const plain = options('locus_volume_write_options_init', {
    format: enumOption(VolumeFormat, given.format, 'format'),
    compression: given.compression,
  });
  yield* must('locus_volume_write', pathText(path), info, data, plain);
}

export function writeVolumeSync(path, data, given) {
  here('writeVolume', () => write(path, data, given));
}

export async function writeVolume(path, data, given) {
  await away('writeVolume', () => write(path, data, given));
}
