import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer } from './lib/explorer.mjs';
import { close, open, picture, until } from './lib/page.mjs';
import { countPixels, hot, lit, screen, tiles } from './lib/pixels.mjs';

after(close);
const DEMO = ['--demo', '--rate', '400', '--horizon', '1800'];
const drawn = () => [...document.querySelectorAll('.heat-tile')].some((tile) =>
  tile.getContext('2d').getImageData(0, 0, tile.width, tile.height).data.some((value, i) => i % 4 === 3 && value));

test('the map draws: land, sea and the heat of the stream', async (t) => {
  const server = await Explorer.start(t, DEMO);
  const page = await open(t, server.url);
  await until(page, drawn);
  await until(page, () => !document.querySelector('.leaflet-tile:not(.leaflet-tile-loaded)') && !document.querySelector('.leaflet-tile[style*="opacity: 0"]'));
  const pixels = await screen(page, { x: 250, y: 80, width: 650, height: 500 });
  const area = pixels.width * pixels.height;
  assert.ok(countPixels(pixels, hot) > area / 2000, 'heat');
  assert.ok(countPixels(pixels, (r, g, b) => r < 16 && g < 20 && b < 28) > area / 10, 'sea');
  assert.ok(countPixels(pixels, (r, g, b) => r > 20 && r < 30 && g > 26 && g < 38 && b > 36 && b < 52) > area / 10, 'land');
  await picture(page, 'map-dark');
});

test('tiles change as the stream runs, and none is blank meanwhile', async (t) => {
  const server = await Explorer.start(t, DEMO);
  const page = await open(t, server.url, { hash: '#view=5/50/8' });
  await until(page, drawn);
  const before = await tiles(page);
  await page.evaluate((least) => {
    window.fewest = Infinity;
    const look = () => {
      let count = 0;
      for (const tile of document.querySelectorAll('.leaflet-tile-loaded.heat-tile')) {
        const { data } = tile.getContext('2d').getImageData(0, 0, tile.width, tile.height);
        for (let i = 3; i < data.length; i += 4) if (data[i]) ++count;
      }
      window.fewest = Math.min(window.fewest, count);
      if (!window.enough) setTimeout(look, 100);
    };
    look();
    return least;
  });
  const requests = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.waitForTimeout(6000);
  const later = await tiles(page);
  const fewest = await page.evaluate(() => {
    window.enough = true;
    return window.fewest;
  });
  assert.notEqual(later.sum, before.sum);
  assert.ok(fewest > before.drawn / 2, `${fewest} of ${before.drawn} pixels were left at one moment`);
  assert.ok(requests.some((address) => address.includes('/tiles/5/')));
});

test('a store that does not change is not asked for tiles again', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest([{ time: Date.now() * 1000, lat: 48.8, lon: 2.3, text: 'one' }]);
  const page = await open(t, server.url);
  await until(page, drawn);
  await page.waitForTimeout(2500);
  let asked = 0;
  page.on('request', (request) => (asked += request.url().includes('/tiles/')));
  await page.waitForTimeout(3000);
  assert.equal(asked, 0);
});

test('colours, scale, grain and edges change the tiles and the legend', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(Array.from({ length: 300 }, (_, i) => ({ time: Date.now() * 1000, lat: 48 + (i % 17) / 20, lon: 2 + (i % 23) / 20, text: 'x' })));
  const page = await open(t, server.url, { hash: '#view=8/48.4/2.5' });
  await until(page, drawn);
  await page.click('#legend-toggle');
  for (const [id, value] of [['colours', 'viridis'], ['scale', 'linear'], ['bins', '32'], ['blur', '2']]) {
    const before = await tiles(page);
    const answer = page.waitForResponse((response) => response.url().includes('/scale'));
    await page.selectOption(`#${id}`, value);
    await answer;
    await page.waitForTimeout(500);
    assert.notEqual((await tiles(page)).sum, before.sum, id);
  }
  assert.equal(await page.textContent('#legend-title'), 'Records per 8 × 8 pixels');
  assert.equal(await page.locator('#legend-marks span').count(), 5);
  assert.match(new URL(page.url()).hash, /bins=32.*colours=viridis.*scale=linear/);
});

test('the map goes down to streets', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest([{ time: Date.now() * 1000, lat: 48.8566, lon: 2.3522, text: 'here' }]);
  const page = await open(t, server.url, { hash: '#view=19/48.8566/2.3522' });
  await until(page, drawn);
  assert.ok(countPixels(await screen(page, { x: 540, y: 300, width: 200, height: 200 }), lit) > 30);
});
