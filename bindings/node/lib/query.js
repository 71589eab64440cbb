// What to ask a store for.
import { CONSTANTS } from './interface.js';
import { ARRAYS } from './records.js';
import { addressOf, Struct } from './struct.js';
import { copyFrom } from './native.js';
import { options } from './call.js';
import { callable, microseconds, real } from './values.js';

/** A record that a callback is shown, copied into memory of its own: `next` gives a view that the next one overwrites. */
export class Shown {
  #array;
  #view;

  constructor(record) {
    this.#array = new ARRAYS[record](1);
    this.#view = this.#array.at(0);
  }

  next(address) {
    copyFrom(address, this.#array.bytes);
    return this.#view;
  }

  /** A record that stays. */
  copy(address) {
    const array = new ARRAYS[this.#array.byteLength](1);
    copyFrom(address, array.bytes);
    return array.at(0);
  }
}

/** The named numbers of a region, given by name or in their order. */
function numbers(region, names, what) {
  const values = Array.isArray(region) ? region : names.map((name) => region?.[name]);
  if (values.length !== names.length) throw new TypeError(`${what} is { ${names.join(', ')} } or these numbers in an array`);
  return Object.fromEntries(names.map((name, index) => [name, real(values[index], `${what}.${name}`)]));
}

/** The rings of a polygon, each of [latitude, longitude] or { latitude, longitude }. */
function setPolygon(struct, rings) {
  const each = Array.from(rings, (ring) => Array.from(ring, (place) => numbers(place, ['latitude', 'longitude'], 'polygon')));
  const vertices = Float64Array.from(each.flat().flatMap(({ latitude, longitude }) => [latitude, longitude]));
  const sizes = BigUint64Array.from(each, (ring) => BigInt(ring.length));
  struct.bytes.kept.push(vertices, sizes);
  const polygon = { vertices: addressOf(vertices), ring_sizes: addressOf(sizes), rings: each.length };
  struct.set({ region: CONSTANTS.REGION_POLYGON, polygon });
}

/**
 * A query as C has it.
 * @param {object|undefined} query
 * @param {number} record the layout of the records, for the filter
 * @param {(run: Function) => bigint} callback makes the filter a callback
 * @param {bigint} [snapshot]
 * @returns {Struct}
 */
export function cQuery(query, record, callback, snapshot) {
  const { box, circle, polygon, since, until, filter, expired, anyOrder } = query ?? {};
  if ([box, circle, polygon].filter(Boolean).length > 1) {
    throw new TypeError('a query has one region: a box, a circle or a polygon');
  }
  const struct = options('locus_pmq_query_init', {
    snapshot,
    expired: expired ? 1 : 0,
    order: anyOrder ? CONSTANTS.ORDER_ANY : CONSTANTS.ORDER_KEY,
    time_from: since === undefined ? undefined : microseconds(since, 'since'),
    time_to: until === undefined ? undefined : microseconds(until, 'until'),
  });
  if (box) struct.set({ region: CONSTANTS.REGION_BOX, box: numbers(box, ['south', 'west', 'north', 'east'], 'box') });
  if (circle) struct.set({ region: CONSTANTS.REGION_CIRCLE, circle: numbers(circle, ['latitude', 'longitude', 'radius'], 'circle') });
  if (polygon) setPolygon(struct, polygon);
  if (callable(filter, 'filter')) {
    const shown = new Shown(record);
    struct.set({ filter: callback((address) => (filter(shown.next(address)) ? 1 : 0)) });
  }
  return struct;
}
