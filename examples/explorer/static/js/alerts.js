// Alerts: rectangles on the map as they come, and a list whose entries fly there.
import L from './leaflet.js';
import { get } from './api.js';
import { element, find } from './dom.js';
import { flyToBounds } from './fly.js';
import { clock, readable, short } from './format.js';
import { boundsOf } from './rubber.js';
import { state } from './state.js';
import * as tabs from './tabs.js';
import { report, toast } from './toast.js';

const KEPT = 100;
const BRIGHT = 10; // of the newest, whose rectangles stand out
const FRESH_MS = 5000;
const LOOK_ZOOM = 11;

const kinds = { jump: 'jump', rate: 'high rate', share: 'high share', fence: 'fence entered' };

let map, box, empty;
let known = []; // newest first: { alert, layer, item }
let unseen = 0;

export function fly(entry) {
  flyToBounds(map, boundsOf(entry.alert.box, map), LOOK_ZOOM);
  if (tabs.small()) tabs.fold();
}

export const flyToLatest = () => (known.length ? fly(known[0]) : toast('There are no alerts yet.'));

function title({ kind, text }) {
  return readable(text ?? '') || kinds[kind] || readable(kind);
}

function describe({ kind, rate, expected, time }) {
  const usual = expected > 0 ? `, usually ${short(expected)}/s` : '';
  return `${clock(time)} UTC · ${kinds[kind] ?? readable(kind)}${usual}`;
}

function make(alert, fresh) {
  const layer = L.rectangle(boundsOf(alert.box, map), { className: `outline-alert${fresh ? ' fresh' : ''}`, bubblingMouseEvents: false });
  const button = element('button', { type: 'button' }, element('span.title', {}, title(alert)),
    element('span.rate', {}, `${short(alert.rate)}/s`), element('span.sub', {}, describe(alert)));
  const entry = { alert, layer: layer.addTo(map), item: element('li', {}, button) };
  button.addEventListener('click', () => fly(entry));
  layer.on('click', () => fly(entry));
  if (fresh) setTimeout(() => layer._path?.classList.remove('fresh'), FRESH_MS);
  return entry;
}

// An alert has come; those that are known already (after a new connection) are not added twice.
export function add(alert, fresh = true) {
  if (known.some((entry) => entry.alert.id === alert.id)) return;
  const entry = make(alert, fresh);
  known = [entry, ...known].sort((a, b) => b.alert.id - a.alert.id);
  while (known.length > KEPT) known.pop().layer.remove();
  known.forEach(({ layer }, i) => layer._path?.classList.toggle('old', i >= BRIGHT));
  box.replaceChildren(...known.map(({ item }) => item));
  empty.hidden = true;
  if (fresh) {
    find('announcer').textContent = `Alert: ${title(alert)}`;
    if (state.tab !== 'alerts') ++unseen;
  }
  count();
}

function count() {
  if (state.tab === 'alerts') unseen = 0;
  const badge = find('alert-count');
  badge.hidden = !unseen;
  badge.textContent = unseen > 99 ? '99+' : unseen;
}

// Those that came before the page, or while the connection was lost.
export async function load() {
  try {
    const { alerts } = await get('/alerts', { limit: KEPT });
    alerts.reverse().forEach((alert) => add(alert, false));
  } catch (error) {
    report(error);
  }
}

// Some servers look for no bursts.
export function allow(allowed) {
  if (!allowed) empty.textContent = 'This server does not look for bursts.';
}

export function start(onMap) {
  map = onMap;
  empty = element('p.hint', {}, 'No alerts yet. Where records suddenly come much faster than before, a rectangle appears on the map and an entry here.');
  box = element('ol.alerts', { id: 'alert-list' });
  find('pane-alerts').append(element('h2', {}, 'Bursts in the stream'), empty, box);
  addEventListener('pane', count);
}
