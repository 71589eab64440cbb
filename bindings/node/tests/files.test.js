// Volume files and record streams.
import assert from 'node:assert/strict';
import { closeSync, openSync, writeFileSync } from 'node:fs';
import test from 'node:test';
import * as locus from '../lib/index.js';
import { random, scratch, thrown } from './common.js';

test('volumes come back', async (t) => {
  const file = scratch(t);
  const next = random();
  for (const type of [Uint8Array, Int16Array, Float32Array, Float64Array, BigUint64Array]) {
    for (const ending of ['.mha', '.mhd', '.nrrd', '.nhdr']) {
      const number = () => Math.floor(next() * 100);
      const data = type.from({ length: 60 }, type === BigUint64Array ? () => BigInt(number()) : number);
      const path = file(`a${ending}`);
      await locus.writeVolume(path, data, { dims: [5, 4, 3], spacing: [1, 2, 3], origin: [-1, 0, 1], compression: ending === '.mha' ? 6 : 0 });
      const kept = await locus.readVolume(path, { keep: true });
      assert.deepEqual(kept.data, data);
      assert.deepEqual([kept.info.dims, kept.info.spacing, kept.info.origin], [[5, 4, 3], [1, 2, 3], [-1, 0, 1]]);
      assert.deepEqual(locus.readVolumeSync(path).data, Float32Array.from(data, Number));
      assert.deepEqual(locus.readVolumeInfo(path, { keep: true }).type, kept.info.type);
    }
  }
  const direction = [0, 1, 0, -1, 0, 0, 0, 0, 1];
  locus.writeVolumeSync(file('b.mha'), new Int8Array(16).fill(-3), { dims: [2, 2, 2], components: 2, direction });
  const { data, info } = locus.readVolumeSync(file('b.mha'), { keep: true });
  assert.deepEqual([data, info.components, info.direction], [new Int8Array(16).fill(-3), 2, direction]);
});

test('raw files, and a graph of one', async (t) => {
  const file = scratch(t);
  const bytes = new DataView(new ArrayBuffer(4 + 120));
  for (let i = 0; i < 60; ++i) bytes.setInt16(4 + 2 * i, i);
  writeFileSync(file('a.raw'), bytes);
  const raw = { dims: [5, 4, 3], type: 'int16', offset: 4, bigEndian: true, spacing: [1, 1, 2] };
  const { data, info } = await locus.readVolume(file('a.raw'), { raw });
  assert.deepEqual([...data], Array.from({ length: 60 }, (_, i) => i));
  assert.deepEqual(info.spacing, [1, 1, 2]);
  assert.equal(new locus.Graph({ dims: info.dims, material: data, spacing: info.spacing }).info.passable, 60);
  thrown(() => locus.readVolumeSync(file('a.raw'), { raw: { ...raw, type: 'complex' } }), RangeError, /complex/);
  thrown(() => locus.readVolumeSync(file('a.raw'), { raw: { ...raw, dims: [50, 4, 3] } }), locus.FormatError, /a.raw/);
});

test('errors of files', async (t) => {
  const file = scratch(t);
  await assert.rejects(locus.readVolume(file('none.mha')), (error) => error instanceof locus.IoError && error.code === 'LOCUS_E_IO');
  locus.writeVolumeSync(file('a.mha'), new Float64Array(729), { dims: [9, 9, 9] });
  thrown(() => locus.readVolumeSync(file('a.mha'), { memoryLimit: 100 }), locus.OutOfMemoryError);
  thrown(() => locus.writeVolumeSync(file('a.mha'), [1], { dims: [1, 1, 1] }), TypeError, /typed array/);
  thrown(() => locus.writeVolumeSync(file('a.mha'), new Uint8Array(7), { dims: [2, 2, 2] }), RangeError, /7 numbers instead of 8/);
  thrown(() => locus.writeVolumeSync(file('a.xyz'), new Uint8Array(8), { dims: [2, 2, 2] }), locus.ArgumentError, /a.xyz|ending/);
});

const POSTS = 'when,lat,lon,text\n1700000000,48.5,2.25,Bonjour\nnever,1,2,bad\n1700000001,-1,3,Hello\n';

test('records', async (t) => {
  const file = scratch(t);
  const path = file('posts.csv');
  writeFileSync(path, POSTS);
  const bad = [];
  const reader = new locus.RecordReader(path, { timeColumn: 'when', batch: 1, badLine: (line, reason) => void bad.push([line, reason]) });
  const batches = [...reader];
  assert.deepEqual(batches.map((batch) => batch.length), [1, 1]);
  assert.deepEqual(batches.map((batch) => batch.at(0).text), ['Bonjour', 'Hello']);
  assert.deepEqual(batches.map((batch) => batch.at(0).time), [1.7e15, 1.7e15 + 1e6]);
  assert.deepEqual([bad[0][0], typeof bad[0][1], reader.stats.bad, reader.stats.records], [3, 'string', 1, 2]);
  await assert.rejects(reader.read(), locus.UnsupportedError);
  const points = await new locus.RecordReader(path, { record: 'point32', timeColumn: 'when' }).read();
  assert.deepEqual(points.column('longitude'), [2.25, 3]);
  const store = new locus.Store();
  await store.insert(points, 1_700_000_002_000_000);
  assert.equal(store.countSync(), 2);
  let read = 0;
  for await (const batch of new locus.RecordReader(path, { timeColumn: 'when', batch: 1 })) read += batch.length;
  assert.equal(read, 2);
  const refusing = new locus.RecordReader(path, { timeColumn: 'when', refuseBadLines: true });
  assert.equal((await refusing.read()).length, 1);
  await assert.rejects(refusing.read(), (error) => error instanceof locus.FormatError && /line 3|never/.test(error.message));
  const throwing = new locus.RecordReader(path, { timeColumn: 'when', badLine: (line) => { throw new RangeError(`line ${line}`); } });
  thrown(() => throwing.readSync(), RangeError, /line 3/);
  thrown(() => new locus.RecordReader(file('none.csv')), locus.IoError, /none.csv/);
  thrown(() => new locus.RecordReader(path, { separator: '::' }), TypeError, /separator/);
});

test('records from a descriptor', (t) => {
  const file = scratch(t);
  writeFileSync(file('posts.ndjson'), '{"time": 1700000000, "lat": 1, "lon": 2, "text": "x"}\n');
  const descriptor = openSync(file('posts.ndjson'));
  const reader = new locus.RecordReader(descriptor, { format: 'ndjson' });
  assert.equal(reader.readSync().length, 1);
  reader.dispose();
  closeSync(descriptor);
});
