// The cold tier, against a store that keeps everything.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { NOON, posts, random, scratch, thrown } from './common.js';

const INDEX = new URL('../lib/index.js', import.meta.url).href;

/** Records, some of them at one place. */
function crowded(count) {
  const records = posts(count, random(5));
  for (let i = 0; i < count; i += 7) Object.assign(records.at(i), { latitude: 48.5, longitude: 2.5 });
  return records;
}

/** A window of three minutes with its tier, and a store that keeps everything. */
function both(path, records, given = {}, options = {}) {
  const tier = new locus.Cold(path, given);
  const store = new locus.Store({ horizon: 3 * locus.MINUTE, cold: tier, ...options });
  const everything = new locus.Store();
  for (let from = 0; from < records.length; from += 50) {
    const batch = records.subarray(from, from + 50);
    for (const one of [store, everything]) one.insertSync(batch, batch.at(-1).time);
  }
  return { tier, store, everything };
}

for (const layout of ['ring_leaves', 'packed_array']) {
  test(`store and tier answer together: ${layout}`, async (t) => {
    const records = crowded(2000);
    const { tier, store, everything } = both(scratch(t)('tier.db'), records, {}, { layout });
    const queries = [
      undefined,
      { box: [-30, -20, 55, 60] },
      { circle: [48.5, 2.5, 2e6], since: NOON + 5 * locus.MINUTE, until: NOON + 31 * locus.MINUTE },
      { polygon: [[[-41, -100], [-59, 90], [50, 100]]] },
    ];
    for (const when of ['at once', 'in the file']) {
      assert.ok((await tier.count(store)) === 2000 && store.countSync() < 250, when);
      for (const query of queries) {
        const wanted = everything.readSync(query);
        assert.deepEqual((await tier.read(store, query)).bytes, wanted.bytes);
        assert.deepEqual([await tier.count(store, query), tier.countSync(store, query)], [wanted.length, wanted.length]);
      }
      const filtered = { filter: (record) => record.device === 3 };
      assert.deepEqual(tier.readSync(store, filtered).bytes, everything.readSync(filtered).bytes);
      await store.sweep(records.at(-1).time);
      await tier.flush();
    }
    await tier.check();
    tier.checkSync();
    assert.equal(tier.countSync(), 2000 - store.countSync());
    const out = new locus.Point32Array(2000);
    assert.equal((await tier.read(store, undefined, out)).buffer, out.buffer);
    await assert.rejects(tier.read(store, {}, out.subarray(0, 10)), locus.CapacityError);
    const { received, written, failure } = tier.stats;
    assert.deepEqual([received, written, failure], [tier.countSync(), received, 0]);
  });
}

test('the moment of a snapshot', async (t) => {
  const { tier, store, everything } = both(scratch(t)('tier.db'), posts(1000));
  const moment = store.snapshot();
  await store.erase();
  assert.deepEqual((await tier.read(moment)).bytes, everything.readSync().bytes);
  assert.equal(await tier.count(null), 1000);
});

test('visitors', (t) => {
  const records = posts(500);
  const { tier, store, everything } = both(scratch(t)('tier.db'), records);
  const seen = [];
  assert.equal(tier.visitSync(({ spare }) => void seen.push(spare), store), true);
  assert.deepEqual(seen, everything.readSync().column('spare'));
  assert.equal(tier.visitSync(() => false, store), false);
  const bad = () => {
    throw new RangeError('mine');
  };
  thrown(() => tier.visitSync(bad, store), RangeError, /mine/);
  thrown(() => tier.countSync(store, { filter: bad }), RangeError, /mine/);
  const now = records.at(-1).time;
  const inside = [
    () => tier.countSync(), () => tier.flushSync(), () => tier.checkSync(), () => tier.stats, () => tier.sweep(now), () => tier.rewindSync(0),
    () => tier.dispose(), () => store.insertSync(records.subarray(0, 0), now), () => store.sweepSync(now), () => store.eraseSync(),
  ];
  tier.visitSync(() => {
    for (const one of inside) thrown(one, locus.BusyError);
    return false;
  }, store);
  assert.equal(tier.countSync(store), 500);
});

test('functions of promises are refused', async (t) => {
  const { tier, store } = both(scratch(t)('tier.db'), posts(10));
  await assert.rejects(tier.count(store, { filter: () => true }), locus.UnsupportedError);
});

test('age, restart and rewind', async (t) => {
  const path = scratch(t)('tier.db');
  const records = posts(600);
  const { tier, store } = both(path, records, { maxAge: 5 * locus.MINUTE, sync: 'full', delay: 1000 });
  const end = records.at(-1).time;
  store.sweepSync(end);
  tier.sweep(end);
  await tier.flush();
  const young = records.column('time').filter((time) => time >= end - 5 * locus.MINUTE).length;
  assert.deepEqual([await tier.count(store), tier.stats.removed], [young, 600 - young]);
  thrown(() => tier.sweep(0), locus.ArgumentError, /now is 0/);
  await assert.rejects(tier.rewind(0), locus.StateError);
  await assert.rejects(locus.Cold.open(path), locus.BusyError);
  thrown(() => tier.dispose(), locus.StateError, /a store is attached/);
  const [kept, { received }] = [tier.countSync(), tier.stats];
  store.dispose();
  tier.dispose();
  thrown(() => tier.countSync(), locus.StateError, /disposed/);
  await assert.rejects(locus.Cold.open(path, { record: 'text156' }), (error) => /holds records of 32 bytes/.test(error.message));
  const again = await locus.Cold.open(path);
  assert.equal(await again.count(), kept);
  await again.rewind(received - 10);
  assert.equal(again.countSync(), kept - 10);
  thrown(() => again.rewindSync(received), locus.ArgumentError, /received is/);
});

test('one store at a time', async (t) => {
  const file = scratch(t);
  const tier = new locus.Cold(file('tier.db'));
  const store = new locus.Store({ cold: tier });
  thrown(() => new locus.Store({ cold: tier }), locus.StateError, /another store/);
  thrown(() => tier.countSync(new locus.Store()), locus.ArgumentError, /without this tier/);
  thrown(() => new locus.Store({ cold: {} }), TypeError, /cold must be a Cold/);
  store.insertSync(posts(10), NOON + 1e9);
  store.eraseSync();
  store.saveSync(file('store'));
  store.dispose();
  thrown(() => new locus.Store({ cold: tier, sink: () => {} }), locus.ArgumentError, /sink is set/);
  thrown(() => new locus.Store({ cold: tier, record: 'text156' }), locus.ArgumentError, /record is 156/);
  await assert.rejects(locus.Store.load(file('none'), { record: 'point32', cold: tier }), locus.IoError);
  const again = await locus.Store.load(file('store'), { cold: tier });
  await again.insert(posts(5), NOON + 1e9);
  assert.equal(await tier.count(again), 15);
});

test('questions beside the writer', async (t) => {
  const records = posts(20_000);
  const tier = await locus.Cold.open(scratch(t)('tier.db'), { queueBytes: 2 ** 20 });
  const store = new locus.Store({ horizon: 3 * locus.MINUTE, cold: tier });
  let done = false;
  const ask = async () => {
    while (!done) {
      assert.equal((await tier.count(store)) % 100, 0);
      assert.equal((await tier.read(store)).length % 100, 0);
    }
  };
  const asking = [ask(), ask()];
  for (let from = 0; from < 20_000; from += 100) {
    const batch = records.subarray(from, from + 100);
    await store.insert(batch, batch.at(-1).time);
  }
  done = true;
  await Promise.all(asking);
  assert.equal(await tier.count(store), 20_000);
});

test('texts', (t) => {
  const tier = new locus.Cold(scratch(t)('tier.db'), { record: 'text156' });
  const store = new locus.Store({ record: 'text156', cold: tier });
  store.insertSync(new locus.Text156Array([{ text: 'Zürich', time: NOON }]), NOON);
  store.eraseSync();
  assert.equal(tier.Records, locus.Text156Array);
  assert.equal(tier.readSync(store).at(0).text, 'Zürich');
});

test('errors of a tier', async (t) => {
  const file = scratch(t);
  await assert.rejects(locus.Cold.open(file('none/tier.db')), (error) => error instanceof locus.IoError && /none\/tier.db/.test(error.message));
  writeFileSync(file('text'), 'this is no database');
  thrown(() => new locus.Cold(file('text')), locus.FormatError);
  thrown(() => new locus.Cold(file('tier.db'), { queueBytes: 1 }), locus.ArgumentError, /queue_bytes is 1/);
  thrown(() => new locus.Cold(file('tier.db'), { sync: 'slow' }), RangeError, /slow/);
});

/** Run a program that imports the package. */
function node(program, variables = {}) {
  const env = { ...process.env, ...variables };
  return spawnSync(process.execPath, ['--input-type=module', '-e', `import * as locus from '${INDEX}';${program}`], { encoding: 'utf8', env });
}

test('only the tier needs its library', () => {
  const done = node('new locus.Store().countSync(); new locus.Cold("tier.db");', { LOCUS_COLD_LIBRARY: '/none/liblocus_cold.so' });
  assert.match(done.stderr, /LibraryError: LOCUS_COLD_LIBRARY is \/none\/liblocus_cold.so/);
});

test('a process that exits writes what is queued', (t) => {
  const path = scratch(t)('tier.db');
  const done = node(`
    const tier = new locus.Cold(${JSON.stringify(path)}), store = new locus.Store({ cold: tier });
    store.insertSync(new locus.Point32Array(10), 0);
    store.eraseSync();`);
  assert.deepEqual([done.status, done.stderr], [0, '']);
  assert.equal(new locus.Cold(path).countSync(), 10);
});
