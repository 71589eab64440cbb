// A tour of both engines: tour.js [PICTURE]. Prints what it finds, and writes the heat map of a stream as a PNG file.
import { writeFileSync } from 'node:fs';
import { deflateSync } from 'node:zlib';
import { Diagram, Graph, HOUR, MINUTE, NO_SEED, Point32Array, Store, Weights } from 'locus';

/** Numbers from 0 to 1, the same every time. */
function* numbers(seed) {
  for (let state = seed; ; ) {
    state = (Math.imul(state, 1664525) + 1013904223) | 0;
    yield (state >>> 8) / 2 ** 24;
  }
}

async function volume() {
  // A block with a stiff rod along x and a hole through it, four seeds placed by the library.
  const dims = [48, 32, 32];
  const material = new Float32Array(48 * 32 * 32).fill(1);
  for (let z = 12; z < 20; ++z) for (let y = 12; y < 20; ++y) material.fill(0.1, 48 * (y + 32 * z), 48 * (y + 32 * z) + 48);
  const graph = await Graph.create({ dims, material, materialRange: [0.1, 1] });
  const diagram = new Diagram(graph);
  await diagram.placeSeeds({ count: 4, lloydIterations: 5 });
  await diagram.solve();
  console.log('cells of', diagram.cellSizes.join(', '), 'voxels; the farthest voxel lies', diagram.stats.maxDistance.toFixed(2), 'away');

  // A cut across the block, and the cells that it changes.
  const edges = graph.cutPlane([23.5, 0, 0], [1, 0.1, 0]);
  const { voxels } = await diagram.update();
  console.log(edges, 'edges cut,', voxels, 'voxels changed; cells of', diagram.cellSizes.join(', '));
  console.log(diagram.labels().includes(NO_SEED) ? 'some voxels have no seed' : 'every voxel has a seed');

  // Values at the seeds, interpolated over the middle slice.
  const weights = await Weights.create(diagram, { method: 'sibson', box: { origin: [0, 0, 16], extent: [48, 32, 1] } });
  const values = await weights.interpolate(diagram.seeds.map(({ x }) => x));
  console.log('interpolated x along the rim:', [0, 12, 24, 36, 47].map((x) => values[x].toFixed(1)).join(' '));
}

/** Posts around a few towns, in the order of their times. */
function posts(count, start, span) {
  const towns = [[48.85, 2.35, 1], [51.5, -0.12, 0.8], [52.52, 13.4, 0.6], [41.9, 12.5, 0.5], [40.4, -3.7, 0.5], [59.3, 18.1, 0.3]];
  const next = numbers(1);
  const random = () => next.next().value;
  const records = new Point32Array(count);
  for (let i = 0; i < count; ++i) {
    const [latitude, longitude, spread] = towns[Math.floor(towns.length * random() ** 1.5)];
    const [angle, far] = [2 * Math.PI * random(), spread * 3 * random() ** 3];
    const time = start + Math.floor((span * i) / count);
    records.set(i, { latitude: latitude + far * Math.sin(angle), longitude: longitude + 1.5 * far * Math.cos(angle), time, device: i % 3 });
  }
  return records;
}

async function stream(picture) {
  const start = Date.UTC(2023, 10, 14) * 1000;
  const store = new Store({ horizon: HOUR });
  const all = posts(200_000, start, 3 * HOUR);
  for (let from = 0; from < all.length; from += 10_000) {
    const batch = all.subarray(from, from + 10_000);
    await store.insert(batch, batch.at(-1).time);
  }
  const { records, evicted } = store.stats;
  console.log(records, 'of', all.length, 'records are younger than an hour,', evicted, 'have left');
  const since = all.at(-1).time - 10 * MINUTE;
  console.log(await store.count({ circle: [48.85, 2.35, 20_000], since }), 'came within 20 km of Paris in the last ten minutes');
  const { values } = await store.nearest(3, { latitude: 53.35, longitude: -6.26 });
  console.log('the three nearest to Dublin are', Array.from(values, (metres) => `${(metres / 1000).toFixed(1)} km`).join(', '), 'away');
  if (!picture) return;
  const tiles = [[15, 10], [16, 10], [17, 10], [15, 11], [16, 11], [17, 11]];
  const bins = await Promise.all(tiles.map(([x, y]) => store.tile({ zoom: 5, x, y, log2Bins: 7 })));
  writeFileSync(picture, png(384, 256, (x, y) => bins[3 * (y >> 7) + Math.floor(x / 128)][128 * (y % 128) + (x % 128)]));
  console.log('the heat map of Europe is', picture);
}

/** A picture of counts: dark to bright with their logarithms. */
function png(width, height, countAt) {
  const rows = Buffer.alloc(height * (1 + 3 * width));
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const light = Math.min(1, Math.log2(1 + countAt(x, y)) / 10);
      const colour = [light * 2, (light - 0.3) * 1.8, 0.12 + 0.4 * light * (1 - light) + Math.max(0, light - 0.75) * 3];
      rows.set(colour.map((one) => Math.round(255 * Math.max(0, Math.min(1, one)))), y * (1 + 3 * width) + 1 + 3 * x);
    }
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2], 8);
  const chunk = (type, data) => {
    const whole = Buffer.alloc(12 + data.length);
    whole.writeUInt32BE(data.length, 0);
    whole.write(type, 4, 'latin1');
    whole.set(data, 8);
    whole.writeUInt32BE(checksum(whole.subarray(4, 8 + data.length)), 8 + data.length);
    return whole;
  };
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  return Buffer.concat([signature, chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

/** CRC-32, as PNG has it. */
function checksum(bytes) {
  let sum = -1;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

await volume();
await stream(process.argv[2]);
