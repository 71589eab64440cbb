// The selection: a rectangle on the map, how many records it holds, what they speak of and when, and the records page by page.
import L from './leaflet.js';
import { box as boxText, latest } from './api.js';
import { element, find } from './dom.js';
import { Dots } from './dots.js';
import { flyTo } from './fly.js';
import { count, metres, position, readable } from './format.js';
import { list, pager } from './records.js';
import { Rubber, boundsOf, boxOf } from './rubber.js';
import { on, set, state } from './state.js';
import * as tabs from './tabs.js';
import { range } from './time.js';
import { report } from './toast.js';

const PAGE = 20;
const WORDS = 6;
const SHARE = 0.6; // of the view that the keyboard's selection takes

let map, rubber, outline, dots, parts;
let page = 0;
let cursors = [null]; // where each page begins, as far as they have been turned
const ask = latest();

export const dragged = () => rubber.dragged;
export function clear() {
  rubber.arm(false);
  set({ box: null });
}

export function select(box) {
  set({ box });
  tabs.open('selection');
}

export const selectMiddle = () => select(boxOf(map.getBounds().pad((SHARE - 1) / 2)));

function describe({ south, west, north, east }) {
  const [right, middle] = [east < west ? east + 360 : east, (south + north) / 2];
  const width = map.distance([middle, west], [middle, right]);
  const height = map.distance([south, west], [north, west]);
  return `${metres(width)} × ${metres(height)} around ${position(middle, ((west + right) / 2 + 540) % 360 - 180)}`;
}

function build() {
  const button = (text, onclick, title) => element('button', { type: 'button', onclick, title }, text);
  parts = {
    empty: element('div', {}, element('h2', {}, 'Nothing selected'),
      element('p.hint', {}, 'Drag a rectangle on the map with shift held down, or press S, to see how many records it holds and what they say.')),
    full: element('div.stack', { hidden: true }),
    figure: element('p.figure', { id: 'selection-count' }),
    place: element('p.place'),
    words: element('div.words'),
    pages: element('div'),
    records: element('div', { id: 'selection-records' }),
    clear: button('Clear', clear, 'Esc'),
  };
  const head = element('div', { 'aria-live': 'polite' }, parts.figure, element('h3', {}, 'records in the selection'), parts.place);
  parts.full.append(head, parts.words, parts.pages, parts.records);
  const actions = element('div.actions', {}, button('Draw', () => rubber.arm(), 'Draw a rectangle: drag on the map'),
    button('Middle of the view', selectMiddle, 'S'), parts.clear);
  find('pane-selection').append(parts.empty, actions, parts.full);
}

function show() {
  const { box } = state;
  parts.empty.hidden = Boolean(box);
  parts.full.hidden = parts.clear.hidden = !box;
  outline?.remove();
  dots.show([]);
  if (!box) return;
  outline = L.rectangle(boundsOf(box, map), { className: 'outline-selection', interactive: false }).addTo(map);
  parts.place.textContent = describe(box);
  parts.figure.textContent = '…';
  for (const part of [parts.pages, parts.records, parts.words]) part.replaceChildren();
  restart();
}

function restart() {
  page = 0;
  cursors = [null];
  refresh(true);
}

function turn(to) {
  page = to;
  refresh(true);
}

function wordBars({ groups }) {
  if (!groups.length) return [];
  const row = ({ word, count: records }) => {
    const bar = element('i', { 'aria-hidden': 'true' });
    bar.style.width = `${100 * records / groups[0].count}%`;
    return element('li', {}, element('span.word', {}, readable(word)), element('span', {}, count(records)), bar);
  };
  return [element('h3', {}, 'Words in the newest of them'), element('ul.bars', {}, ...groups.map(row))];
}

// Ask again, as the stream runs on. A page that has been turned to stays as it is, and so does a list that is pointed at, unless `anew`.
export async function refresh(anew = false) {
  if (!state.box) return;
  const what = { box: boxText(state.box), ...range() };
  const held = !anew && (page > 0 || parts.records.matches(':hover, :focus-within'));
  try {
    const answer = await ask((get) => Promise.all([get('/count', what), get('/aggregate', { ...what, by: 'word', k: WORDS }),
      held ? null : get('/records', { ...what, limit: PAGE, after: cursors[page] })]), anew);
    if (!answer || !state.box) return;
    const [{ count: total }, words, records] = answer;
    parts.figure.textContent = count(total);
    parts.words.replaceChildren(...wordBars(words));
    if (records) showRecords(records, total);
  } catch (error) {
    report(error);
  }
}

function showRecords({ records, next }, total) {
  cursors[page + 1] = next;
  parts.records.replaceChildren(list(records, { chosen: (record) => dots.choose(record), opened: (record) => flyTo(map, record) }));
  parts.pages.replaceChildren(...(total > PAGE ? [pager(page, PAGE, total, next !== null, turn)] : []));
  dots.show(records);
}

export function start(onMap) {
  map = onMap;
  rubber = new Rubber(map, select);
  dots = new Dots(map, () => tabs.open('selection'));
  build();
  on(['box'], show);
  on(['at', 'window'], restart);
  show();
}
