// The state as the part of the address behind '#', so that a link shows the same view, time, selection and settings.
import { debounced } from './dom.js';
import { defaults, on, set, state } from './state.js';

const number = (text) => (text !== '' && Number.isFinite(Number(text)) ? Number(text) : undefined);
const numbers = (text, length, separator = ',') => {
  const parts = text.split(separator).map(number);
  return parts.length === length && !parts.includes(undefined) ? parts : undefined;
};
const within = (value, least, most) => (value >= least && value <= most ? value : undefined);
const degrees = (value) => Number(value.toFixed(5));
const word = (text) => (/^[a-z]{1,16}$/.test(text) ? text : undefined);

function parsePlace(text) {
  const parts = numbers(text, 2);
  return parts && Math.abs(parts[0]) <= 90 && Math.abs(parts[1]) <= 180 ? { latitude: parts[0], longitude: parts[1] } : undefined;
}

// How each part of the state is written and read; what cannot be read is left as it is by default.
const codes = {
  view: {
    write: ({ zoom, latitude, longitude }) => `${zoom}/${degrees(latitude)}/${degrees(longitude)}`,
    read: (text) => {
      const [zoom, latitude, longitude] = numbers(text, 3, '/') ?? [];
      const fits = Number.isInteger(zoom) && zoom >= 0 && zoom <= 20 && Math.abs(latitude) <= 90 && Math.abs(longitude) <= 360;
      return fits ? { zoom, latitude, longitude } : undefined;
    },
  },
  box: {
    write: ({ south, west, north, east }) => [south, west, north, east].map(degrees).join(),
    read: (text) => {
      const [south, west, north, east] = numbers(text, 4) ?? [];
      const fits = south >= -90 && south <= north && north <= 90 && Math.abs(west) <= 180 && Math.abs(east) <= 180;
      return fits ? { south, west, north, east } : undefined;
    },
  },
  top: { write: ({ latitude, longitude }) => `${degrees(latitude)},${degrees(longitude)}`, read: parsePlace },
  at: { write: String, read: (text) => within(number(text), 0, 2 ** 53) },
  window: { write: String, read: (text) => within(number(text), 0, 1e9) },
  alpha: { write: String, read: (text) => within(number(text), 0, 1) },
  radius: { write: String, read: (text) => within(number(text), 1, 2e7) },
  period: { write: String, read: (text) => within(number(text), 1, 1e9) },
  k: { write: String, read: (text) => within(Math.round(number(text)), 1, 1000) },
  bins: { write: String, read: (text) => [0, 32, 64, 128, 256].find((bins) => bins === number(text)) },
  blur: { write: String, read: (text) => within(Math.round(number(text)), 0, 4) },
  colours: { write: String, read: word },
  scale: { write: String, read: word },
  theme: { write: String, read: word },
  tab: { write: String, read: word },
};

export function read(hash = location.hash) {
  const found = {};
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    const value = Object.hasOwn(codes, name) ? codes[name].read(text) : undefined;
    if (value !== undefined) found[name] = value;
  }
  return found;
}

export function write() {
  const parts = Object.keys(codes)
    .filter((name) => state[name] !== null && JSON.stringify(state[name]) !== JSON.stringify(defaults[name]))
    .map((name) => `${name}=${codes[name].write(state[name])}`);
  return `#${parts.join('&')}`;
}

// Follow the state with the address, and the address with the state (a link that is opened in the same tab).
export function start() {
  const names = Object.keys(codes);
  let written = location.hash;
  on(names, debounced(200, () => {
    written = write();
    history.replaceState(null, '', written);
  }));
  addEventListener('hashchange', () => {
    if (location.hash !== written) set({ ...defaults, ...read() });
  });
}
