// Alerts and fences.
import assert from 'node:assert/strict';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { NOON, posts, thrown } from './common.js';

class Mine extends Error {}
const raising = () => {
  throw new Mine('mine');
};

test('fences', async () => {
  const store = new locus.Store();
  const shown = [];
  const alerts = new locus.Alerts(store, { fence: (id, record) => void shown.push([id, record]) });
  alerts.addFence(5, { box: [-30, -60, 30, 60] });
  alerts.addFence(4n, { circle: [0, 0, 3e6], filter: ({ device }) => device === 1 });
  const records = posts(2000);
  const now = records.at(-1).time;
  store.insertSync(records, now);
  const inside = [...records].filter(({ latitude, longitude }) => Math.abs(latitude) <= 30 && Math.abs(longitude) <= 60);
  const of = (fence) => shown.filter(([id]) => id === fence).map(([, { spare }]) => spare);
  assert.deepEqual(of(5), inside.map(({ spare }) => spare));
  assert.ok(of(4).length > 0 && of(4).length < 100);
  assert.equal(alerts.stats.fences, 2);
  assert.equal(alerts.stats.shown, shown.length);
  alerts.removeFence(5);
  thrown(() => alerts.removeFence(5), locus.ArgumentError);
  alerts.addFence(6, { filter: raising });
  assert.throws(() => store.insertSync(records, now), Mine);
  assert.equal(store.countSync(), 4000);
  await assert.rejects(store.insert(records, now), locus.UnsupportedError);
  alerts.dispose();
  alerts.dispose();
  shown.length = 0;
  await store.insert(records, now);
  assert.equal(shown.length, 0);
  thrown(() => alerts.active(), locus.StateError);
});

function rush(store) {
  for (let minute = 0; minute < 5; ++minute) {
    const time = NOON + minute * locus.MINUTE;
    store.insertSync(new locus.Point32Array(Array.from({ length: 100 }, () => ({ latitude: 48.85, longitude: 2.35, time }))), time);
  }
}

test('alerts', () => {
  const [store, told] = [new locus.Store(), []];
  const alerts = new locus.Alerts(store, { rate: 0.5, minimum: 50, alert: (region) => void told.push(region) });
  rush(store);
  assert.ok(told.length > 0 && Object.values(locus.AlertKind).includes(told[0].kind));
  assert.ok(told[0].box.south <= 48.85 && told[0].box.north >= 48.85 && told[0].number === 1);
  assert.deepEqual(alerts.active().map(({ number }) => number), told.map(({ number }) => number).reverse());
  const throwing = new locus.Store();
  new locus.Alerts(throwing, { rate: 0.5, minimum: 50, alert: raising });
  assert.throws(() => rush(throwing), Mine);
  const stopping = new locus.Store();
  new locus.Alerts(stopping, { rate: 0.5, minimum: 50, alert: () => false });
  thrown(() => rush(stopping), locus.StoppedError);
  thrown(() => new locus.Alerts(store, { minimum: -1 }), locus.ArgumentError, /minimum/);
});

test('a fence may ask the store and dispose of its object', () => {
  const [store, counts] = [new locus.Store(), []];
  const alerts = new locus.Alerts(store, {
    fence: () => {
      counts.push(store.countSync());
      alerts.dispose();
    },
  });
  alerts.addFence(1, {});
  store.insertSync(posts(10), NOON + 1e9);
  store.insertSync(posts(10), NOON + 1e9);
  assert.deepEqual(counts, [10]);
});

test('alerts without functions watch promises too, and cannot end beside one', async () => {
  const store = new locus.Store();
  const alerts = new locus.Alerts(store, { rate: 0.5, minimum: 50 });
  const work = store.insert(posts(1000), NOON + 1e9);
  thrown(() => alerts.dispose(), locus.BusyError);
  await work;
  assert.ok(alerts.stats.regions > 0);
  alerts.dispose();
});
