// The time window that everything on the page is asked for, and the timeline that moves it.
import { context, colour, debounced, find } from './dom.js';
import { box, get } from './api.js';
import { clock as clockText, duration, moment } from './format.js';
import { on, set, state } from './state.js';
import { report } from './toast.js';

const SECOND = 1e6;
const WINDOWS = [0, 60, 300, 900, 3600, 3 * 3600, 6 * 3600, 24 * 3600];
const STEPS = 1000; // of the slider
const BARS = 120; // about so many
const BARS_MS = 5000; // until they are asked for again

// What the server said last: its clock, and the oldest time that it still keeps.
const stream = { now: null, oldest: null };

// The window as the server takes it.
export function range() {
  return { to: state.at, last: state.window || null };
}

export const paused = () => state.at !== null;

const span = () => Math.max(SECOND, stream.now - stream.oldest);
const stepLength = () => (state.window ? state.window * SECOND / 2 : span() / 20);

export function togglePause() {
  if (stream.now !== null) set({ at: paused() ? null : stream.now });
}

// Move the end of the window by half a window; past the newest record the window is live again.
export function step(direction) {
  if (stream.now === null) return;
  const to = (state.at ?? stream.now) + direction * stepLength();
  set({ at: to >= stream.now ? null : Math.round(Math.max(stream.oldest, to)) });
}

let sliding = false; // the user holds the slider

const share = (time) => Math.max(0, Math.min(1, (time - stream.oldest) / span()));

function label() {
  if (!paused()) return state.window ? `live, the last ${duration(state.window)}` : 'live';
  const end = `until ${moment(state.at)}`;
  return state.window ? `${duration(state.window)} ${end}` : end;
}

function show() {
  const slider = find('time');
  const known = stream.now !== null;
  const end = paused() ? state.at : stream.now;
  slider.disabled = !known;
  if (known && !sliding) slider.value = Math.round(STEPS * share(end));
  slider.setAttribute('aria-valuetext', label());
  find('time-label').textContent = label();
  find('time-oldest').textContent = known ? clockText(stream.oldest) : '';
  find('time-newest').textContent = known ? clockText(stream.now) : '';
  find('step-forward').disabled = !paused();
  const button = find('pause');
  button.setAttribute('aria-label', paused() ? 'Go on live' : 'Pause');
  button.querySelector('use').setAttribute('href', paused() ? '#i-play' : '#i-pause');
  draw();
}

// The arrivals over time, in the selection if there is one, as bars; those of the window are lit.
let bars = [];
let asked = -Infinity;

async function askBars() {
  const step = Math.max(1, Math.ceil(span() / SECOND / BARS));
  const { groups } = await get('/aggregate', { by: 'time', step, box: state.box && box(state.box) });
  bars = groups.map(({ from, count }) => ({ start: from, end: from + step * SECOND, count }));
  draw();
}

export function draw() {
  const { pen, width, height } = context(find('histogram'));
  if (stream.now === null) return;
  const end = state.at ?? stream.now;
  const [left, right] = [state.window ? share(end - state.window * SECOND) : 0, share(end)];
  const most = Math.max(1, ...bars.map(({ count }) => count));
  const [lit, dim] = [colour('--accent'), colour('--line')];
  for (const { start, end, count } of bars) {
    const [a, b] = [share(start), share(end)];
    const tall = Math.max(1, height * count / most);
    pen.fillStyle = (a + b) / 2 >= left && (a + b) / 2 <= right ? lit : dim;
    pen.fillRect(a * width, height - tall, Math.max(1, (b - a) * width - 1), tall);
  }
}

// The server's clock moved; the slider follows unless it is paused.
export function tick(now, oldest) {
  Object.assign(stream, { now, oldest: Math.min(oldest, now) });
  show();
  if (document.hidden || performance.now() - asked < BARS_MS) return;
  asked = performance.now();
  askBars().catch(report);
}

export function start() {
  const chooser = find('window');
  chooser.append(...WINDOWS.map((length) => new Option(length ? duration(length) : 'all', length)));
  const settings = () => {
    if (!WINDOWS.includes(state.window)) chooser.append(new Option(duration(state.window), state.window));
    chooser.value = state.window;
    show();
  };
  chooser.addEventListener('change', () => set({ window: Number(chooser.value) }));
  find('pause').addEventListener('click', togglePause);
  find('step-back').addEventListener('click', () => step(-1));
  find('step-forward').addEventListener('click', () => step(1));
  const slider = find('time');
  const move = debounced(40, (place) => set({ at: place >= STEPS ? null : Math.round(stream.oldest + span() * place / STEPS) }));
  slider.addEventListener('input', () => {
    sliding = true;
    move(Number(slider.value)); // by then a tick may have moved it
  });
  slider.addEventListener('change', () => (sliding = false));
  on(['at', 'window'], settings);
  on(['box'], () => (asked = -Infinity));
  settings();
}
