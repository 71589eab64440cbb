import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
import { close, open, state, until } from './lib/page.mjs';

after(close);

const focused = (page) => page.evaluate(() => document.activeElement.id || document.activeElement.className);

test('everything without a mouse', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 48.85, lon: 2.35, count: 30, gap: 0.0005 }));
  const page = await open(t, server.url, { hash: '#view=12/48.85/2.35' });
  const press = (key) => page.keyboard.press(key);

  await press('Tab');
  assert.equal(await focused(page), 'skip');
  await press('Enter');
  assert.equal(await focused(page), 'map');
  const { lng } = await page.evaluate(() => ({ lng: location.hash }));
  await press('ArrowRight');
  await until(page, (before) => location.hash !== before, lng);
  await press('ArrowLeft');
  await page.waitForTimeout(600);
  await press('+');
  await until(page, () => location.hash.includes('view=13/'));

  await press('s');
  await until(page, () => document.querySelectorAll('#selection-records li').length === 20);
  await press('t');
  await until(page, () => document.querySelectorAll('#top-records li').length === 20);
  assert.equal((await state(page)).tab, 'top');

  await press('2');
  assert.equal(await focused(page), 'tab-top');
  await press('ArrowRight');
  assert.equal(await focused(page), 'tab-alerts');
  await press('End');
  assert.equal(await focused(page), 'tab-stream');
  await press('Home');
  await press('Tab');
  await press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.closest('#pane-selection') !== null), true);

  await page.focus('#selection-records li');
  await press('ArrowDown');
  assert.equal(await page.locator('.dot-record.chosen').count(), 1);
  await press('Enter');

  await press('?');
  assert.ok(await page.isVisible('#help'));
  await press('Escape');
  assert.ok(!(await page.isVisible('#help')));
  assert.notEqual((await state(page)).box, null, 'Escape closed the dialog alone');
  await press('m');
  await press(' ');
  await until(page, () => document.getElementById('pause').getAttribute('aria-label') === 'Go on live');
  await press('[');
  await press(' ');
  assert.equal((await state(page)).at, null);
  await press('Escape');
  assert.deepEqual([(await state(page)).box, (await state(page)).top], [null, null]);
});

test('the focus comes by everything that can be used, and everything has a name', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const page = await open(t, server.url);
  const met = new Set();
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    met.add(await focused(page));
  }
  for (const id of ['copy-link', 'theme', 'help-open', 'map', 'legend-toggle', 'tab-selection', 'step-back', 'pause', 'window']) assert.ok(met.has(id), id);
  const nameless = await page.evaluate(() => [...document.querySelectorAll('button, select, input, [role="tab"], canvas[role="img"]')]
    .filter((node) => !(node.getAttribute('aria-label') || node.textContent.trim() || node.labels?.length))
    .map((node) => node.outerHTML));
  assert.deepEqual(nameless, []);
});

test('less motion where it is wanted', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 48.85, lon: 2.35, count: 3 }));
  const page = await open(t, server.url, { hash: '#view=4/40/2&box=48,2,49,3', reducedMotion: 'reduce' });
  await page.waitForSelector('#selection-records li');
  await page.click('#selection-records li');
  assert.equal((await state(page)).view.zoom, 12, 'it is there at once');
});
