// What the colours mean: the ramp with its numbers, and the choice of colours, scale, grain and smoothness.
import { context, element, find } from './dom.js';
import { short } from './format.js';
import { on, set, state } from './state.js';

const GRAINS = [[0, 'by zoom'], [256, 'fine'], [128, 'medium'], [64, 'coarse'], [32, 'blocks']];
const BLURS = [[0, 'sharp'], [1, 'soft'], [2, 'softer'], [4, 'softest']];

let shown = null;

function drawRamp() {
  const canvas = find('legend-ramp');
  if (!shown || !canvas.offsetWidth) return;
  const { pen, width, height } = context(canvas);
  const ramp = pen.createLinearGradient(0, 0, width, 0);
  for (const { at, colour } of shown.stops) ramp.addColorStop(at, colour);
  pen.fillStyle = ramp;
  pen.fillRect(0, 0, width, height);
}

// Both ends, and what fits between them.
function drawMarks() {
  const { stops } = shown;
  const marks = [0, 2, 4, 6, 8].map((i) => stops[Math.round(i * (stops.length - 1) / 8)]);
  const spans = marks.map(({ at, value }) => {
    const span = element('span', {}, short(Number(value.toPrecision(2))));
    span.style.left = `${100 * at}%`;
    return span;
  });
  find('legend-marks').replaceChildren(...spans);
}

// The answer of /scale.
export function show(scale) {
  shown = scale;
  find('legend-title').textContent = scale.bins === 256 ? 'Records per pixel' : `Records per ${256 / scale.bins} × ${256 / scale.bins} pixels`;
  find('legend-ramp').setAttribute('aria-label', `Colours from ${short(scale.low)} to ${short(scale.high)} records, ${scale.scale} scale`);
  drawRamp();
  drawMarks();
}

// A select for one part of the state.
function choice(name, options) {
  const select = find(name);
  select.append(...options.map(([value, text]) => new Option(text, value)));
  const values = options.map(([value]) => value);
  const follow = () => {
    if (!values.includes(state[name])) set({ [name]: values[0] });
    select.value = state[name];
  };
  select.addEventListener('change', () => set({ [name]: values[select.selectedIndex] }));
  on([name], follow);
  follow();
}

export function start({ maps, scales }) {
  choice('colours', maps.map((name) => [name, name]));
  choice('scale', scales.map((name) => [name, name]));
  choice('bins', GRAINS);
  choice('blur', BLURS);
  const toggle = find('legend-toggle');
  toggle.addEventListener('click', () => toggle.setAttribute('aria-expanded', find('legend').classList.toggle('open')));
  addEventListener('resize', drawRamp);
}
