// What the tests share: plain models to compare with.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Point32Array } from '../lib/index.js';

export const NOON = 1_700_000_000 * 1_000_000;

/** Numbers from 0 to 1 of a fixed seed (mulberry32). */
export function random(seed = 1) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Records all over the world, a second apart. */
export function posts(count, next = random(), start = NOON) {
  return new Point32Array(
    Array.from({ length: count }, (_, index) => ({
      latitude: next() * 180 - 90,
      longitude: next() * 360 - 180,
      time: start + index * 1_000_000,
      device: Math.floor(next() * 5),
      spare: index % 65536,
    })),
  );
}

/** Great-circle distance by the haversine formula. */
export function metres(a, b) {
  const radians = Math.PI / 180;
  const half = (x) => Math.sin(x / 2) ** 2;
  const inner =
    half((b.latitude - a.latitude) * radians) +
    Math.cos(a.latitude * radians) * Math.cos(b.latitude * radians) * half((b.longitude - a.longitude) * radians);
  return 2 * 6371008.7714 * Math.asin(Math.min(1, Math.sqrt(inner)));
}

const OFFSETS = [-1, 0, 1].flatMap((z) => [-1, 0, 1].flatMap((y) => [-1, 0, 1].map((x) => [x, y, z]))).filter((o) => o.some(Boolean));

/** Distances from seeds [[x, y, z], start] over compliances: Bellman and Ford, in doubles. */
export function distances(dims, material, seeds, spacing = [1, 1, 1], connectivity = 26) {
  const most = { 6: 1, 18: 2, 26: 3 }[connectivity];
  const hops = OFFSETS.filter((offset) => offset.filter(Boolean).length <= most);
  const [nx, ny, nz] = dims;
  const found = new Array(nx * ny * nz).fill(Infinity);
  for (const [[x, y, z], start] of seeds) found[x + nx * (y + ny * z)] = Math.min(start, found[x + nx * (y + ny * z)]);
  for (let changed = true; changed; ) {
    changed = false;
    for (let v = 0; v < found.length; ++v) {
      if (!(material[v] >= 0) || found[v] === Infinity) continue;
      const place = [v % nx, Math.floor(v / nx) % ny, Math.floor(v / (nx * ny))];
      for (const hop of hops) {
        const to = place.map((at, axis) => at + hop[axis]);
        if (to.some((at, axis) => at < 0 || at >= dims[axis])) continue;
        const w = to[0] + nx * (to[1] + ny * to[2]);
        if (!(material[w] >= 0)) continue;
        const far = found[v] + (Math.hypot(...hop.map((step, axis) => step * spacing[axis])) * (material[v] + material[w])) / 2;
        if (far < found[w]) [found[w], changed] = [far, true];
      }
    }
  }
  return found;
}

export function close(found, wanted, relative) {
  assert.equal(found.length, wanted.length);
  for (let i = 0; i < wanted.length; ++i) {
    const [a, b] = [Number(found[i]), wanted[i]];
    assert.ok(a === b || Math.abs(a - b) <= relative * Math.max(Math.abs(b), 1e-9), `${a} instead of ${b} at ${i}`);
  }
}

/** A folder that goes with the test. */
export function scratch(test) {
  const folder = mkdtempSync(join(tmpdir(), 'locus-'));
  test.after(() => rmSync(folder, { recursive: true }));
  return (name) => join(folder, name);
}

/** The error that a call throws. */
export function thrown(call, kind, pattern = /./) {
  let error;
  assert.throws(call, (caught) => {
    error = caught;
    assert.ok(caught instanceof kind, `${caught?.name}: ${caught?.message} is no ${kind.name}`);
    assert.match(caught.message, pattern);
    return true;
  });
  return error;
}
