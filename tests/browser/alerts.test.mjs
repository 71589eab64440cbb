import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
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

const CITIES = [[48.857, 2.352], [51.507, -0.128], [52.52, 13.405], [40.417, -3.703], [41.893, 12.483], [50.85, 4.349], [43.296, 5.37]];
const LYON = { lat: 45.764, lon: 4.836 };

// Two hours of posts, four a minute in each city, up to a few minutes ago.
function quietHours() {
  const now = Date.now() * 1000 - 150e6;
  return Array.from({ length: 480 }, (_, i) => CITIES.map(([lat, lon]) =>
    ({ time: now - (480 - i) * 15e6, lat: lat + (i % 7) * 0.01, lon: lon + (i % 5) * 0.01, text: 'coffee and rain' }))).flat();
}

const covers = ({ south, west, north, east }, { lat, lon }) => south <= lat && lat <= north && west <= lon && lon <= east;

// An alert's rectangle is on the map, beside the panel and large enough to see.
const outlined = (page) => until(page, () => [...document.querySelectorAll('.outline-alert')].some((outline) => {
  const { left, right, top, bottom, width } = outline.getBoundingClientRect();
  return left > 0 && right < 928 && top > 60 && bottom < 700 && width > 50;
}));

test('a burst in the stream is found by the server, told to the page and flown to', async (t) => {
  const server = await Explorer.start(t, ['--json', '-']);
  const quiet = quietHours();
  server.feed(quiet);
  while ((await server.get('/count')).count < quiet.length) await new Promise((resolve) => setTimeout(resolve, 50));
  const page = await open(t, server.url, { hash: '#view=4/30/60' });
  await page.waitForTimeout(1500);
  assert.equal(await page.locator('.outline-alert').count(), 0, 'nothing has happened yet');
  server.feed(around({ ...LYON, count: 150, gap: 0.0001, text: () => 'smoke and sirens at the station' }));
  await until(page, () => /^Alert: .*(smoke|sirens|station).* near Lyon/.test(document.getElementById('announcer').textContent));
  const { alerts } = await server.get('/alerts');
  assert.equal(alerts.length, 1, JSON.stringify(alerts));
  assert.ok(covers(alerts[0].box, LYON) && alerts[0].rate > 4 * alerts[0].expected, JSON.stringify(alerts[0]));
  assert.equal(await page.locator('.outline-alert').count(), 1);

  await page.click('#tab-alerts');
  assert.deepEqual(await texts(page, '#alert-list .title'), [alerts[0].text]);
  await page.click('#alert-list li button');
  await until(page, () => /view=1[0-2]\/45\.[67]/.test(location.hash));
  const { view } = await state(page);
  assert.ok(Math.abs(view.latitude - LYON.lat) < 0.3 && Math.abs(view.longitude - LYON.lon) < 0.5, JSON.stringify(view));
  await outlined(page);
  await picture(page, 'alert-burst');
});

test('the bursts that are planted in the demo stream are listed, the latest first, and flown to', async (t) => {
  const server = await Explorer.start(t, ['--demo', '--rate', '30', '--prefill', '5400', '--horizon', '5400']);
  const end = Date.now() + 60000;
  let alerts = [];
  while (!alerts.length && Date.now() < end) ({ alerts } = await server.get('/alerts'));
  const page = await open(t, server.url);
  await page.keyboard.press('3');
  await until(page, () => document.querySelectorAll('#alert-list li').length > 0);
  ({ alerts } = await server.get('/alerts'));
  assert.ok(alerts.length > 0);
  const latest = alerts[0];
  await page.locator('#alert-list li button', { hasText: latest.text }).first().click();
  const middle = [(latest.box.south + latest.box.north) / 2, (latest.box.west + latest.box.east) / 2];
  await until(page, async ([latitude, longitude]) => {
    const { state: { view } } = await import('/js/state.js');
    return view?.zoom > 6 && Math.abs(view.latitude - latitude) < 1 && Math.abs(view.longitude - longitude) < 1;
  }, middle);
  await outlined(page);
});
