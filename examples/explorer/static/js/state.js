// What the page shows, in one place: parts change it with set(), and hear of changes by on(). It lives in the address too (link.js).
export const defaults = {
  view: null, // { latitude, longitude, zoom }
  colours: 'inferno',
  scale: 'log',
  bins: 0, // a side of a tile; 0: by the zoom
  blur: 0,
  theme: 'auto', // auto, dark, light
  tab: 'selection',
  window: 0, // seconds before the end of the window; 0: all
  at: null, // where a paused window ends, microseconds; null: live
  box: null, // { south, west, north, east }
  top: null, // { latitude, longitude }
  alpha: 0.2,
  radius: 30000, // metres
  period: 10000, // seconds
  k: 20,
};

export const state = { ...defaults };

const hearers = [];

// Call `hear` whenever one of these names has changed.
export const on = (names, hear) => hearers.push([names, hear]);

export function set(changes) {
  const changed = Object.keys(changes).filter((name) => JSON.stringify(state[name]) !== JSON.stringify(changes[name]));
  Object.assign(state, changes);
  if (!changed.length) return;
  for (const [names, hear] of hearers) if (names.some((name) => changed.includes(name))) hear(changed);
}
