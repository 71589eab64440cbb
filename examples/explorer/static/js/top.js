// Top-k: the best records around a place that was clicked, by nearness and youth; sliders for how much of each.
import L from './leaflet.js';
import { latest } from './api.js';
import { debounced, element, find, slider } from './dom.js';
import { Dots } from './dots.js';
import { flyTo } from './fly.js';
import { duration, metres, position } from './format.js';
import { list } from './records.js';
import { on, set, state } from './state.js';
import * as tabs from './tabs.js';
import { range } from './time.js';
import { report } from './toast.js';

// 1, 2, 5, 10, ... times `unit`.
const steps125 = (least, most) => {
  const steps = [];
  for (let power = least; power <= most; power *= 10) steps.push(...[1, 2, 3, 5, 7].map((step) => step * power));
  return steps.filter((step) => step <= most);
};

const settings = [
  { id: 'alpha', label: 'α, weight of nearness', steps: Array.from({ length: 21 }, (_, i) => i / 20), text: (value) => value.toFixed(2) },
  { id: 'radius', label: 'R, reach', steps: steps125(100, 2e6), text: metres },
  { id: 'period', label: 'T, age', steps: [10, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 10000, 14400, 21600, 43200, 86400], text: duration },
  { id: 'k', label: 'k, records', steps: [1, 2, 3, 5, 10, 15, 20, 30, 50, 75, 100], text: String },
];
const names = settings.map(({ id }) => id);

let map, dots, parts;
const marks = L.layerGroup();
const ask = latest();

export const clear = () => set({ top: null });

export function at({ lat, lng }) {
  set({ top: { latitude: Math.max(-90, Math.min(90, lat)), longitude: L.latLng(lat, lng).wrap().lng } });
  tabs.open('top');
}

function build() {
  parts = {
    hint: element('p.hint', {}, 'Click on the map, or press T for the middle of the view, to find the records that are near and young.'),
    place: element('p.place'),
    clear: element('button', { type: 'button', onclick: clear, title: 'Esc' }, 'Clear'),
    records: element('div', { id: 'top-records' }),
    sliders: settings.map((setting) => slider({ ...setting, value: state[setting.id], change: (value) => set({ [setting.id]: value }) })),
  };
  find('pane-top').append(
    element('div.head', {}, element('div', {}, element('h2', {}, 'Best records near a place'), parts.place), parts.clear), parts.hint,
    element('div.sliders', {}, ...parts.sliders.map(({ row }) => row)), parts.records);
}

function mark() {
  marks.clearLayers();
  if (!state.top) return;
  const { latitude, longitude } = state.top;
  const centre = [latitude, longitude + 360 * Math.round((map.getCenter().lng - longitude) / 360)];
  L.circle(centre, { radius: state.radius, className: 'outline-reach', interactive: false }).addTo(marks);
  L.circleMarker(centre, { radius: 6, className: 'dot-centre', interactive: false }).addTo(marks);
}

function show() {
  parts.hint.hidden = Boolean(state.top);
  parts.clear.hidden = parts.place.hidden = !state.top;
  parts.sliders.forEach(({ set: place }, i) => place(state[names[i]]));
  mark();
  if (state.top) {
    parts.place.textContent = position(state.top.latitude, state.top.longitude);
  } else {
    parts.records.replaceChildren();
    dots.show([]);
  }
}

// Ask again: sliders moved, or the stream ran on (then a list that is pointed at stays as it is).
export async function refresh(anew = false) {
  if (!state.top || (!anew && parts.records.matches(':hover, :focus-within'))) return;
  const { top: { latitude: lat, longitude: lon }, alpha, radius, period, k } = state;
  try {
    const answer = await ask((get) => get('/topk', { lat, lon, alpha, radius, period, k, ...range() }), anew);
    if (!answer || !state.top) return;
    const none = element('p.hint', {}, `No records within ${metres(radius)} that are younger than ${duration(period)}.`);
    parts.records.replaceChildren(answer.records.length ? list(answer.records, { chosen: (record) => dots.choose(record), opened: (record) => flyTo(map, record) }) : none);
    dots.show(answer.records);
  } catch (error) {
    report(error);
  }
}

export function start(onMap) {
  map = onMap;
  marks.addTo(map);
  dots = new Dots(map, () => tabs.open('top'));
  build();
  const soon = debounced(60, () => refresh(true));
  on(['top', ...names], () => {
    show();
    soon();
  });
  on(['at', 'window'], soon);
  show();
  refresh(true);
}
