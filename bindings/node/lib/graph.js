// The voxel graph: a grid of voxels, each with a compliance or impassable.
import { Callbacks } from './callbacks.js';
import { Backend, Material, Simd, WeightRule, Word } from './constants.js';
import { DISPOSE, Handle, INNER, Made, away, filled, guarded, here, must, number64, options } from './call.js';
import { Guard } from './guard.js';
import { native } from './library.js';
import { Struct } from './struct.js';
import { callable, enumOption, integer, integers, real, reals, triple, writable } from './values.js';

/** The box as C has it; nothing stands for the whole grid. */
export function cBox(box, dims) {
  const { origin = [0, 0, 0], extent = dims } = box ?? {};
  return new Struct('locus_voxel_box').set({ origin: triple(origin, 'box.origin'), extent: triple(extent, 'box.extent') });
}

/** How many voxels a box has. */
export function volumeOf(box, dims) {
  return triple(box?.extent ?? dims, 'box.extent').reduce((product, extent) => product * Number(extent), 1);
}

/** The functions of a graph as callbacks, and the options that name them. */
function callbacksOf({ weight, log }) {
  const callbacks = new Callbacks();
  const fields = {};
  if (callable(weight, 'weight')) {
    // What it is told after an error is more than a word can hold: the call fails, and nothing is computed from it.
    const call = (u, v, length) => real(weight(Number(u), Number(v), length), "the weight function's answer");
    fields.weight = callbacks.add('locus_weight_fn', call, Number.MAX_VALUE);
  }
  if (callable(log, 'log')) fields.log = callbacks.add('locus_log_fn', (level, text) => void log(level, text), undefined);
  return { callbacks, fields };
}

function graphOptions(given, dims, fields) {
  const [low, high] = given.materialRange ?? [];
  return options('locus_graph_options_init', {
    dims,
    spacing: given.spacing && triple(given.spacing, 'spacing'),
    connectivity: given.connectivity,
    weight_rule: enumOption(WeightRule, given.weightRule, 'weightRule'),
    material: enumOption(Material, given.kind, 'kind'),
    word_bits: enumOption(Word, given.word, 'word'),
    stiffness_exponent: given.stiffnessExponent,
    max_seeds: given.maxSeeds,
    scale: given.scale,
    precision: given.precision,
    material_min: low,
    material_max: high,
    // A function is called on the thread it belongs to.
    threads: given.weight ? 1 : given.threads,
    backend: enumOption(Backend, given.backend, 'backend'),
    simd: enumOption(Simd, given.simd, 'simd'),
    ...fields,
  });
}

/** What makes a graph, for the constructor and for `create`. */
function* make(work, given = {}) {
  const dims = triple(given.dims, 'dims');
  const material = given.material ? reals(given.material, Float32Array, 'material', volumeOf(null, dims)) : null;
  const { callbacks, fields } = callbacksOf(given);
  const made = number64();
  try {
    work.uses(callbacks);
    yield* must('locus_graph_create', graphOptions(given, dims, fields), material, made);
    return { dims: Object.freeze(dims.map(Number)), address: made[0], callbacks };
  } catch (error) {
    native.get('locus_graph_destroy')(made[0]);
    callbacks.release();
    throw error;
  }
}

export class Graph {
  constructor(given) {
    const { dims, address, callbacks } = given instanceof Made ? given.made : here('new Graph', (work) => make(work, given));
    this.dims = dims;
    this[INNER] = { guard: new Guard('Graph'), callbacks, handle: new Handle(this, 'locus_graph_destroy', address, callbacks) };
  }

  static async create(given) {
    return new Graph(new Made(await away('Graph.create', (work) => make(work, given))));
  }

  get info() {
    Guard.enter({ reading: [this[INNER].guard] })();
    return filled('locus_graph_info', 'locus_graph_get_info', this.#address);
  }

  get #address() {
    return this[INNER].handle.address;
  }

  #changing(body) {
    return () => guarded({ writing: [this[INNER].guard] }, body);
  }

  #reading(body) {
    return () => guarded({ reading: [this[INNER].guard] }, body);
  }

  #setBox(box, values) {
    const where = cBox(box, this.dims);
    if (typeof values === 'number') return this.#changing(() => must('locus_graph_fill_box', this.#address, where, values));
    const numbers = reals(values, Float32Array, 'values', volumeOf(box, this.dims));
    return this.#changing(() => must('locus_graph_set_box', this.#address, where, numbers));
  }

  setBoxSync(box, values) {
    here('Graph.setBox', this.#setBox(box, values));
  }

  async setBox(box, values) {
    await away('Graph.setBox', this.#setBox(box, values));
  }

  setVoxels(voxels, values) {
    const indices = integers(voxels, BigUint64Array, 'voxels');
    const numbers = reals(values, Float32Array, 'values', indices.length);
    const body = () => must('locus_graph_set_voxels', this.#address, indices, numbers, indices.length);
    here('Graph.setVoxels', this.#changing(body));
  }

  getBox(box, out) {
    const values = writable(out, Float32Array, volumeOf(box, this.dims));
    const body = () => must('locus_graph_get_box', this.#address, cBox(box, this.dims), values, values.length);
    here('Graph.getBox', this.#reading(body));
    return values;
  }

  edgeWeight(u, v) {
    const steps = number64();
    const ends = [integer(u, 'uint64_t', 'u'), integer(v, 'uint64_t', 'v')];
    here('Graph.edgeWeight', (work) => {
      work.uses(this[INNER].callbacks);
      return this.#reading(() => must('locus_graph_edge_weight', this.#address, ...ends, steps))();
    });
    return steps[0];
  }

  cutPlane(point, normal, box) {
    const [at, along] = [reals(point, Float64Array, 'point', 3), reals(normal, Float64Array, 'normal', 3)];
    return here('Graph.cutPlane', this.#counted('locus_graph_cut_plane', at, along, cBox(box, this.dims)));
  }

  #cutMesh(vertices, triangles) {
    const corners = reals(vertices, Float64Array, 'vertices');
    const faces = integers(triangles, Uint32Array, 'triangles');
    for (const [name, array] of Object.entries({ vertices: corners, triangles: faces })) {
      if (array.length % 3 !== 0) throw new RangeError(`${name} has ${array.length} numbers, not three for each`);
    }
    return this.#counted('locus_graph_cut_mesh', corners, corners.length / 3, faces, faces.length / 3);
  }

  /** A change that tells how many edges it changed. */
  #counted(name, ...args) {
    const edges = number64();
    return this.#changing(function* body() {
      yield* must(name, this.#address, ...args, edges);
      return Number(edges[0]);
    }.bind(this));
  }

  cutMeshSync(vertices, triangles) {
    return here('Graph.cutMesh', this.#cutMesh(vertices, triangles));
  }

  async cutMesh(vertices, triangles) {
    return away('Graph.cutMesh', this.#cutMesh(vertices, triangles));
  }

  mendBox(box) {
    return here('Graph.mendBox', this.#counted('locus_graph_mend_box', cBox(box, this.dims)));
  }

  dispose() {
    Guard.enter({ writing: [this[INNER].guard] })();
    this[INNER].handle.dispose();
  }

  [DISPOSE]() {
    this.dispose();
  }
}
