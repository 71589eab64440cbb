// Between JavaScript's values and those of the C interface: numbers, arrays, enumerations, times, paths.
import { fileURLToPath } from 'node:url';

const LIMITS = {
  uint16_t: [0n, 0xffffn],
  uint32_t: [0n, 0xffffffffn],
  int32_t: [-0x80000000n, 0x7fffffffn],
  uint64_t: [0n, 0xffffffffffffffffn],
  int64_t: [-0x8000000000000000n, 0x7fffffffffffffffn],
};

/** How a value is shown in an error. */
function shown(value) {
  return typeof value === 'bigint' ? `${value}n` : typeof value === 'string' ? `'${value}'` : String(value);
}

/** A number of any kind. */
export function real(value, name) {
  if (typeof value !== 'number') throw new TypeError(`${name} must be a number, not ${shown(value)}`);
  return value;
}

/** An integer of a C type, as a bigint. */
export function integer(value, type, name) {
  if (typeof value !== 'bigint' && !Number.isInteger(value)) throw new TypeError(`${name} must be an integer, not ${shown(value)}`);
  const whole = BigInt(value);
  const [low, high] = LIMITS[type];
  if (whole < low || whole > high) throw new RangeError(`${name} is ${shown(value)}, not within ${low}..${high}`);
  return whole;
}

/** A length or an index, as a number. */
export function size(value, name) {
  if (!Number.isSafeInteger(value) || value < 0) throw new RangeError(`${name} must be an integer of 0 or more, not ${shown(value)}`);
  return value;
}

/** A list, however it was given. */
function listed(values, name) {
  if (typeof values !== 'string' && typeof values?.[Symbol.iterator] === 'function') return Array.from(values);
  throw new TypeError(`${name} must be an array, not ${shown(values)}`);
}

/** An array of floating-point numbers: the caller's own where it is of the type, else a converted one. */
export function reals(values, type, name, length) {
  const array = values instanceof type ? values : type.from(listed(values, name), (one) => real(one, name));
  return ofLength(array, name, length);
}

/** The same for integers. */
export function integers(values, type, name, length) {
  if (values instanceof type) return ofLength(values, name, length);
  const big = type === BigUint64Array;
  const each = listed(values, name).map((one) => integer(one, big ? 'uint64_t' : 'uint32_t', name));
  return ofLength(big ? type.from(each) : type.from(each, Number), name, length);
}

function ofLength(array, name, length) {
  if (length !== undefined && array.length !== length) throw new RangeError(`${name} has ${array.length} numbers instead of ${length}`);
  return array;
}

/** The caller's array, which has to fit as it is, or a new one. */
export function writable(out, type, length, name = 'out') {
  if (out === undefined || out === null) return new type(length);
  if (!(out instanceof type) || out.length !== length) {
    const given = out?.constructor?.name ?? shown(out);
    throw new RangeError(`${name} must be a ${type.name} of ${length} elements, not ${given} of ${out?.length}`);
  }
  return out;
}

/** Three numbers x, y, z. */
export function triple(value, name) {
  if (value?.length !== 3) throw new TypeError(`${name} must be three numbers [x, y, z], not ${shown(value)}`);
  return Array.from(value);
}

/** The number of an enumeration's member, given as itself or by its name in any case. */
export function enumValue(members, value, name) {
  if (typeof value === 'string') {
    const found = members[value.toUpperCase().replaceAll(/[- ]/g, '_')];
    if (found === undefined) throw new RangeError(`${name} is '${value}', not one of ${Object.keys(members).join(', ').toLowerCase()}`);
    return found;
  }
  return Number(integer(value, 'uint32_t', name));
}

/** The same of an option, which may be left out. */
export function enumOption(members, value, name) {
  return value === undefined || value === null ? undefined : enumValue(members, value, name);
}

/** A time, or a length of time, in microseconds; a Date since 1970. */
export function microseconds(time, name) {
  return time instanceof Date ? BigInt(time.getTime()) * 1000n : integer(time, 'int64_t', name);
}

/** A path as text. */
export function pathText(path, name = 'path') {
  const text = path instanceof URL ? fileURLToPath(path) : path;
  return plainText(text, name);
}

/** A text without NUL, which would end it for C. */
export function plainText(text, name) {
  if (typeof text !== 'string') throw new TypeError(`${name} must be a string, not ${shown(text)}`);
  if (text.includes('\0')) throw new TypeError(`${name} must not hold a NUL: ${JSON.stringify(text)}`);
  return text;
}

/** A function, or nothing. */
export function callable(value, name) {
  if (value !== undefined && value !== null && typeof value !== 'function') {
    throw new TypeError(`${name} must be a function, not ${shown(value)}`);
  }
  return value ?? undefined;
}

/** someName for some_name. */
export function camel(name) {
  return name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
}
