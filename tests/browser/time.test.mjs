import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer } from './lib/explorer.mjs';
import { close, open, state, until } from './lib/page.mjs';
import { tiles } from './lib/pixels.mjs';

after(close);
const seconds = 1e6;

async function world(t) {
  const server = await Explorer.start(t, ['--empty', '--horizon', '3600']);
  const now = Date.now() * 1000;
  await server.ingest([...Array(50)].map((_, i) => ({ time: now - (50 - i) * 60 * seconds, lat: 10 + i / 100, lon: 10, text: `minute ${i}` })));
  return server;
}

const selected = (page, count) => until(page, (wanted) => document.getElementById('selection-count').textContent === wanted, String(count));

test('pause keeps the moment, steps go back in it, and live goes on', async (t) => {
  const server = await world(t);
  const page = await open(t, server.url, { hash: '#view=8/10.2/10&box=9,9,11,11' });
  await selected(page, 50);
  await page.click('#pause');
  assert.equal(await page.getAttribute('#pause', 'aria-label'), 'Go on live');
  await until(page, () => document.getElementById('connection').textContent === 'paused');
  const shown = await tiles(page);
  await server.ingest([{ time: Date.now() * 1000, lat: 10, lon: 10.1, text: 'after the pause' }]);
  await page.waitForTimeout(3000);
  assert.deepEqual(await tiles(page), shown);
  await selected(page, 50);

  const { at } = await state(page);
  await page.click('#step-back');
  const back = (await state(page)).at;
  assert.ok(back < at);
  await selected(page, (await server.get(`/count?box=9,9,11,11&to=${back}`)).count);
  await page.click('#step-forward');
  await page.click('#pause');
  assert.equal((await state(page)).at, null);
  await selected(page, 51);
});

test('the slider and the window choose what is shown', async (t) => {
  const server = await world(t);
  const page = await open(t, server.url, { hash: '#view=8/10.2/10&box=9,9,11,11' });
  await selected(page, 50);
  await page.selectOption('#window', '900');
  await selected(page, (await server.get('/count?box=9,9,11,11&last=900')).count);
  await until(page, () => !document.getElementById('time').disabled);
  await page.focus('#time');
  await page.keyboard.press('PageDown');
  await page.keyboard.press('PageDown');
  await page.waitForTimeout(300);
  const { at, window } = await state(page);
  assert.ok(at !== null && window === 900);
  await selected(page, (await server.get(`/count?box=9,9,11,11&to=${at}&last=900`)).count);
  assert.match(await page.textContent('#time-label'), /^15 min until \d{4}-/);
  await page.keyboard.press('End');
  await until(page, () => document.getElementById('time-label').textContent === 'live, the last 15 min');
});

test('the bars of the time line are the arrivals', async (t) => {
  const server = await world(t);
  const page = await open(t, server.url);
  await until(page, () => {
    const canvas = document.getElementById('histogram');
    return canvas.width && canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some((value, i) => i % 4 === 3 && value);
  });
});
