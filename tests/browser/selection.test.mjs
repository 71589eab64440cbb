import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
import { close, open, picture, state, texts, until } from './lib/page.mjs';

after(close);
const RECORDS = around({ lat: 48.85, lon: 2.35, count: 50, gap: 0.002 });
const VIEW = '#view=12/48.85/2.35';

async function drag(page, from, to, keys = ['Shift']) {
  for (const key of keys) await page.keyboard.down(key);
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
  await page.mouse.move(...to);
  await page.mouse.up();
  for (const key of keys) await page.keyboard.up(key);
}

const count = (page) => page.textContent('#selection-count').then((text) => Number(text.replaceAll(',', '')));

// The records that the page must show for what is selected, asked of the server.
async function expected(server, page) {
  const { box: { south, west, north, east } } = await state(page);
  const box = `box=${[south, west, north, east].join()}`;
  const { records } = await server.get(`/records?${box}&limit=1000`);
  return { count: (await server.get(`/count?${box}`)).count, texts: records.map(({ text }) => text) };
}

test('shift-drag selects: the count and the records are those of the server', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(RECORDS);
  const page = await open(t, server.url, { hash: VIEW });
  await drag(page, [500, 300], [760, 520]);
  await until(page, () => /^\d/.test(document.getElementById('selection-count').textContent));
  const wanted = await expected(server, page);
  assert.ok(wanted.count > 20 && wanted.count < RECORDS.length, `${wanted.count} records`);
  assert.equal(await count(page), wanted.count);
  assert.deepEqual(await texts(page, '#selection-records .text'), wanted.texts.slice(0, 20));
  assert.equal(await page.locator('.dot-record').count(), 20);
  assert.equal((await state(page)).top, null, 'the drag is no click');
  await picture(page, 'selection');

  await page.click('[aria-label="Next page"]');
  await until(page, (text) => document.querySelector('#selection-records .text')?.textContent === text, wanted.texts[20]);
  assert.deepEqual(await texts(page, '#selection-records .text'), wanted.texts.slice(20, 40));
  await page.click('[aria-label="Previous page"]');
  await until(page, (text) => document.querySelector('#selection-records .text')?.textContent === text, wanted.texts[0]);
});

test('what arrives is counted, and what the words of the records are', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 10, lon: 10, count: 5, text: () => 'concert tonight' }));
  const page = await open(t, server.url, { hash: '#view=10/10/10&box=9,9,11,11' });
  await until(page, () => document.getElementById('selection-count').textContent === '5');
  assert.deepEqual((await texts(page, '.bars .word')).sort(), ['concert', 'tonight']);
  await server.ingest(around({ lat: 10, lon: 10, count: 3, text: () => 'later' }));
  await until(page, () => document.getElementById('selection-count').textContent === '8');
  await until(page, () => document.querySelector('#selection-records .text').textContent === 'later');
});

test('a selection across the antimeridian', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest([[179.9, 'west of it'], [-179.9, 'east of it'], [0, 'far']].map(([lon, text], i) => ({ time: Date.now() * 1000 - i, lat: 0, lon, text })));
  const page = await open(t, server.url, { hash: '#view=8/0/180' });
  await drag(page, [400, 250], [880, 550]);
  await until(page, () => document.getElementById('selection-count').textContent === '2');
  const { box } = await state(page);
  assert.ok(box.west > 170 && box.east < -170, JSON.stringify(box));
  assert.deepEqual(await texts(page, '#selection-records .text'), ['west of it', 'east of it']);
});

test('draw without a shift key, point at a record, clear', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(RECORDS);
  const page = await open(t, server.url, { hash: VIEW });
  const view = (await state(page)).view;
  await page.click('text=Draw');
  await drag(page, [500, 300], [760, 520], []);
  await until(page, () => document.querySelectorAll('.records li').length === 20);
  assert.deepEqual((await state(page)).view, view, 'the map has not moved');
  await page.hover('.records li');
  assert.equal(await page.locator('.dot-record.chosen').count(), 1);
  await page.click('text=Clear');
  assert.equal(await page.locator('.outline-selection').count(), 0);
  assert.equal((await state(page)).box, null);
});
