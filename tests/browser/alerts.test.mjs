import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer } from './lib/explorer.mjs';
import { close, open, picture, state, texts, until } from './lib/page.mjs';

after(close);
const PARIS = { south: 48.8, west: 2.2, north: 48.9, east: 2.5 };
const OSAKA = { south: 34.6, west: 135.4, north: 34.7, east: 135.6 };
const alert = (id, box, text) => ({ id, kind: 'jump', z: 11, x: 1, y: 1, box, rate: 3.2, expected: 0.4, time: Date.now() * 1000, text });

// The server's part played by the test: an alert that was there before the page, and one that comes while it is open.
async function withAlerts(page) {
  await page.route('**/info', async (route) => {
    const answer = await route.fetch();
    await route.fulfill({ response: answer, json: { ...await answer.json(), alerts: true } });
  });
  await page.route('**/alerts?*', (route) => route.fulfill({ json: { alerts: [alert(1, PARIS, '<b>concert</b>, music')], last: 1, version: 1, now: 0 } }));
  let sent = false;
  await page.route('**/events', (route) => {
    if (sent) return route.continue();
    sent = true;
    const data = JSON.stringify(alert(2, OSAKA, 'fire, smoke'));
    return route.fulfill({ contentType: 'text/event-stream', body: `event: alert\nid: 2\ndata: ${data}\n\n` });
  });
}

test('alerts appear on the map and in the list, and are flown to', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const page = await open(t, server.url, { hash: '#view=3/30/60', before: withAlerts });
  await until(page, () => document.querySelectorAll('.outline-alert').length === 2);
  await until(page, () => document.getElementById('announcer').textContent === 'Alert: fire, smoke');
  assert.equal(await page.textContent('#alert-count'), '1', 'the one that came');
  await page.click('#tab-alerts');
  assert.deepEqual(await texts(page, '#alert-list .title'), ['fire, smoke', '<b>concert</b>, music']);
  assert.ok(!(await page.isVisible('#alert-count')));

  await page.click('#alert-list li:nth-child(2) button');
  await until(page, () => location.hash.includes('view=11/48.'));
  await page.waitForTimeout(800);
  const rectangle = await page.locator('.outline-alert').nth(1).boundingBox();
  const other = await page.locator('.outline-alert').nth(0).boundingBox();
  const seen = [rectangle, other].find((box) => box && box.x > 0 && box.x + box.width < 928 && box.y > 60 && box.y + box.height < 700);
  assert.ok(seen && seen.width > 50, 'the rectangle is in view, beside the panel');
  await picture(page, 'alert');

  await page.keyboard.press('a');
  await until(page, () => location.hash.includes('view=11/34.'));
  assert.ok(Math.abs((await state(page)).view.longitude - 135.5) < 0.5);
});
