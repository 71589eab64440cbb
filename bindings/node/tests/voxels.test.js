// Graphs, diagrams and weights against textbook algorithms.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { close, distances, random, thrown } from './common.js';

const DIMS = [7, 6, 5];

function material(next, dims = DIMS) {
  return Float32Array.from({ length: dims[0] * dims[1] * dims[2] }, () => (next() < 0.2 ? NaN : 0.5 + 3.5 * next()));
}

function places(next, values, count, [nx, ny] = DIMS) {
  const found = [];
  while (found.length < count) {
    const v = Math.floor(next() * values.length);
    const place = [v % nx, Math.floor(v / nx) % ny, Math.floor(v / (nx * ny))];
    if (values[v] >= 0 && !found.some((one) => String(one) === String(place))) found.push(place);
  }
  return found;
}

const index = ([x, y, z], [nx, ny] = DIMS) => x + nx * (y + ny * z);

for (const connectivity of [6, 18, 26]) {
  for (const engine of ['heap', 'bucket', 'relax', locus.Engine.BRICKS]) {
    test(`distances and labels, ${connectivity} neighbours, engine ${engine}`, async () => {
      const next = random();
      const [values, spacing] = [material(next), [1, 0.5, 2]];
      const seeds = places(next, values, 3);
      const graph = await locus.Graph.create({ dims: DIMS, material: values, spacing, connectivity });
      const diagram = new locus.Diagram(graph, { engine });
      diagram.addSeeds(seeds.map((position, i) => ({ position, id: 7 + i, distance: i === 1 ? 0.25 : 0 })));
      await diagram.solve();
      const each = seeds.map((seed, i) => distances(DIMS, values, [[seed, i === 1 ? 0.25 : 0]], spacing, connectivity));
      const wanted = each[0].map((_, v) => Math.min(...each.map((one) => one[v])));
      const { weightError, scale } = graph.info;
      close(diagram.distances(), wanted, weightError + 1e-6);
      const labels = diagram.labels();
      wanted.forEach((far, v) => {
        if (far === Infinity) assert.equal(labels[v], locus.NO_SEED);
        else close([each[labels[v] - 7][v]], [far], 2 * weightError + 1e-6);
      });
      close(Array.from(diagram.distancesExact(), (steps) => (steps === 2n ** 64n - 1n ? Infinity : Number(steps) / scale)), wanted, weightError + 1e-6);
      assert.equal(diagram.cellSizes.reduce((a, b) => a + b), wanted.filter(Number.isFinite).length);
      assert.deepEqual(diagram.seeds.map(({ id, distance }) => [id, distance]), [[7, 0], [8, 0.25], [9, 0]]);
    });
  }
}

test('paths go from a voxel to its seed', () => {
  const next = random(2);
  const values = material(next);
  const graph = new locus.Graph({ dims: DIMS, material: values });
  const diagram = new locus.Diagram(graph);
  const seeds = places(next, values, 2);
  diagram.addSeeds(seeds.map((position) => ({ position })));
  const exact = diagram.solveSync().distancesExact();
  for (const place of places(next, values, 20)) {
    const path = diagram.path(place);
    if (diagram.labels()[index(place)] === locus.NO_SEED) {
      assert.equal(path.length, 0);
      continue;
    }
    assert.deepEqual(path[0], place);
    assert.ok(seeds.some((seed) => String(seed) === String(path.at(-1))));
    const steps = path.slice(1).reduce((sum, to, i) => sum + graph.edgeWeight(index(path[i]), index(to)), 0n);
    assert.equal(steps, exact[index(place)]);
  }
});

test('edits update, and equal a fresh solve', async () => {
  const next = random(3);
  const dims = [10, 9, 8];
  const values = material(next, dims);
  const graph = new locus.Graph({ dims, material: values, materialRange: [0.1, 20] });
  const diagram = new locus.Diagram(graph);
  diagram.addSeeds(places(next, values, 4, dims).map((position) => ({ position, fixed: true })));
  await diagram.solve();
  const before = diagram.distancesExact();
  await graph.setBox({ origin: [4, 3, 2], extent: [4, 3, 3] }, 5);
  graph.setBoxSync({ extent: [2, 1, 1] }, [1.5, NaN]);
  graph.setVoxels([717, 718n], [3, 4]);
  const cut = graph.cutPlane([4.5, 0, 0], [1, 0, 0]);
  assert.ok(cut > 0);
  const change = await diagram.update();
  const after = diagram.distancesExact();
  const fresh = new locus.Diagram(graph, { engine: 'heap' });
  fresh.addSeeds(diagram.seeds);
  assert.deepEqual(fresh.solveSync().distancesExact(), after);
  const changed = before.reduce((list, old, v) => (old === after[v] ? list : [...list, v]), []);
  assert.ok(change.voxels >= changed.length && changed.length > 0);
  for (const v of changed) {
    [v % 10, Math.floor(v / 10) % 9, Math.floor(v / 90)].forEach((at, axis) => {
      const { origin, extent } = change.box;
      assert.ok(at >= origin[axis] && at < origin[axis] + extent[axis]);
    });
  }
  assert.equal(graph.mendBox(), cut);
  const corners = [4.5, -9, -9, 4.5, 99, -9, 4.5, 99, 99, 4.5, -9, 99];
  assert.equal(await graph.cutMesh(corners, [0, 1, 2, 0, 2, 3]), cut);
  assert.equal(graph.mendBox(), cut);
  assert.equal(graph.cutMeshSync(Float64Array.from(corners), Uint32Array.of(0, 1, 2, 0, 2, 3)), cut);
  assert.deepEqual([...graph.getBox({ extent: [2, 1, 1] })], [1.5, NaN]);
  assert.deepEqual([...graph.getBox({ origin: [7, 8, 7], extent: [2, 1, 1] })], [3, 4]);
  assert.equal(graph.getBox({ origin: [4, 3, 2], extent: [4, 3, 3] }).every((value) => value === 5), true);
  thrown(() => graph.cutMeshSync([1, 2], []), RangeError, /vertices has 2 numbers/);
});

test('Sibson weights by their definition', () => {
  const next = random(4);
  const dims = [6, 5, 4];
  const values = material(next, dims);
  const seeds = places(next, values, 4, dims);
  const ids = [3, 1, 4, 5];
  const diagram = new locus.Diagram(new locus.Graph({ dims, material: values, precision: 1e-4 }));
  diagram.addSeeds(seeds.map((position, i) => ({ position, id: ids[i] })));
  const labels = diagram.solveSync().labels();
  const dense = new locus.Weights(diagram).dense();
  const nearest = distances(dims, values, seeds.map((seed) => [seed, 0]));
  let tried = 0;
  for (const place of places(next, values, 25, dims)) {
    const row = [...dense.subarray(4 * index(place, dims), 4 * index(place, dims) + 4)];
    if (nearest[index(place, dims)] === Infinity) assert.deepEqual(row, [0, 0, 0, 0]);
    if (nearest[index(place, dims)] === Infinity || seeds.some((seed) => String(seed) === String(place))) continue;
    const mine = distances(dims, values, [[place, 0]]);
    // Ties, which rounding decides, are left out.
    const tie = (v) => Number.isFinite(mine[v]) && Math.abs(mine[v] - nearest[v]) <= 1e-3 * (1 + nearest[v]);
    const stolen = (v) => Number.isFinite(mine[v]) && mine[v] < nearest[v] && !tie(v);
    const all = Array.from(labels.keys());
    const counts = ids.map((id) => all.filter((v) => stolen(v) && labels[v] === id).length);
    const sum = Math.max(counts.reduce((a, b) => a + b), 1);
    const slack = all.filter(tie).length / sum + 1e-6;
    counts.forEach((count, i) => assert.ok(Math.abs(row[i] - count / sum) <= slack, `${row} at ${place}`));
    tried += 1;
  }
  assert.ok(tried > 10);
});

test('weights in their forms', async () => {
  const diagram = new locus.Diagram(new locus.Graph({ dims: [9, 9, 1], material: new Array(81).fill(1) }));
  await diagram.placeSeeds({ count: 4, firstId: 10 });
  await diagram.solve();
  for (const method of Object.values(locus.Method)) {
    const weights = await locus.Weights.create(diagram, { method });
    const { offsets, ids, values } = weights.rows();
    const dense = weights.dense();
    assert.equal(weights.length, 81);
    assert.equal(ids.length, weights.entries);
    const rebuilt = new Float32Array(81 * 4);
    for (let row = 0; row < 81; ++row) for (let i = offsets[row]; i < offsets[row + 1]; ++i) rebuilt[4 * row + ids[i] - 10] = values[i];
    assert.deepEqual(rebuilt, dense);
    const given = Float32Array.from({ length: 12 }, random(5));
    const wanted = Array.from({ length: 81 * 3 }, (_, at) =>
      [0, 1, 2, 3].reduce((sum, seed) => sum + dense[4 * Math.floor(at / 3) + seed] * given[3 * seed + (at % 3)], 0),
    );
    close(await weights.interpolate(given, { components: 3 }), wanted, 1e-5);
    assert.deepEqual(weights.interpolateSync(given, { components: 3, first: 80 }), (await weights.interpolate(given, { components: 3 })).slice(240));
    const gradients = weights.gradients(10);
    for (let v = 10; v < 17; ++v) assert.ok(Math.abs(gradients[3 * v] - (dense[4 * (v + 1)] - dense[4 * (v - 1)]) / 2) < 1e-6);
  }
  const some = new locus.Weights(diagram, { voxels: [40, 0n], maxPerRow: 1 });
  assert.deepEqual([some.length, some.entries, some.seedIds], [2, 2, [10, 11, 12, 13]]);
  thrown(() => some.gradients(10), locus.StateError);
  thrown(() => some.interpolateSync([1, 2, 3]), RangeError, /values has 3 numbers instead of 4/);
  thrown(() => some.rows({ first: 1, count: 2 }), locus.ArgumentError);
  const part = new locus.Weights(diagram, { box: { origin: [3, 2, 0], extent: [5, 2, 1] } });
  const whole = new locus.Weights(diagram).dense();
  assert.deepEqual(part.dense([10]), Float32Array.from({ length: 10 }, (_, i) => whole[4 * (3 + (i % 5) + 9 * (2 + Math.floor(i / 5)))]));
});

test('weights follow their diagram', async () => {
  const diagram = new locus.Diagram(new locus.Graph({ dims: [9, 9, 1], material: new Array(81).fill(1) }));
  diagram.addSeeds([{ position: [0, 0, 0] }, { position: [8, 8, 0] }]);
  await diagram.solve();
  const both = [new locus.Weights(diagram, { method: 'laplace' }), await locus.Weights.create(diagram, { method: 'laplace' })];
  diagram.addSeeds([{ x: 8, y: 0, z: 0 }]);
  assert.deepEqual(diagram.seeds.map(({ id }) => id), [0, 1, 2]);
  await diagram.update();
  const changed = [both[0].updateSync(), await both[1].update({ progress: () => true })];
  assert.ok(changed[0].length > 0);
  assert.deepEqual(changed[1], changed[0]);
  const wanted = new locus.Weights(diagram, { method: 'laplace' }).dense();
  for (const weights of both) assert.deepEqual(weights.dense(), wanted);
  diagram.moveSeed(2, [7, 1, 0]);
  diagram.updateSync();
  assert.deepEqual(await both[0].update(), both[1].updateSync());
});

test('seeds move and go; traces and infos', () => {
  const graph = new locus.Graph({ dims: [5, 1, 1], material: [1, 1, 1, 1, 1] });
  const diagram = new locus.Diagram(graph);
  diagram.addSeeds([{ position: [0, 0, 0], id: 7 }, { position: [4, 0, 0], id: 8 }]);
  diagram.moveSeed(8, [2, 0, 0]);
  assert.deepEqual([...diagram.solveSync().labels()], [7, 7, 8, 8, 8]);
  assert.deepEqual(diagram.cellPairs, [{ a: 7, b: 8, edges: 1 }]);
  diagram.removeSeeds(7);
  assert.deepEqual([...diagram.solveSync().labels()], [8, 8, 8, 8, 8]);
  const traced = new locus.Diagram(graph, { engine: 'relax', recordTrace: true, maxDistance: 3, grain: [16, 8, 1], stream: 0n, onDevice: true });
  traced.addSeeds([{ position: [0, 0, 0] }]);
  traced.solveSync();
  assert.equal(traced.trace.length, traced.stats.iterations);
  assert.equal(traced.distances()[4], Infinity);
  thrown(() => new locus.Diagram(graph, { grain: [1, 1] }), TypeError, /grain must be three numbers/);
  const { info } = new locus.Graph({ dims: [4, 3, 2], materialRange: [1, 2], spacing: [1, 2, 3] });
  assert.deepEqual([info.dims, info.spacing, info.passable], [[4, 3, 2], [1, 2, 3], 0]);
});

test('results go into the arrays that are given', () => {
  const diagram = new locus.Diagram(new locus.Graph({ dims: [5, 4, 3], material: new Float32Array(60).fill(1) }));
  diagram.addSeeds([{ position: [0, 0, 0] }]);
  diagram.solveSync();
  const whole = new Float32Array(100);
  const out = whole.subarray(20, 80);
  assert.equal(diagram.distances(null, out), out);
  assert.deepEqual([...whole.slice(19, 23)], [0, 0, 1, 2]);
  thrown(() => diagram.distances(null, new Float32Array(59)), RangeError, /Float32Array of 60 elements/);
  thrown(() => diagram.distances(null, new Float64Array(60)), RangeError, /not Float64Array/);
});
