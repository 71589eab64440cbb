// Numbers, times and places as people read them. Times are microseconds since 1970, UTC.
const whole = new Intl.NumberFormat('en');
const compact = new Intl.NumberFormat('en', { notation: 'compact', maximumSignificantDigits: 3 });

export const count = (number) => (number === null || number === undefined ? '–' : whole.format(Math.round(number)));
export const short = (number) => (number === null || number === undefined ? '–' : compact.format(number));

export function bytes(number) {
  if (number === null || number === undefined) return '–';
  const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
  const step = number < 1 ? 0 : Math.min(units.length - 1, Math.floor(Math.log2(number) / 10));
  return `${Number((number / 1024 ** step).toPrecision(3))} ${units[step]}`;
}

export function seconds(value) {
  if (value === null || value === undefined) return '–';
  if (value < 1e-3) return `${Number((value * 1e6).toPrecision(3))} µs`;
  if (value < 1) return `${Number((value * 1e3).toPrecision(3))} ms`;
  return `${Number(value.toPrecision(3))} s`;
}

// A length of time: 45 s, 12 min, 2 h 30 min, 3 d 4 h.
export function duration(value) {
  const total = Math.round(value);
  const units = [[86400, 'd'], [3600, 'h'], [60, 'min'], [1, 's']];
  const first = Math.max(0, units.findIndex(([size]) => total >= size));
  if (total < 1) return `${Number(value.toFixed(1))} s`;
  const [size, name] = units[first];
  const head = Math.floor(total / size);
  const next = units[first + 1];
  const rest = next ? Math.round((total - head * size) / next[0]) : 0;
  if (next && rest * next[0] >= size) return `${head + 1} ${name}`;
  return rest ? `${head} ${name} ${rest} ${next[1]}` : `${head} ${name}`;
}

export const metres = (value) => (value < 1000 ? `${Math.round(value)} m` : `${Number((value / 1000).toPrecision(3))} km`);

const pad = (number) => String(number).padStart(2, '0');
export function clock(time) {
  const date = new Date(time / 1000);
  return `${pad(date.getUTCHours())}:${pad(date.getUTCMinutes())}:${pad(date.getUTCSeconds())}`;
}
export const moment = (time) => `${new Date(time / 1000).toISOString().slice(0, 10)} ${clock(time)}`;

export const position = (latitude, longitude) =>
  `${Math.abs(latitude).toFixed(3)}° ${latitude < 0 ? 'S' : 'N'}, ${Math.abs(longitude).toFixed(3)}° ${longitude < 0 ? 'W' : 'E'}`;

// Text of the stream as one can read it: control characters and marks that turn the writing direction appear as their symbols.
export const readable = (text) => text
  .replace(/[\u0000-\u0008\u000b-\u001f]/g, (found) => String.fromCharCode(0x2400 + found.charCodeAt(0)))
  .replace(/[\u007f]/g, '\u2421')
  .replace(/[\u0080-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g, '\ufffd');
