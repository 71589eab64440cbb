// The state of the stream: charts of the last minutes and a few facts.
import { Chart, binary } from './chart.js';
import { element, find } from './dom.js';
import { bytes, count, duration, moment, readable, seconds, short } from './format.js';

const micro = (value) => seconds(value === null ? null : value / 1e6);

const charts = [
  { chart: new Chart('Records', ['records'], short), values: ({ records }) => [records] },
  { chart: new Chart('Inserts per second', ['inserts'], short), values: ({ rate }) => [rate] },
  { chart: new Chart('Insert latency', ['p50', 'p99', 'max'], micro), values: ({ insert }) => [insert.p50, insert.p99, insert.max] },
  { chart: new Chart('Memory', ['store', 'process'], bytes, binary), values: ({ bytes: store, resident }) => [store, resident] },
];

const states = { filling: 'catching up', live: 'live', ended: 'ended', failed: 'failed' };

const facts = (stats) => [
  ['Source', `${readable(stats.source.name)}, ${states[stats.source.state] ?? stats.source.state}`],
  ['Clock', `${moment(stats.now)} UTC`],
  ['Inserted', count(stats.inserted)],
  ['Left the window', count(stats.evicted)],
  ['Refused', count(stats.refused)],
  ['Listeners', count(stats.listeners)],
  ['Running for', duration(stats.uptime)],
  ...(stats.cold ? [['Kept on disk', `${count(stats.cold.records)}, ${bytes(stats.cold.bytes)}`]] : []),
];

let table;

export function add(stats) {
  for (const { chart, values } of charts) chart.add(stats.wall / 1e6, values(stats));
  table.replaceChildren(...facts(stats).flatMap(([name, text]) => [element('dt', {}, name), element('dd', {}, text)]));
  find('bar-records').textContent = short(stats.records);
  find('bar-rate').textContent = short(stats.rate);
}

export const draw = () => charts.forEach(({ chart }) => chart.draw());

export function start() {
  table = element('dl.facts', { id: 'facts' });
  find('pane-stream').append(...charts.map(({ chart }) => chart.box), table);
  addEventListener('pane', draw);
  addEventListener('resize', draw);
}
