import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer } from './lib/explorer.mjs';
import { close, open, state, until } from './lib/page.mjs';

after(close);
const shows = (text) => document.getElementById('connection').textContent.includes(text);

test('the connection is lost, that is shown, and it comes back', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const page = await open(t, server.url, { quiet: false });
  await until(page, shows, 'live');
  const { port } = server;
  await server.stop();
  await until(page, shows, 'connection lost');
  const next = await Explorer.start(t, ['--empty'], port);
  await next.ingest([{ time: Date.now() * 1000, lat: 1, lon: 1, text: 'back' }]);
  await until(page, shows, 'live');
  await until(page, () => document.getElementById('bar-records').textContent === '1');
});

test('what goes wrong is told, in the words of the server', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const page = await open(t, server.url, { quiet: false });
  await page.route('**/count?*', (route) => route.fulfill({ status: 503, contentType: 'application/json', body: '{"status": 503, "error": "too many <b>questions</b>"}' }));
  await page.keyboard.press('s');
  await page.waitForSelector('.toast.error');
  assert.equal(await page.textContent('.toast p'), 'too many <b>questions</b>');
  await page.unroute('**/count?*'); // else the next question brings the message back
  await page.waitForTimeout(500);
  await page.click('.toast button');
  assert.equal(await page.locator('.toast').count(), 0);
});

test('a link shows the same view, time, selection and settings', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const at = Date.now() * 1000;
  const hash = `#view=7/48.5/2.5&box=48,2,49,3&top=48.6,2.4&at=${at}&window=300&alpha=0.5&radius=5000&period=600&k=5&bins=128&blur=1&colours=magma&scale=quantile&theme=light&tab=top`;
  const page = await open(t, server.url, { hash });
  const first = await state(page);
  assert.equal(first.at, at);
  assert.equal(await page.inputValue('#colours'), 'magma');
  assert.equal(await page.inputValue('#window'), '300');
  assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).colorScheme), 'light');
  await page.mouse.move(400, 400);
  await page.mouse.wheel(0, -300);
  await until(page, () => !location.hash.includes('view=7/'));
  await page.waitForTimeout(1500);
  const again = await open(t, server.url, { hash: new URL(page.url()).hash });
  const [{ view, ...rest }, shown] = [await state(page), await state(again)];
  assert.deepEqual({ ...shown, view: null }, { ...rest, view: null });
  assert.equal(shown.view.zoom, view.zoom);
  assert.ok(Math.hypot(shown.view.latitude - view.latitude, shown.view.longitude - view.longitude) < 2e-5);
  assert.notDeepEqual((await state(again)).view, first.view);
});

test('the charts and figures of the stream', async (t) => {
  const server = await Explorer.start(t, ['--demo', '--rate', '300', '--horizon', '600']);
  const page = await open(t, server.url, { hash: '#tab=stream' });
  await until(page, () => document.querySelectorAll('.chart canvas').length === 4 && [...document.querySelectorAll('.chart canvas')]
    .every((canvas) => /now .*\d/.test(canvas.getAttribute('aria-label') ?? '')));
  assert.deepEqual(await page.locator('.chart h3').allTextContents(), ['Records', 'Inserts per second', 'Insert latency', 'Memory']);
  const blue = await page.evaluate(() => [...document.querySelectorAll('.chart canvas')].map((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += data[i + 2] > 200 && data[i] < 150;
    return count;
  }));
  assert.ok(blue.every((count) => count > 5), `pixels of the lines: ${blue}`);
});
