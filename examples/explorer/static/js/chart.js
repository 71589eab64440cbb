// A small line chart on a canvas: the last minutes of one or more series on a common axis that begins at 0.
import { colour, context, element } from './dom.js';

const SHORTEST = 60; // seconds across the chart at first,
const LONGEST = 300; // and at last
const PAD = { top: 14, bottom: 4 };

// The next of 1, 2, 5, 10, ... times a power of ten above a number, or the next power of two.
export const decimal = (number) => {
  const power = 10 ** Math.floor(Math.log10(number));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= number);
};
export const binary = (number) => 2 ** Math.ceil(Math.log2(number));

export class Chart {
  // `names`: of the series; `format`: of their values; `ceiling`: where the axis ends.
  constructor(title, names, format, ceiling = decimal) {
    Object.assign(this, { title, names, format, ceiling });
    this.samples = []; // [seconds, value, value, ...]
    this.values = names.map(() => element('b', {}, '–'));
    const keys = names.map((name, i) => element('span.keyed', {}, ...(names.length > 1 ? [element('i'), name, ' '] : []), this.values[i]));
    this.canvas = element('canvas', { role: 'img' });
    this.box = element('figure.chart', {},
      element('figcaption.chart-head', {}, element('h3', {}, title), element('div.values', {}, ...keys)), this.canvas);
  }

  add(seconds, values) {
    this.samples.push([seconds, ...values]);
    while (this.samples[0][0] < seconds - LONGEST) this.samples.shift();
    const texts = values.map((value) => this.format(value));
    texts.forEach((text, i) => (this.values[i].textContent = text));
    this.canvas.setAttribute('aria-label', `${this.title} over the last minutes; now ${texts.map((text, i) => `${this.names[i]} ${text}`).join(', ')}`);
    this.draw();
  }

  draw() {
    if (!this.canvas.isConnected || !this.canvas.offsetWidth || !this.samples.length) return;
    const { pen, width, height } = context(this.canvas);
    const last = this.samples.at(-1)[0];
    const most = Math.max(...this.samples.flatMap(([, ...values]) => values.filter(Number.isFinite)), 0);
    const top = most > 0 ? this.ceiling(most) : 1;
    const span = Math.max(SHORTEST, last - this.samples[0][0]);
    const x = (seconds) => (width - 4) * (1 - (last - seconds) / span);
    const y = (value) => height - PAD.bottom - (height - PAD.top - PAD.bottom) * value / top;
    this.drawAxis(pen, width, y, top);
    this.names.forEach((name, i) => this.drawSeries(pen, i, x, y));
  }

  drawAxis(pen, width, y, top) {
    pen.strokeStyle = colour('--line');
    pen.lineWidth = 1;
    for (const share of [0, 0.5, 1]) {
      const at = Math.round(y(share * top)) + 0.5;
      pen.beginPath();
      pen.moveTo(0, at);
      pen.lineTo(width, at);
      pen.stroke();
    }
    pen.fillStyle = colour('--quiet');
    pen.font = '10px system-ui, sans-serif';
    pen.textBaseline = 'bottom';
    pen.fillText(this.format(top), 4, y(top));
  }

  drawSeries(pen, i, x, y) {
    const points = this.samples.filter((sample) => Number.isFinite(sample[i + 1])).map((sample) => [x(sample[0]), y(sample[i + 1])]);
    if (!points.length) return;
    pen.strokeStyle = pen.fillStyle = colour(`--series-${i + 1}`);
    pen.lineWidth = 1.6;
    pen.lineJoin = 'round';
    pen.beginPath();
    points.forEach(([px, py], n) => (n ? pen.lineTo(px, py) : pen.moveTo(px, py)));
    pen.stroke();
    if (this.names.length === 1) {
      pen.lineTo(points.at(-1)[0], y(0));
      pen.lineTo(points[0][0], y(0));
      pen.globalAlpha = 0.15;
      pen.fill();
      pen.globalAlpha = 1;
    }
    pen.beginPath();
    pen.arc(...points.at(-1), 2.2, 0, 2 * Math.PI);
    pen.fill();
  }
}
