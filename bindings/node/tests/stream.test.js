// Stores against plain arrays of records.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { NOON, close, metres, posts, random, thrown } from './common.js';

const LAYOUTS = { ring: {}, implicit: { layout: 'packed_array' }, explicit: { layout: 'packed array', index: locus.Index.EXPLICIT } };

async function filled(options) {
  const records = posts(3000);
  const store = new locus.Store(options);
  for (let from = 0; from < 3000; from += 430) {
    const batch = records.subarray(from, Math.min(from + 430, 3000));
    if (from % 860 === 0) await store.insert(batch, batch.at(-1).time);
    else store.insertSync(batch, batch.at(-1).time);
  }
  return { store, all: [...records].map((record) => record.toJSON()) };
}

const spares = (records) => [...records].map(({ spare }) => spare);
const sorted = (numbers) => numbers.sort((a, b) => a - b);
const same = (found, wanted) => assert.deepEqual(sorted(spares(found)), sorted(spares(wanted)));

for (const [name, options] of Object.entries(LAYOUTS)) {
  test(`regions, times and order: ${name}`, async () => {
    const { store, all } = await filled(options);
    const inside = ({ latitude, longitude }) => latitude >= -30 && latitude <= 50 && longitude >= -20 && longitude <= 70;
    const box = { box: { south: -30, west: -20, north: 50, east: 70 } };
    same(await store.read(box), all.filter(inside));
    assert.equal(store.countSync(box), all.filter(inside).length);
    assert.equal(await store.count(), 3000);
    same(store.readSync({ ...box, anyOrder: true }), all.filter(inside));
    same(store.readSync({ box: [-90, 170, 90, -170] }), all.filter(({ longitude }) => longitude >= 170 || longitude <= -170));
    const middle = { latitude: 10, longitude: 20 };
    same(await store.read({ circle: { ...middle, radius: 3e6 } }), all.filter((record) => metres(middle, record) <= 3e6));
    const ring = [[-30, -20], [-30, 70], [50, 70], [50, -20]];
    const hole = [{ latitude: 0, longitude: 0 }, { latitude: 0, longitude: 10 }, [10, 10], [10, 0]];
    const inHole = ({ latitude, longitude }) => latitude > 0 && latitude < 10 && longitude > 0 && longitude < 10;
    same(await store.read({ polygon: [ring, hole] }), all.filter((record) => inside(record) && !inHole(record)));
    same(await store.read({ since: NOON + 1e9 }), all.filter(({ time }) => time >= NOON + 1e9));
    assert.equal(await store.count({ until: new Date(1_700_000_010_000) }), 11);
    assert.equal(await store.count({ until: BigInt(NOON) + 10_000_000n }), 11);
    same(store.readSync({ filter: ({ device }) => device === 3, since: NOON }), all.filter(({ device }) => device === 3));
    thrown(() => store.countSync({ box: [0, 0, 1, 1], circle: [0, 0, 1] }), TypeError, /one region/);
    thrown(() => store.countSync({ box: [0, 0, 1] }), TypeError, /box is \{ south, west, north, east \}/);

    const everything = await store.read();
    const keys = [...everything].map(({ latitude, longitude }) => locus.pmqKey(latitude, longitude));
    assert.ok(keys.every((key, i) => i === 0 || keys[i - 1] <= key));
    const pages = [...store.pagesSync({ size: 100 })];
    for (let i = 0, at = 0; i < pages.length; at += pages[i].length, ++i) {
      assert.deepEqual(pages[i].bytes, everything.subarray(at, at + pages[i].length).bytes);
    }
    let read = 0;
    for await (const page of store.pages({ size: 700, query: { since: NOON } })) read += page.length;
    assert.equal(read, 3000);
    const seen = [];
    assert.equal(store.visitSync(({ spare }) => void seen.push(spare)), true);
    assert.deepEqual(seen, spares(everything));
    assert.equal(store.visitSync(({ spare }) => spare !== seen[2]), false);
    const room = new locus.Point32Array(3000);
    assert.equal((await store.read({}, room)).buffer, room.buffer);
    thrown(() => store.readSync({}, room.subarray(0, 10)), locus.CapacityError, /3000/);
  });

  test(`groups, tiles, nearest and best: ${name}`, async () => {
    const { store, all } = await filled(options);
    const groups = await store.groups('device');
    assert.deepEqual(
      Object.fromEntries(groups.map(({ value, count }) => [value, count])),
      Object.fromEntries([0, 1, 2, 3, 4].map((device) => [device, all.filter((record) => record.device === device).length])),
    );
    assert.ok(groups.every(({ count }, i) => i === 0 || groups[i - 1].count >= count));
    assert.equal(store.groupsSync(({ spare }) => BigInt(spare)).length, 3000);
    assert.equal(store.groupsSync(locus.Field.DEVICE)[0].newest <= NOON + 3e9, true);
    const bins = await store.tile({ zoom: 0, x: 0, y: 0, log2Bins: 2 });
    assert.equal(bins.length, 16);
    const columns = [0, 1, 2, 3].map((x) => [0, 1, 2, 3].reduce((sum, y) => sum + bins[4 * y + x], 0));
    const wanted = [0, 0, 0, 0];
    for (const { longitude } of all) wanted[Math.min(3, Math.floor((longitude + 180) / 90))] += 1;
    assert.deepEqual(columns, wanted);
    const weighted = store.weightedTileSync(({ device }) => device, { zoom: 0, x: 0, y: 0, log2Bins: 2 });
    assert.equal(weighted.reduce((a, b) => a + b), all.reduce((sum, { device }) => sum + device, 0));
    thrown(() => store.weightedTileSync(() => NaN, { zoom: 0, x: 0, y: 0 }), locus.ArgumentError);
    thrown(() => store.tileSync({ zoom: -1, x: 0, y: 0 }), RangeError, /zoom is -1/);

    const place = { latitude: 40, longitude: 50 };
    const far = all.map((record) => ({ ...record, far: metres(place, record) }));
    const nearest = await store.nearest(10, place);
    const closest = [...far].sort((a, b) => a.far - b.far).slice(0, 10);
    close(nearest.values, closest.map((one) => one.far), 1e-9);
    assert.deepEqual(spares(nearest.records), spares(closest));
    const now = all.at(-1).time;
    const scores = far.filter((one) => one.far <= 5e6 && now - one.time <= 2e9).map((one) => (0.5 * one.far) / 5e6 + (0.5 * (now - one.time)) / 2e9);
    const best = store.topkSync(8, { ...place, radius: 5e6, alpha: 0.5, period: 2000 * locus.SECOND });
    close(best.values, scores.sort((a, b) => a - b).slice(0, 8), 1e-9);
    assert.equal((await store.nearest(5000, place)).records.length, 3000);
    await assert.rejects(store.topk(0, place), locus.ArgumentError);
  });
}

test('pages of one place', () => {
  const records = posts(300);
  for (const record of records) Object.assign(record, { latitude: 1, longitude: 2 });
  const store = new locus.Store();
  store.insertSync(records, NOON + 1e9);
  assert.deepEqual([...store.pagesSync({ size: 7 })].flatMap(spares), spares(records));
});

test('windows, predicates and sinks', () => {
  const records = posts(10000);
  const now = records.at(-1).time;
  const gone = [];
  const store = new locus.Store({ horizon: 1000 * locus.SECOND, sink: (left) => gone.push(left), remove: ({ device }) => device === 4 });
  store.insertSync(records, now);
  store.sweepSync(now);
  const leaves = ({ time, device }) => time < now - 1e9 || device === 4;
  same(gone.flatMap((left) => [...left]), [...records].filter(leaves));
  same(store.readSync(), [...records].filter((record) => !leaves(record)));
  assert.ok(gone.every((left) => left.length <= 4096 && left instanceof locus.Point32Array));
  const before = gone.length;
  const erased = store.eraseSync({ box: [0, -180, 90, 180] });
  assert.equal(erased, gone.slice(before).reduce((sum, left) => sum + left.length, 0));
  store.checkSync();
  assert.equal(store.stats.erased, erased);
  const limited = new locus.Store({ maxRecords: 500 });
  limited.insertSync(records, now);
  assert.ok(limited.countSync() >= 468 && limited.countSync() <= 500);
});

test('a sink that throws loses nothing', () => {
  const taken = [];
  let full = true;
  const store = new locus.Store({
    sink: (records) => {
      if (full) throw new Error('the disk is full');
      taken.push(...spares(records));
    },
  });
  store.insertSync(posts(9000), NOON + 1e10);
  assert.throws(() => store.eraseSync(), /the disk is full/);
  assert.throws(() => store.sweepSync(NOON + 1e10), /the disk is full/);
  full = false;
  store.sweepSync(NOON + 1e10);
  assert.deepEqual(sorted(taken), Array.from({ length: 9000 }, (_, i) => i));
});

test('snapshots, and readers beside the writer', async () => {
  const store = new locus.Store();
  await store.insert(posts(100), NOON + 1e9);
  const before = store.snapshot();
  await store.insert(posts(50), NOON + 1e9);
  assert.deepEqual([await before.count(), await store.count()], [100, 150]);
  assert.deepEqual([...(await before.tile({ zoom: 0, x: 0, y: 0, log2Bins: 0 }))], [100]);
  assert.equal([...before.pagesSync({ size: 7 })].reduce((sum, page) => sum + page.length, 0), 100);
  before.dispose();
  before.dispose();
  thrown(() => before.countSync(), locus.StateError);
  thrown(() => new locus.Store({ layout: 'packed_array' }).snapshot(), locus.UnsupportedError);
  const busy = new locus.Store();
  const reads = [];
  for (let i = 0; i < 40; ++i) {
    reads.push(busy.count());
    await busy.insert(posts(100, random(i), NOON + i * 1e9), NOON + i * 1e9 + 1e9);
  }
  assert.ok((await Promise.all(reads)).every((count) => count % 100 === 0));
  const work = busy.insert(posts(1, random(), NOON + 1e12), NOON + 1e12);
  thrown(() => busy.dispose(), locus.BusyError);
  await work;
});

test('records are views over their memory', () => {
  const memory = new ArrayBuffer(200);
  const records = new locus.Point32Array(memory, 8, 3);
  records.set(1, { latitude: 1.5, time: new Date(5), device: 65535 });
  const bytes = new DataView(memory);
  assert.deepEqual([bytes.getFloat64(40, true), bytes.getBigInt64(56, true), bytes.getUint16(64, true)], [1.5, 5000n, 65535]);
  const view = records.at(1);
  view.longitude = -2;
  assert.deepEqual(records.at(-2).toJSON(), { latitude: 1.5, longitude: -2, time: 5000, device: 65535, application: 0, language: 0, spare: 0 });
  assert.deepEqual(JSON.parse(JSON.stringify(records.slice(1, 2).at(0))), view.toJSON());
  assert.equal(records.subarray(1).at(0).longitude, -2);
  assert.deepEqual(records.column('latitude'), [0, 1.5, 0]);
  assert.deepEqual([records.length, records.byteOffset, records.byteLength, locus.Text156Array.BYTES_PER_ELEMENT], [3, 8, 96, 156]);
  thrown(() => records.set(3, {}), RangeError, /record 3 of an array of 3/);
  thrown(() => records.set(0, { device: 65536 }), RangeError, /device is 65536/);
  thrown(() => records.set(0, { latitude: '1' }), TypeError, /latitude must be a number/);
  thrown(() => records.column('text'), RangeError, /no text/);
  thrown(() => new locus.Point32Array(memory, 8, 7), RangeError);
});

test('texts', async () => {
  const store = new locus.Store({ record: 'text156' });
  const texts = ['Bonjour', '日本', 'x'.repeat(140)];
  await store.insert(new locus.Text156Array(texts.map((text) => ({ text, time: NOON }))), NOON);
  assert.deepEqual((await store.read()).column('text').sort(), [...texts].sort());
  assert.equal(store.countSync({ filter: ({ text }) => text.startsWith('Bon') }), 1);
  thrown(() => new locus.Text156Array([{ text: '日'.repeat(47) }]), RangeError, /141 bytes/);
  await assert.rejects(store.groups('device'), locus.UnsupportedError);
});

test('errors name the record', async () => {
  const store = new locus.Store();
  const records = posts(5);
  records.at(3).latitude = 91;
  await assert.rejects(store.insert(records, NOON + 1e9), (error) => error instanceof locus.ArgumentError && /91/.test(error.message));
  assert.equal(store.countSync(), 0);
  thrown(() => store.insertSync(new locus.Text156Array(3), NOON), TypeError, /must be a Point32Array, not Text156Array/);
  thrown(() => store.insertSync(posts(1), 'now'), TypeError, /now must be an integer/);
  thrown(() => new locus.Store({ record: 'point64' }), RangeError, /point32, text156/);
  assert.equal(locus.pmqKey(0, 0), 3 * 2 ** 48);
});

test('expired records until they leave', async () => {
  const store = new locus.Store({ horizon: 1000 * locus.SECOND });
  store.insertSync(posts(1000), NOON + 1e9);
  store.insertSync(posts(0), NOON + 1e9 + 1e7);
  assert.equal(await store.count({ expired: true }), store.stats.stored);
  assert.equal(store.countSync(), 990);
  thrown(() => store.eraseSync({ expired: true }), locus.ArgumentError, /expired/);
});
