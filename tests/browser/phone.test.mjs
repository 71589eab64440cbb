import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
import { close, open, picture, state, until } from './lib/page.mjs';

after(close);
const PHONE = { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true };

// Elements that stick out of the window to the side.
const outside = (page) => page.evaluate(() => [...document.querySelectorAll('.card, .card button, .card select, .card input, .card p')]
  .filter((node) => node.checkVisibility())
  .map((node) => ({ node: node.id || node.className, box: node.getBoundingClientRect() }))
  .filter(({ box }) => box.width && (box.left < -1 || box.right > innerWidth + 1))
  .map(({ node }) => node));

test('all of it at the width of a phone', async (t) => {
  const server = await Explorer.start(t, ['--demo', '--rate', '400', '--horizon', '1800']);
  await server.get('/stats');
  const page = await open(t, server.url, PHONE);
  await until(page, () => /\d/.test(document.getElementById('bar-records').textContent));
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  assert.deepEqual(await outside(page), []);
  await page.waitForTimeout(1500);
  await picture(page, 'phone');
  for (const name of ['top', 'alerts', 'stream', 'selection']) {
    await page.tap(`#tab-${name}`);
    assert.ok(await page.isVisible(`#pane-${name}`), name);
    assert.deepEqual(await outside(page), [], name);
    const box = await page.locator('.panel').boundingBox();
    assert.ok(box.y > 250, 'the map can still be seen');
  }
  await page.tap('#tab-selection');
  assert.ok(!(await page.isVisible('#pane-selection')), 'the sheet folds');
});

test('select and ask for the best records with a finger', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 48.85, lon: 2.35, count: 30, gap: 0.0005 }));
  const page = await open(t, server.url, { ...PHONE, hash: '#view=12/48.85/2.35' });
  await page.tap('#tab-selection');
  await page.tap('text=Middle of the view');
  await until(page, () => document.querySelectorAll('#selection-records li').length === 20);
  await picture(page, 'phone-selection');
  await page.touchscreen.tap(180, 200);
  await until(page, () => document.querySelectorAll('#top-records li').length > 0);
  assert.equal((await state(page)).tab, 'top');
});
