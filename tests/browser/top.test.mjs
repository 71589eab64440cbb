import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
import { close, open, picture, state, texts, until } from './lib/page.mjs';

after(close);

// What the list must hold: the answer of the server to the same question.
async function wanted(server, page) {
  const { top: { latitude, longitude }, alpha, radius, period, k } = await state(page);
  const { records } = await server.get(`/topk?lat=${latitude}&lon=${longitude}&alpha=${alpha}&radius=${radius}&period=${period}&k=${k}`);
  return records.map(({ text }) => text);
}

async function settle(page, server) {
  const right = await wanted(server, page);
  await until(page, (list) => JSON.stringify([...document.querySelectorAll('#top-records .text')].map((node) => node.textContent)) === JSON.stringify(list), right);
  return right;
}

test('a click asks for the best records, and the sliders change them', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  // The nearer, the older: nearness and youth want different records.
  const now = Date.now() * 1000;
  await server.ingest(Array.from({ length: 40 }, (_, i) => ({ time: now - (40 - i) * 60e6, lat: 48.85 + i * 0.005, lon: 2.35, text: `post ${i}` })));
  const page = await open(t, server.url, { hash: '#view=10/48.85/2.35' });
  await page.mouse.click(640, 400);
  await page.waitForSelector('#top-records li');
  const first = await settle(page, server);
  assert.equal(first.length, 20);
  assert.equal(await page.locator('.outline-reach').count(), 1);
  await picture(page, 'top');

  const move = async (id, key) => {
    await page.focus(`#${id}`);
    await page.keyboard.press(key);
    return settle(page, server);
  };
  const near = await move('alpha', 'End');
  assert.equal(near[0], 'post 0');
  const young = await move('alpha', 'Home');
  assert.equal((await state(page)).alpha, 0);
  assert.notDeepEqual(young, near);
  assert.equal((await move('k', 'Home')).length, 1);
  assert.ok((await move('k', 'End')).length > 20);
  const within = await move('radius', 'PageDown');
  assert.ok((await state(page)).radius < 30000);
  assert.ok(within.length < 40);
  await move('period', 'Home');
  assert.equal((await state(page)).period, 10);
  assert.deepEqual(await texts(page, '#top-records .text'), []);
  assert.match(await page.textContent('#top-records'), /No records within/);
});

test('the best records follow the stream', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 48.85, lon: 2.35, count: 5 }));
  const page = await open(t, server.url, { hash: '#view=12/48.85/2.35&top=48.85,2.35&tab=top&k=3' });
  await page.waitForSelector('#top-records li');
  await server.ingest([{ time: Date.now() * 1000, lat: 48.85, lon: 2.35, text: 'the newest' }]);
  await until(page, () => document.querySelector('#top-records .text').textContent === 'the newest');
});
