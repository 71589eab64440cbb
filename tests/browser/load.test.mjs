import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { readdirSync, readFileSync } from 'node:fs';
import { Explorer } from './lib/explorer.mjs';
import { close, open } from './lib/page.mjs';

after(close);
const LOADS = 3;
const LIMIT_MS = 2000;

// The wall clock of a busy machine says little: it is printed, and the limit holds for the best of a few.
test('the page can be used within two seconds', async (t) => {
  const server = await Explorer.start(t, ['--demo', '--rate', '400', '--horizon', '1800']);
  const times = [];
  for (let i = 0; i < LOADS; ++i) {
    const page = await open(t, server.url);
    times.push(Number(await page.getAttribute('html', 'data-ready')));
    await page.close();
  }
  t.diagnostic(`ready after ${times.join(', ')} ms`);
  assert.ok(Math.min(...times) < LIMIT_MS, `ready after ${times.join(', ')} ms`);
});

test('every module is named in the head, so that they load at once', () => {
  const folder = new URL('../../examples/explorer/static/', import.meta.url);
  const named = [...readFileSync(new URL('index.html', folder), 'utf8').matchAll(/(?:modulepreload" href|script type="module" src)="js\/([^"]+)"/g)].map(([, name]) => name);
  assert.deepEqual(named.sort(), readdirSync(new URL('js/', folder)).sort());
});
