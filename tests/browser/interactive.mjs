// How long the page needs until it can be used: node tests/browser/interactive.mjs URL TIMES. A number of milliseconds a line, each from a
// fresh browser context.
import { chromium } from 'playwright-core';

const [url, times] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--headless', '--no-sandbox', '--disable-gpu'] });
try {
  for (let i = 0; i < Number(times); ++i) {
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
    await page.goto(url);
    await page.waitForSelector('html[data-ready]');
    console.log(await page.getAttribute('html', 'data-ready'));
    await page.waitForTimeout(2000); // it draws its tiles
    await page.context().close();
  }
} finally {
  await browser.close();
}
