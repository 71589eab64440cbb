// Records as views over an ArrayBuffer, as the library reads and writes them: no copies on the way.
import { STRUCTS } from './interface.js';
import { integer, size } from './values.js';
import { readStruct, writeStruct } from './struct.js';

const LITTLE = true;
const TEXT_BYTES = 140;
const decoder = new TextDecoder();
const encoder = new TextEncoder();

/** A time of a record in microseconds; a Date is one. */
const timeOf = (value) => (value instanceof Date ? value.getTime() * 1000 : value);

/** Getters and setters of a number's type at a place in a record. */
const ACCESS = {
  double: ['getFloat64', 'setFloat64'],
  float: ['getFloat32', 'setFloat32'],
  uint16_t: ['getUint16', 'setUint16'],
};

/** The field of a record at an offset from its beginning: how it is read and written. */
function accessors(type, offset, name) {
  if (type === 'int64_t') {
    return {
      get: (view, at) => Number(view.getBigInt64(at + offset, LITTLE)),
      set: (view, at, value) => view.setBigInt64(at + offset, integer(timeOf(value), type, name), LITTLE),
    };
  }
  if (type === 'char') {
    return {
      get(view, at) {
        const bytes = new Uint8Array(view.buffer, view.byteOffset + at + offset, TEXT_BYTES);
        const end = bytes.indexOf(0);
        return decoder.decode(end < 0 ? bytes : bytes.subarray(0, end));
      },
      set(view, at, value) {
        const text = encoder.encode(value);
        if (text.length > TEXT_BYTES) throw new RangeError(`${name} takes ${text.length} bytes of UTF-8, more than ${TEXT_BYTES}: '${value}'`);
        const bytes = new Uint8Array(view.buffer, view.byteOffset + at + offset, TEXT_BYTES);
        bytes.fill(0).set(text);
      },
    };
  }
  const [get, set] = ACCESS[type];
  const whole = type === 'uint16_t';
  return {
    get: (view, at) => view[get](at + offset, LITTLE),
    set(view, at, value) {
      if (whole) integer(value, type, name);
      else if (typeof value !== 'number') throw new TypeError(`${name} must be a number, not ${String(value)}`);
      view[set](at + offset, Number(value), LITTLE);
    },
  };
}

/** The class of arrays of a record's struct. */
function recordArray(className, struct) {
  const { size: stride, fields } = STRUCTS[struct];
  const names = Object.keys(fields);
  const access = Object.fromEntries(Object.entries(fields).map(([name, [type, offset]]) => [name, accessors(type, offset, name)]));

  /** One record, as long as its array lives; its fields are read and written where they lie. */
  class View {
    #view;
    #at;

    constructor(view, at) {
      this.#view = view;
      this.#at = at;
    }

    static {
      for (const name of names) {
        const { get, set } = access[name];
        Object.defineProperty(View.prototype, name, {
          enumerable: true,
          get() {
            return get(this.#view, this.#at);
          },
          set(value) {
            set(this.#view, this.#at, value);
          },
        });
      }
    }

    /** The fields as a plain object, which stays as it is. */
    toJSON() {
      return Object.fromEntries(names.map((name) => [name, this[name]]));
    }
  }

  const made = class {
    #view;

    /**
     * @param {number|ArrayBuffer|Iterable<object>} from how many records, all zero; or memory; or records
     * @param {number} [byteOffset] where they begin in the memory
     * @param {number} [length] how many they are; all there is room for
     */
    constructor(from, byteOffset = 0, length = undefined) {
      const shared = typeof SharedArrayBuffer === 'function' && from instanceof SharedArrayBuffer;
      if (typeof from === 'number') {
        this.bytes = new Uint8Array(new ArrayBuffer(size(from, 'length') * stride));
      } else if (from instanceof ArrayBuffer || shared) {
        const room = Math.floor((from.byteLength - byteOffset) / stride);
        this.bytes = new Uint8Array(from, byteOffset, size(length ?? room, 'length') * stride);
      } else {
        const records = Array.from(from);
        this.bytes = new Uint8Array(new ArrayBuffer(records.length * stride));
        this.#view = new DataView(this.bytes.buffer);
        records.forEach((record, index) => this.set(index, record));
      }
      this.#view ??= new DataView(this.bytes.buffer, this.bytes.byteOffset, this.bytes.byteLength);
    }

    /** Bytes per record. */
    static get BYTES_PER_ELEMENT() {
      return stride;
    }

    /** How many records there are. */
    get length() {
      return this.bytes.byteLength / stride;
    }

    get buffer() {
      return this.bytes.buffer;
    }

    get byteOffset() {
      return this.bytes.byteOffset;
    }

    get byteLength() {
      return this.bytes.byteLength;
    }

    #place(index) {
      if (!Number.isInteger(index) || index < 0 || index >= this.length) {
        throw new RangeError(`record ${String(index)} of an array of ${this.length}`);
      }
      return index * stride;
    }

    /** The record at an index, to be read and written where it lies; a negative index counts from the end. */
    at(index) {
      return new View(this.#view, this.#place(index < 0 ? index + this.length : index));
    }

    /** Write the fields that `record` names. */
    set(index, record) {
      const place = this.#place(index);
      for (const name of names) if (record[name] !== undefined) access[name].set(this.#view, place, record[name]);
    }

    /** A field of all records, as an array. */
    column(name) {
      if (!access[name]) throw new RangeError(`records have ${names.join(', ')}, no ${String(name)}`);
      const { get } = access[name];
      return Array.from({ length: this.length }, (_, index) => get(this.#view, index * stride));
    }

    /** The records `from` to `to` (not included), in the same memory. */
    subarray(from = 0, to = this.length) {
      const bytes = this.bytes.subarray(from * stride, to * stride);
      return new made(bytes.buffer, bytes.byteOffset, bytes.byteLength / stride);
    }

    /** The same as a copy. */
    slice(from = 0, to = this.length) {
      const copy = this.bytes.slice(from * stride, to * stride);
      return new made(copy.buffer);
    }

    *[Symbol.iterator]() {
      for (let index = 0; index < this.length; ++index) yield this.at(index);
    }
  };
  Object.defineProperty(made, 'name', { value: className });
  return made;
}

/** Records of 32 bytes: latitude, longitude, time, device, application, language, spare. */
export const Point32Array = recordArray('Point32Array', 'locus_point32');

/** Records of 156 bytes: latitude, longitude, time and a text of at most 140 bytes of UTF-8. */
export const Text156Array = recordArray('Text156Array', 'locus_text156');

/** The array of a record layout, by LOCUS_RECORD_. */
export const ARRAYS = { 32: Point32Array, 156: Text156Array };

/** Memory for structs that a call stores, read as plain objects. */
export class StructArray {
  #struct;

  constructor(struct, length) {
    this.#struct = struct;
    this.length = length;
    this.bytes = new Uint8Array(new ArrayBuffer(length * STRUCTS[struct].size));
  }

  /** An array of structs from objects whose fields have the names of C. */
  static from(struct, values) {
    const array = new StructArray(struct, values.length);
    const view = new DataView(array.bytes.buffer);
    values.forEach((value, index) => writeStruct(struct, view, value, index * STRUCTS[struct].size));
    return array;
  }

  /** The first `count` as objects, their fields in camelCase. */
  read(count = this.length) {
    const view = new DataView(this.bytes.buffer);
    const { size: stride } = STRUCTS[this.#struct];
    return Array.from({ length: count }, (_, index) =>
      readStruct(this.#struct, new DataView(view.buffer, index * stride, stride)),
    );
  }
}

