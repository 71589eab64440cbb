// Errors, callbacks, cancelling, and calls beside each other.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { NOON, posts, thrown } from './common.js';

class Mine extends Error {}
const raising = () => {
  throw new Mine('mine');
};

function solvable(side = 40, options = {}) {
  const dims = [side, side, side];
  const diagram = new locus.Diagram(new locus.Graph({ dims, material: new Float32Array(side ** 3).fill(1), ...options }), { engine: 'heap' });
  diagram.addSeeds([{ position: [0, 0, 0] }]);
  return diagram;
}

test('every failing promise has the text of its own call', async () => {
  const store = new locus.Store();
  const graph = new locus.Graph({ dims: [4, 4, 4], material: new Float32Array(64).fill(1) });
  const calls = Array.from({ length: 600 }, (_, i) =>
    i % 3 === 0 ? store.nearest(1, { latitude: 100 + i, longitude: 0 })
    : i % 3 === 1 ? store.tile({ zoom: 3, x: 100 + i, y: 0 })
    : locus.Graph.create({ dims: [1, 1, 1], connectivity: 100 + i }),
  );
  const good = Array.from({ length: 100 }, () => store.count());
  const settled = await Promise.allSettled(calls);
  settled.forEach(({ reason }, i) => {
    assert.ok(reason instanceof locus.ArgumentError);
    assert.match(reason.message, new RegExp(`\\b${100 + i}\\b`));
    assert.match(reason.message, [/^locus_pmq_nearest: /, /^locus_pmq_tile: /, /^locus_graph_create: /][i % 3]);
    assert.equal(reason.code, 'LOCUS_E_ARGUMENT');
    assert.equal(reason.status, locus.Status.ARGUMENT);
  });
  assert.deepEqual(await Promise.all(good), new Array(100).fill(0));
  // The other library's too, and none is mixed up with this thread's.
  thrown(() => graph.edgeWeight(0, 1000), locus.ArgumentError, /1000/);
  const files = await Promise.allSettled(Array.from({ length: 50 }, (_, i) => locus.readVolume(`/none-${i}.mha`)));
  files.forEach(({ reason }, i) => {
    assert.ok(reason instanceof locus.IoError);
    assert.match(reason.message, new RegExp(`/none-${i}\\.mha`));
  });
});

test('a call on a worker lets this thread go on', async () => {
  const diagram = solvable(64);
  let turns = 0;
  const timer = setInterval(() => (turns += 1), 1);
  await diagram.solve();
  clearInterval(timer);
  assert.ok(turns > 0);
  assert.equal(diagram.stats.reached, 64 ** 3);
});

test('every status has its class', () => {
  const error = thrown(() => new locus.Graph({ dims: [3, 1, 1], material: [1, 1, 1], connectivity: 7 }), locus.ArgumentError, /connectivity is 7/);
  assert.ok(error instanceof locus.LocusError && error.name === 'ArgumentError' && error.code === 'LOCUS_E_ARGUMENT');
  thrown(() => solvable(3).labels(), locus.StateError);
  thrown(() => new locus.Graph({}), TypeError, /dims/);
  thrown(() => new locus.Graph(), TypeError, /dims/);
  thrown(() => new locus.Graph({ dims: [3, 1, 1], material: [1, 'x', 1] }), TypeError, /material must be a number, not 'x'/);
  thrown(() => new locus.Graph({ dims: [3, 1, 1], connectivity: -1 }), RangeError, /connectivity is -1/);
  thrown(() => new locus.Graph({ dims: [3, 1, 1], threads: 1.5 }), TypeError, /threads must be an integer, not 1.5/);
  thrown(() => new locus.Graph({ dims: [3, 1, 1], weightRule: 'none' }), RangeError, /weightRule is 'none', not one of mean_compliance/);
  thrown(() => locus.fileInfo('a\0b'), TypeError, /NUL/);
  thrown(() => new locus.Store({ sink: 5 }), TypeError, /sink must be a function/);
});

test('progress reports and cancels', async () => {
  const told = [];
  await solvable().solve({ progress: (fraction) => void told.push(fraction) });
  solvable().solveSync({ progress: (fraction) => void told.push(fraction) });
  assert.ok(told.length >= 2 && told.every((fraction) => fraction >= 0 && fraction <= 1));
  for (const stop of [() => false, raising]) {
    const kind = stop === raising ? Mine : locus.StoppedError;
    const diagram = solvable(40);
    thrown(() => diagram.solveSync({ progress: stop }), kind);
    thrown(() => diagram.labels(), locus.StateError);
    await assert.rejects(diagram.solve({ progress: stop }), kind);
    await assert.rejects(diagram.placeSeeds({ count: 50, progress: stop }), kind);
    thrown(() => diagram.placeSeedsSync({ count: 50, progress: stop }), kind);
    assert.equal(diagram.seeds.length, 1);
  }
  const solved = await solvable(24).solve();
  solved.addSeeds([{ position: [23, 23, 23] }]);
  await solved.solve();
  thrown(() => new locus.Weights(solved, { progress: () => false }), locus.StoppedError);
  await assert.rejects(locus.Weights.create(solved, { progress: raising }), Mine);
});

test('a signal cancels', async () => {
  const diagram = solvable(80);
  const reason = new Error('enough');
  const early = AbortSignal.abort(reason);
  await assert.rejects(diagram.solve({ signal: early }), (error) => error === reason);
  const controller = new AbortController();
  const work = diagram.solve({ signal: controller.signal, progress: () => controller.abort(reason) });
  await assert.rejects(work, (error) => error === reason);
  thrown(() => diagram.labels(), locus.StateError);
  await diagram.solve({ signal: new AbortController().signal });
});

test('what a function throws comes out of the call', async () => {
  const store = new locus.Store();
  store.insertSync(posts(10), NOON + 1e9);
  let calls = 0;
  const bad = { filter: () => (calls += 1) && raising() };
  for (const call of [
    () => store.countSync(bad),
    () => store.readSync(bad),
    () => store.eraseSync(bad),
    () => store.visitSync(raising),
    () => store.visitSync(() => true, bad),
    () => store.groupsSync(raising),
    () => store.groupsSync(() => -1),
    () => store.weightedTileSync(raising, { zoom: 0, x: 0, y: 0 }),
    () => [...store.pagesSync({ size: 5, query: bad })],
  ]) {
    calls = 0;
    assert.throws(call, (error) => error instanceof Mine || error instanceof RangeError);
    assert.ok(calls <= 1);
  }
  assert.equal(store.countSync(), 10);
  const removing = new locus.Store({ remove: raising });
  removing.insertSync(new removing.Records(0), NOON);
  assert.throws(() => {
    removing.insertSync(posts(10), NOON + 1e9);
    removing.sweepSync(NOON + 1e9);
  }, Mine);
  assert.equal(removing.countSync(), 10);
});

test('functions of promises are refused, and change nothing', async () => {
  const store = new locus.Store({ sink: () => {} });
  store.insertSync(posts(10), NOON + 1e9);
  await assert.rejects(store.count({ filter: () => true }), /Store.count: .* use Store.countSync/);
  await assert.rejects(store.insert(posts(1), NOON + 2e9), locus.UnsupportedError);
  await assert.rejects(store.sweep(NOON + 2e9), locus.UnsupportedError);
  assert.equal(await store.count(), 10);
  const lines = [];
  const graph = new locus.Graph({ dims: [3, 1, 1], material: [1, 1, 1], log: (level, text) => lines.push([level, text]) });
  assert.ok(lines.length > 0 && Object.values(locus.LogLevel).includes(lines[0][0]) && typeof lines[0][1] === 'string');
  const diagram = new locus.Diagram(graph);
  diagram.addSeeds([{ position: [0, 0, 0] }]);
  await assert.rejects(diagram.solve(), locus.UnsupportedError);
  diagram.solveSync();
});

test('weight functions, and one that throws', () => {
  const material = new Float32Array(120).fill(1);
  const options = { dims: [6, 5, 4], material, weightRule: 'caller', materialRange: [1, 4], threads: 4 };
  const graph = new locus.Graph({ ...options, connectivity: 6, weight: (u, v, length) => (assert.ok(u < v), 2 * length) });
  const diagram = new locus.Diagram(graph);
  diagram.addSeeds([{ position: [0, 0, 0] }]);
  graph.dispose();
  assert.equal(diagram.solveSync().distances()[119], 24);
  for (const engine of ['heap', 'bucket', 'relax', 'bricks']) {
    let left = 40;
    const failing = new locus.Graph({ ...options, weight: (u, v, length) => ((left -= 1) < 0 ? raising() : 2 * length) });
    const half = new locus.Diagram(failing, { engine });
    half.addSeeds([{ position: [0, 0, 0] }]);
    assert.throws(() => half.solveSync(), Mine);
    thrown(() => half.labels(), locus.StateError);
  }
  assert.throws(() => new locus.Graph({ ...options, materialRange: undefined, weight: raising }), Mine);
});

test('calls that exclude each other are refused', async () => {
  const diagram = solvable();
  const refused = [];
  const inside = () => {
    for (const call of [
      () => diagram.solveSync(),
      () => diagram.labels(),
      () => diagram.graph.setBoxSync(null, 2),
      () => diagram.addSeeds([{ position: [1, 1, 1] }]),
      () => diagram.dispose(),
    ]) {
      refused.push(thrown(call, locus.BusyError).message);
    }
    return false;
  };
  thrown(() => diagram.solveSync({ progress: inside }), locus.StoppedError);
  assert.equal(refused.length, 5);
  const work = diagram.solve();
  await assert.rejects(diagram.solve(), locus.BusyError);
  thrown(() => diagram.dispose(), locus.BusyError);
  thrown(() => diagram.graph.dispose(), locus.BusyError);
  await work;
  diagram.dispose();
  diagram.dispose();
  thrown(() => diagram.labels(), locus.StateError, /disposed/);
});

test('objects end well: disposed of, collected, at exit', () => {
  const program = `
    import * as locus from ${JSON.stringify(new URL('../lib/index.js', import.meta.url).href)};
    for (let i = 0; i < 50; ++i) {
      const graph = new locus.Graph({ dims: [8, 8, 8], material: new Float32Array(512).fill(1), log: () => {} });
      const diagram = new locus.Diagram(graph);
      diagram.addSeeds([{ position: [0, 0, 0] }]);
      diagram.solveSync();
      new locus.Weights(diagram);
      const store = new locus.Store({ sink: console.log });
      store.insertSync(new locus.Point32Array(5), 5);
      store.snapshot();
      if (i % 2) graph.dispose();
      if (i % 10 === 0) { globalThis.gc(); await new Promise(setImmediate); }
    }
    const big = new locus.Diagram(new locus.Graph({ dims: [128, 128, 128], material: new Float32Array(128 ** 3).fill(1) }), { engine: 'heap' });
    big.addSeeds([{ position: [0, 0, 0] }]);
    big.solve().catch(() => {});
    setTimeout(() => process.exit(3), 50);`;
  const done = spawnSync(process.execPath, ['--expose-gc', '--input-type=module', '-e', program], { encoding: 'utf8', timeout: 60000 });
  assert.deepEqual([done.status, done.stdout, done.stderr], [3, '', '']);
});
