import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { cutLine, cutRing } from '../../tools/basemap/cut.mjs';

const map = JSON.parse(readFileSync(new URL('../../examples/explorer/static/basemap.json', import.meta.url), 'utf8'));

function decode(numbers) {
  let [x, y] = [0, 0];
  return Array.from({ length: numbers.length / 2 }, (_, i) => [(x += numbers[2 * i]) / 100, (y += numbers[2 * i + 1]) / 100]);
}

const land = map.land.map(decode);

// Even-odd over all rings: holes count too.
const isLand = (lon, lat) => land.reduce((inside, ring) => ring.reduce((within, [x1, y1], i) => {
  const [x0, y0] = ring.at(i - 1);
  return (y0 > lat) !== (y1 > lat) && lon < x0 + (x1 - x0) * (lat - y0) / (y1 - y0) ? !within : within;
}, inside), false);

test('land is where it is, on both sides of the antimeridian and at the pole', () => {
  const places = { Paris: [2.35, 48.85], Chukotka: [-175, 66.5], 'east of Siberia': [178, 67], 'Viti Levu': [178, -17.8], 'the pole': [30, -89], 'Ross ice': [179, -85] };
  for (const [name, at] of Object.entries(places)) assert.ok(isLand(...at), name);
  const seas = { Atlantic: [-40, 30], 'Bering sea': [179, 59], 'off Fiji': [-179, -21], Caspian: [51, 41], 'north of Antarctica': [-179.5, -60] };
  for (const [name, at] of Object.entries(seas)) assert.ok(!isLand(...at), name);
});

test('no line runs across the map', () => {
  for (const line of [...land, ...map.borders.map(decode)]) {
    line.forEach(([x, y], i) => {
      assert.ok(Math.abs(x) <= 180 && Math.abs(y) <= 90, `${x} ${y}`);
      const far = i && Math.abs(x - line[i - 1][0]) > 90;
      assert.ok(!far || (y === -90 && line[i - 1][1] === -90), `${line[i - 1]} to ${x} ${y}`);
    });
  }
});

test('a ring across the antimeridian becomes two, one around the pole is closed along it', () => {
  const box = [[170, 0], [-170, 0], [-170, 10], [170, 10], [170, 0]];
  const parts = cutRing(box).map((ring) => ring.map(([x]) => x));
  assert.deepEqual(parts.map((xs) => [Math.min(...xs), Math.max(...xs)]).sort((a, b) => a[0] - b[0]), [[-180, -170], [170, 180]]);
  const [cap, ...more] = cutRing([[-120, -70], [0, -70], [120, -70], [-120, -70]]).sort((a, b) => b.length - a.length);
  assert.ok(cap.some(([, y]) => y === -90));
  assert.ok(more.flat().every(([x, y]) => Math.abs(x) <= 180 && y >= -90));
  assert.deepEqual(cutRing([[0, 0], [1, 0], [1, 1], [0, 0]]).length, 1);
});

test('a line across the antimeridian is cut where it crosses', () => {
  assert.deepEqual(cutLine([[170, 0], [-170, 10]]), [[[170, 0], [180, 5]], [[-180, 5], [-170, 10]]]);
  assert.deepEqual(cutLine([[0, 0], [10, 0]]), [[[0, 0], [10, 0]]]);
});
