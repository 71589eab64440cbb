// C structs in memory of this process, by the layouts of interface.js.
import koffi from 'koffi';
import { STRUCTS } from './interface.js';
import { camel, integer, real } from './values.js';

const LITTLE = true;
const SIZES = { char: 1, uint16_t: 2, int32_t: 4, uint32_t: 4, float: 4, uint64_t: 8, int64_t: 8, double: 8, pointer: 8 };

const READERS = {
  uint16_t: (view, at) => view.getUint16(at, LITTLE),
  int32_t: (view, at) => view.getInt32(at, LITTLE),
  uint32_t: (view, at) => view.getUint32(at, LITTLE),
  float: (view, at) => view.getFloat32(at, LITTLE),
  uint64_t: (view, at) => Number(view.getBigUint64(at, LITTLE)),
  int64_t: (view, at) => Number(view.getBigInt64(at, LITTLE)),
  double: (view, at) => view.getFloat64(at, LITTLE),
  pointer: (view, at) => view.getBigUint64(at, LITTLE),
};

const WRITERS = {
  uint16_t: (view, at, value, name) => view.setUint16(at, Number(integer(value, 'uint16_t', name)), LITTLE),
  int32_t: (view, at, value, name) => view.setInt32(at, Number(integer(value, 'int32_t', name)), LITTLE),
  uint32_t: (view, at, value, name) => view.setUint32(at, Number(integer(value, 'uint32_t', name)), LITTLE),
  float: (view, at, value, name) => view.setFloat32(at, real(value, name), LITTLE),
  uint64_t: (view, at, value, name) => view.setBigUint64(at, integer(value, 'uint64_t', name), LITTLE),
  int64_t: (view, at, value, name) => view.setBigInt64(at, integer(value, 'int64_t', name), LITTLE),
  double: (view, at, value, name) => view.setFloat64(at, real(value, name), LITTLE),
  pointer: (view, at, value) => view.setBigUint64(at, value ?? 0n, LITTLE),
};

/** Fields whose numbers do not fit into a double: they are read as bigint. */
const BIG = new Set(['max_exact']);

/** The value of a field: a number, a struct as an object, or an array of them. */
function readField(view, [type, offset, count], name) {
  if (BIG.has(name)) return view.getBigUint64(offset, LITTLE);
  const one = (at) => (STRUCTS[type] ? readStruct(type, view, at) : READERS[type](view, at));
  if (count === 1) return one(offset);
  return Array.from({ length: count }, (_, i) => one(offset + i * (STRUCTS[type]?.size ?? SIZES[type])));
}

/** A struct as an object, its fields in camelCase, without its size, spare fields and addresses. */
export function readStruct(struct, view, offset = 0) {
  const inside = offset === 0 ? view : new DataView(view.buffer, view.byteOffset + offset, STRUCTS[struct].size);
  const values = {};
  for (const [name, field] of Object.entries(STRUCTS[struct].fields)) {
    if (name === 'struct_size' || name.startsWith('reserved') || field[0] === 'pointer') continue;
    values[camel(name)] = readField(inside, field, name);
  }
  return values;
}

/** Write the fields that `values` names, of a struct at an offset; undefined leaves one as it is. */
export function writeStruct(struct, view, values, offset = 0) {
  for (const [name, value] of Object.entries(values)) {
    if (value === undefined || value === null) continue;
    const [type, place, count] = STRUCTS[struct].fields[name];
    if (STRUCTS[type]) writeStruct(type, view, value, offset + place);
    else if (count === 1) WRITERS[type](view, offset + place, value, name);
    else Array.from(value).forEach((one, i) => WRITERS[type](view, offset + place + i * SIZES[type], one, `${name}[${i}]`));
  }
}

/** One struct. */
export class Struct {
  #name;
  #view;

  constructor(name) {
    this.#name = name;
    this.bytes = new Uint8Array(new ArrayBuffer(STRUCTS[name].size));
    // What the struct points at: a call keeps the bytes alive, and these with them.
    this.bytes.kept = [];
    this.#view = new DataView(this.bytes.buffer);
    if (STRUCTS[name].fields.struct_size) this.set({ struct_size: STRUCTS[name].size });
  }

  /** Write fields; undefined leaves one as it is. */
  set(values) {
    writeStruct(this.#name, this.#view, values);
    return this;
  }

  /** Let a field point at memory, which lives as long as this struct. */
  point(field, memory) {
    this.bytes.kept.push(memory);
    return this.set({ [field]: addressOf(memory) });
  }

  /** The struct as an object. */
  read() {
    return readStruct(this.#name, this.#view);
  }
}

const NOTHING = new Uint8Array(new ArrayBuffer(8));

/** The address of an array's memory, which stays where it is as long as the array lives. */
export function addressOf(array) {
  return koffi.address(array.byteLength > 0 ? array : NOTHING);
}

/** A text as C has it. */
export function cText(text) {
  return new Uint8Array(Buffer.from(`${text}\0`, 'utf8'));
}
