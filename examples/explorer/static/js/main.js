// The page: puts its parts together.
import L from './leaflet.js';
import * as alerts from './alerts.js';
import { get } from './api.js';
import { Basemap } from './basemap.js';
import { calm, find } from './dom.js';
import { listen } from './events.js';
import * as heat from './heat.js';
import * as legend from './legend.js';
import * as link from './link.js';
import { Places } from './places.js';
import * as selection from './selection.js';
import * as shortcuts from './shortcuts.js';
import { on, set, state } from './state.js';
import * as stream from './stream.js';
import * as tabs from './tabs.js';
import * as theme from './theme.js';
import * as time from './time.js';
import { report, toast } from './toast.js';
import * as top from './top.js';

const MAX_ZOOM = 20;
const ASK_MS = 2000; // between two questions about the selection and the best records
const START = { zoom: 3, latitude: 28, longitude: 10 };
const HOURS = 3; // kept by default; what the time line spans before the server has told

function createMap() {
  const { zoom, latitude, longitude } = state.view ?? { ...START, zoom: tabs.small() ? 1 : START.zoom };
  const still = calm();
  const map = L.map('map', {
    boxZoom: false, center: [latitude, longitude], zoom, minZoom: 1, maxZoom: MAX_ZOOM, worldCopyJump: true, keyboardPanDelta: 120,
    zoomAnimation: !still, fadeAnimation: false, markerZoomAnimation: !still, inertia: !still, attributionControl: false,
  });
  map.createPane('base').style.zIndex = 150;
  map.createPane('places').style.zIndex = 450;
  L.control.scale({ position: 'bottomleft', imperial: false }).addTo(map);
  L.control.attribution({ position: 'bottomleft', prefix: false }).addTo(map);
  return map;
}

async function addBasemap(map) {
  const data = await get('basemap.json');
  const base = new Basemap(data, { pane: 'base', attribution: 'Natural Earth through world-atlas' }).addTo(map);
  new Places(data.places, { attribution: 'GeoNames, CC BY 4.0' }).addTo(map);
  return base;
}

function followView(map) {
  map.on('moveend', () => {
    const { lat, lng } = map.getCenter();
    set({ view: { zoom: map.getZoom(), latitude: lat, longitude: L.latLng(lat, lng).wrap().lng } });
  });
  on(['view'], () => {
    const { zoom, latitude, longitude } = state.view ?? START;
    const centre = L.latLng(map.getCenter().lat, map.getCenter().lng).wrap();
    if (zoom !== map.getZoom() || centre.distanceTo([latitude, longitude]) > 1) map.setView([latitude, longitude], zoom);
  });
}

function showConnection(kind, seconds) {
  const box = find('connection');
  const texts = { connecting: 'connecting', live: time.paused() ? 'paused' : 'live', lost: `connection lost, again in ${Math.ceil(seconds)} s` };
  box.dataset.state = kind === 'live' && time.paused() ? 'paused' : kind;
  box.querySelector('.text').textContent = texts[kind];
}

let kind = 'connecting'; // of the connection

function connect(info) {
  const tell = (to, seconds) => {
    if (to === 'live' && kind !== 'live' && info.alerts) alerts.load();
    showConnection(kind = to, seconds);
  };
  on(['at'], () => showConnection(kind));
  listen('/events', {
    stats: (stats) => {
      stream.add(stats);
      time.tick(stats.now, stats.oldest ?? stats.now - (info.horizon ?? HOURS * 3600) * 1e6);
      heat.changed(stats.version);
    },
    version: ({ version }) => heat.changed(version),
    alert: (alert) => alerts.add(alert),
  }, tell);
}

// What the selection, the best records and the time line show is asked for again while the stream runs.
function keepAsking() {
  setInterval(() => {
    if (document.hidden || time.paused() || kind !== 'live') return;
    selection.refresh();
    top.refresh();
  }, ASK_MS);
}

async function copyLink() {
  try {
    await navigator.clipboard.writeText(location.origin + location.pathname + link.write());
    toast('The link to this view is copied.');
  } catch {
    toast('The browser does not let the page copy: the link to this view is in the address bar.');
  }
}

function clear() {
  selection.clear();
  top.clear();
}

function startKeys(map) {
  const middle = () => map.getCenter();
  const pane = (name) => () => {
    tabs.open(name);
    find(`tab-${name}`).focus();
  };
  shortcuts.start({
    s: selection.selectMiddle, t: () => top.at(middle()), a: alerts.flyToLatest, d: theme.next, m: () => find('map').focus(), Escape: clear,
    ' ': time.togglePause, '[': () => time.step(-1), ']': () => time.step(1),
    1: pane('selection'), 2: pane('top'), 3: pane('alerts'), 4: pane('stream'),
  });
}

async function start() {
  Object.assign(state, link.read());
  const map = createMap();
  let base = null;
  theme.start(() => {
    base?.redraw();
    stream.draw();
    time.draw();
  });
  tabs.start();
  time.start();
  stream.start();
  selection.start(map);
  top.start(map);
  alerts.start(map);
  map.on('click', ({ latlng }) => selection.dragged() || top.at(latlng));
  followView(map);
  link.start();
  startKeys(map);
  // The address behind '#' is the state: this link must not change it.
  document.querySelector('.skip').addEventListener('click', (event) => {
    event.preventDefault();
    find('map').focus();
  });
  find('copy-link').addEventListener('click', copyLink);

  const [info] = await Promise.all([get('/info'), addBasemap(map).then((layer) => (base = layer))]);
  legend.start(info);
  heat.start(map);
  alerts.allow(info.alerts);
  connect(info);
  keepAsking();
  document.documentElement.dataset.ready = Math.round(performance.now());
}

start().catch(report);
