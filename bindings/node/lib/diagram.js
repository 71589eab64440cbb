// The Voronoi diagram of a voxel graph: every voxel's nearest seed and its distance.
import { Engine, Metric, Status } from './constants.js';
import { DISPOSE, Handle, INNER, PROGRESS, away, call, check, filled, guarded, here, must, number64, options, quick } from './call.js';
import { Graph, cBox, volumeOf } from './graph.js';
import { Guard } from './guard.js';
import { StructArray } from './records.js';
import { Struct } from './struct.js';
import { enumOption, integer, integers, triple, writable } from './values.js';

/** A seed as C has it, from { position: [x, y, z] } or { x, y, z }. */
function cSeed(seed, id) {
  const [x, y, z] = seed.position ? triple(seed.position, 'position') : [seed.x, seed.y, seed.z];
  return { x, y, z, distance: seed.distance ?? 0, id: seed.id ?? id, fixed: Number(seed.fixed ?? false) };
}

/** Memory that grows to what a list needs. */
export const LISTS = {
  seeds: (count) => new StructArray('locus_seed', count),
  pairs: (count) => new StructArray('locus_cell_pair', count),
  numbers: (count) => new BigUint64Array(new ArrayBuffer(8 * count)),
};

export class Diagram {
  constructor(graph, given = {}) {
    if (!(graph instanceof Graph)) throw new TypeError('a diagram is made of a Graph');
    const plain = options('locus_diagram_options_init', {
      engine: enumOption(Engine, given.engine, 'engine'),
      record_trace: given.recordTrace === undefined ? undefined : Number(given.recordTrace),
      max_distance: given.maxDistance,
      grain: given.grain && triple(given.grain, 'grain'),
      stream: given.stream === undefined ? undefined : integer(given.stream, 'uint64_t', 'stream'),
      on_device: given.onDevice === undefined ? undefined : Number(given.onDevice),
    });
    const made = number64();
    Guard.enter({ reading: [graph[INNER].guard] })();
    quick('locus_diagram_create', graph[INNER].handle.address, plain, made);
    const callbacks = graph[INNER].callbacks.retain();
    this.graph = graph;
    this[INNER] = { guard: new Guard('Diagram'), callbacks, handle: new Handle(this, 'locus_diagram_destroy', made[0], callbacks) };
  }

  get #address() {
    return this[INNER].handle.address;
  }

  get #guards() {
    return { reading: [this.graph[INNER].guard], writing: [this[INNER].guard] };
  }

  /** A call that computes, told to stop by `progress` or `signal`. */
  #computing(listening, body) {
    return (work) => {
      work.uses(this[INNER].callbacks);
      work.listen(listening);
      return guarded(this.#guards, () => body(work));
    };
  }

  /** A quick change on this thread. */
  #change(method, name, ...args) {
    here(method, () => guarded(this.#guards, () => must(name, this.#address, ...args)));
  }

  addSeeds(seeds) {
    const known = this.seeds;
    const first = known.reduce((most, seed) => Math.max(most, seed.id + 1), 0);
    const array = StructArray.from('locus_seed', Array.from(seeds, (seed, index) => cSeed(seed, first + index)));
    this.#change('Diagram.addSeeds', 'locus_diagram_add_seeds', array.bytes, array.length);
  }

  removeSeeds(ids) {
    const array = integers(typeof ids === 'number' ? [ids] : ids, Uint32Array, 'ids');
    this.#change('Diagram.removeSeeds', 'locus_diagram_remove_seeds', array, array.length);
  }

  moveSeed(id, position) {
    const place = triple(position, 'position').map((one) => integer(one, 'uint64_t', 'position'));
    this.#change('Diagram.moveSeed', 'locus_diagram_move_seed', Number(integer(id, 'uint32_t', 'id')), ...place);
  }

  get seeds() {
    return this.#list(LISTS.seeds, 'locus_diagram_get_seeds').read();
  }

  #placeSeeds({ count = 0, firstId, lloydIterations, metric, ...listening } = {}) {
    return this.#computing(listening, (work) => {
      const plain = options('locus_place_options_init', {
        count,
        first_id: firstId,
        lloyd_iterations: lloydIterations,
        metric: enumOption(Metric, metric, 'metric'),
      });
      work.progressField(plain, 'progress');
      return must('locus_diagram_place_seeds', this.#address, plain);
    });
  }

  /** The options of placeSeeds, with the id behind the largest there is. */
  #numbered(given) {
    return { firstId: this.seeds.reduce((most, seed) => Math.max(most, seed.id + 1), 0), ...given };
  }

  placeSeedsSync(given) {
    here('Diagram.placeSeeds', this.#placeSeeds(this.#numbered(given)));
  }

  async placeSeeds(given) {
    await away('Diagram.placeSeeds', this.#placeSeeds(this.#numbered(given)));
  }

  #solve(listening) {
    return this.#computing(listening, () => must('locus_diagram_solve', this.#address, PROGRESS, null));
  }

  solveSync(listening) {
    here('Diagram.solve', this.#solve(listening));
    return this;
  }

  async solve(listening) {
    await away('Diagram.solve', this.#solve(listening));
    return this;
  }

  #update(listening) {
    return this.#computing(listening, function* body() {
      const [box, voxels] = [new Struct('locus_voxel_box'), number64()];
      yield* must('locus_diagram_update', this.#address, box, voxels, PROGRESS, null);
      return { box: box.read(), voxels: Number(voxels[0]) };
    }.bind(this));
  }

  updateSync(listening) {
    return here('Diagram.update', this.#update(listening));
  }

  async update(listening) {
    return away('Diagram.update', this.#update(listening));
  }

  /** Read the result of a box into the caller's array or a new one. */
  #read(name, type, box, out) {
    const { dims } = this.graph;
    const array = writable(out, type, volumeOf(box, dims));
    return () =>
      guarded({ reading: [this[INNER].guard] }, function* body() {
        yield* must(name, this.#address, cBox(box, dims), array, array.length);
        return array;
      }.bind(this));
  }

  labels(box, out) {
    return here('Diagram.labels', this.#read('locus_diagram_labels', Uint32Array, box, out));
  }

  distances(box, out) {
    return here('Diagram.distances', this.#read('locus_diagram_distances', Float32Array, box, out));
  }

  distancesExact(box, out) {
    return here('Diagram.distancesExact', this.#read('locus_diagram_distances_exact', BigUint64Array, box, out));
  }

  /** A list whose length the library tells: asked for with no room first, then with what it needs. */
  #list(room, name, ...args) {
    const count = number64();
    const address = this.#address;
    function* body() {
      const told = yield call(name, address, ...args, null, 0, count);
      if (told.status !== Status.CAPACITY) check(told);
      const list = room(Number(count[0]));
      if (list.length > 0) yield* must(name, address, ...args, list.bytes ?? list, list.length, count);
      return list;
    }
    const guards = { reading: [this.graph[INNER].guard, this[INNER].guard] };
    return here('Diagram', (work) => {
      work.uses(this[INNER].callbacks);
      return guarded(guards, body);
    });
  }

  path(position) {
    const place = triple(position, 'position').map((one) => integer(one, 'uint64_t', 'position'));
    const [nx, ny] = this.graph.dims;
    return Array.from(this.#list(LISTS.numbers, 'locus_diagram_path', ...place), Number).map((voxel) => [
      voxel % nx,
      Math.floor(voxel / nx) % ny,
      Math.floor(voxel / (nx * ny)),
    ]);
  }

  get cellSizes() {
    return Array.from(this.#list(LISTS.numbers, 'locus_diagram_cell_sizes'), Number);
  }

  get cellPairs() {
    return this.#list(LISTS.pairs, 'locus_diagram_cell_pairs').read();
  }

  get trace() {
    return Array.from(this.#list(LISTS.numbers, 'locus_diagram_trace'), Number);
  }

  get stats() {
    Guard.enter({ reading: [this[INNER].guard] })();
    return filled('locus_diagram_stats', 'locus_diagram_get_stats', this.#address);
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}
