// The heat map while the stream runs: drawn anew when the store has changed, never faster than it can be drawn, with its legend.
import { get } from './api.js';
import { HeatLayer } from './heat-layer.js';
import * as legend from './legend.js';
import { on, state } from './state.js';
import { paused, range } from './time.js';
import { report } from './toast.js';

const LEAST_MS = 1000; // between two drawings

let map, layer;
let version = 0; // of the store, as told by the server
let drawn = -1; // the version that is shown: of the tiles the oldest, for one that takes the server long may be of a while ago
let timer = 0;
let last = 0; // when a drawing ended
let cost = 0; // milliseconds that it took

// Closer up records lie further apart: larger squares keep them visible.
const grain = (zoom) => (zoom <= 4 ? 256 : zoom <= 8 ? 128 : zoom <= 13 ? 64 : 32);

const look = (zoom) => ({ map: state.colours, scale: state.scale, bins: state.bins || grain(zoom), blur: state.blur, ...range() });

async function scale() {
  try {
    const z = Math.round(map.getZoom()); // in flight it is between two
    legend.show(await get('/scale', { z, ...look(z) }));
  } catch (error) {
    report(error);
  }
}

async function redraw() {
  timer = 0;
  if (document.hidden) return;
  const begin = performance.now();
  const at = version;
  await Promise.all([layer.refresh(), scale()]);
  last = performance.now();
  cost = last - begin;
  drawn = Math.min(at, layer.shown);
  if (drawn !== version && !paused()) plan();
}

// Twice the time that a drawing takes lies between two of them, so that a slow server is not kept busy with pictures alone.
function plan(wait = Math.max(LEAST_MS, 2 * cost)) {
  if (!timer) timer = setTimeout(redraw, Math.max(0, last + wait - performance.now()));
}

// The store has a new version.
export function changed(to) {
  version = to;
  if (version !== drawn && !paused() && !document.hidden) plan();
}

function again() {
  clearTimeout(timer);
  timer = 0;
  redraw();
}

export function start(onMap) {
  map = onMap;
  layer = new HeatLayer(look, report, { maxZoom: map.getMaxZoom(), updateWhenIdle: false, updateWhenZooming: false, keepBuffer: 1 }).addTo(map);
  on(['colours', 'scale', 'bins', 'blur', 'at', 'window'], again);
  map.on('zoomend', scale);
  document.addEventListener('visibilitychange', () => document.hidden || again());
  scale();
  return layer;
}
