// The page in Chromium. What it must never do is watched in every test: errors, and requests to anything but its own server.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { defer } from './defer.mjs';

const FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];
const PATIENCE_MS = 30000;
const PICTURES = process.env.PICTURES;

let browser = null;

// Open the explorer at `url`; `options` are those of a Playwright context, `quiet: false` for tests in which errors are meant to happen,
// `before(page)` comes before its first request.
export async function open(t, url, { hash = '', quiet = true, before = null, ...options } = {}) {
  browser ??= await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: 'dark', reducedMotion: 'no-preference', ...options });
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  const seen = { errors: [], outside: [] };
  page.on('console', (message) => {
    const ours = message.text().includes('willReadFrequently'); // the tests read pixels
    if (['error', 'warning'].includes(message.type()) && !ours) seen.errors.push(message.text());
  });
  page.on('pageerror', (error) => seen.errors.push(String(error)));
  page.on('request', (request) => {
    const address = request.url();
    if (!address.startsWith(`${url}/`) && !/^(data|blob):/.test(address)) seen.outside.push(address);
  });
  defer(t, async () => {
    await context.close();
    assert.deepEqual(seen.outside, [], 'requests to other servers');
    if (quiet) assert.deepEqual(seen.errors, [], 'errors on the console');
  });
  await before?.(page);
  await page.goto(`${url}/${hash}`);
  await page.waitForSelector('html[data-ready]');
  return page;
}

export async function close() {
  await browser?.close();
  browser = null;
}

// Wait until `check(argument)`, run in the page, is true.
export const until = (page, check, argument) => page.waitForFunction(check, argument, { timeout: PATIENCE_MS, polling: 100 });

export const texts = (page, selector) => page.locator(selector).evaluateAll((found) => found.map(({ textContent }) => textContent));

export const state = (page) => page.evaluate(async () => ({ ...(await import('/js/state.js')).state }));

// Keep a picture of the page where PICTURES names a folder.
export async function picture(page, name) {
  if (!PICTURES) return;
  mkdirSync(PICTURES, { recursive: true });
  await page.screenshot({ path: `${PICTURES}/${name}.png` });
}
