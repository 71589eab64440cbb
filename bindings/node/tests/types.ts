// Compiled and never run: what the types allow, and, behind the expected errors, what they refuse.
import {
  Alerts, Cold, ColdSync, Diagram, Engine, Graph, HOUR, LocusError, Point32, Point32Array, RecordReader, Snapshot, Status, Store, Text156,
  Text156Array, Weights, readVolume, version, writeVolume,
} from '../lib/index.js';

async function voxels(): Promise<number> {
  using graph = new Graph({ dims: [5, 1, 1], material: new Float32Array(5), weightRule: 'mean_compliance' });
  const other: Graph = await Graph.create({ dims: [5, 1, 1], material: [1, 2, 3, 4, 5], log: (level, text) => console.log(level, text) });
  const diagram = new Diagram(graph, { engine: Engine.HEAP, grain: [8, 4, 4], stream: 0n, onDevice: false });
  diagram.addSeeds([{ position: [0, 0, 0], id: 7 }, { x: 4, y: 0, z: 0 }]);
  const labels: Uint32Array = (await diagram.solve({ progress: (fraction) => fraction < 1, signal: new AbortController().signal })).labels();
  const { box, voxels: changed } = diagram.updateSync();
  const weights = await Weights.create(diagram, { method: 'laplace', box: { extent: [1, 1, 1] } });
  const [path] = diagram.path([1, 0, 0]);
  const values: Float32Array = await weights.interpolate([1, 2], { components: 1 });
  // @ts-expect-error there is no such engine
  new Diagram(graph, { engine: 'quick' });
  // @ts-expect-error a graph has dims
  new Graph({ material: [1] });
  return labels.length + box.extent[0]! + changed + path![0] + values.length + other.info.passable + version().length;
}

async function streams(): Promise<void> {
  const store = new Store({ horizon: HOUR, sink: (records) => console.log(records.at(0).device), remove: (record) => record.spare });
  store.insertSync(new Point32Array([{ latitude: 1, longitude: 2, time: new Date() }]), Date.now() * 1000);
  const found: Point32Array = await store.read({ box: [0, 0, 1, 1], since: 5n });
  store.countSync({ filter: (record) => record.device === 3 });
  // @ts-expect-error functions are called by Sync calls only
  await store.count({ filter: () => true });
  // @ts-expect-error a query's circle has a radius
  store.countSync({ circle: [1, 2] });
  const texts = new Store<Text156>({ record: 'text156' });
  const first: string = (await texts.read()).at(0).text;
  const snapshot: Snapshot<Text156> = texts.snapshot();
  for await (const page of snapshot.pages({ size: 10 })) for (const { text } of page) console.log(text, first);
  const columns: number[] = found.column('latitude');
  new Alerts(store, { alert: ({ box }) => box.south > 0, fence: (id, record) => record.device !== id }).addFence(1, { circle: [0, 0, 1] });
  for (const batch of new RecordReader('posts.csv', { timeUnit: 'seconds' })) texts.insertSync(batch, columns[0]!);
  const points = new Text156Array(found.buffer, 0, 1);
  const { data, info } = await readVolume('head.mha', { keep: true });
  await writeVolume('again.mha', data, { dims: [info.dims[0]!, points.length, 1] });
}

async function tiers(): Promise<number> {
  const cold = await Cold.open<Text156>('posts.db', { record: 'text156', sync: ColdSync.FULL, whenFull: 'refuse', maxAge: 30 * HOUR });
  const store = new Store<Text156>({ record: 'text156', cold });
  const found: Text156Array = await cold.read(store, { box: [0, 0, 1, 1] });
  cold.visitSync(({ text }) => text.length < 10, store.snapshot(), { filter: (record) => record.text !== '' });
  // @ts-expect-error the records of the store are those of the tier
  await cold.count(new Store<Point32>());
  // @ts-expect-error functions are called by Sync calls only
  await cold.count(store, { filter: () => true });
  cold.sweep(new Date());
  return found.length + cold.stats.received;
}

export function statusOf(error: unknown): string | undefined {
  return error instanceof LocusError && error.status === Status.STATE ? error.code : undefined;
}

export default [voxels, streams, tiers];
