import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { Explorer, around } from './lib/explorer.mjs';
import { close, open, picture, texts, until } from './lib/page.mjs';

after(close);
const TEXTS = [
  '<img src=x onerror="window.broken=1">',
  '<script>window.broken=2</script>',
  '"><svg onload=window.broken=3>',
  '<style>*{display:none}</style>',
  '<a href="javascript:window.broken=4">press</a>',
  '&lt;b&gt; &amp; &#x3c;',
  "'; window.broken=5; //",
  'one\u0000two\u0007three\u001b[31mfour\u007f',
  'from \u202eright to left\u202c',
  'zero\u200bwidth',
  `${'\u0301'.repeat(60)}marks`,
  'https://example.org/picture.png',
  '{{constructor.constructor("window.broken=6")()}}',
];
// A NUL would end the text of a record: it is read as a space.
const SHOWN = [...TEXTS];
SHOWN[7] = 'one two\u2407three\u241b[31mfour\u2421';
SHOWN[8] = 'from \ufffdright to left\ufffd';
SHOWN[9] = 'zero\ufffdwidth';

test('markup and control characters of the stream show as text', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  await server.ingest(around({ lat: 10, lon: 10, count: TEXTS.length, text: (i) => TEXTS[i] }));
  const page = await open(t, server.url, { hash: '#view=10/10/10&box=9,9,11,11' });
  await until(page, (count) => document.querySelectorAll('#selection-records li').length === count, TEXTS.length);
  const shown = await texts(page, '#selection-records .text');
  assert.deepEqual(shown.reverse(), SHOWN);
  await picture(page, 'hostile');
  await page.keyboard.press('t');
  await page.waitForSelector('#top-records li');
  assert.equal(await page.locator(':is(#pane-selection, #pane-top) :is(img, script, style, a, b, svg)').count(), 0);
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.ok(await page.isVisible('#pane-top'));
});

test('a permalink that is nonsense leaves the page as it is by default', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const hash = '#view=<b>/1/2&box=1,2,3&at=-5&alpha=9&radius=NaN&k=1e9&colours=<img>&scale=x&theme=javascript&tab=none&__proto__=1&constructor=2';
  const page = await open(t, server.url, { hash });
  assert.ok(await page.isVisible('#pane-selection'));
  assert.equal(await page.inputValue('#colours'), 'inferno');
});

test('the policy of the page allows its own files only', async (t) => {
  const server = await Explorer.start(t, ['--empty']);
  const answer = await fetch(`${server.url}/`);
  const policy = answer.headers.get('content-security-policy');
  assert.match(policy, /default-src '(none|self)'/);
  assert.doesNotMatch(policy, /unsafe|\*|https?:/);
  assert.doesNotMatch(await answer.text(), /<script(?![^>]*src=)|\son[a-z]+=|\sstyle=|javascript:/);
});
