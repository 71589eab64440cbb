// Shape functions: how much each seed of a Voronoi diagram weighs at a voxel.
import { Callbacks, stopsAtFalse } from './callbacks.js';
import { Method, Status } from './constants.js';
import { DISPOSE, Handle, INNER, Made, away, call, check, guarded, here, must, number64, options, quick } from './call.js';
import { Diagram } from './diagram.js';
import { cBox } from './graph.js';
import { Guard } from './guard.js';
import { bind } from './pool.js';
import { callable, enumOption, integer, integers, reals, size, writable } from './values.js';

/** Compute the rows of a box, or of a list of voxels. */
function* create(diagram, plain, { box, voxels }, made) {
  const guards = { reading: [diagram.graph[INNER].guard, diagram[INNER].guard] };
  const address = diagram[INNER].handle.address;
  yield* guarded(guards, () => {
    if (!voxels) return must('locus_weights_create', address, plain, cBox(box, diagram.graph.dims), made);
    const indices = integers(voxels, BigUint64Array, 'voxels');
    return must('locus_weights_create_for', address, plain, indices, indices.length, made);
  });
}

/** What makes weights, for the constructor and for `create`. */
function* make(work, diagram, given) {
  if (!(diagram instanceof Diagram)) throw new TypeError('weights are made of a Diagram');
  if (given.box && given.voxels) throw new TypeError('weights are of a box or of a list of voxels, not of both');
  const plain = options('locus_weights_options_init', {
    method: enumOption(Method, given.method, 'method'),
    max_per_row: given.maxPerRow,
    batch_bytes: given.batchBytes,
  });
  const made = number64();
  work.uses(diagram[INNER].callbacks);
  // The weights keep the callback that reports progress, for `update` calls it, too: that of a worker ties them to it.
  if (!work.here) {
    work.listen(given);
    work.progressField(plain, 'progress');
    bind(work);
  }
  const callbacks = new Callbacks();
  const progress = work.here ? callable(given.progress, 'progress') : undefined;
  try {
    if (progress) {
      work.uses(callbacks);
      plain.set({ progress: callbacks.add('locus_progress_fn', (fraction) => stopsAtFalse(progress(fraction)), 1) });
    }
    yield* create(diagram, plain, given, made);
    return { address: made[0], callbacks, worker: work.worker };
  } catch (error) {
    callbacks.release();
    throw error;
  }
}

export class Weights {
  #seedIds;

  constructor(diagram, given = {}) {
    const { address, callbacks, worker } =
      given instanceof Made ? given.made : here('new Weights', (work) => make(work, diagram, given));
    this.diagram = diagram;
    const graphs = diagram[INNER].callbacks.retain();
    const both = { release: () => [callbacks, graphs].forEach((one) => one.release()) };
    this[INNER] = { guard: new Guard('Weights'), callbacks, worker, handle: new Handle(this, 'locus_weights_destroy', address, both) };
    this.#seedIds = diagram.seeds.map((seed) => seed.id);
  }

  static async create(diagram, given = {}) {
    return new Weights(diagram, new Made(await away('Weights.create', (work) => make(work, diagram, given))));
  }

  get #address() {
    return this[INNER].handle.address;
  }

  #reading(body) {
    return () => guarded({ reading: [this[INNER].guard] }, body);
  }

  #size() {
    const [rows, entries] = [number64(), number64()];
    Guard.enter({ reading: [this[INNER].guard] })();
    quick('locus_weights_size', this.#address, rows, entries);
    return { rows: Number(rows[0]), entries: Number(entries[0]) };
  }

  get length() {
    return this.#size().rows;
  }

  get entries() {
    return this.#size().entries;
  }

  get seedIds() {
    return [...this.#seedIds];
  }

  /** The rows that are asked for, by default all from the first on. */
  #span({ first = 0, count } = {}) {
    const rows = this.length;
    return [size(first, 'first'), size(count ?? Math.max(rows - first, 0), 'count')];
  }

  rows(span) {
    const [first, count] = this.#span(span);
    const there = first + count <= this.length;
    // The library refuses rows that are not there; no memory is taken for them.
    const offsets = new BigUint64Array(new ArrayBuffer(8 * ((there ? count : 0) + 1)));
    const entries = number64();
    const address = this.#address;
    return here('Weights.rows', this.#reading(function* body() {
      const told = yield call('locus_weights_rows', address, first, count, offsets, null, null, 0, entries);
      if (told.status !== Status.CAPACITY) check(told);
      const [ids, values] = [new Uint32Array(Number(entries[0])), new Float32Array(Number(entries[0]))];
      if (ids.length > 0) yield* must('locus_weights_rows', address, first, count, offsets, ids, values, ids.length, null);
      return { offsets: Array.from(offsets, Number), ids, values };
    }));
  }

  dense(ids, { out, ...span } = {}) {
    const [first, count] = this.#span(span);
    const wanted = integers(ids ?? this.#seedIds, Uint32Array, 'ids');
    const array = writable(out, Float32Array, count * wanted.length);
    here('Weights.dense', this.#reading(() =>
      must('locus_weights_dense', this.#address, first, count, wanted, wanted.length, array, array.length),
    ));
    return array;
  }

  #interpolate(values, { components = 1, out, ...span } = {}) {
    const [first, count] = this.#span(span);
    const given = reals(values, Float32Array, 'values', this.#seedIds.length * size(components, 'components'));
    const array = writable(out, Float32Array, count * components);
    return this.#reading(function* body() {
      yield* must('locus_weights_interpolate', this.#address, first, count, given, components, array, array.length);
      return array;
    }.bind(this));
  }

  interpolateSync(values, given) {
    return here('Weights.interpolate', this.#interpolate(values, given));
  }

  async interpolate(values, given) {
    return away('Weights.interpolate', this.#interpolate(values, given));
  }

  gradients(id, { out, ...span } = {}) {
    const [first, count] = this.#span(span);
    const array = writable(out, Float32Array, 3 * count);
    const seed = Number(integer(id, 'uint32_t', 'id'));
    here('Weights.gradients', this.#reading(() => must('locus_weights_gradients', this.#address, first, count, seed, array, array.length)));
    return array;
  }

  #update(listening) {
    const { diagram } = this;
    const { callbacks, guard, worker } = this[INNER];
    return (work) => {
      for (const one of [callbacks, diagram[INNER].callbacks]) work.uses(one);
      work.worker = work.here ? undefined : worker;
      work.listen(listening);
      const guards = { reading: [diagram.graph[INNER].guard, diagram[INNER].guard], writing: [guard] };
      return guarded(guards, function* body() {
        const [changed, count] = [new BigUint64Array(new ArrayBuffer(8 * this.#rowsNow())), number64()];
        yield* must('locus_weights_update', this.#address, changed, changed.length, count);
        this.#seedIds = diagram.seeds.map((seed) => seed.id);
        return Array.from(changed.subarray(0, Number(count[0])), Number);
      }.bind(this));
    };
  }

  /** How many rows there are, from within a call that has entered the guard. */
  #rowsNow() {
    const rows = number64();
    quick('locus_weights_size', this.#address, rows, null);
    return Number(rows[0]);
  }

  updateSync() {
    return here('Weights.update', this.#update());
  }

  async update(listening) {
    return away('Weights.update', this.#update(listening));
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}
